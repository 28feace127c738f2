// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/GeoFile.h"

#include "core/geo/Crs.h"
#include "core/io/GdalSession.h"
#include "core/io/GdalVector.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>

namespace reflet {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostPoints = 1'000'000;
constexpr std::uintmax_t kLargestFile = std::uintmax_t(512) << 20;

/// Formats that keep their data in the file itself. Left out on purpose: what fetches from
/// elsewhere (VRT, web services, databases) or writes beside its input (GML).
constexpr const char* kDrivers[] = {"GeoJSON",     "GeoJSONSeq", "TopoJSON", "ESRI Shapefile",
                                    "GPKG",        "FlatGeobuf", "KML",      "LIBKML",
                                    "GPX",         "DXF",        "OSM",      "MapInfo File",
                                    "OpenFileGDB", "SQLite",     nullptr};

struct Layer {
    std::vector<GeoLine> lines;
    Box bounds;  ///< of the lines as they are in the file
};

/// Collects the lines of one file, within the limit on points.
class LineCollector {
public:
    [[nodiscard]] bool tooMany() const { return m_points > kMostPoints; }

    void addLayer(OGRLayer& source, Layer& layer) {
        source.ResetReading();
        while (!tooMany()) {
            const OGRFeatureUniquePtr feature(source.GetNextFeature());
            if (!feature)
                return;
            const OGRGeometry* const geometry = feature->GetGeometryRef();
            if (geometry == nullptr)
                continue;
            m_name = nameOf(*feature);
            m_attributes = attributesOf(*feature);
            m_part = 0;
            addGeometry(*geometry, layer, 0);
        }
    }

private:
    static std::map<std::string, std::string> attributesOf(const OGRFeature& feature) {
        constexpr int kMost = 64;
        constexpr std::size_t kLongest = 1000;
        std::map<std::string, std::string> attributes;
        for (int k = 0; k < std::min(feature.GetFieldCount(), kMost); ++k) {
            if (feature.IsFieldSetAndNotNull(k) == 0)
                continue;
            const std::string text = feature.GetFieldAsString(k);
            if (!text.empty() && text.size() <= kLongest)
                attributes[feature.GetFieldDefnRef(k)->GetNameRef()] = text;
        }
        return attributes;
    }
    static std::string nameOf(const OGRFeature& feature) {
        for (const char* field : {"name", "id"}) {
            const int index = feature.GetFieldIndex(field);  // upper or lower case
            if (index < 0 || feature.IsFieldSetAndNotNull(index) == 0)
                continue;
            const std::string text = feature.GetFieldAsString(index);
            if (!text.empty())
                return text;
        }
        return std::to_string(feature.GetFID());
    }

    void addGeometry(const OGRGeometry& geometry, Layer& layer, int depth) {
        constexpr int kDeepest = 16;
        if (depth > kDeepest)
            return;
        if (geometry.hasCurveGeometry() != 0) {
            const std::unique_ptr<OGRGeometry> linear(geometry.getLinearGeometry());
            if (linear)
                addGeometry(*linear, layer, depth + 1);
            return;
        }
        const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
        if (type == wkbLineString) {
            addLine(*geometry.toLineString(), layer);
        } else if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection) != 0) {
            for (const OGRGeometry* part : *geometry.toGeometryCollection())
                addGeometry(*part, layer, depth + 1);
        }
    }

    void addLine(const OGRLineString& line, Layer& layer) {
        const auto count = std::size_t(line.getNumPoints());
        m_points += count;
        if (count < 2 || tooMany())
            return;
        GeoLine out;
        const bool hasHeights = line.Is3D() != 0;
        Box bounds;
        for (int i = 0; i < int(count); ++i) {
            const glm::dvec3 p(line.getX(i), line.getY(i),
                               hasHeights ? line.getZ(i) : std::nan(""));
            if (!std::isfinite(p.x) || !std::isfinite(p.y))
                return;
            bounds.add(glm::dvec3(p.x, p.y, 0.0));
            out.points.push_back(p);
        }
        out.name = ++m_part == 1 ? m_name : m_name + " (" + std::to_string(m_part) + ")";
        out.attributes = m_attributes;
        layer.bounds.add(bounds);
        layer.lines.push_back(std::move(out));
    }

    std::size_t m_points = 0;
    std::string m_name;
    std::map<std::string, std::string> m_attributes;
    int m_part = 0;
};

