// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/HeightfieldCache.h"

#include "core/base/ContentHash.h"
#include "core/base/Files.h"

#include <algorithm>
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
constexpr char kMagic[8] = {'R', 'e', 'f', 'l', 'H', 'f', '0', '1'};
constexpr std::size_t kHashDigits = 32;

/// What stands before the three layers. No padding.
struct Header {
    char magic[8];
    double x0, y0, cellSize;
    std::int64_t columns, rows;
    char hash[kHashDigits];  ///< of the layers
};
static_assert(std::is_trivially_copyable_v<Header> && sizeof(Header) == 80);

std::string layersHash(const Heightfield& field) {
    ContentHash hash;
    for (const auto* layer : {&field.ground, &field.topMax, &field.topCenter})
        hash.addBytes(std::as_bytes(std::span(*layer)));
    return hash.hex();
}

Header headerOf(const GridSpec& grid, const std::string& hash) {
    Header header{{}, grid.x0, grid.y0, grid.cellSize, grid.columns, grid.rows, {}};
    std::memcpy(header.magic, kMagic, sizeof kMagic);
    std::memcpy(header.hash, hash.data(), kHashDigits);
    return header;
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
    const std::size_t layerBytes = grid.cellCount() * sizeof(float);
    if (error || layerBytes == 0 || size != sizeof(Header) + 3 * layerBytes)
        return std::nullopt;
    std::ifstream file(path, std::ios::binary);
    Header header{};
    if (!file.read(bytesOf(&header), sizeof header))
        return std::nullopt;
    Heightfield field;
    field.grid = grid;
    for (auto* layer : {&field.ground, &field.topMax, &field.topCenter}) {
        layer->resize(grid.cellCount());
        if (!file.read(bytesOf(layer->data()), std::streamsize(layerBytes)))
            return std::nullopt;
    }
    const Header expected = headerOf(grid, layersHash(field));
    if (std::memcmp(&header, &expected, sizeof header) != 0)
        return std::nullopt;
    std::filesystem::last_write_time(path, std::filesystem::file_time_type::clock::now(), error);
    return field;
}

Result<void> HeightfieldCache::store(const std::string& key, const Heightfield& field) const {
    const std::filesystem::path path = pathOf(key);
    if (!fillsItsGrid(field))
        return fail(ErrorCode::Refused, "the heightfield is not complete", path.string());
    if (auto made = makeFolder(path.parent_path()); !made)
        return made;
    const Header header = headerOf(field.grid, layersHash(field));
    auto written = writeAtomically(path, [&](const std::filesystem::path& temporary) {
        std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
        file.write(bytesOf(&header), sizeof header);
        for (const auto* layer : {&field.ground, &field.topMax, &field.topCenter})
            file.write(bytesOf(layer->data()), std::streamsize(layer->size() * sizeof(float)));
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
