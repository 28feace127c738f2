// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/terrain/Orthophoto.h"

#include "core/geo/Crs.h"
#include "core/io/RasterFile.h"
#include "importers/terrain/PictureTiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

using terrain::PictureGrid;

constexpr float kLevel = 0.5F;  ///< |n.z| from which a surface is ground rather than a kerb

bool isBare(const CityModel& city, const CitySurface& surface) {
    const CityObject& object = city.objects[surface.object];
    const bool generated = object.id == "reflet-generated-ground";
    return isTerrain(object.type) && surface.texture == kNone &&
           (surface.material == kNone || generated);
}

/// The triangles that a picture may be laid on.
std::vector<std::uint32_t> groundTriangles(const CityModel& city) {
    std::vector<std::uint32_t> ground;
    for (std::uint32_t t = 0; t < city.triangles.size(); ++t)
        if (isBare(city, city.surfaces[city.triangles[t].surface]) &&
            std::abs(city.normal(t).z) >= kLevel)
            ground.push_back(t);
    return ground;
}

Box boundsOf(const CityModel& city, const std::vector<std::uint32_t>& triangles) {
    Box box;
    for (const std::uint32_t t : triangles)
        for (const std::uint32_t v : city.triangles[t].vertex)
            box.add(glm::dvec3(city.vertices[v]));
    return box;
}

/// A picture in the frame.
struct Placed {
    std::string file;
    std::optional<std::string> crs;  ///< that the pixels are brought into; nullopt = its own
    glm::dvec2 shift{0.0};           ///< from that system into the frame
    glm::dvec2 min{0.0}, max{0.0};   ///< in the frame
    double pixel = 1.0;              ///< metres
};

/// The rim of the raster in its own coordinates.
std::vector<glm::dvec3> rimOf(const RasterInfo& info) {
    constexpr int kSteps = 32;
    std::vector<glm::dvec3> rim;
    for (int k = 0; k <= kSteps; ++k) {
        const double s = double(k) / kSteps;
        for (const double side : {0.0, 1.0}) {
            rim.emplace_back(info.at(s * info.columns, side * info.rows), 0.0);
            rim.emplace_back(info.at(side * info.columns, s * info.rows), 0.0);
        }
    }
    return rim;
}

Result<void> bringIntoFrame(const Crs& from, const ProjectFrame& frame,
                            std::vector<glm::dvec3>& points) {
    const auto to = Crs::parse(*frame.crs);
    if (!to)
        return tl::unexpected(to.error());
    const auto transform = CrsTransform::create(from, *to);
    if (!transform)
        return tl::unexpected(transform.error());
    return transform->apply(points);
}

/// The system that the file's coordinates are in; nullopt = the frame's.
Result<std::optional<Crs>> systemOf(const RasterInfo& info, const Orthophoto& picture) {
    const bool given = !picture.crs.empty() && picture.crs != "local";
    if (!info.crs && !given)
        return std::nullopt;
    auto crs = Crs::parse(info.crs ? *info.crs : picture.crs);
    if (!crs)
        return tl::unexpected(crs.error());
    return std::optional(std::move(*crs));
}

Result<Placed> placeOf(const Orthophoto& picture, const ProjectFrame& frame) {
    const auto file = RasterFile::open(picture.file);
    if (!file)
        return tl::unexpected(file.error());
    const RasterInfo& info = file->info();
    const std::string subject = picture.file.string();
    if (!info.placed)
        return fail(ErrorCode::Refused, "does not say where it lies", subject,
                    "Give it a world file (.tfw, .jgw) beside it.");
    if (!info.bytes)
        return fail(ErrorCode::Refused, "its colours have more than 8 bits", subject,
                    "Convert it: gdal_translate -ot Byte -scale IN.tif OUT.tif");
    const auto crs = systemOf(info, picture);
    if (!crs)
        return tl::unexpected(crs.error());
    if (*crs && !frame.crs)
        return fail(ErrorCode::Refused,
                    "has a place on the Earth, and the project is in local metres", subject,
                    "Place the project first, or give the picture in local coordinates.");
    std::vector<glm::dvec3> rim = rimOf(info);
    Placed placed;
    placed.file = subject;
    if (*crs && (*crs)->horizontal() != *frame.crs) {
        if (auto done = bringIntoFrame(**crs, frame, rim); !done)
            return tl::unexpected(done.error().in("placing " + subject));
    }
    if (info.crs)
        placed.crs = frame.crs;
    placed.shift = picture.offset - glm::dvec2(frame.origin);
    Box box;
    for (const glm::dvec3& p : rim)
        box.add(p);
    placed.min = glm::dvec2(box.min) + placed.shift;
    placed.max = glm::dvec2(box.max) + placed.shift;
    // Metres of the frame per pixel of the file, by its whole size.
    placed.pixel = std::max(
        1e-3, std::sqrt(box.size().x * box.size().y / (double(info.columns) * double(info.rows))));
    return placed;
}

/// The part of the picture over the ground; false when there is none.
bool clip(Placed& placed, const Box& ground) {
    placed.min = glm::max(placed.min, glm::dvec2(ground.min));
    placed.max = glm::min(placed.max, glm::dvec2(ground.max));
    return placed.min.x < placed.max.x && placed.min.y < placed.max.y;
}

}  // namespace

Result<std::vector<Diagnostic>> drape(CityModel& city, const std::vector<Orthophoto>& pictures,
                                      const OrthophotoOptions& options, const JobContext& job) {
    std::vector<Diagnostic> remarks;
    std::vector<Placed> all;
    for (const Orthophoto& picture : pictures) {
        auto placed = placeOf(picture, city.frame);
        if (!placed)
            return tl::unexpected(placed.error());
        if (clip(*placed, boundsOf(city, groundTriangles(city)))) {
            all.push_back(std::move(*placed));
        } else {
            remarks.push_back({Severity::Warning, "orthophoto-beside", picture.file.string(),
                               "The orthophoto does not lie over the ground of the city.",
                               "Check its coordinate reference system."});
        }
    }
    for (std::size_t k = 0; k < all.size(); ++k) {
        const Placed& placed = all[k];
        if (job.cancelled())
            return tl::unexpected(JobContext::cancelledError());
        job.progress(double(k) / double(all.size()));
        const std::size_t share = std::max<std::size_t>(1, options.mostTiles / all.size());
        const PictureGrid grid = terrain::tileGrid(placed.min, placed.max, placed.pixel, share);
        terrain::layOn(city, groundTriangles(city), grid, {placed.file, placed.crs, placed.shift});
        if (grid.pixel > 1.01 * placed.pixel) {
            remarks.push_back({Severity::Info, "orthophoto-coarser", placed.file,
                               fmt::format("The orthophoto is shown with pixels of {:.2f} m; the "
                                           "file has {:.2f} m.",
                                           grid.pixel, placed.pixel),
                               "Import a smaller part of the city to see it finer."});
        }
    }
    return remarks;
}

}  // namespace reflet
