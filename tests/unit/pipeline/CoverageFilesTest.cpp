// SPDX-License-Identifier: GPL-3.0-or-later
// Coverage of a street written to files, read back by our own readers.
#include "app/pipeline/Bake.h"
#include "app/pipeline/Edit.h"
#include "app/pipeline/coverage/CoverageFiles.h"
#include "app/pipeline/coverage/CoverageJson.h"
#include "app/pipeline/coverage/CoveragePicture.h"
#include "app/pipeline/coverage/CoverageThumbnails.h"
#include "app/pipeline/coverage/SuggestBench.h"
#include "core/io/GeoFile.h"
#include "core/io/ImageText.h"
#include "core/io/RasterFile.h"
#include "core/io/VectorFile.h"
#include "tests/support/StreetProject.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace reflet {
namespace {

class CoverageFilesTest : public testing::Test {
protected:
    CoverageFilesTest() : file(folder / "street.reflet") {
        EXPECT_TRUE(test::importStreetWithCar(folder, file));
        EditRequest edit;
        edit.probes = {{"p1", 690'010.0, 5'335'000.0, std::nullopt}};
        edit.settings = {{"bake.resolution", "32"}, {"tuning.resolution", "32"}};
        EXPECT_TRUE(editProject(file, edit, {}));
        auto opened = PreparedCity::open(file, {});
        EXPECT_TRUE(opened) << opened.error().message();
        city.emplace(std::move(*opened));
    }
    [[nodiscard]] CoverageReport report(DemandOn on = DemandOn::Routes) const {
        CoverageOptions options;
        options.on = on;
        options.mostSamples = 4096;
        auto made = reportCoverage(*city, options, {});
        EXPECT_TRUE(made) << made.error().message();
        return made ? std::move(*made) : CoverageReport{};
    }

    test::TemporaryFolder folder;
    std::filesystem::path file;
    std::optional<PreparedCity> city;
};

TEST_F(CoverageFilesTest, LayersHoldStretchesPlacesProbesAndFacades) {
    const CoverageReport made = report();
    for (const char* name : {"c.gpkg", "c.geojson"}) {
        const auto written = writeCoverage(made, *city, folder / name);
        ASSERT_TRUE(written) << written.error().message();
        const auto lines = readLines(folder / name, city->project().frame);
        ASSERT_TRUE(lines) << lines.error().message();
        ASSERT_EQ(lines->size(), made.stretches.size()) << name;
        EXPECT_EQ(lines->front().name, "street");
        EXPECT_NEAR(std::stod(lines->front().attributes.at("coverage")),
                    made.stretches.front().coverage, 1e-6);
        EXPECT_EQ(lines->front().attributes.at("attr_name"), "street");
        EXPECT_NEAR(lines->front().points.front().x, 690'002.0, 0.01);
    }
    auto package = VectorFile::open(folder / "c.gpkg");
    ASSERT_TRUE(package);
    std::vector<std::string> names;
    for (const VectorLayer& layer : package->layers())
        names.push_back(layer.name);
    EXPECT_EQ(names, (std::vector<std::string>{"stretches", "worst", "probes", "facades"}));
    std::size_t patches = 0;
    ASSERT_TRUE(package->readPoints(3, {}, [&](const PointFeature& feature) {
        patches += feature.places.size();
        return true;
    }));
    EXPECT_EQ(patches, made.patches.size());
    EXPECT_GT(patches, 50U);
}

TEST_F(CoverageFilesTest, TheRasterIsThatOfTheStretchesAlongTheRoad) {
    const CoverageReport made = report();
    const CoverageRaster raster = coverageRaster(made);
    const auto written = writeCoverage(made, *city, folder / "c.tif");
    ASSERT_TRUE(written) << written.error().message();
    const auto tif = RasterFile::open(folder / "c.tif");
    ASSERT_TRUE(tif) << tif.error().message();
    EXPECT_EQ(tif->info().bands, 2);
    std::vector<float> read(raster.grid.cellCount());
    ASSERT_TRUE(tif->readHeights(0, 0, raster.grid.columns, raster.grid.rows, read.data()));
    const GridSpec& grid = raster.grid;
    std::size_t covered = 0;
    for (int j = 0; j < grid.rows; ++j)
        for (int i = 0; i < grid.columns; ++i) {
            const float ours = raster.coverage[grid.index(i, j)];
            const float theirs =
                read[std::size_t(grid.rows - 1 - j) * std::size_t(grid.columns) + std::size_t(i)];
            ASSERT_TRUE(ours == theirs || (std::isnan(ours) && std::isnan(theirs)));
            covered += std::isnan(ours) ? 0 : 1;
        }
    // 56 m of road, 4 m wide, and the cells that are touched at its edges.
    EXPECT_NEAR(double(covered), 56.0 * 4.0, 90.0);
    const glm::dvec3 middle =
        made.plan.lines[0].route->at(0.5 * (made.stretches[1].from + made.stretches[1].to));
    EXPECT_EQ(raster.coverage[grid.index(grid.column(middle.x), grid.row(middle.y))],
              float(made.stretches[1].coverage));
}

TEST_F(CoverageFilesTest, TheGroundIsARasterOfItsSamples) {
    const CoverageReport made = report(DemandOn::Ground);
    const CoverageRaster raster = coverageRaster(made);
    ASSERT_GT(raster.grid.cellCount(), 0U);
    const double cells = raster.grid.cellSize / CoverageRaster::kGroundCell;
    EXPECT_EQ(cells, std::round(cells));
    const double area = double(made.plan.ground->places.size()) * made.plan.ground->cellSize *
                        made.plan.ground->cellSize;
    EXPECT_GE(double(made.demand.samples.size()) * raster.grid.cellSize * raster.grid.cellSize,
              8.0 * area);
    double sum = 0.0;
    for (const DemandSample& sample : made.demand.samples)
        sum += double(raster.coverage[raster.grid.index(raster.grid.column(sample.vehicle.x),
                                                        raster.grid.row(sample.vehicle.y))]);
    EXPECT_NEAR(sum / double(made.demand.samples.size()), made.coverage.mean, 1e-4);
    const auto written = writeCoverage(made, *city, folder / "c.gpkg");
    ASSERT_TRUE(written) << written.error().message();
    auto package = VectorFile::open(folder / "c.gpkg");
    ASSERT_TRUE(package);
    EXPECT_EQ(package->layers()[0].name, "ground");
    const auto json = coverageJson(made, city->project());
    EXPECT_EQ(json["on"], "ground");
    EXPECT_TRUE(json["coverage"]["worst"].is_null());
}

TEST_F(CoverageFilesTest, TheTableHasARowForEachRouteWithItsAttributes) {
    const CoverageReport made = report();
    ASSERT_TRUE(writeCoverage(made, *city, folder / "c.csv"));
    std::istringstream text(test::bytesOf(folder / "c.csv"));
    std::string head, row, more;
    std::getline(text, head);
    std::getline(text, row);
    EXPECT_TRUE(head.starts_with("id,name,length_m,coverage,")) << head;
    EXPECT_TRUE(head.ends_with(",attr_name")) << head;
    EXPECT_TRUE(row.starts_with("street,street,56.00,")) << row;
    EXPECT_TRUE(row.ends_with(",street")) << row;
    EXPECT_FALSE(std::getline(text, more));
    const auto other = writeCoverage(made, *city, folder / "c.xls");
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().code, ErrorCode::Usage);
}

TEST_F(CoverageFilesTest, TheReportHasTheKeysThatProgramsRelyOn) {
    const CoverageReport made = report();
    const auto json = coverageJson(made, city->project());
    for (const char* key :
         {"total", "error", "seen", "seenTwice", "shown", "worst", "p05", "largestGap"})
        EXPECT_TRUE(json["coverage"][key].is_number()) << key;
    EXPECT_EQ(json["coverage"]["total"], made.coverage.mean);
    EXPECT_EQ(json["routes"][0]["id"], "street");
    EXPECT_EQ(json["routes"][0]["attributes"]["name"], "street");
    EXPECT_EQ(json["probes"][0]["id"], "p1");
    EXPECT_NEAR(json["probes"][0]["lon"].get<double>(), 11.55, 0.05);
    EXPECT_EQ(json["worst"].size(), made.worst.size());
    EXPECT_EQ(json["crs"], "EPSG:25832");
    Suggestion suggestion;
    suggestion.probes.push_back({"s1", {690'020.0, 5'335'000.0, 1.75}, 0.4, 0.9, {"street"}, "r"});
    const auto told = suggestionJson(suggestion, city->project());
    for (const char* key : {"id", "position", "lon", "lat", "gain"})
        EXPECT_TRUE(told["probes"][0].contains(key)) << key;
    for (const char* key : {"before", "after", "worst", "p05"})
        EXPECT_TRUE(told["coverage"][key].is_number()) << key;
    for (const char* key : {"upperBound", "ratio"})
        EXPECT_TRUE(told["certificate"][key].is_number()) << key;
    for (const char* key : {"uniform", "junctions", "random"})
        EXPECT_TRUE(told["baselines"][key].is_null()) << key;
    EXPECT_TRUE(told["seconds"].is_number());
}

TEST_F(CoverageFilesTest, ThePictureShowsTheRouteInTheColoursOfItsStretches) {
    if (!textWidth("x", 12))
        GTEST_SKIP() << "no font";
    const CoverageReport made = report();
    const auto picture = coveragePicture(made, *city);
    ASSERT_TRUE(picture) << picture.error().message();
    EXPECT_GE(picture->width, 640);
    for (const CoveredStretch& stretch : made.stretches) {
        const glm::vec3 color = coverageColor(stretch.coverage);
        EXPECT_GT(std::count(picture->pixels.begin(), picture->pixels.end(), color), 100)
            << stretch.from;
    }
}

TEST_F(CoverageFilesTest, ThumbnailsNeedBakedProbesAndStandBesideTheReference) {
    if (!textWidth("x", 12))
        GTEST_SKIP() << "no font";
    const CoverageReport made = report();
    ASSERT_FALSE(made.worst.empty());
    const ThumbnailOptions options{"", 96, 54, 1};
    const auto early = worstPlaces(made, *city, options, {});
    ASSERT_FALSE(early);
    EXPECT_EQ(early.error().code, ErrorCode::Refused);
    EXPECT_NE(early.error().remedy.find("bake"), std::string::npos);
    ASSERT_TRUE(bakeProbes(*city, {}, {}));
    const auto sheet = worstPlaces(made, *city, options, {});
    ASSERT_TRUE(sheet) << sheet.error().message();
    EXPECT_EQ(sheet->width, 2 * 96 + 3 * 8);
    // Two pictures that are not blank, and not the same.
    const auto pixel = [&](int x, int y) {
        return sheet->pixels[std::size_t(y) * std::size_t(sheet->width) + std::size_t(x)];
    };
    int inked = 0, different = 0;
    for (int y = 60; y < 110; ++y)
        for (int x = 8; x < 104; ++x) {
            inked += pixel(x, y) != glm::vec3(1.0F) ? 1 : 0;
            different += pixel(x, y) != pixel(x + 104, y) ? 1 : 0;
        }
    EXPECT_GT(inked, 4000);
    EXPECT_GT(different, 0);
    CoverageReport none = made;
    none.worst.clear();
    const auto nothing = worstPlaces(none, *city, options, {});
    ASSERT_FALSE(nothing);
    EXPECT_EQ(nothing.error().code, ErrorCode::Usage);
}

TEST_F(CoverageFilesTest, TheBenchMeasuresAProject) {
    SuggestBenchOptions options;
    options.project = file;
    options.candidates = 40;
    options.samples = 8192;
    options.count = 2;
    const auto bench = benchSuggest(options, {});
    ASSERT_TRUE(bench) << bench.error().message();
    EXPECT_EQ(bench->probes, 2U);
    EXPECT_NEAR(double(bench->candidates), 40.0, 5.0);
    EXPECT_EQ(bench->samples, 8192U);
    EXPECT_GT(bench->seconds, 0.0);
    EXPECT_GT(bench->moveOne, 0.0);
    EXPECT_NEAR(bench->routes, 56.0, 0.1);
    options.project = folder / "absent.reflet";
    EXPECT_FALSE(benchSuggest(options, {}));
}

TEST_F(CoverageFilesTest, TheCityOfTheBenchIsReadWithoutRemarks) {
    ImportRequest request;
    request.files = {folder.write("blocks.city.json", blockCity(2))};
    const auto imported = importProject(request, {});
    ASSERT_TRUE(imported) << imported.error().message();
    EXPECT_GT(imported->city->city.objects.size(), 40U);
    EXPECT_EQ(blockCity(2), blockCity(2));
}

}  // namespace
}  // namespace reflet
