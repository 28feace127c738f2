// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/Placement.h"

#include "core/base/ParallelFor.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

namespace reflet::importers {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kPerMillimetre = 1e3;
constexpr double kPerMicrometre = 1e6;

glm::dvec3 snapped(const glm::dvec3& p, double perUnit) {
    return glm::dvec3(std::round(p.x * perUnit), std::round(p.y * perUnit),
                      std::round(p.z * perUnit)) /
           perUnit;
}

/// The unit of the heights: that of the vertical CRS, else of the horizontal one, as in the
/// surveys of US counties that are in feet throughout.
double heightUnit(const Crs& crs) {
    constexpr double kUsSurveyFoot = 1200.0 / 3937.0;
    constexpr double kFoot = 0.3048;
    const auto& vertical = crs.vertical();
    if (vertical)
        return *vertical == "EPSG:6360" ? kUsSurveyFoot : (*vertical == "EPSG:8228" ? kFoot : 1.0);
    return crs.isProjected() ? crs.metresPerUnit() : 1.0;
}

bool isMetric(const Crs& crs) {
    return crs.isProjected() && crs.metresPerUnit() == 1.0;
}

/// Transforms all points; those without an image become NaN.
void transformSome(const CrsTransform& transform, std::vector<glm::dvec3>& points) {
    std::vector<glm::dvec3> attempt = points;
    if (transform.apply(attempt)) {
        points = std::move(attempt);
        return;
    }
    for (glm::dvec3& p : points) {
        const auto image = transform.apply(p);
        p = image ? *image : glm::dvec3(kNaN);
    }
}

}  // namespace

Result<void> Placement::into(const std::string& crs, const std::string& subject) {
    auto target = Crs::parse(crs);
    if (!target)
        return tl::unexpected<Error>(target.error().in("choosing the project's CRS"));
    if (!isMetric(*target)) {
        return fail(ErrorCode::Refused,
                    fmt::format("the project's CRS {:.80} is not a projected one in metres", crs),
                    subject, "Choose a projected CRS in metres, for example the UTM zone.");
    }
    m_frame.crs = target->horizontal();
    if (m_source && m_source->horizontal() != target->horizontal()) {
        auto operation = CrsTransform::create(*m_source, *target);
        if (!operation)
            return tl::unexpected<Error>(operation.error().in("importing " + subject));
        m_target = *std::move(target);
    }
    return {};
}

/// The UTM zone on WGS 84 that a point of the source CRS lies in.
Result<std::string> Placement::metricCrs(const glm::dvec3& centre) const {
    glm::dvec3 degrees = centre;
    if (auto wgs84 = Crs::parse("EPSG:4326");
        wgs84 && wgs84->horizontal() != m_source->horizontal()) {
        auto operation = CrsTransform::create(*m_source, *wgs84);
        if (!operation)
            return tl::unexpected<Error>(operation.error());
        auto image = operation->apply(centre);
        if (!image)
            return tl::unexpected<Error>(image.error());
        degrees = *image;
    }
    const int zone = std::clamp(static_cast<int>(std::floor((degrees.x + 180.0) / 6.0)) + 1, 1, 60);
    return fmt::format("EPSG:{}", (degrees.y >= 0.0 ? 32600 : 32700) + zone);
}

Result<void> Placement::chooseFrame(const ImportOptions& options, const glm::dvec3& centre,
                                    const std::string& subject,
                                    std::vector<Diagnostic>& diagnostics) {
    if (options.frame) {
        m_frame = *options.frame;
        if (!m_source)
            return {};  // its coordinates are taken to be the frame's
        if (!m_frame.crs) {
            return fail(ErrorCode::Refused,
                        fmt::format("is in {:.80}, but the project has local coordinates",
                                    m_source->name()),
                        subject, "Start a project of its own from this file.");
        }
        const auto& vertical = m_source->vertical();
        if (vertical && m_frame.vertical && *vertical != *m_frame.vertical) {
            diagnostics.push_back(
                {Severity::Warning, "vertical-datum", "",
                 fmt::format("heights are in {}, those of the project in {}; they were taken over "
                             "as they are",
                             *vertical, *m_frame.vertical),
                 "Bring the file into the project's vertical datum first."});
        }
        return into(*m_frame.crs, subject);
    }
    if (!m_source) {
        m_frame.origin = frameOrigin(centre);
        if (!options.projectCrs.empty() && options.projectCrs != "local")
            return into(options.projectCrs, subject);
        return {};
    }
    m_frame.vertical = m_source->vertical();
    std::string crs = options.projectCrs;
    if (crs.empty() && isMetric(*m_source))
        crs = m_source->horizontal();
    if (crs.empty()) {
        auto metric = metricCrs(centre);
        if (!metric)
            return tl::unexpected<Error>(
                metric.error().in("looking for the UTM zone of " + subject));
        crs = *metric;
        diagnostics.push_back({Severity::Info, "reprojected", "",
                               fmt::format("{} is not in metres; the city was brought into {}",
                                           m_source->name(), crs),
                               "Choose another target with --project-crs."});
    }
    if (auto done = into(crs, subject); !done)
        return done;
    glm::dvec3 middle = centre;
    if (m_target) {
        auto operation = CrsTransform::create(*m_source, *m_target);
        auto image = operation ? operation->apply(centre)
                               : Result<glm::dvec3>(tl::unexpected<Error>(operation.error()));
        if (!image)
            return tl::unexpected<Error>(image.error().in("importing " + subject));
        middle = *image;
    }
    m_frame.origin = frameOrigin(middle);
    return {};
}

