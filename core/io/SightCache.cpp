// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/SightCache.h"

#include "core/base/ContentHash.h"
#include "core/base/Files.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

namespace reflet {

namespace {

static_assert(std::endian::native == std::endian::little, "the file holds numbers as in memory");

constexpr char kMagic[8] = {'R', 'e', 'f', 'l', 'S', 'i', '0', '1'};
constexpr std::size_t kHashDigits = 32;
/// Of the largest grid, with every cell another than the one before it.
constexpr std::size_t kMostBytes = 256 + sizeof(std::uint32_t) * (kMostCells + 1);

/// What stands before the runs: numbers of cells that are not depended on, that are, that are not,
/// and so on, as 32 bits each. No padding.
struct Header {
    char magic[8];
    double origin[3], size;
    std::int32_t count[3];
    std::uint32_t runs;
    std::uint64_t content;
    char map[kHashDigits];
    char hash[kHashDigits];  ///< of all before it and the runs
};
static_assert(std::is_trivially_copyable_v<Header> && sizeof(Header) == 128);

std::vector<std::uint32_t> runsOf(const std::vector<unsigned char>& cells) {
    std::vector<std::uint32_t> runs(1, 0);
    unsigned char now = 0;
    for (const unsigned char cell : cells) {
        if (cell != now) {
            runs.push_back(0);
            now = cell;
        }
        ++runs.back();
    }
    return runs;
}

/// Nothing when the runs do not fill the grid.
std::optional<std::vector<unsigned char>> cellsOf(const std::vector<std::uint32_t>& runs,
                                                  std::size_t count) {
    std::vector<unsigned char> cells;
    cells.reserve(count);
    unsigned char now = 0;
    for (const std::uint32_t run : runs) {
        if (run > count - cells.size())
            return std::nullopt;
        cells.insert(cells.end(), run, now);
        now ^= 1U;
    }
    return cells.size() == count ? std::optional(std::move(cells)) : std::nullopt;
}

std::string hashOf(const Header& header, const std::vector<std::uint32_t>& runs) {
    ContentHash hash;
    hash.addBytes(std::as_bytes(std::span(&header, 1)).first(sizeof header - kHashDigits));
    hash.addBytes(std::as_bytes(std::span(runs)));
    return hash.hex();
}

std::optional<CellGrid> gridOf(const Header& header) {
    CellGrid grid;
    double cells = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        grid.origin[axis] = header.origin[axis];
        grid.count[axis] = header.count[axis];
        cells *= double(header.count[axis]);
        if (header.count[axis] < 1 || !std::isfinite(header.origin[axis]))
            return std::nullopt;
    }
    grid.size = header.size;
    const bool sound = std::isfinite(grid.size) && grid.size > 0.0 && cells <= double(kMostCells);
    return sound ? std::optional(grid) : std::nullopt;
}

/// Nothing when the file is not sound.
std::optional<Sight> readSight(const std::filesystem::path& path) {
    const auto bytes = readFile(path, kMostBytes);
    Header header{};
    if (!bytes || bytes->size() < sizeof header)
        return std::nullopt;
    std::memcpy(&header, bytes->data(), sizeof header);
    const std::size_t left = bytes->size() - sizeof header;
    if (std::memcmp(header.magic, kMagic, sizeof kMagic) != 0 ||
        left != std::size_t(header.runs) * sizeof(std::uint32_t))
        return std::nullopt;
    std::vector<std::uint32_t> runs(header.runs);
    std::memcpy(runs.data(), bytes->data() + sizeof header, left);
    if (hashOf(header, runs) != std::string(header.hash, kHashDigits))
        return std::nullopt;
    const auto grid = gridOf(header);
    auto cells = grid ? cellsOf(runs, grid->cells()) : std::nullopt;
    if (!cells)
        return std::nullopt;
    return Sight{std::string(header.map, kHashDigits), {*grid, std::move(*cells)}, header.content};
}

}  // namespace

std::filesystem::path SightCache::pathOf(const std::string& key, const std::string& map) const {
    return m_folder / "sight" / key / (map + ".bin");
}

std::vector<std::filesystem::path> SightCache::filesOf(const std::string& key) const {
    using Aged = std::pair<std::filesystem::file_time_type, std::filesystem::path>;
    std::vector<Aged> files;
    std::error_code error;
    for (std::filesystem::directory_iterator entry(m_folder / "sight" / key, error), end;
         !error && entry != end; entry.increment(error)) {
        std::error_code ignored;
        if (entry->path().extension() == ".bin")
            files.emplace_back(entry->last_write_time(ignored), entry->path());
    }
    std::sort(files.begin(), files.end(), std::greater<>());
    std::vector<std::filesystem::path> paths;
    for (Aged& file : files)
        paths.push_back(std::move(file.second));
    return paths;
}

std::vector<Sight> SightCache::find(const std::string& key) const {
    std::vector<Sight> sights;
    for (const std::filesystem::path& path : filesOf(key)) {
        if (auto sight = readSight(path); sight && sights.size() < kKept)
            sights.push_back(std::move(*sight));
    }
    return sights;
}

Result<void> SightCache::store(const std::string& key, const Sight& sight) const {
    const std::filesystem::path path = pathOf(key, sight.map);
    if (sight.map.size() != kHashDigits || sight.seen.cells.size() != sight.seen.grid.cells())
        return fail(ErrorCode::Refused, "the sight of a map is not complete", path.string());
    if (auto made = makeFolder(path.parent_path()); !made)
        return made;
    const auto runs = runsOf(sight.seen.cells);
    Header header{};
    std::memcpy(header.magic, kMagic, sizeof kMagic);
    for (int axis = 0; axis < 3; ++axis) {
        header.origin[axis] = sight.seen.grid.origin[axis];
        header.count[axis] = sight.seen.grid.count[axis];
    }
    header.size = sight.seen.grid.size;
    header.runs = std::uint32_t(runs.size());
    header.content = sight.content;
    std::memcpy(header.map, sight.map.data(), kHashDigits);
    std::memcpy(header.hash, hashOf(header, runs).data(), kHashDigits);
    std::string bytes(sizeof header + runs.size() * sizeof(std::uint32_t), '\0');
    std::memcpy(bytes.data(), &header, sizeof header);
    std::memcpy(bytes.data() + sizeof header, runs.data(), bytes.size() - sizeof header);
    if (auto written = writeFileAtomically(path, bytes); !written)
        return written;
    const auto files = filesOf(key);
    std::error_code ignored;
    for (std::size_t i = kKept; i < files.size(); ++i)
        std::filesystem::remove(files[i], ignored);
    return {};
}

}  // namespace reflet
