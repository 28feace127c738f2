// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/city/CityModel.h"
#include "importers/common/ImportReport.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace reflet::importers {

/// Polygons with their holes, in flat arrays: a city has millions of points.
struct SurfaceSoup {
    struct Surface {
        std::uint32_t owner = 0;  ///< index of the object, or of the template
        std::uint32_t firstRing = 0;
        std::uint32_t ringCount = 0;
        std::uint32_t material = kNone;
        std::uint32_t texture = kNone;
        std::uint32_t firstUv = kNone;  ///< into uvs: one for each point, ring after ring
        SurfaceType type = SurfaceType::Unknown;
    };
    std::vector<Surface> surfaces;
    std::vector<std::uint32_t> ringEnds;  ///< into points, one for each ring
    std::vector<std::uint32_t> points;    ///< indices of vertices, all of them valid
    std::vector<std::uint32_t> uvs;       ///< indices of texture coordinates, all of them valid

    [[nodiscard]] std::uint32_t ringBegin(std::uint32_t ring) const {
        return ring == 0 ? 0 : ringEnds[ring - 1];
    }
    [[nodiscard]] std::uint32_t firstPoint(const Surface& surface) const {
        return ringBegin(surface.firstRing);
    }
    [[nodiscard]] std::uint32_t pointCount(const Surface& surface) const {
        return surface.ringCount == 0
                   ? 0
                   : ringEnds[surface.firstRing + surface.ringCount - 1] - firstPoint(surface);
    }
};

/// The triangles that a polygon of `points` points in `rings` rings has, closing and repeated
/// points included, if none are added: points + 2 * holes - 2. It is what reports count; the
/// triangles of the model are fewer where points are repeated or lie on a line, and differ where
/// edges cross.
[[nodiscard]] std::size_t nominalTriangles(std::size_t points, std::size_t rings);

struct InstanceRecord {
    std::uint32_t object = 0;
    std::uint32_t templateIndex = 0;
    std::uint32_t anchor = 0;         ///< index of a vertex
    std::array<double, 16> matrix{};  ///< row-major
};

/// What is odd about a template, for each object that shows it.
struct TemplateNote {
    Issue issue;
    std::string detail;
    std::size_t count;
};

/// All chosen geometry of a file.
struct CityGeometry {
    SurfaceSoup surfaces;
    SurfaceSoup templates;                     ///< owner = index of the template, ascending
    std::vector<std::uint32_t> templateBegin;  ///< into templates.surfaces; one more than templates
    std::vector<std::vector<TemplateNote>> templateNotes;  ///< one for each, or fewer
    std::vector<InstanceRecord> instances;
    std::vector<bool> usedBySurface;   ///< of each vertex
    std::size_t writtenSurfaces = 0;   ///< polygons met, unusable ones included
    std::size_t writtenTriangles = 0;  ///< their nominal triangles
    bool withoutAppearance = false;    ///< textures or materials are named, but the file lists none
};

}  // namespace reflet::importers
