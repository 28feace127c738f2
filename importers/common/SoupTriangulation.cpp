// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/SoupTriangulation.h"

#include "core/base/ParallelFor.h"
#include "core/city/PolygonTriangulation.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <utility>

namespace reflet::importers {

namespace {

using State = SoupTriangles::State;

/// Texture coordinates are an affine function of the place on a plane surface; this is the one
/// through three points of the polygon that lie far apart. It gives coordinates to the points where
/// edges cross, which have none of their own.
class AffineUv {
public:
    AffineUv(const std::vector<glm::dvec3>& points, const std::vector<glm::vec2>& uv) {
        std::size_t far = 0;
        std::size_t wide = 0;
        double widest = 0.0;
        for (std::size_t i = 0; i < uv.size(); ++i) {
            if (glm::distance(points[i], points[0]) > glm::distance(points[far], points[0]))
                far = i;
        }
        for (std::size_t i = 0; i < uv.size(); ++i) {
            const double area =
                glm::length(glm::cross(points[far] - points[0], points[i] - points[0]));
            if (area > widest) {
                widest = area;
                wide = i;
            }
        }
        m_origin = points[0];
        m_e1 = points[far] - m_origin;
        m_e2 = points[wide] - m_origin;
        m_uv = uv[0];
        m_uv1 = uv[far] - uv[0];
        m_uv2 = uv[wide] - uv[0];
    }
    [[nodiscard]] glm::vec2 at(const glm::dvec3& p) const {
        // Least squares for p = origin + a e1 + b e2, by the normal equations.
        const glm::dvec3 d = p - m_origin;
        const double e11 = glm::dot(m_e1, m_e1);
        const double e12 = glm::dot(m_e1, m_e2);
        const double e22 = glm::dot(m_e2, m_e2);
        const double determinant = e11 * e22 - e12 * e12;
        if (!(determinant > 0.0))
            return m_uv;
        const double d1 = glm::dot(d, m_e1);
        const double d2 = glm::dot(d, m_e2);
        const auto a = static_cast<float>((d1 * e22 - d2 * e12) / determinant);
        const auto b = static_cast<float>((d2 * e11 - d1 * e12) / determinant);
        return m_uv + a * m_uv1 + b * m_uv2;
    }

private:
    glm::dvec3 m_origin{0.0};
    glm::dvec3 m_e1{0.0};
    glm::dvec3 m_e2{0.0};
    glm::vec2 m_uv{0.0F};
    glm::vec2 m_uv1{0.0F};
    glm::vec2 m_uv2{0.0F};
};

/// Triangulates a run of surfaces; the points born in it are numbered from vertexCount on.
class PieceTriangulator {
public:
    PieceTriangulator(const SurfaceSoup& soup, const std::vector<glm::dvec3>& vertices,
                      const std::vector<glm::vec2>& textureVertices, SoupTriangles& out)
        : m_soup(soup), m_vertices(vertices), m_textureVertices(textureVertices), m_out(out) {}

    State run(std::uint32_t index) {
        const SurfaceSoup::Surface& surface = m_soup.surfaces[index];
        const std::uint32_t first = m_soup.firstPoint(surface);
        if (!gather(surface, index))
            return State::BadVertex;
        triangulatePolygon({m_rings.data(), surface.ringCount}, m_polygon);
        const TriangulatedPolygon& polygon = m_polygon;
        if (polygon.triangles.empty()) {
            m_out.problems.push_back(
                {index, polygon.problem.empty() ? "its rings cancel out" : polygon.problem});
            return State::Degenerate;
        }
        const auto bornBase = static_cast<std::uint32_t>(m_out.born.size());
        const auto inputs = static_cast<std::uint32_t>(polygon.inputPoints);
        m_out.born.insert(m_out.born.end(), polygon.points.begin() + inputs, polygon.points.end());
        for (const auto& triangle : polygon.triangles) {
            SoupTriangles::Triangle made;
            made.surface = index;
            for (std::size_t k = 0; k < 3; ++k) {
                made.vertex[k] = triangle[k] < inputs
                                     ? m_soup.points[first + triangle[k]]
                                     : m_out.vertexCount + bornBase + (triangle[k] - inputs);
            }
            m_out.triangles.push_back(made);
        }
        if (!m_soup.uvs.empty())
            addUv(surface, polygon);
        noteDeviation(index, polygon.planeDeviation);
        return polygon.repaired ? State::Repaired : State::Good;
    }

private:
    bool gather(const SurfaceSoup::Surface& surface, std::uint32_t index) {
        if (m_rings.size() < surface.ringCount)
            m_rings.resize(surface.ringCount);
        for (std::uint32_t r = 0; r < surface.ringCount; ++r) {
            const std::uint32_t ring = surface.firstRing + r;
            m_rings[r].clear();
            for (std::uint32_t i = m_soup.ringBegin(ring); i < m_soup.ringEnds[ring]; ++i) {
                const glm::dvec3& p = m_vertices[m_soup.points[i]];
                if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
                    m_out.problems.push_back({index, fmt::format("vertex {}", m_soup.points[i])});
                    return false;
                }
                m_rings[r].push_back(p);
            }
        }
        return true;
    }

