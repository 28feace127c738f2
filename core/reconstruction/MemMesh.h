// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/reconstruction/MemVertexTracer.h"

#include <span>
#include <utility>
#include <vector>

namespace reflet {

/// Indices [first, last) of the texel columns (or rows) whose centres lie in [from, to), a part of
/// [-1, 1]. Borders that are equal as doubles divide the texels without gap or overlap.
struct TexelRange {
    int first = 0;
    int last = 0;
    [[nodiscard]] bool empty() const { return first >= last; }
};
[[nodiscard]] TexelRange texelsWithin(int resolution, double from, double to);

/// The adaptive mesh of one face, built level by level (paper, section 4.4). The order of vertices
/// and quads depends on nothing but the input.
///
/// Who builds it alternates: beginLevel(), rays for newDirections(), then the same for askMiddles()
/// where it asks for more, divideLevel(), until beginLevel() has none; last, rays for the texels.
class MemMeshBuilder {
public:
    MemMeshBuilder(const MemVertexTracer& tracer, int face, const MemSettings& settings);

    /// False when there is nothing left to look at.
    [[nodiscard]] bool beginLevel();
    void askMiddles();
    void divideLevel();

    /// Vertices that have no ray yet, behind all that do.
    [[nodiscard]] std::span<MemVertex> newVertices() {
        return std::span(m_face.vertices).subspan(m_traced);
    }
    void markTraced() { m_traced = m_face.vertices.size(); }
    [[nodiscard]] MemFace take() { return std::move(m_face); }

private:
    /// A quad in units of the finest level, [i, i + size) × [j, j + size).
    struct Square {
        int i = 0, j = 0, size = 0;
    };

    [[nodiscard]] double coordinate(int unit) const {
        return double(2 * unit) / double(m_units) - 1.0;
    }
    [[nodiscard]] MemQuad quadOf(const Square& square);
    [[nodiscard]] std::uint32_t vertexAt(int i, int j);
    [[nodiscard]] std::uint32_t addVertex(const glm::dvec2& st);
    [[nodiscard]] bool wantsSplit(const Square& square, const MemQuad& quad);
    [[nodiscard]] bool differsInDepth(const MemQuad& quad) const;
    [[nodiscard]] bool servedAlike(const MemQuad& quad);
    [[nodiscard]] bool servedAlikeBySight(const MemQuad& quad);
    [[nodiscard]] double lookupError(const Square& square, const MemQuad& quad) const;
    void divide(const Square& square, std::vector<Square>& children) const;
    void divideIntoTexels(const MemQuad& quad);

    const MemVertexTracer& m_tracer;
    const MemSettings& m_settings;
    int m_faceIndex;
    int m_meshSize;                      ///< N
    int m_levels = 0;                    ///< halvings from the plain mesh to the finest quads
    int m_units;                         ///< finest quads along an edge of the face
    std::vector<std::uint32_t> m_index;  ///< of the vertex at each corner of the finest quads
    std::size_t m_traced = 0;            ///< vertices that have been traced
    std::vector<Square> m_level;         ///< what is looked at
    std::vector<MemQuad> m_quads;        ///< of m_level
    MemFace m_face;
};

/// The meshes of some faces (0..5) at once: rays of a level are traced together.
[[nodiscard]] std::vector<MemFace> buildMemMesh(const MemVertexTracer& tracer,
                                                std::span<const int> faces,
                                                const MemSettings& settings);

}  // namespace reflet
