// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geo/CrsSpelling.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>

namespace reflet {

namespace {

constexpr std::size_t kLongestWkt = 100'000;  // real ones stay below 10 kB
constexpr std::size_t kLongestName = 400;

std::string lower(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return out;
}

std::string_view trimmed(std::string_view text) {
    const auto isSpace = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
    while (!text.empty() && isSpace(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && isSpace(text.back()))
        text.remove_suffix(1);
    return text;
}

bool isNumber(std::string_view text) {
    return !text.empty() && text.size() <= 9 &&
           std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool startsWith(std::string_view text, std::string_view prefix) {
    return text.substr(0, prefix.size()) == prefix;
}

/// The names of the Arbeitsgemeinschaft der Vermessungsverwaltungen: urn:adv:crs:<H>[*<V>].
constexpr std::array<std::pair<std::string_view, std::string_view>, 9> kAdvNames{{
    {"etrs89_utm31", "25831"},
    {"etrs89_utm32", "25832"},
    {"etrs89_utm33", "25833"},
    {"de_dhdn_3gk2", "31466"},
    {"de_dhdn_3gk3", "31467"},
    {"de_dhdn_3gk4", "31468"},
    {"de_dhdn_3gk5", "31469"},
    {"de_dhhn92_nh", "5783"},
    {"de_dhhn2016_nh", "7837"},
}};

std::optional<std::string_view> advCode(std::string_view name) {
    for (const auto& [adv, code] : kAdvNames)
        if (adv == name)
            return code;
    return std::nullopt;
}

std::optional<std::string> fromAdv(std::string_view names) {
    const std::size_t star = names.find('*');
    const auto horizontal = advCode(names.substr(0, star));
    if (!horizontal)
        return std::nullopt;
    std::string out = "EPSG:" + std::string(*horizontal);
    if (star == std::string_view::npos)
        return out;
    const auto vertical = advCode(names.substr(star + 1));
    if (!vertical)
        return std::nullopt;
    return out + "+" + std::string(*vertical);
}

/// "EPSG:a", "EPSG:a+b", "EPSG:a+EPSG:b", "EPSG:a,b", "EPSG:a, EPSG:b"; also "EPSG::a".
std::optional<std::string> fromEpsgList(std::string_view text) {
    std::string out;
    while (true) {
        const std::size_t end = text.find_first_of("+,");
        std::string_view part = trimmed(text.substr(0, end));
        if (startsWith(part, "epsg:"))
            part.remove_prefix(startsWith(part, "epsg::") ? 6 : 5);
        else if (out.empty())
            return std::nullopt;
        part = trimmed(part);
        if (!isNumber(part))
            return std::nullopt;
        out += (out.empty() ? "EPSG:" : "+") + std::string(part);
        if (end == std::string_view::npos)
            return out;
        text.remove_prefix(end + 1);
    }
}

bool isOtherAuthority(std::string_view name) {
    for (const std::string_view authority : {"ogc:", "esri:", "ignf:", "iau_2015:", "nkg:"})
        if (startsWith(name, authority)) {
            const std::string_view code = name.substr(authority.size());
            return !code.empty() && std::all_of(code.begin(), code.end(), [](unsigned char c) {
                return std::isalnum(c) != 0 || c == '_' || c == '.';
            });
        }
    return false;
}

bool isWkt(std::string_view text) {
    const std::size_t bracket = text.find_first_of("[(");
    if (bracket == std::string_view::npos)
        return false;
    const std::string word = lower(trimmed(text.substr(0, bracket)));
    constexpr std::array<std::string_view, 17> kRoots{
        "projcs",       "geogcs",        "geoccs",      "compd_cs",    "vert_cs",    "local_cs",
        "projcrs",      "geogcrs",       "geodcrs",     "compoundcrs", "vertcrs",    "boundcrs",
        "projectedcrs", "geographiccrs", "geodeticcrs", "engcrs",      "verticalcrs"};
    return std::find(kRoots.begin(), kRoots.end(), word) != kRoots.end();
}

tl::unexpected<Error> unknownSpelling(std::string_view text) {
    const std::string_view shown = text.substr(0, 80);
    if (isNumber(text))
        return fail(ErrorCode::Refused, "a number alone names no coordinate reference system",
                    std::string(shown), "Write EPSG:" + std::string(text) + ".");
    return fail(ErrorCode::Refused, "unknown spelling of a coordinate reference system",
                std::string(shown),
                "Write EPSG:n, EPSG:n+m for a position and a height system (for example "
                "EPSG:25832+7837), or WKT.");
}

}  // namespace

Result<std::string> projSpelling(std::string_view text) {
    text = trimmed(text);
    if (isWkt(text)) {
        if (text.size() <= kLongestWkt)
            return std::string(text);
        return fail(ErrorCode::ResourceLimit, "the WKT is longer than 100000 characters",
                    std::string(text.substr(0, 80)), "Write EPSG:n instead.");
    }
    if (text.size() > kLongestName)
        return unknownSpelling(text);
    const std::string name = lower(text);
    if (const auto list = fromEpsgList(name))
        return *list;

    constexpr std::string_view kAdv = "urn:adv:crs:";
    if (startsWith(name, kAdv)) {
        if (const auto code = fromAdv(std::string_view(name).substr(kAdv.size())))
            return *code;
        return unknownSpelling(text);
    }
    constexpr std::string_view kEpsgXml = "epsg.xml#";
    if (const std::size_t at = name.rfind(kEpsgXml); at != std::string::npos) {
        const std::string code = name.substr(at + kEpsgXml.size());
        if (isNumber(code))
            return "EPSG:" + code;
        return unknownSpelling(text);
    }
    if (startsWith(name, "urn:ogc:") || startsWith(name, "urn:opengis:") ||
        startsWith(name, "urn:x-ogc:") || startsWith(name, "http://www.opengis.net/") ||
        startsWith(name, "https://www.opengis.net/"))
        return std::string(text);
    if (isOtherAuthority(name)) {
        std::string upper(text);
        std::transform(upper.begin(), upper.end(), upper.begin(),
                       [](unsigned char c) { return char(std::toupper(c)); });
        return upper;
    }
    return unknownSpelling(text);
}

}  // namespace reflet
