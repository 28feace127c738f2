// SPDX-License-Identifier: GPL-3.0-or-later
// Real files, damaged ones, and the other formats that GDAL reads.
#include "importers/FormatRegistry.h"
#include "tests/support/ClosedCity.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/support/TestData.h"
#include "tests/unit/importers/footprints/FootprintText.h"

#include <gdal_priv.h>
#include <ogr_spatialref.h>
#include <ogrsf_frmts.h>

namespace reflet {
namespace {

using namespace test;
namespace fs = std::filesystem;

Imported<SourceSummary> inspected(const fs::path& path) {
    auto result = inspectFootprints(path, {}, {});
    if (!result) {
        ADD_FAILURE() << result.error().message();
        return {};
    }
    return *std::move(result);
}

Imported<CityImport> importedFile(const fs::path& path, const ImportOptions& options = {}) {
    auto result = importFootprints(path, options, {});
    if (!result) {
        ADD_FAILURE() << result.error().message();
        return {};
    }
    return *std::move(result);
}

TEST(FootprintFiles, HuntingtonBeachHasItsCountsHeightsAndBounds) {
    const auto path = sharedData("geojson/huntington-beach-heights.geojson");
    if (!path)
        GTEST_SKIP() << kNoSharedData;
    const auto info = inspected(*path);
    const SourceSummary& s = info.value;
    EXPECT_EQ(s.format, "GeoJSON");
    EXPECT_EQ(s.crsHorizontal, "EPSG:4326");
    EXPECT_EQ(s.objects, 317U);
    EXPECT_EQ(s.byType.at("Building"), 317U);
    // 1795 positions of 317 closed rings make 1478 walls, but one footprint has a point twice.
    EXPECT_EQ(info.counts.loaded, 316U);
    EXPECT_EQ(info.counts.repaired, 1U);
    EXPECT_EQ(s.surfaces, 1477U + 2U * 317U);
    EXPECT_EQ(s.vertices, 2U * 1477U);
    EXPECT_NEAR(s.bounds.min.x, -117.9978164, 1e-7);
    EXPECT_NEAR(s.bounds.min.y, 33.7084756, 1e-7);
    EXPECT_NEAR(s.bounds.max.x, -117.9898219, 1e-7);
    EXPECT_NEAR(s.bounds.max.y, 33.7154699, 1e-7);
    EXPECT_EQ(s.bounds.min.z, 0.0);
    EXPECT_EQ(s.bounds.max.z, 6.0);
    EXPECT_EQ(remark(info.diagnostics, "height-assumed"), nullptr);

    const auto city = importedFile(*path).value.city;
    EXPECT_EQ(city.frame.crs, "EPSG:32611");
    EXPECT_EQ(city.objects.size(), 317U);
    EXPECT_EQ(openEdges(city), 0U);
    EXPECT_GT(volume(city), 0.0);
    EXPECT_NEAR(city.bounds().max.z, 6.0, 1e-6);
}

TEST(FootprintFiles, DelftHasItsCountsAndBoundsAndNoHeights) {
    const auto path = sharedData("geojson/delft-footprints.geojson");
    if (!path)
        GTEST_SKIP() << kNoSharedData;
    const auto info = inspected(*path);
    const SourceSummary& s = info.value;
    EXPECT_EQ(s.crsHorizontal, "EPSG:28992");
    EXPECT_EQ(s.objects, 1529U);
    EXPECT_EQ(info.counts.loaded, 1529U);
    // 21987 positions of 1536 closed rings, six of them holes, in 1530 polygons.
    EXPECT_EQ(s.surfaces, (21987U - 1536U) + 2U * 1530U);
    EXPECT_EQ(s.vertices, 2U * (21987U - 1536U));
    EXPECT_NEAR(s.bounds.min.x, 84756.1421995, 1e-6);
    EXPECT_NEAR(s.bounds.min.y, 445388.1958283, 1e-6);
    EXPECT_NEAR(s.bounds.max.x, 86104.7500823, 1e-6);
    EXPECT_NEAR(s.bounds.max.y, 447070.9391534, 1e-6);
    const Diagnostic* assumed = remark(info.diagnostics, "height-assumed");
    ASSERT_NE(assumed, nullptr);
    EXPECT_NE(assumed->text.find("1529 of 1529"), std::string::npos) << assumed->text;

    const auto result = importedFile(*path);
    EXPECT_EQ(result.value.city.frame.crs, "EPSG:28992");
    EXPECT_EQ(result.value.city.frame.origin, glm::dvec3(85000, 446000, 0));
    EXPECT_EQ(result.value.aboveGround.size(), 1529U);
    EXPECT_EQ(openEdges(result.value.city), 0U);
    EXPECT_GT(volume(result.value.city), 0.0);
}

TEST(FootprintFiles, DamagedOnesGiveAnErrorOrAnAccount) {
    const auto folder = sharedData("bad/geojson");
    if (!folder)
        GTEST_SKIP() << kNoSharedData;
    const auto outcome = [&](const char* name) {
        const auto format = cityFormatOf(*folder / name);
        if (!format)
            return std::string("unknown format");
        if ((*format)->name != "GeoJSON")
            return std::string((*format)->name);
        const auto result = importFootprints(*folder / name, {}, {});
        if (!result) {
            EXPECT_FALSE(result.error().remedy.empty()) << name;
            return result.error().code == ErrorCode::Unreadable ? std::string("unreadable")
                                                                : result.error().message();
        }
        return fmt::format("{} loaded {} repaired {} skipped", result->counts.loaded,
                           result->counts.repaired, result->counts.skipped);
    };
    EXPECT_EQ(outcome("bad-json.geojson"), "unreadable");
    EXPECT_EQ(outcome("bad-object-type.geojson"), "unreadable");
    EXPECT_EQ(outcome("badcoord.geojson"), "unreadable");
    EXPECT_EQ(outcome("point-string.geojson"), "unreadable");
    EXPECT_EQ(outcome("featurecollection-obj.geojson"), "unreadable");
    EXPECT_EQ(outcome("bad-featurelist.geojson"), "unreadable");
    EXPECT_EQ(outcome("no-geometry-type.geojson"), "0 loaded 0 repaired 3 skipped");
    EXPECT_EQ(outcome("short-linearring.geojson"), "0 loaded 1 repaired 0 skipped");
    EXPECT_EQ(outcome("different-first-last.geojson"), "0 loaded 1 repaired 0 skipped");
}

TEST(FootprintFiles, ThatDoNotExistOrAreEmptyAreUnreadable) {
    const auto missing = importFootprints("/nonexistent/city.geojson", {}, {});
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, ErrorCode::Unreadable);
    const auto empty = importFootprintBytes("", "empty.geojson", {}, {});
    ASSERT_FALSE(empty);
    EXPECT_EQ(empty.error().code, ErrorCode::Unreadable);
}

/// Writes two footprints with GDAL's own driver.
fs::path written(const fs::path& path, const char* driver) {
    GDALAllRegister();
    GDALDriver* const made = GetGDALDriverManager()->GetDriverByName(driver);
    EXPECT_NE(made, nullptr) << driver;
    GDALDataset* const dataset = made->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr);
    OGRSpatialReference rd;
    rd.importFromEPSG(28992);
    rd.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    OGRLayer* const layer = dataset->CreateLayer("houses", &rd, wkbMultiPolygon, nullptr);
    OGRFieldDefn height("HEIGHT", OFTReal);
    layer->CreateField(&height);
    for (int i = 0; i < 2; ++i) {
        OGRFeature feature(layer->GetLayerDefn());
        feature.SetField("HEIGHT", 5.0 + i);
        const std::string wkt =
            fmt::format("MULTIPOLYGON ((({0} 446000,{0} 446010,{1} 446010,{1} 446000,{0} 446000)))",
                        85000 + 100 * i, 85020 + 100 * i);
        OGRGeometry* geometry = nullptr;
        const char* text = wkt.c_str();
        OGRGeometryFactory::createFromWkt(&text, nullptr, &geometry);
        feature.SetGeometryDirectly(geometry);
        EXPECT_EQ(layer->CreateFeature(&feature), OGRERR_NONE);
    }
    GDALClose(dataset);
    return path;
}

TEST(FootprintFiles, OfOtherFormatsSayTheSame) {
    const TemporaryFolder folder;
    for (const auto& [name, driver] :
         {std::pair("houses.gpkg", "GPKG"), std::pair("houses.shp", "ESRI Shapefile"),
          std::pair("houses.fgb", "FlatGeobuf")}) {
        SCOPED_TRACE(name);
        const fs::path path = written(folder.path() / name, driver);
        const auto format = cityFormatOf(path);
        ASSERT_TRUE(format);
        EXPECT_EQ((*format)->read, &importFootprints);
        const auto result = importedFile(path);
        EXPECT_EQ(result.counts.loaded, 2U);
        EXPECT_EQ(result.value.city.frame.crs, "EPSG:28992");
        EXPECT_EQ(openEdges(result.value.city), 0U);
        EXPECT_NEAR(volume(result.value.city), 200.0 * (5.0 + 6.0), 1e-2);
    }
}

}  // namespace
}  // namespace reflet