Result<Placement> Placement::create(SourceCrs crs, const Extent& extent,
                                    const ImportOptions& options, const std::string& subject,
                                    std::vector<Diagnostic>& diagnostics) {
    constexpr double kHugeMetres = 200e3;
    constexpr double kHugeDegrees = 2.0;
    Placement placement;
    const bool degrees = crs.crs && crs.crs->isGeographic();
    const glm::dvec3 centre = extent.centre(degrees ? kHugeDegrees : kHugeMetres, diagnostics);
    placement.m_source = std::move(crs.crs);
    if (placement.m_source) {
        placement.m_heightUnit = heightUnit(*placement.m_source);
        if (placement.m_heightUnit != 1.0) {
            diagnostics.push_back(
                {Severity::Warning, "height-unit", "",
                 fmt::format("heights were taken to be in units of {:.6f} m, like the coordinates",
                             placement.m_heightUnit),
                 "Convert the file to metres if they are not."});
        }
    }
    if (auto chosen = placement.chooseFrame(options, centre, subject, diagnostics); !chosen)
        return tl::unexpected<Error>(chosen.error());
    if (placement.m_target) {
        placement.nameOperation(centre);
        diagnostics.push_back(
            {Severity::Info, "heights-unchanged", "",
             fmt::format("east and north were transformed to {:.80}; heights were taken over as "
                         "they are",
                         placement.m_frame.crs.value_or("")),
             ""});
    }
    return placement;
}

/// The operation that PROJ uses at the city, which may differ from one for all of the CRS's area.
void Placement::nameOperation(const glm::dvec3& centre) {
    const auto operation = CrsTransform::create(*m_source, *m_target);
    if (!operation)
        return;
    [[maybe_unused]] const auto image = operation->apply(centre);
    m_operation = operation->operationName();
    if (operation->accuracy() >= 0.0)
        m_accuracy = operation->accuracy();
}

Result<void> Placement::transform(std::vector<glm::dvec3>& points) const {
    // A piece pays for the making of its own operation.
    constexpr std::size_t kPiece = 1U << 16;
    std::atomic<bool> failed{false};
    parallelFor(0, points.size(), kPiece, [&](std::size_t first, std::size_t last) {
        auto operation = CrsTransform::create(*m_source, *m_target);
        if (!operation) {
            failed = true;
            return;
        }
        const auto begin = points.begin() + static_cast<std::ptrdiff_t>(first);
        std::vector<glm::dvec3> piece(begin, begin + static_cast<std::ptrdiff_t>(last - first));
        transformSome(*operation, piece);
        std::copy(piece.begin(), piece.end(), begin);
    });
    if (failed)
        return fail(ErrorCode::Internal, "a transformation could be made once but not again");
    for (glm::dvec3& p : points)
        p = snapped(p - m_frame.origin, kPerMillimetre);
    return {};
}

Result<std::vector<glm::dvec3>> Placement::vertices(const SourceCity& file,
                                                    const std::vector<glm::dvec3>& source,
                                                    bool swapAxes, const JobContext& job) const {
    std::vector<glm::dvec3> local;
    if (m_target) {
        local = source;
        for (glm::dvec3& p : local) {
            if (swapAxes)
                std::swap(p.x, p.y);
            p.z *= m_heightUnit;
        }
        if (auto done = transform(local); !done)
            return tl::unexpected<Error>(done.error());
    } else {
        const VertexTransform grid = file.transform.value_or(VertexTransform{});
        const glm::dvec3& o = m_frame.origin;
        const glm::dvec3 shift = grid.translate - (swapAxes ? glm::dvec3(o.y, o.x, o.z) : o);
        const double perUnit = file.transform ? kPerMicrometre : kPerMillimetre;
        local.reserve(source.size());
        for (std::size_t i = 0; i < source.size(); ++i) {
            glm::dvec3 p = file.vertices[i] * grid.scale + shift;
            if (swapAxes)
                std::swap(p.x, p.y);
            p.z *= m_heightUnit;
            local.push_back(std::isnan(source[i].x) ? glm::dvec3(kNaN) : snapped(p, perUnit));
        }
    }
    if (job.cancelled())
        return tl::unexpected<Error>(JobContext::cancelledError());
    return local;
}

Result<void> Placement::placeAround(const glm::dvec3& sourceAnchor, const glm::dvec3& localAnchor,
                                    std::vector<glm::dvec3>& offsets) const {
    if (!m_target || m_source->isGeographic()) {
        for (glm::dvec3& p : offsets)
            p = snapped(localAnchor + p, kPerMillimetre);
        return {};
    }
    for (glm::dvec3& p : offsets) {
        p += sourceAnchor;
        p.z *= m_heightUnit;
    }
    return transform(offsets);
}

}  // namespace reflet::importers
