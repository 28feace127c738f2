// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/SourceCrs.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace reflet::importers {

namespace {

constexpr const char* kGiveCrs =
    "Give the right one with --crs, for example --crs EPSG:25832; --crs local takes the "
    "coordinates as local metres.";

Result<Crs> usable(Result<Crs> crs, const std::string& subject) {
    if (crs && crs->isGeocentric()) {
        return fail(ErrorCode::Refused,
                    fmt::format("has geocentric coordinates ({:.80})", crs->name()), subject,
                    "Convert it to a projected coordinate reference system first.");
    }
    return crs;
}

}  // namespace

Result<SourceCrs> sourceCrs(const SourceCity& file, const ImportOptions& options, bool inspection,
                            const std::string& subject, std::vector<Diagnostic>& diagnostics) {
    if (file.referenceSystem) {
        auto declared = usable(Crs::parse(*file.referenceSystem), subject);
        if (declared)
            return SourceCrs{*std::move(declared), false};
        const std::string text = fmt::format(
            "declares the coordinate reference system \"{:.120}\", which cannot be "
            "used: {}",
            *file.referenceSystem, declared.error().what);
        if (inspection && options.crs.empty()) {
            diagnostics.push_back({Severity::Error, "crs-unknown", "", text, kGiveCrs});
            return SourceCrs{};
        }
        if (options.crs.empty())
            return fail(ErrorCode::Refused, text, subject, kGiveCrs);
        diagnostics.push_back({Severity::Warning, "crs-replaced", "",
                               fmt::format("{}; {:.80} was taken in its place", text, options.crs),
                               ""});
    }
    if (options.crs == "local")
        return SourceCrs{};
    if (!options.crs.empty()) {
        auto given = usable(Crs::parse(options.crs), subject);
        if (!given)
            return tl::unexpected<Error>(given.error().in("reading the option --crs"));
        return SourceCrs{*std::move(given), false};
    }
    if (options.strict)
        return fail(ErrorCode::Refused, "declares no coordinate reference system", subject,
                    kGiveCrs);
    diagnostics.push_back({Severity::Warning, "no-crs", "",
                           "no coordinate reference system is declared; the coordinates were taken "
                           "as local metres",
                           kGiveCrs});
    return SourceCrs{};
}

void checkAxes(const glm::dvec3& centre, SourceCrs& crs, std::vector<Diagnostic>& diagnostics) {
    if (!crs.crs || crs.crs->areaContains(centre.x, centre.y))
        return;
    const bool swapped = crs.crs->areaContains(centre.y, centre.x);
    if (swapped && crs.crs->isGeographic()) {
        crs.swapAxes = true;
        diagnostics.push_back({Severity::Info, "axis-order", "",
                               "the coordinates have the latitude first and were read that way",
                               ""});
        return;
    }
    diagnostics.push_back(
        {Severity::Warning, "outside-area-of-use", "",
         fmt::format("the coordinates around {:.3f}, {:.3f} lie outside the area that {} is made "
                     "for{}",
                     centre.x, centre.y, crs.crs->name(),
                     swapped ? "; with east and north exchanged they would lie inside" : ""),
         "Check the coordinate reference system that the file declares."});
}

std::vector<glm::dvec3> sourceVertices(const SourceCity& file) {
    constexpr double kFarthest = 1e9;
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    const VertexTransform transform = file.transform.value_or(VertexTransform{});
    std::vector<glm::dvec3> source;
    source.reserve(file.vertices.size());
    for (const glm::dvec3& numbers : file.vertices) {
        const glm::dvec3 p = numbers * transform.scale + transform.translate;
        // Written so that NaN fails too.
        const bool sound =
            std::abs(p.x) < kFarthest && std::abs(p.y) < kFarthest && std::abs(p.z) < kFarthest;
        source.push_back(sound ? p : glm::dvec3(kNaN));
    }
    return source;
}

glm::dvec3 centreOf(const std::vector<glm::dvec3>& points, const std::vector<bool>& marked,
                    double hugeSize, std::vector<Diagnostic>& diagnostics) {
    Box box;
    std::size_t count = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (marked[i] && !std::isnan(points[i].x)) {
            box.add(points[i]);
            ++count;
        }
    }
    if (count == 0)
        return glm::dvec3(0.0);
    const glm::dvec3 size = box.size();
    if (size.x <= hugeSize && size.y <= hugeSize)
        return box.center();
    diagnostics.push_back(
        {Severity::Warning, "far-apart", "",
         fmt::format("the objects spread over {:.0f} by {:.0f} units", size.x, size.y),
         "Check for stray objects, or import a part with --bbox."});
    glm::dvec3 median(0.0);
    std::vector<double> values;
    values.reserve(count);
    for (int axis = 0; axis < 3; ++axis) {
        values.clear();
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (marked[i] && !std::isnan(points[i].x))
                values.push_back(points[i][axis]);
        }
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        median[axis] = *middle;
    }
    return median;
}

}  // namespace reflet::importers
