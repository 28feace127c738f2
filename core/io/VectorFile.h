// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"
#include "core/io/PlanPolygon.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace reflet {

struct VectorLayer {
    std::string name;
    std::vector<std::string> fields;
    /// What the layer declares, as WKT2. GeoJSON without a crs member counts as WGS 84 (RFC 7946).
    std::optional<std::string> crs;
    bool assumedCrs = false;   ///< WGS 84 by the standard, not by the file
    bool mayHaveAreas = true;  ///< false: declared to hold points or lines alone
    bool points = false;       ///< declared to hold points, or a table
};

/// A feature of a layer, as far as it is a place.
struct PointFeature {
    std::int64_t number = 0;  ///< GDAL's feature id
    /// Of a point or points, east, north and height, the latter NaN where the file has none; empty
    /// for anything else.
    std::vector<glm::dvec3> places;
    std::vector<std::string> values;  ///< of the fields asked for; empty where there is none
};

/// A feature of a layer, as far as it covers an area.
struct AreaFeature {
    enum class Kind { Areas, NoGeometry, NotAnArea };
    std::int64_t number = 0;            ///< GDAL's feature id
    Kind kind = Kind::Areas;            ///< NotAnArea: points or lines
    std::vector<PlanPolygon> polygons;  ///< as they are in the file; empty unless Kind::Areas
    bool unclosed = false;              ///< a ring does not end where it begins
    std::size_t points = 0;             ///< as they are written, closing points included
    std::vector<std::string> values;    ///< of the fields asked for; empty where there is none
};

/// Polygons or points and attributes of a vector file: GeoJSON, GeoPackage, shapefile, FlatGeobuf,
/// and CSV (all of whose columns are fields), through GDAL. East comes first, whatever the CRS's
/// own order. Curves become short lines; heights are kept of points alone. One thread at a time.
class VectorFile {
public:
    /// Unreadable when there is no such file or GDAL cannot open it.
    [[nodiscard]] static Result<VectorFile> open(const std::filesystem::path& path);
    /// From memory; `name` tells the format by its suffix where the content does not.
    [[nodiscard]] static Result<VectorFile> open(std::string_view bytes, const std::string& name);

    /// GDAL's name of the format, "GeoJSON".
    [[nodiscard]] const std::string& format() const;
    [[nodiscard]] const std::vector<VectorLayer>& layers() const;

    /// Called with each feature; false ends the reading.
    using Sink = std::function<bool(AreaFeature&&)>;
    /// Reads a layer from its start. `fields`: indices into VectorLayer::fields. What GDAL says in
    /// between comes back as text (empty: nothing): damage that costs features.
    [[nodiscard]] Result<std::string> readAreas(std::size_t layer,
                                                std::span<const std::size_t> fields,
                                                const Sink& sink);

    using PointSink = std::function<bool(PointFeature&&)>;
    /// The same for points.
    [[nodiscard]] Result<std::string> readPoints(std::size_t layer,
                                                 std::span<const std::size_t> fields,
                                                 const PointSink& sink);

    VectorFile(VectorFile&&) noexcept;
    VectorFile& operator=(VectorFile&&) noexcept;
    ~VectorFile();

private:
    struct Impl;
    explicit VectorFile(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

}  // namespace reflet