bool plainlyNoDegrees(const Box& bounds) {
    return bounds.min.x < -180.0 || bounds.max.x > 180.0 || bounds.min.y < -90.0 ||
           bounds.max.y > 90.0;
}

Result<void> transformLines(Layer& layer, const Crs& from, const ProjectFrame& frame) {
    const auto to = Crs::parse(*frame.crs);
    if (!to)
        return tl::unexpected(to.error());
    const auto transform = CrsTransform::create(from, *to);
    if (!transform)
        return tl::unexpected(transform.error());
    for (GeoLine& line : layer.lines)
        if (auto done = transform->apply(line.points); !done)
            return done;
    return {};
}

/// Brings a layer's lines into the frame's CRS; nothing to do for a layer that declares none.
Result<void> place(Layer& layer, const OGRSpatialReference* system, bool geoJson,
                   const ProjectFrame& frame) {
    if (system == nullptr || system->IsLocal() != 0 || layer.lines.empty())
        return {};
    // GeoJSON is in degrees by RFC 7946, whether it says so or not; planners ship metres.
    const bool assumed = geoJson && system->IsGeographic() != 0;
    if (assumed && (!frame.crs || plainlyNoDegrees(layer.bounds)))
        return {};
    if (!frame.crs)
        return fail(ErrorCode::Refused,
                    "its lines have a place on the Earth, and the project is in local metres", {},
                    "Give the project a coordinate reference system, or draw the lines in its "
                    "own coordinates.");
    const auto from = Crs::parse(gdal::wktOf(*system));
    if (!from)
        return tl::unexpected(from.error());
    if (gdal::northFirst(*system))
        for (GeoLine& line : layer.lines)
            for (glm::dvec3& p : line.points)
                std::swap(p.x, p.y);
    return transformLines(layer, *from, frame);
}

Error about(const fs::path& path, Error error) {
    error.what = error.subject.empty() ? error.what : error.what + " (" + error.subject + ")";
    error.subject = path.string();
    return error;
}

Result<void> checkSize(const fs::path& path) {
    std::error_code failed;
    const std::uintmax_t size = fs::file_size(path, failed);
    if (!failed && size > kLargestFile)
        return fail(ErrorCode::ResourceLimit, "is larger than 512 MB", path.string(),
                    "Keep only the routes.");
    return {};
}

Result<std::vector<GeoLine>> readAll(const fs::path& path, const ProjectFrame& frame) {
    const GdalSession session;
    const auto dataset = gdal::openVector(path, kDrivers, session);
    if (!dataset)
        return tl::unexpected(dataset.error());
    LineCollector collector;
    std::vector<GeoLine> lines;
    for (OGRLayer* source : (*dataset)->GetLayers()) {
        Layer layer;
        collector.addLayer(*source, layer);
        if (collector.tooMany())
            return fail(ErrorCode::ResourceLimit, "its lines have more than a million points",
                        path.string(), "Keep only the routes, or simplify them.");
        if (auto done = place(layer, source->GetSpatialRef(), gdal::isGeoJson(**dataset), frame);
            !done)
            return tl::unexpected(about(path, done.error()));
        std::move(layer.lines.begin(), layer.lines.end(), std::back_inserter(lines));
    }
    if (lines.empty())
        return fail(ErrorCode::Unreadable,
                    "it holds no line" + (session.failed() ? ": " + session.message() : ""),
                    path.string(), "Draw each route as a line (LineString).");
    return lines;
}

}  // namespace

Result<std::vector<GeoLine>> readLines(const fs::path& path, const ProjectFrame& frame) {
    if (auto usable = checkSize(path); !usable)
        return tl::unexpected(usable.error());
    try {
        return readAll(path, frame);
    } catch (const std::exception& error) {
        return fail(ErrorCode::Unreadable, std::string("GDAL gave up: ") + error.what(),
                    path.string());
    }
}

std::string gdalVersion() {
    return GDALVersionInfo("RELEASE_NAME");
}

}  // namespace reflet
