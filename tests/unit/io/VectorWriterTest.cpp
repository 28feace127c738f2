// SPDX-License-Identifier: GPL-3.0-or-later
// Layers and rasters that were written, read back by our own readers.
#include "core/io/GeoFile.h"
#include "core/io/GridFile.h"
#include "core/io/RasterFile.h"
#include "core/io/VectorFile.h"
#include "core/io/VectorWriter.h"
#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet {
namespace {

const ProjectFrame kFrame{"EPSG:25832", std::nullopt, {690'000.0, 5'335'000.0, 0.0}};
const glm::dvec3 kPlace(690'010.25, 5'335'020.5, 3.75);

/// A layer of two points and one of a line.
std::vector<WrittenLayer> layers() {
    using Kind = VectorColumn::Kind;
    WrittenLayer points{"probes",
                        WrittenLayer::Kind::Points,
                        {{"id", Kind::Text},
                         {"serves", Kind::Real},
                         {"number", Kind::Integer},
                         {"locked", Kind::Yes}},
                        {}};
    points.shapes.push_back({{kPlace}, {std::string("ä, \"b\""), 0.25, std::int64_t(7), true}});
    points.shapes.push_back(
        {{kPlace + 1.0}, {std::string("c"), VectorValue(), VectorValue(), false}});
    WrittenLayer lines{"stretches",
                       WrittenLayer::Kind::Lines,
                       {{"name", Kind::Text}, {"coverage", Kind::Real}},
                       {}};
    lines.shapes.push_back(
        {{kPlace, kPlace + glm::dvec3(10.0, 0.0, 0.0)}, {std::string("s"), 0.5}});
    return {points, lines};
}

TEST(VectorWriter, WritesAGeoPackageWithALayerForEach) {
    const test::TemporaryFolder folder;
    const auto written = writeVector(layers(), kFrame, folder / "out.gpkg");
    ASSERT_TRUE(written) << written.error().message();
    EXPECT_EQ(folder.entryCount(), 1U);
    auto file = VectorFile::open(folder / "out.gpkg");
    ASSERT_TRUE(file) << file.error().message();
    ASSERT_EQ(file->layers().size(), 2U);
    const VectorLayer& probes = file->layers()[0];
    EXPECT_EQ(probes.name, "probes");
    EXPECT_TRUE(probes.points);
    ASSERT_EQ(probes.fields.size(), 4U);
    EXPECT_NE(probes.crs->find("25832"), std::string::npos);
    std::vector<PointFeature> read;
    const std::array<std::size_t, 4> fields{0, 1, 2, 3};
    ASSERT_TRUE(file->readPoints(0, fields, [&](PointFeature&& feature) {
        read.push_back(std::move(feature));
        return true;
    }));
    ASSERT_EQ(read.size(), 2U);
    EXPECT_EQ(read[0].values, (std::vector<std::string>{"ä, \"b\"", "0.25", "7", "1"}));
    EXPECT_EQ(read[1].values, (std::vector<std::string>{"c", "", "", "0"}));
    EXPECT_EQ(read[0].places.front(), kPlace);
    const auto lines = readLines(folder / "out.gpkg", kFrame);
    ASSERT_TRUE(lines) << lines.error().message();
    ASSERT_EQ(lines->size(), 1U);
    EXPECT_EQ(lines->front().points.front(), kPlace);
    EXPECT_EQ(lines->front().attributes.at("coverage"), "0.5");
}

TEST(VectorWriter, WritesGeoJsonInDegreesToAMillimetre) {
    const test::TemporaryFolder folder;
    const auto written = writeVector(layers(), kFrame, folder / "out.geojson");
    ASSERT_TRUE(written) << written.error().message();
    const auto root = nlohmann::json::parse(test::bytesOf(folder / "out.geojson"));
    ASSERT_EQ(root["features"].size(), 3U);
    const auto& point = root["features"][0];
    EXPECT_EQ(point["properties"]["layer"], "probes");
    EXPECT_EQ(point["properties"]["locked"], true);
    EXPECT_NEAR(point["geometry"]["coordinates"][0].get<double>(), 11.6, 0.1);
    EXPECT_NEAR(point["geometry"]["coordinates"][1].get<double>(), 48.1, 0.1);
    EXPECT_EQ(root["features"][2]["geometry"]["type"], "LineString");
    const auto lines = readLines(folder / "out.geojson", kFrame);
    ASSERT_TRUE(lines) << lines.error().message();
    EXPECT_LT(glm::length(lines->front().points.front() - kPlace), 0.002);
}

TEST(VectorWriter, KeepsTheMetresOfALocalFrame) {
    const test::TemporaryFolder folder;
    const ProjectFrame local;
    for (const char* name : {"out.geojson", "out.gpkg"}) {
        const auto written = writeVector(layers(), local, folder / name);
        ASSERT_TRUE(written) << written.error().message();
        const auto lines = readLines(folder / name, local);
        ASSERT_TRUE(lines) << name << lines.error().message();
        EXPECT_EQ(lines->front().points.front(), kPlace) << name;
    }
}

TEST(VectorWriter, ReplacesAFileAndRefusesOtherSuffixes) {
    const test::TemporaryFolder folder;
    folder.write("out.gpkg", "old");
    EXPECT_TRUE(writeVector(layers(), kFrame, folder / "out.gpkg"));
    EXPECT_TRUE(VectorFile::open(folder / "out.gpkg"));
    const auto other = writeVector(layers(), kFrame, folder / "out.shp");
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().code, ErrorCode::Usage);
    const auto nowhere = writeVector(layers(), kFrame, folder / "absent" / "out.gpkg");
    ASSERT_FALSE(nowhere);
    EXPECT_EQ(nowhere.error().code, ErrorCode::WriteFailed);
    EXPECT_EQ(folder.entryCount(), 1U);
}

TEST(VectorFile, GivesPointsTheirHeightsAndNoneWhereThereAreNone) {
    const std::string text = R"({"type":"FeatureCollection","features":[
        {"type":"Feature","properties":{},"geometry":{"type":"Point","coordinates":[11.5,48.1,520.5]}},
        {"type":"Feature","properties":{},"geometry":{"type":"Point","coordinates":[11.5,48.1]}}]})";
    auto file = VectorFile::open(text, "a.geojson");
    ASSERT_TRUE(file);
    std::vector<glm::dvec3> places;
    ASSERT_TRUE(file->readPoints(0, {}, [&](const PointFeature& feature) {
        places.insert(places.end(), feature.places.begin(), feature.places.end());
        return true;
    }));
    ASSERT_EQ(places.size(), 2U);
    EXPECT_EQ(places[0].z, 520.5);
    EXPECT_TRUE(std::isnan(places[1].z));
}

