// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/footprints/FootprintImporter.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace reflet::test {

/// A feature of GeoJSON: `geometry` and `properties` as JSON.
inline std::string feature(const std::string& geometry, const std::string& properties = "{}") {
    return fmt::format(R"({{"type": "Feature", "geometry": {}, "properties": {}}})", geometry,
                       properties);
}

inline std::string polygon(const std::string& rings) {
    return fmt::format(R"({{"type": "Polygon", "coordinates": [{}]}})", rings);
}

/// A rectangle in RD New: 20 m by 10 m from (x, y) on.
inline std::string rectangle(double x, double y) {
    return polygon(
        fmt::format("[[{0},{1}],[{2},{1}],[{2},{3}],[{0},{3}],[{0},{1}]]", x, y, x + 20, y + 10));
}

inline const char* const kRd =
    R"("crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::28992"}},)";

inline std::string collection(const std::vector<std::string>& features, const char* crs = kRd) {
    std::string all;
    for (const std::string& one : features)
        all += (all.empty() ? "" : ",\n") + one;
    return fmt::format(R"({{"type": "FeatureCollection", {} "features": [{}]}})", crs, all);
}

inline Imported<CityImport> imported(const std::string& text, const ImportOptions& options = {}) {
    auto result = importFootprintBytes(text, "test.geojson", options, {});
    if (!result) {
        ADD_FAILURE() << result.error().message();
        return {};
    }
    return *std::move(result);
}

/// The first remark with a code; nullptr when there is none.
inline const Diagnostic* remark(const std::vector<Diagnostic>& diagnostics,
                                const std::string& code) {
    const auto found = std::find_if(diagnostics.begin(), diagnostics.end(),
                                    [&](const Diagnostic& d) { return d.code == code; });
    return found == diagnostics.end() ? nullptr : &*found;
}

}  // namespace reflet::test
