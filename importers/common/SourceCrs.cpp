// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/SourceCrs.h"

#include <fmt/core.h>

#include <cmath>
#include <limits>
#include <string_view>

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

/// By the first axis of its WKT: those of the base of a projected CRS are not written there.
bool northComesFirst(const Crs& crs) {
    const std::string wkt = crs.wkt();
    const std::size_t axis = wkt.find("AXIS[\"");
    const std::size_t nameEnd = axis == std::string::npos ? axis : wkt.find('"', axis + 6);
    if (nameEnd == std::string::npos)
        return false;
    const std::string_view rest = std::string_view(wkt).substr(nameEnd + 1, 16);
    return rest.find("north") != std::string_view::npos;
}

}  // namespace

Result<SourceCrs> sourceCrs(const std::optional<std::string>& declared,
                            const ImportOptions& options, bool inspection,
                            const std::string& subject, std::vector<Diagnostic>& diagnostics) {
    if (declared) {
        auto crs = usable(Crs::parse(*declared), subject);
        if (crs)
            return SourceCrs{*std::move(crs), false, CrsRule::Declared};
        const std::string text = fmt::format(
            "declares the coordinate reference system \"{:.120}\", which cannot be "
            "used: {}",
            *declared, crs.error().what);
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
        return SourceCrs{std::nullopt, false, declared ? CrsRule::Replaced : CrsRule::Given};
    if (!options.crs.empty()) {
        auto given = usable(Crs::parse(options.crs), subject);
        if (!given)
            return tl::unexpected<Error>(given.error().in("reading the option --crs"));
        return SourceCrs{*std::move(given), false, declared ? CrsRule::Replaced : CrsRule::Given};
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

void checkAxes(const glm::dvec3& centre, AxisOrder order, std::string_view asked, SourceCrs& crs,
               std::vector<Diagnostic>& diagnostics) {
    if (!asked.empty() && order != AxisOrder::Settled) {
        crs.swapAxes = asked == "ne";
        diagnostics.push_back({Severity::Info, "axis-order", "",
                               fmt::format("the coordinates were read with {} first, as was asked",
                                           crs.swapAxes ? "north" : "east"),
                               ""});
    }
    if (!crs.crs)
        return;
    const bool ofAuthority = order == AxisOrder::OfAuthority;
    const auto contains = [&](bool swapped) {
        return swapped ? crs.crs->areaContains(centre.y, centre.x)
                       : crs.crs->areaContains(centre.x, centre.y);
    };
    if (asked.empty())
        crs.swapAxes = ofAuthority && northComesFirst(*crs.crs);
    if (contains(crs.swapAxes))
        return;
    const bool other = contains(!crs.swapAxes);
    const bool mayExchange =
        ofAuthority || (order == AxisOrder::EastNorth && crs.crs->isGeographic());
    if (other && asked.empty() && mayExchange) {
        crs.swapAxes = !crs.swapAxes;
        const bool degrees = crs.crs->isGeographic();
        const char* first = crs.swapAxes ? (degrees ? "the latitude" : "north")
                                         : (degrees ? "the longitude" : "east");
        diagnostics.push_back(
            {Severity::Info, "axis-order", "",
             fmt::format("the coordinates have {} first and were read that way", first), ""});
        return;
    }
    const std::string outside = fmt::format(
        "the coordinates around {:.3f}, {:.3f} lie outside the area that {} is made for", centre.x,
        centre.y, crs.crs->name());
    if (other && asked.empty())
        diagnostics.push_back(
            {Severity::Warning, kAxesExchanged, "",
             outside + "; with east and north exchanged they would lie inside",
             "Read the file with --axes ne, or press Exchange east and north in the window."});
    else
        diagnostics.push_back({Severity::Warning, "outside-area-of-use", "", outside,
                               asked.empty()
                                   ? "Check the coordinate reference system that the file declares."
                                   : "Check the coordinate reference system, and --axes."});
}

glm::dvec3 sourceVertex(const SourceCity& file, std::size_t vertex) {
    constexpr double kFarthest = 1e9;
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    const VertexTransform transform = file.transform.value_or(VertexTransform{});
    const glm::dvec3 p = file.vertices[vertex] * transform.scale + transform.translate;
    // Written so that NaN fails too.
    const bool sound =
        std::abs(p.x) < kFarthest && std::abs(p.y) < kFarthest && std::abs(p.z) < kFarthest;
    return sound ? p : glm::dvec3(kNaN);
}

std::vector<glm::dvec3> sourceVertices(const SourceCity& file) {
    std::vector<glm::dvec3> source(file.vertices.size());
    for (std::size_t v = 0; v < source.size(); ++v)
        source[v] = sourceVertex(file, v);
    return source;
}

}  // namespace reflet::importers
