// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/reconstruction/MemVertexTracer.h"

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

/// Builds the adaptive mesh of one face level by level (paper, section 4.4), so that all rays of a
/// level can be traced at once. The order of vertices and quads depends on nothing but the input.
class MemMeshBuilder {
public:
    MemMeshBuilder(const MemVertexTracer& tracer, int face, const MemSettings& settings);
    [[nodiscard]] MemFace build();

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
    void traceMiddles(const std::vector<Square>& level, const std::vector<MemQuad>& quads);
    void divide(const Square& square, std::vector<Square>& children) const;
    void divideIntoTexels(const MemQuad& quad);
    void traceNewVertices();

    const MemVertexTracer& m_tracer;
    const MemSettings& m_settings;
    int m_faceIndex;
    int m_meshSize;                      ///< N
    int m_levels = 0;                    ///< halvings from the plain mesh to the finest quads
    int m_units;                         ///< finest quads along an edge of the face
    std::vector<std::uint32_t> m_index;  ///< of the vertex at each corner of the finest quads
    std::size_t m_traced = 0;            ///< vertices that have been traced
    MemFace m_face;
};

}  // namespace reflet
