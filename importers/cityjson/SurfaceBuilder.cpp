// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/cityjson/SurfaceBuilder.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace reflet::cityjson {

namespace {

/// The values of a geometry, laid over its surfaces or rings; all null when there are none.
Alignment laidOver(const NestedIndices& boundaries, const NestedIndices& values, bool rings,
                   Issue broken, const std::string& theme, Noter note) {
    if (values.empty())
        return {};
    Alignment alignment = values.malformed ? Alignment{}
                          : rings          ? alignRings(boundaries, values)
                                           : alignSurfaces(boundaries, values);
    if (values.malformed || alignment.mismatch) {
        const char* what = values.malformed ? "nested in another way than the boundaries"
                                            : "not as many as there are surfaces";
        note(broken, theme.empty() ? what : fmt::format("theme {:.40} is {}", theme, what), 1);
    }
    return alignment;
}

std::uint32_t at(const Alignment& alignment, std::size_t i) {
    return i < alignment.first.size() ? alignment.first[i] : kNullIndex;
}

}  // namespace

void SurfaceBuilder::noteEmptyParts(const NestedIndices& boundaries, Noter note) const {
    std::size_t empty = 0;
    for (int level = 0; level < boundaries.depth - 2; ++level) {
        const auto& counts = boundaries.counts[static_cast<std::size_t>(level)];
        empty += static_cast<std::size_t>(std::count(counts.begin(), counts.end(), 0U));
    }
    if (empty > 0)
        note(Issue::EmptyGeometry, {}, empty);
}

/// Checks the indices of a surface and appends them. False, and nothing appended: one is invalid.
bool SurfaceBuilder::addPoints(std::size_t firstLeaf, std::size_t leafCount, Noter note) {
    const auto first =
        m_geometry->boundaries.leaves.begin() + static_cast<std::ptrdiff_t>(firstLeaf);
    const auto last = first + static_cast<std::ptrdiff_t>(leafCount);
    const auto bad =
        std::find_if(first, last, [&](std::uint32_t index) { return index >= m_vertexCount; });
    if (bad != last) {
        note(Issue::IndexOutOfRange,
             *bad >= kNullIndex
                 ? "an entry is no index"
                 : fmt::format("index {}, counted from 0, of {}", *bad, m_vertexCount),
             1);
        return false;
    }
    m_into.points.insert(m_into.points.end(), first, last);
    return true;
}

void SurfaceBuilder::setSemantics(std::uint32_t leaf, Noter note,
                                  SurfaceSoup::Surface& surface) const {
    if (leaf == kNullIndex)
        return;
    if (leaf < m_geometry->semanticTypes.size())
        surface.type = m_geometry->semanticTypes[leaf];
    else
        note(Issue::SemanticsIndex,
             leaf == kBadIndex ? "an entry is no index"
                               : fmt::format("index {}, counted from 0, of {}", leaf,
                                             m_geometry->semanticTypes.size()),
             1);
}

void SurfaceBuilder::setMaterial(std::uint32_t leaf, SurfaceSoup::Surface& surface) const {
    if (leaf < m_file.materials.size())
        surface.material = leaf;
}

/// Appends the texture coordinates of a ring, whose entry is the texture and then a coordinate for
/// each point. False: the entry is not like that.
bool SurfaceBuilder::addRingUv(const Alignment& rings, std::size_t entry, std::uint32_t ring,
                               Noter note) {
    const auto& leaves = m_geometry->textures.leaves;
    const std::uint32_t size = m_into.ringEnds[ring] - m_into.ringBegin(ring);
    const std::uint32_t first = at(rings, entry);
    const std::uint32_t count = first == kNullIndex ? 0 : rings.count[entry];
    if (count != size + 1) {
        note(Issue::TextureBroken, fmt::format("{} entries for a ring of {} points", count, size),
             1);
        return false;
    }
    const std::size_t known = m_file.textureVertices.size();
    for (std::uint32_t i = 1; i <= size; ++i) {
        const std::uint32_t uv = leaves[first + i];
        if (uv >= known || !std::isfinite(m_file.textureVertices[uv].x)) {
            note(Issue::TextureIndex,
                 uv >= kNullIndex ? "a coordinate is no index"
                                  : fmt::format("coordinate {}, counted from 0, of {}", uv, known),
                 1);
            return false;
        }
        m_into.uvs.push_back(uv);
    }
    return true;
}

