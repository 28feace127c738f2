// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/base/GlObjects.h"
#include "core/gpu/city/CityMesh.h"
#include "core/gpu/city/CityView.h"

#include <functional>
#include <limits>
#include <vector>

namespace reflet {

/// A table that shaders read as a usamplerBuffer of four 32-bit values.
class TableTexture {
public:
    TableTexture() = default;
    explicit TableTexture(const std::vector<TableTexel>& texels);
    void bind(unsigned unit) const;

private:
    Buffer m_buffer;
    GlName<deleteTexture> m_texture;
};

/// Sizes of parts in metres: from `least` to below `limit`; nothing when least is not below limit.
struct SizeRange {
    float least = 0.0F;
    float limit = std::numeric_limits<float>::infinity();
};
inline constexpr SizeRange kNoSizes{0.0F, 0.0F};

/// A CityMesh on the GPU.
class CityBuffers {
public:
    CityBuffers() = default;
    explicit CityBuffers(std::shared_ptr<const CityMesh> mesh);

    [[nodiscard]] const CityMesh* mesh() const { return m_mesh.get(); }
    /// Whether any triangle is of this kind.
    [[nodiscard]] bool has(ShadeKind kind) const;
    /// Texture units 1 to 6, as city_shade.frag.glsl has them.
    void bindTables() const;
    void bindGeometry() const { m_vertexArray.bind(); }

    /// What part of a chunk to draw.
    using Choice = std::function<SizeRange(const CityChunk& chunk)>;
    /// Draws the chunks of one kind, in the order of `chunks`; returns how many triangles.
    std::size_t draw(const std::vector<std::uint32_t>& chunks, ShadeKind kind,
                     const Choice& choice);
    /// All chunks by their distance from the eye, nearest first.
    [[nodiscard]] std::vector<std::uint32_t> nearestFirst(const glm::dvec3& eye) const;

private:
    std::shared_ptr<const CityMesh> m_mesh;
    Buffer m_vertices, m_indices;
    VertexArray m_vertexArray;
    TableTexture m_triangles, m_surfaces, m_facades, m_walls, m_mapping;
    Texture m_pages;
    std::vector<int> m_counts;  // of the multi-draw at hand
    std::vector<const void*> m_offsets;
};

/// Metres from a point to a box; 0 inside.
[[nodiscard]] double distanceTo(const Box& box, const glm::dvec3& point);

/// The parts of a chunk that a view shows.
[[nodiscard]] SizeRange sizesInView(const CityView& view, const CityChunk& chunk);

}  // namespace reflet
