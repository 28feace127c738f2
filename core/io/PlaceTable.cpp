// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/PlaceTable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <initializer_list>

namespace reflet {

namespace {

constexpr std::size_t kMostColumns = 1000;

std::string_view trimmed(std::string_view text) {
    const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    while (!text.empty() && blank(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && blank(text.back()))
        text.remove_suffix(1);
    return text;
}

std::string lower(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return out;
}

/// "Height [m]" is "height".
std::string columnName(std::string_view text) {
    text = text.substr(0, text.find_first_of("[("));
    return lower(trimmed(text));
}

struct Row {
    std::size_t line = 1;
    std::vector<std::string> fields;
    [[nodiscard]] bool empty() const { return fields.size() == 1 && fields.front().empty(); }
    [[nodiscard]] bool isRemark() const { return fields.front().starts_with('#'); }
};

/// Cuts text into rows and fields by RFC 4180, quotes and line breaks within them included.
class RowReader {
public:
    RowReader(std::string_view text, char separator) : m_text(text), m_separator(separator) {}

    bool next(Row& row) {
        if (m_at >= m_text.size())
            return false;
        row.line = m_line;
        row.fields.clear();
        while (field(row)) {
        }
        return true;
    }

private:
    /// Takes one field; false when it was the row's last.
    bool field(Row& row) {
        std::string out;
        bool quoted = false;
        const bool remark = row.fields.empty() && m_at < m_text.size() && m_text[m_at] == '#';
        for (; m_at < m_text.size(); ++m_at) {
            const char c = m_text[m_at];
            if (c == '\n')
                ++m_line;
            if (c == '"' && !remark) {
                const bool twice = quoted && m_at + 1 < m_text.size() && m_text[m_at + 1] == '"';
                if (!twice) {
                    quoted = !quoted;
                    continue;
                }
                ++m_at;
            } else if (!quoted && (c == '\n' || (c == m_separator && !remark))) {
                ++m_at;
                keep(row, out);
                return c != '\n';
            }
            out += c;
        }
        keep(row, out);
        return false;
    }
    static void keep(Row& row, const std::string& out) {
        if (row.fields.size() < kMostColumns)
            row.fields.emplace_back(trimmed(out));
    }

    std::string_view m_text;
    char m_separator;
    std::size_t m_at = 0, m_line = 1;
};

/// The first line that is neither empty nor a remark, and what system a remark before it names.
struct Opening {
    std::string_view head;
    std::string crs;
};

std::string epsgIn(std::string_view line) {
    const std::string text = lower(line);
    const auto at = text.find("epsg");
    if (at == std::string::npos)
        return {};
    const auto first = text.find_first_of("0123456789", at);
    if (first == std::string::npos)
        return {};
    const auto end = text.find_first_not_of("0123456789", first);
    return "EPSG:" + text.substr(first, end - first);
}

Opening openingOf(std::string_view text) {
    Opening opening;
    while (!text.empty()) {
        const auto end = std::min(text.find('\n'), text.size());
        const std::string_view line = trimmed(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line.starts_with('#')) {
            if (opening.crs.empty())
                opening.crs = epsgIn(line);
        } else if (!line.empty()) {
            opening.head = line;
            break;
        }
    }
    return opening;
}

struct Columns {
    std::optional<std::size_t> id, x, y, height, crs;
    bool degrees = false;
};

std::optional<std::size_t> find(const std::vector<std::string>& names,
                                std::initializer_list<const char*> wanted) {
    for (const char* name : wanted) {
        const auto found = std::find(names.begin(), names.end(), name);
        if (found != names.end())
            return std::size_t(found - names.begin());
    }
    return std::nullopt;
}

Columns columnsOf(const Row& head) {
    std::vector<std::string> names;
    for (const std::string& field : head.fields)
        names.push_back(columnName(field));
    Columns columns;
    columns.id = find(names, {"id", "name", "probe", "number", "nr", "fid"});
    columns.x = find(names, {"x", "east", "easting", "e", "rechtswert", "ostwert"});
    columns.y = find(names, {"y", "north", "northing", "n", "hochwert", "nordwert"});
    if (!columns.x || !columns.y) {
        columns.x = find(names, {"lon", "longitude", "lng", "long"});
        columns.y = find(names, {"lat", "latitude"});
        columns.degrees = true;
    }
    columns.height = find(
        names, {"z", "up", "u", "height", "elevation", "altitude", "ele", "h", "hoehe", "höhe"});
    columns.crs = find(names, {"epsg", "crs", "srid", "srs"});
    return columns;
}

enum class Number { Absent, Wrong, Known };

Number parse(std::string_view text, bool decimalComma, double& out) {
    if (text.empty())
        return Number::Absent;
    std::string digits(text);
    const auto comma = digits.find(',');
    if (decimalComma && comma != std::string::npos && digits.find('.') == std::string::npos)
        digits[comma] = '.';
    const char* first = digits.data() + (digits.front() == '+' ? 1 : 0);
    const char* const last = digits.data() + digits.size();
    const auto [end, error] = std::from_chars(first, last, out);
    return error == std::errc() && end == last && std::isfinite(out) ? Number::Known
                                                                     : Number::Wrong;
}

class TableReader {
public:
    TableReader(const Columns& columns, std::string crs, bool decimalComma)
        : m_columns(columns), m_crs(std::move(crs)), m_decimalComma(decimalComma) {}

    void take(const Row& row) {
        TablePlace place;
        place.line = row.line;
        place.id = field(row, m_columns.id);
        place.crs = m_crs;
        double height = 0.0;
        const Number x = number(row, m_columns.x, place.place.x);
        const Number y = number(row, m_columns.y, place.place.y);
        const Number z = number(row, m_columns.height, height);
        if (x == Number::Absent || y == Number::Absent)
            return leaveOut(row, "has no place");
        if (x == Number::Wrong || y == Number::Wrong || z == Number::Wrong)
            return leaveOut(row, "has a coordinate that is no number");
        if (m_columns.degrees &&
            (std::abs(place.place.x) > 180.0 || std::abs(place.place.y) > 90.0))
            return leaveOut(row, "has a longitude or latitude that is none");
        if (z == Number::Known)
            place.height = height;
        if (const std::string own = field(row, m_columns.crs); !own.empty()) {
            const bool plain = own.find_first_not_of("0123456789") == std::string::npos;
            place.crs = plain ? "EPSG:" + own : own;
        }
        if (place.crs.empty() && m_columns.degrees)
            place.crs = "EPSG:4326";
        m_table.places.push_back(std::move(place));
    }
    [[nodiscard]] PlaceTable& table() { return m_table; }

private:
    [[nodiscard]] static std::string field(const Row& row, std::optional<std::size_t> column) {
        return column && *column < row.fields.size() ? row.fields[*column] : std::string();
    }
    [[nodiscard]] Number number(const Row& row, std::optional<std::size_t> column,
                                double& out) const {
        return parse(field(row, column), m_decimalComma, out);
    }
    void leaveOut(const Row& row, const char* why) {
        if (++m_table.skipped > PlaceTable::kMostTold)
            return;
        m_table.remarks.push_back({Severity::Warning, "row-skipped",
                                   fmt::format("line {}", row.line),
                                   fmt::format("The row {}; it was left out.", why),
                                   "Put its coordinates right, and take a point for decimals "
                                   "where columns are apart by commas."});
    }

    Columns m_columns;
    std::string m_crs;
    bool m_decimalComma;
    PlaceTable m_table;
};

tl::unexpected<Error> noTable(const Row& head, const std::string& subject) {
    std::string names;
    for (std::size_t i = 0; i < std::min<std::size_t>(head.fields.size(), 12); ++i)
        names += (names.empty() ? "" : ", ") + head.fields[i].substr(0, 40);
    return fail(ErrorCode::Unreadable, "its first row names no columns with a place: " + names,
                subject, "Name them in the first row: id, x, y, z or id, lon, lat, height.");
}

}  // namespace

Result<PlaceTable> readPlaceTable(std::string_view text, const std::string& subject) {
    if (text.starts_with("\xef\xbb\xbf"))
        text.remove_prefix(3);
    if (text.find('\0') != std::string_view::npos)
        return fail(ErrorCode::Unreadable, "it is no plain text", subject,
                    "Save it as CSV in UTF-8.");
    const Opening opening = openingOf(text);
    const bool semicolon = opening.head.find(';') != std::string_view::npos;
    const bool tab = !semicolon && opening.head.find('\t') != std::string_view::npos;
    RowReader rows(text, semicolon ? ';' : tab ? '\t' : ',');
    Row row;
    while (rows.next(row) && (row.empty() || row.isRemark())) {
    }
    const Columns columns = row.fields.empty() ? Columns{} : columnsOf(row);
    if (!columns.x || !columns.y)
        return noTable(row, subject);
    TableReader reader(columns, opening.crs, semicolon || tab);
    while (rows.next(row)) {
        if (row.empty() || row.isRemark())
            continue;
        if (reader.table().places.size() == PlaceTable::kMostPlaces)
            return fail(ErrorCode::ResourceLimit,
                        fmt::format("it has more than {} places", PlaceTable::kMostPlaces), subject,
                        "Keep only those that belong to the project.");
        reader.take(row);
    }
    PlaceTable table = std::move(reader.table());
    if (table.skipped > PlaceTable::kMostTold)
        table.remarks.push_back(
            {Severity::Warning, "rows-skipped", "",
             fmt::format("{} further rows were left out.", table.skipped - PlaceTable::kMostTold),
             ""});
    return table;
}

std::string tableField(const std::string& text) {
    if (text.find_first_of(",;\t\"\n\r#") == std::string::npos)
        return text;
    std::string out = "\"";
    for (const char c : text)
        out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

}  // namespace reflet