/// The texture is the outer ring's.
void SurfaceBuilder::setTexture(const Alignment& rings, std::size_t firstRing, Noter note,
                                SurfaceSoup::Surface& surface) {
    const std::uint32_t first = at(rings, firstRing);
    if (first == kNullIndex || rings.count[firstRing] == 0)
        return;
    const std::uint32_t texture = m_geometry->textures.leaves[first];
    if (texture == kNullIndex)
        return;
    if (m_file.textures.empty()) {
        m_withoutAppearance = true;
        return;
    }
    if (texture >= m_file.textures.size()) {
        note(Issue::TextureIndex,
             fmt::format("texture {}, counted from 0, of {}", texture, m_file.textures.size()), 1);
        return;
    }
    const auto begin = m_into.uvs.size();
    for (std::uint32_t r = 0; r < surface.ringCount; ++r) {
        if (!addRingUv(rings, firstRing + r, surface.firstRing + r, note)) {
            m_into.uvs.resize(begin);
            return;
        }
    }
    surface.texture = texture;
    surface.firstUv = static_cast<std::uint32_t>(begin);
}

bool SurfaceBuilder::isReadable(const GeometryText& geometry, Noter note) {
    const NestedIndices& boundaries = geometry.boundaries;
    if (boundaries.empty()) {
        note(Issue::BadGeometry, fmt::format("a {} has no boundaries", toString(geometry.type)), 1);
        return false;
    }
    if (boundaries.malformed || boundaries.hasNullArray) {
        note(Issue::BadGeometry,
             fmt::format("boundaries are nested in another way than those of a {}",
                         toString(geometry.type)),
             1);
        return false;
    }
    return true;
}

void SurfaceBuilder::add(const GeometryText& geometry, std::uint32_t owner, Noter note) {
    m_geometry = &geometry;
    m_withoutAppearance = m_withoutAppearance || geometry.materialsWithoutAppearance;
    if (!isReadable(geometry, note))
        return;
    const NestedIndices& boundaries = geometry.boundaries;
    noteEmptyParts(boundaries, note);
    const Alignment semantics =
        laidOver(boundaries, geometry.semantics, false, Issue::SemanticsBroken, {}, note);
    const Alignment materials = laidOver(boundaries, geometry.materials, false,
                                         Issue::MaterialBroken, geometry.materialTheme, note);
    const Alignment textures = laidOver(boundaries, geometry.textures, true, Issue::TextureBroken,
                                        geometry.textureTheme, note);

    const auto& ringCounts = boundaries.counts[static_cast<std::size_t>(boundaries.depth - 2)];
    const auto& pointCounts = boundaries.counts[static_cast<std::size_t>(boundaries.depth - 1)];
    std::size_t ring = 0;
    std::size_t leaf = 0;
    for (std::size_t s = 0; s < ringCounts.size(); ++s) {
        SurfaceSoup::Surface surface;
        surface.owner = owner;
        surface.firstRing = static_cast<std::uint32_t>(m_into.ringEnds.size());
        surface.ringCount = ringCounts[s];
        std::size_t points = 0;
        for (std::size_t r = 0; r < surface.ringCount; ++r)
            points += pointCounts[ring + r];
        ++m_writtenSurfaces;
        m_writtenTriangles += nominalTriangles(points, surface.ringCount);
        if (addPoints(leaf, points, note)) {
            auto end = static_cast<std::uint32_t>(m_into.points.size() - points);
            for (std::size_t r = 0; r < surface.ringCount; ++r)
                m_into.ringEnds.push_back(end += pointCounts[ring + r]);
            setSemantics(at(semantics, s), note, surface);
            setMaterial(geometry.material.value_or(at(materials, s)), surface);
            setTexture(textures, ring, note, surface);
            m_into.surfaces.push_back(surface);
        }
        ring += surface.ringCount;
        leaf += points;
    }
}

}  // namespace reflet::cityjson
