// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/reflection/RemStore.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cassert>

namespace reflet {

namespace {

constexpr std::size_t kTexelBytes = 8;  // RGBA16F
constexpr float kLargestHalf = 65504.0F;

std::size_t cubeBytes(int resolution) {
    return std::size_t(6) * std::size_t(resolution) * std::size_t(resolution) * kTexelBytes;
}

}  // namespace

std::vector<float> rgbaTexels(const CubeMap<glm::vec3>& radiance, const CubeMap<float>& distance) {
    assert(radiance.texels().size() == distance.texels().size());
    std::vector<float> out;
    out.reserve(radiance.texels().size() * 4);
    for (std::size_t i = 0; i < radiance.texels().size(); ++i) {
        const glm::vec3& c = radiance.texels()[i];
        for (const float channel : {c.x, c.y, c.z})
            out.push_back(std::min(channel, kLargestHalf));
        out.push_back(distance.texels()[i]);
    }
    return out;
}

void RemStore::setRems(const RemSet& rems) {
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
        return map ? Place{m_arrays[map->radiance.resolution()].texture.id(), int(slot)} : Place{};
    };
    return {place(a, slotA), place(b, slotB)};
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
        upload(array, slot, *map);
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
    Texture larger = Texture::makeCubeArray(GL_RGBA16F, resolution, int(cubes));
    if (array.texture) {
        glCopyImageSubData(array.texture.id(), GL_TEXTURE_CUBE_MAP_ARRAY, 0, 0, 0, 0, larger.id(),
                           GL_TEXTURE_CUBE_MAP_ARRAY, 0, 0, 0, 0, resolution, resolution,
                           GLsizei(6 * array.slots.size()));
    }
    array.texture = std::move(larger);
    array.slots.resize(cubes);
}

void RemStore::upload(const Array& array, std::size_t slot, const ReferenceEnvironmentMap& map) {
    const std::vector<float> texels = rgbaTexels(map.radiance, map.distance);
    const int n = map.radiance.resolution();
    glTextureSubImage3D(array.texture.id(), 0, 0, 0, GLint(6 * slot), n, n, 6, GL_RGBA, GL_FLOAT,
                        texels.data());
    ++m_uploads;
}

}  // namespace reflet
