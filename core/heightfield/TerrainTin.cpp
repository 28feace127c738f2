// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/TerrainTin.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Projection_traits_xy_3.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <exception>
#include <tuple>

namespace reflet {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Traits = CGAL::Projection_traits_xy_3<Kernel>;
using Delaunay = CGAL::Delaunay_triangulation_2<Traits>;

/// Cocircular points (any regular grid) have several Delaunay triangulations, and which one comes
/// out depends on the order of insertion: sort, so that the order of the input does not matter.
void sortLowestFirst(std::vector<glm::dvec3>& points) {
    std::sort(points.begin(), points.end(), [](const glm::dvec3& a, const glm::dvec3& b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    });
    const auto samePlace = [](const glm::dvec3& a, const glm::dvec3& b) {
        return a.x == b.x && a.y == b.y;
    };
    points.erase(std::unique(points.begin(), points.end(), samePlace), points.end());
}

glm::dvec3 position(const Kernel::Point_3& p) {
    return {p.x(), p.y(), p.z()};
}

std::vector<TriangleCorners> facesOf(const Delaunay& triangulation) {
    std::vector<TriangleCorners> faces;
    faces.reserve(triangulation.number_of_faces());
    for (const auto& face : triangulation.finite_face_handles()) {
        faces.push_back({position(face->vertex(0)->point()), position(face->vertex(1)->point()),
                         position(face->vertex(2)->point())});
    }
    return faces;
}

Result<std::vector<TriangleCorners>> triangulate(const std::vector<glm::dvec3>& sorted,
                                                 const JobContext& job) {
    std::vector<Kernel::Point_3> points;
    points.reserve(sorted.size());
    for (const glm::dvec3& p : sorted) {
        points.emplace_back(p.x, p.y, p.z);
    }
    CGAL::spatial_sort(points.begin(), points.end(), Traits());
    Delaunay triangulation;
    Delaunay::Face_handle hint;
    for (std::size_t n = 0; n < points.size(); ++n) {
        if (n % 4096 == 0) {
            if (job.cancelled()) {
                return tl::unexpected(JobContext::cancelledError());
            }
            job.progress(double(n) / double(points.size()));
        }
        hint = triangulation.insert(points[n], hint)->face();
    }
    return facesOf(triangulation);
}

}  // namespace

Result<std::vector<TriangleCorners>> delaunayFromAbove(std::vector<glm::dvec3> points,
                                                       const JobContext& job) {
    sortLowestFirst(points);
    try {
        return triangulate(points, job);
    } catch (const std::exception& exception) {
        return fail(ErrorCode::Internal, exception.what(), "terrain triangulation",
                    "Report this, with the model if you can");
    }
}

}  // namespace reflet