TEST(GridFile, WritesBandsNorthUpWhereTheyLie) {
    const test::TemporaryFolder folder;
    const GridSpec grid{2.0, 4.0, 2.0, 3, 2};
    const std::vector<float> values{0.0F, 0.25F, 0.5F, 0.75F, kMissingHeight, 1.0F};
    const auto written =
        writeGrid(grid, {{"coverage", "", [&](std::size_t cell) { return double(values[cell]); }}},
                  {}, kFrame, folder / "out.tif");
    ASSERT_TRUE(written) << written.error().message();
    const auto file = RasterFile::open(folder / "out.tif");
    ASSERT_TRUE(file) << file.error().message();
    EXPECT_EQ(file->info().columns, 3);
    EXPECT_EQ(file->info().rows, 2);
    EXPECT_EQ(file->info().at(0.0, 0.0), glm::dvec2(690'002.0, 5'335'008.0));
    EXPECT_NE(file->info().crs->find("25832"), std::string::npos);
    std::array<float, 6> read{};
    ASSERT_TRUE(file->readHeights(0, 0, 3, 2, read.data()));
    EXPECT_EQ(read[0], 0.75F);
    EXPECT_TRUE(std::isnan(read[1]));
    EXPECT_EQ(read[2], 1.0F);
    EXPECT_EQ(read[5], 0.5F);
    const auto nothing = writeGrid({}, {}, {}, kFrame, folder / "none.tif");
    ASSERT_FALSE(nothing);
    EXPECT_EQ(nothing.error().code, ErrorCode::Refused);
}

}  // namespace
}  // namespace reflet
