// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/HeightfieldCache.h"

#include "core/base/ContentHash.h"
#include "core/base/Files.h"
#include "core/heightfield/HeightRules.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <functional>
#include <ios>
#include <span>
#include <type_traits>
#include <vector>

namespace reflet {

namespace {

static_assert(std::endian::native == std::endian::little, "the file holds numbers as in memory");

constexpr std::size_t kKept = 3;  // with their time: one in use, and two to go back to
constexpr char kMagic[8] = {'R', 'e', 'f', 'l', 'H', 'f', '0', '2'};
constexpr std::size_t kHashDigits = 32;

/// What stands before the three layers and the two sets of columns. No padding.
struct Header {
    char magic[8];
    double x0, y0, cellSize;
    std::int64_t columns, rows;
    std::int64_t hollow[2];  ///< columns that are hollow somewhere: over the cell, at its centre
    std::int64_t spans[2];   ///< solid stretches of those
    char hash[kHashDigits];  ///< of what follows
};
static_assert(std::is_trivially_copyable_v<Header> && sizeof(Header) == 112);

/// A solid stretch in a file. No padding.
struct StoredSpan {
    float low, high;
    std::uint16_t kind, hollow;
};
static_assert(std::is_trivially_copyable_v<StoredSpan> && sizeof(StoredSpan) == 12);

/// Columns as they are written: cells, where the spans of each begin, spans.
struct StoredColumns {
    std::vector<std::uint32_t> cells, first;
    std::vector<StoredSpan> spans;
};

StoredColumns storedColumns(const CellSpans& columns) {
    StoredColumns out{columns.cells(), columns.first(), {}};
    out.spans.reserve(columns.spans().size());
    for (const HeightSpan& s : columns.spans())
        out.spans.push_back({s.low, s.high, std::uint16_t(s.kind), std::uint16_t(s.hollow)});
    return out;
}

/// Nothing when the numbers make no sense: the hash says only that they are the ones written.
std::optional<CellSpans> columnsOf(StoredColumns stored, const GridSpec& grid) {
    if (stored.cells.empty())
        return stored.spans.empty() ? std::optional(CellSpans()) : std::nullopt;
    const bool sound = stored.first.front() == 0 && stored.first.back() == stored.spans.size() &&
                       std::is_sorted(stored.first.begin(), stored.first.end()) &&
                       std::is_sorted(stored.cells.begin(), stored.cells.end()) &&
                       stored.cells.back() < grid.cellCount();
    if (!sound)
        return std::nullopt;
    std::vector<HeightSpan> spans;
    spans.reserve(stored.spans.size());
    for (const StoredSpan& s : stored.spans) {
        if (s.kind >= kCityObjectTypeCount)
            return std::nullopt;
        spans.push_back({s.low, s.high, CityObjectType(s.kind), s.hollow != 0});
    }
    return CellSpans(grid.cellCount(), stored.cells, std::move(stored.first), std::move(spans));
}

/// Calls use(vector) for each array of the file, in their order.
template <class Field, class Columns, class Use>
void eachArray(Field& field, Columns& columns, const Use& use) {
    for (auto* layer : {&field.ground, &field.topMax, &field.topCenter})
        use(*layer);
    for (auto& column : columns) {
        use(column.cells);
        use(column.first);
        use(column.spans);
    }
}

using TwoColumns = std::array<StoredColumns, 2>;

std::string hashOf(const Heightfield& field, const TwoColumns& columns) {
    ContentHash hash;
    eachArray(field, columns,
              [&](const auto& array) { hash.addBytes(std::as_bytes(std::span(array))); });
    return hash.hex();
}

Header headerOf(const GridSpec& grid, const TwoColumns& columns, const std::string& hash) {
    Header header{{}, grid.x0, grid.y0, grid.cellSize, grid.columns, grid.rows, {}, {}, {}};
    for (std::size_t n = 0; n < columns.size(); ++n) {
        header.hollow[n] = std::int64_t(columns[n].cells.size());
        header.spans[n] = std::int64_t(columns[n].spans.size());
    }
    std::memcpy(header.magic, kMagic, sizeof kMagic);
    std::memcpy(header.hash, hash.data(), kHashDigits);
    return header;
}

/// The bytes after the header; nothing for numbers that no file of this grid can have.
std::optional<std::uintmax_t> bytesAfter(const Header& header, const GridSpec& grid) {
    std::uintmax_t bytes = 3 * grid.cellCount() * sizeof(float);
    for (int n = 0; n < 2; ++n) {
        const auto cells = std::uintmax_t(header.hollow[n]);
        const auto spans = std::uintmax_t(header.spans[n]);
        if (cells > grid.cellCount() || spans > UINT32_MAX)
            return std::nullopt;
        bytes += (cells + (cells > 0 ? cells + 1 : 0)) * sizeof(std::uint32_t) +
                 spans * sizeof(StoredSpan);
    }
    return bytes;
}

bool fillsItsGrid(const Heightfield& field) {
    const std::size_t count = field.grid.cellCount();
    return count > 0 && field.ground.size() == count && field.topMax.size() == count &&
           field.topCenter.size() == count;
}

template <class T>
char* bytesOf(T* data) {
    return static_cast<char*>(static_cast<void*>(data));
}

template <class T>
const char* bytesOf(const T* data) {
    return static_cast<const char*>(static_cast<const void*>(data));
}

}  // namespace

std::filesystem::path HeightfieldCache::pathOf(const std::string& key) const {
    return m_folder / "heightfield" / (key + ".bin");
}

std::optional<Heightfield> HeightfieldCache::find(const std::string& key,
                                                  const GridSpec& grid) const {
    const std::filesystem::path path = pathOf(key);
    std::error_code error;
    const auto size = std::filesystem::file_size(path, error);
    if (error || grid.cellCount() == 0)
        return std::nullopt;
    std::ifstream file(path, std::ios::binary);
    Header header{};
    if (!file.read(bytesOf(&header), sizeof header))
        return std::nullopt;
    const auto bytes = bytesAfter(header, grid);
    if (!bytes || size != sizeof header + *bytes)
        return std::nullopt;
    Heightfield field;
    field.grid = grid;
    for (auto* layer : {&field.ground, &field.topMax, &field.topCenter})
        layer->resize(grid.cellCount());
    TwoColumns columns;
    for (std::size_t n = 0; n < columns.size(); ++n) {
        columns[n].cells.resize(std::size_t(header.hollow[n]));
        columns[n].first.resize(columns[n].cells.empty() ? 0 : columns[n].cells.size() + 1);
        columns[n].spans.resize(std::size_t(header.spans[n]));
    }
    eachArray(field, columns, [&](auto& array) {
        file.read(bytesOf(array.data()), std::streamsize(std::span(array).size_bytes()));
    });
    const Header expected = headerOf(grid, columns, hashOf(field, columns));
    if (!file || std::memcmp(&header, &expected, sizeof header) != 0)
        return std::nullopt;
    auto spans = columnsOf(std::move(columns[0]), grid);
    auto centerSpans = columnsOf(std::move(columns[1]), grid);
    if (!spans || !centerSpans)
        return std::nullopt;
    field.spans = std::move(*spans);
    field.centerSpans = std::move(*centerSpans);
    std::filesystem::last_write_time(path, std::filesystem::file_time_type::clock::now(), error);
    return field;
}

Result<void> HeightfieldCache::store(const std::string& key, const Heightfield& field) const {
    const std::filesystem::path path = pathOf(key);
    if (!fillsItsGrid(field))
        return fail(ErrorCode::Refused, "the heightfield is not complete", path.string());
    if (auto made = makeFolder(path.parent_path()); !made)
        return made;
    const TwoColumns columns{storedColumns(field.spans), storedColumns(field.centerSpans)};
    const Header header = headerOf(field.grid, columns, hashOf(field, columns));
    auto written = writeAtomically(path, [&](const std::filesystem::path& temporary) {
        std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
        file.write(bytesOf(&header), sizeof header);
        eachArray(field, columns, [&](const auto& array) {
            file.write(bytesOf(array.data()), std::streamsize(std::span(array).size_bytes()));
        });
        file.close();
        if (!file)
            return Result<void>(fail(ErrorCode::WriteFailed, "cannot be written", path.string(),
                                     "Check the free space and the permissions of the folder."));
        return Result<void>();
    });
    if (written)
        removeOld();
    return written;
}

/// A settings' slider that is dragged would else leave a file behind at every stop.
void HeightfieldCache::removeOld() const {
    using Aged = std::pair<std::filesystem::file_time_type, std::filesystem::path>;
    std::vector<Aged> files;
    std::error_code error;
    for (std::filesystem::directory_iterator entry(m_folder / "heightfield", error), end;
         !error && entry != end; entry.increment(error)) {
        std::error_code ignored;
        if (entry->path().extension() == ".bin")
            files.emplace_back(entry->last_write_time(ignored), entry->path());
    }
    std::sort(files.begin(), files.end(), std::greater<>());
    for (std::size_t i = kKept; i < files.size(); ++i)
        std::filesystem::remove(files[i].second, error);
}

}  // namespace reflet
