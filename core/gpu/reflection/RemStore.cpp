// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/reflection/RemStore.h"

#include "core/gpu/base/GlVersion.h"
#include "core/gpu/reflection/MapTexels.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdlib>
#include <string>

namespace reflet {

namespace {

constexpr std::size_t kTexelBytes = 8;  // RGBA16F

constexpr std::size_t kBlockBytes = sizeof(Bc6hBlock) + sizeof(std::uint64_t);
constexpr unsigned kRadianceFormat = GL_COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT;

void copyLayers(const Texture& from, const Texture& to, unsigned target, int height, int layers) {
    glCopyImageSubData(from.id(), target, 0, 0, 0, 0, to.id(), target, 0, 0, 0, 0, from.width(),
                       height, layers);
}

}  // namespace

Result<RemMemory> usualRemMemory() {
    const char* variable = std::getenv("REFLET_PROBE_MEMORY");
    const std::string wish = variable != nullptr ? variable : "";
    if (wish == "plain")
        return RemMemory::Plain;
    if (wish == "compressed")
        return RemMemory::Compressed;
    if (!wish.empty()) {
        return fail(ErrorCode::Usage, "the environment names no way to keep probes for drawing",
                    "REFLET_PROBE_MEMORY=" + wish,
                    "Set REFLET_PROBE_MEMORY to \"plain\" or \"compressed\", or unset it.");
    }
    return contextDrawsInSoftware() ? RemMemory::Plain : RemMemory::Compressed;
}

RemStore::RemStore(RemMemory memory, std::size_t budget) : m_budget(budget) {
    assert(memory != RemMemory::Automatic && "whoever makes a store has chosen");
    if (memory == RemMemory::Compressed)
        m_compressor = std::make_unique<RemCompressor>();
}

std::size_t RemStore::cubeBytes(int resolution) const {
    const auto texels = std::size_t(resolution);
    const auto blocks = std::size_t(DistanceBlocks::blocksAlong(resolution));
    return m_compressor ? 6 * blocks * blocks * kBlockBytes : 6 * texels * texels * kTexelBytes;
}

void RemStore::setRems(const RemSet& rems) {
    if (m_compressor)
        m_compressor->keep(rems);
    const auto& kept = rems.pointers();
    for (auto& [resolution, array] : m_arrays) {
        for (Slot& slot : array.slots) {
            if (slot.map && std::find(kept.begin(), kept.end(), slot.map) == kept.end())
                slot = {};
        }
    }
    std::erase_if(m_arrays, [](const auto& entry) {
        const auto& slots = entry.second.slots;
        return std::all_of(slots.begin(), slots.end(), [](const Slot& s) { return !s.map; });
    });
}

RemStore::Pair RemStore::places(const RemSet::Pointer& a, const RemSet::Pointer& b) {
    // Both are made resident before either texture is named: an array that grows is another one.
    const std::size_t slotA = a ? slotOf(a) : 0;
    const std::size_t slotB = b ? slotOf(b) : 0;
    const auto place = [&](const RemSet::Pointer& map, std::size_t slot) {
        if (!map)
            return Place{};
        const Array& array = m_arrays[map->radiance.resolution()];
        return Place{array.texture.id(), int(slot), array.distances.id()};
    };
    return {place(a, slotA), place(b, slotB)};
}

std::vector<RemStore::Place> RemStore::places(std::span<const RemSet::Pointer> maps) {
    std::vector<std::size_t> slots;
    for (const RemSet::Pointer& map : maps)
        slots.push_back(slotOf(map));
    std::vector<Place> places;
    for (std::size_t i = 0; i < maps.size(); ++i) {
        const Array& array = m_arrays[maps[i]->radiance.resolution()];
        const bool stayed = array.slots[slots[i]].map == maps[i];
        places.push_back(stayed ? Place{array.texture.id(), int(slots[i]), array.distances.id()}
                                : Place{});
    }
    return places;
}

std::size_t RemStore::slotOf(const RemSet::Pointer& map) {
    const int resolution = map->radiance.resolution();
    assert(resolution > 0 && "a reference map has texels");
    Array& array = m_arrays[resolution];
    std::size_t slot = 0;
    while (slot < array.slots.size() && array.slots[slot].map != map)
        ++slot;
    if (slot == array.slots.size()) {
        slot = freeSlot(array, resolution);
        upload(array, slot, map);
        array.slots[slot].map = map;
    }
    array.slots[slot].lastUse = ++m_clock;
    return slot;
}

std::size_t RemStore::bytes() const {
    std::size_t sum = 0;
    for (const auto& [resolution, array] : m_arrays)
        sum += array.slots.size() * cubeBytes(resolution);
    return sum;
}

/// A slot without a map: an empty one, one of a larger array, or that which was longest unused.
std::size_t RemStore::freeSlot(Array& array, int resolution) {
    const auto empty =
        std::find_if(array.slots.begin(), array.slots.end(), [](const Slot& s) { return !s.map; });
    if (empty != array.slots.end())
        return std::size_t(empty - array.slots.begin());
    const std::size_t before = array.slots.size();
    const std::size_t others = bytes() - before * cubeBytes(resolution);
    const std::size_t left = m_budget > others ? m_budget - others : 0;
    // Two at least: a local map is made from two.
    const std::size_t most = std::max<std::size_t>(2, left / cubeBytes(resolution));
    if (before < most) {
        grow(array, resolution, std::min(most, std::max<std::size_t>(4, 2 * before)));
        return before;
    }
    const auto oldest =
        std::min_element(array.slots.begin(), array.slots.end(),
                         [](const Slot& a, const Slot& b) { return a.lastUse < b.lastUse; });
    return std::size_t(oldest - array.slots.begin());
}

void RemStore::grow(Array& array, int resolution, std::size_t cubes) {
    const int before = int(array.slots.size());
    Texture larger =
        Texture::makeCubeArray(m_compressor ? kRadianceFormat : GL_RGBA16F, resolution, int(cubes));
    if (before > 0)
        copyLayers(array.texture, larger, GL_TEXTURE_CUBE_MAP_ARRAY, resolution, 6 * before);
    array.texture = std::move(larger);
    if (m_compressor) {
        const int blocks = DistanceBlocks::blocksAlong(resolution);
        Texture more = Texture::makeArray(GL_RG32UI, blocks, 6 * blocks, int(cubes));
        more.filter(GL_NEAREST, GL_NEAREST);
        if (before > 0)
            copyLayers(array.distances, more, GL_TEXTURE_2D_ARRAY, 6 * blocks, before);
        array.distances = std::move(more);
    }
    array.slots.resize(cubes);
}

void RemStore::upload(const Array& array, std::size_t slot, const RemSet::Pointer& map) {
    const int n = map->radiance.resolution();
    if (m_compressor) {
        const RemCompressor::Made made = m_compressor->of(map);
        const int blocks = DistanceBlocks::blocksAlong(n);
        glCompressedTextureSubImage3D(array.texture.id(), 0, 0, 0, GLint(6 * slot), n, n, 6,
                                      kRadianceFormat, GLsizei(made->radiance.bytes()),
                                      made->radiance.blocks.data());
        // The lower half of a word first, as it lies in memory.
        static_assert(std::endian::native == std::endian::little);
        glTextureSubImage3D(array.distances.id(), 0, 0, 0, GLint(slot), blocks, 6 * blocks, 1,
                            GL_RG_INTEGER, GL_UNSIGNED_INT, made->distance.words.data());
    } else {
        const MapTexels texels = mapTexels(map->radiance, map->distance, {}, MapLevels::First);
        glTextureSubImage3D(array.texture.id(), 0, 0, 0, GLint(6 * slot), n, n, 6, GL_RGBA,
                            GL_HALF_FLOAT, texels.halves.data());
    }
    ++m_uploads;
}

}  // namespace reflet