    void addUv(const SurfaceSoup::Surface& surface, const TriangulatedPolygon& polygon) {
        if (surface.firstUv == kNone) {
            m_out.uv.resize(m_out.triangles.size());
            return;
        }
        m_uv.clear();
        for (std::size_t i = 0; i < polygon.inputPoints; ++i)
            m_uv.push_back(m_textureVertices[m_soup.uvs[surface.firstUv + i]]);
        const std::size_t born = polygon.points.size() - polygon.inputPoints;
        if (born > 0) {
            const AffineUv affine(polygon.points, m_uv);
            for (std::size_t i = 0; i < born; ++i)
                m_uv.push_back(affine.at(polygon.points[polygon.inputPoints + i]));
        }
        for (const auto& triangle : polygon.triangles)
            m_out.uv.push_back({m_uv[triangle[0]], m_uv[triangle[1]], m_uv[triangle[2]]});
    }

    void noteDeviation(std::uint32_t index, double deviation) {
        constexpr double kPlanar = 0.01;
        m_out.notPlanar += deviation > kPlanar ? 1 : 0;
        if (deviation > m_out.worstDeviation) {
            m_out.worstDeviation = deviation;
            m_out.worstSurface = index;
        }
    }

    const SurfaceSoup& m_soup;
    const std::vector<glm::dvec3>& m_vertices;
    const std::vector<glm::vec2>& m_textureVertices;
    SoupTriangles& m_out;
    std::vector<PolygonRing> m_rings;
    TriangulatedPolygon m_polygon;
    std::vector<glm::vec2> m_uv;
};

/// Appends a piece; its born points get their final numbers.
void appendPiece(SoupTriangles& all, SoupTriangles piece) {
    const auto shift = static_cast<std::uint32_t>(all.born.size());
    for (SoupTriangles::Triangle& triangle : piece.triangles) {
        for (std::uint32_t& vertex : triangle.vertex) {
            if (vertex >= all.vertexCount)
                vertex += shift;
        }
    }
    all.triangles.insert(all.triangles.end(), piece.triangles.begin(), piece.triangles.end());
    all.uv.insert(all.uv.end(), piece.uv.begin(), piece.uv.end());
    all.born.insert(all.born.end(), piece.born.begin(), piece.born.end());
    all.problems.insert(all.problems.end(), std::make_move_iterator(piece.problems.begin()),
                        std::make_move_iterator(piece.problems.end()));
    all.notPlanar += piece.notPlanar;
    if (piece.worstDeviation > all.worstDeviation) {
        all.worstDeviation = piece.worstDeviation;
        all.worstSurface = piece.worstSurface;
    }
}

}  // namespace

Result<SoupTriangles> triangulateSoup(const SurfaceSoup& soup,
                                      const std::vector<glm::dvec3>& vertices,
                                      const std::vector<glm::vec2>& textureVertices,
                                      const std::vector<bool>& leftOut, const std::string& subject,
                                      const JobContext& job) {
    constexpr std::size_t kPieceSize = 256;
    constexpr std::size_t kPoll = 16;
    // Crossing edges can make a square number of points; a sound city makes next to none.
    const std::size_t bornLimit = 1'000'000 + 2 * soup.points.size();

    SoupTriangles all;
    all.vertexCount = static_cast<std::uint32_t>(vertices.size());
    all.states.assign(soup.surfaces.size(), State::LeftOut);
    const std::size_t pieceCount = (soup.surfaces.size() + kPieceSize - 1) / kPieceSize;
    std::vector<SoupTriangles> pieces(pieceCount);
    std::atomic<std::size_t> born{0};
    std::atomic<std::size_t> done{0};
    std::atomic<bool> tooMany{false};
    parallelFor(0, pieceCount, 1, [&](std::size_t firstPiece, std::size_t lastPiece) {
        for (std::size_t p = firstPiece; p < lastPiece; ++p) {
            SoupTriangles& out = pieces[p];
            out.vertexCount = all.vertexCount;
            PieceTriangulator triangulator(soup, vertices, textureVertices, out);
            const std::size_t end = std::min(soup.surfaces.size(), (p + 1) * kPieceSize);
            out.triangles.reserve(2 * (end - p * kPieceSize));
            for (std::size_t i = p * kPieceSize; i < end; ++i) {
                if (leftOut[soup.surfaces[i].owner])
                    continue;
                if (i % kPoll == 0 && (job.cancelled() || tooMany))
                    return;
                const std::size_t before = out.born.size();
                all.states[i] = triangulator.run(static_cast<std::uint32_t>(i));
                const std::size_t added = out.born.size() - before;
                if (added > 0 && born.fetch_add(added) + added > bornLimit)
                    tooMany = true;
            }
            job.progress(static_cast<double>(++done) / static_cast<double>(pieceCount));
        }
    });
    if (job.cancelled())
        return tl::unexpected<Error>(JobContext::cancelledError());
    if (tooMany) {
        return fail(ErrorCode::ResourceLimit,
                    fmt::format("has surfaces whose edges cross each other in more than {} points",
                                bornLimit),
                    subject, "Check the geometry of the file, e.g. with val3dity.");
    }
    for (SoupTriangles& piece : pieces)
        appendPiece(all, std::exchange(piece, {}));
    return all;
}

}  // namespace reflet::importers
