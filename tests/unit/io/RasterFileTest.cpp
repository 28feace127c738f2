// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geo/Crs.h"
#include "core/io/RasterFile.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/support/TestData.h"

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <iterator>
#include <vector>

namespace reflet {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json expectations() {
    std::ifstream in(*test::sharedData("expected.json"));
    return json::parse(in);
}

std::vector<float> allHeights(const RasterFile& file) {
    const RasterInfo& info = file.info();
    std::vector<float> heights(std::size_t(info.columns) * std::size_t(info.rows));
    const auto done = file.readHeights(0, 0, info.columns, info.rows, heights.data());
    EXPECT_TRUE(done) << done.error().message();
    return heights;
}

/// Checks heights with the figures that were computed from the pixels by somebody else.
void expectStatistics(const RasterFile& file, const json& band) {
    const std::vector<float> heights = allHeights(file);
    std::size_t valid = 0;
    double lowest = 1e9;
    double highest = -1e9;
    double sum = 0.0;
    for (const float z : heights) {
        if (std::isnan(z))
            continue;
        ++valid;
        lowest = std::min(lowest, double(z));
        highest = std::max(highest, double(z));
        sum += double(z);
    }
    EXPECT_EQ(valid, band.at("valid"));
    EXPECT_EQ(heights.size() - valid, band.at("nodata_pixels"));
    constexpr double kPrinted = 5.1e-5;  // the figures have four decimals
    EXPECT_NEAR(lowest, band.at("min").get<double>(), kPrinted);
    EXPECT_NEAR(highest, band.at("max").get<double>(), kPrinted);
    EXPECT_NEAR(sum / double(valid), band.at("mean").get<double>(), kPrinted);
    const RasterInfo& info = file.info();
    const float centre = heights[std::size_t(info.rows / 2) * std::size_t(info.columns) +
                                 std::size_t(info.columns / 2)];
    EXPECT_NEAR(double(centre), band.at("centre_pixel").get<double>(), kPrinted);
}

TEST(RasterFile, ReadsEverySharedGeoTiffAsItWasMeasured) {
    if (!test::sharedData("geotiff"))
        GTEST_SKIP() << test::kNoSharedData;
    std::size_t seen = 0;
    const json all = expectations();
    for (const auto& [name, entry] : all.items()) {
        if (!name.starts_with("geotiff/"))
            continue;
        SCOPED_TRACE(name);
        ++seen;
        const json& verified = entry.at("verified");
        const auto file = RasterFile::open(*test::sharedData(name));
        ASSERT_TRUE(file) << file.error().message();
        const RasterInfo& info = file->info();
        EXPECT_EQ(info.format, "GTiff");
        EXPECT_EQ(info.columns, verified.at("width"));
        EXPECT_EQ(info.rows, verified.at("height"));
        EXPECT_EQ(info.bands, int(verified.at("bands").size()));
        ASSERT_TRUE(info.crs);
        EXPECT_EQ(Crs::parse(*info.crs)->horizontal(),
                  "EPSG:" + std::to_string(verified.at("epsg").get<int>()));
        ASSERT_TRUE(info.placed);
        for (std::size_t k = 0; k < 6; ++k)
            EXPECT_NEAR(info.transform[k], verified.at("geotransform")[k].get<double>(), 1e-9);
        for (const auto& [corner, i, j] :
             {std::tuple{"upper_left", 0, 0}, {"lower_right", info.columns, info.rows}}) {
            EXPECT_NEAR(info.at(i, j).x, verified.at(corner)[0].get<double>(), 1e-3);
            EXPECT_NEAR(info.at(i, j).y, verified.at(corner)[1].get<double>(), 1e-3);
        }
        if (!info.isPicture())
            expectStatistics(*file, verified.at("bands")[0]);
    }
    EXPECT_EQ(seen, 4U);
}

TEST(RasterFile, ReadsTheColoursOfTheSharedOrthophotoAtItsOwnPixels) {
    const auto path = test::sharedData("geotiff/manila-ortho.tif");
    if (!path)
        GTEST_SKIP() << test::kNoSharedData;
    const json bands = expectations().at("geotiff/manila-ortho.tif").at("verified").at("bands");
    const auto file = RasterFile::open(*path);
    ASSERT_TRUE(file);
    const RasterInfo& info = file->info();
    EXPECT_TRUE(info.isPicture());
    const glm::dvec2 a = info.at(1024, 1025);
    const glm::dvec2 b = info.at(1025, 1024);
    const auto centre = file->readPicture(std::nullopt, a, b, 1, 1);
    ASSERT_TRUE(centre) << centre.error().message();
    ASSERT_EQ(centre->rgba.size(), 4U);
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_EQ(centre->rgba[c], bands[c].at("centre_pixel").get<double>());
    EXPECT_EQ(centre->rgba[3], 255);
    // Half of this one lies west of the picture, and has no colour.
    const auto rim = file->readPicture(std::nullopt, info.at(-64, 1064), info.at(64, 1000), 16, 8);
    ASSERT_TRUE(rim);
    EXPECT_EQ(rim->rgba[3], 0);
    EXPECT_EQ(rim->rgba[15 * 4 + 3], 255);
}

TEST(RasterFile, BringsColoursIntoAnotherSystem) {
    const auto path = test::sharedData("geotiff/manila-ortho.tif");
    if (!path)
        GTEST_SKIP() << test::kNoSharedData;
    const auto file = RasterFile::open(*path);
    ASSERT_TRUE(file);
    const RasterInfo& info = file->info();
    // One place, looked up by PROJ alone: the mean colour about it must be the same in both.
    const auto to = CrsTransform::create(*Crs::parse("EPSG:3395"), *Crs::parse("EPSG:32651"));
    ASSERT_TRUE(to);
    const glm::dvec2 middle = info.at(1500, 700);
    const auto there = to->apply(glm::dvec3(middle, 0.0));
    ASSERT_TRUE(there);
    const auto own = file->readPicture(std::nullopt, middle - 3.0, middle + 3.0, 4, 4);
    const auto moved =
        file->readPicture("EPSG:32651", glm::dvec2(*there) - 2.9, glm::dvec2(*there) + 2.9, 4, 4);
    ASSERT_TRUE(own && moved);
    for (std::size_t c = 0; c < 3; ++c) {
        double a = 0.0;
        double b = 0.0;
        for (std::size_t k = 0; k < 16; ++k) {
            a += own->rgba[4 * k + c] / 16.0;
            b += moved->rgba[4 * k + c] / 16.0;
        }
        EXPECT_NEAR(a, b, 4.0);
    }
}

TEST(RasterFile, TellsTheOutcomeOfEveryBadGeoTiff) {
    const auto folder = test::sharedData("bad/geotiff");
    if (!folder)
        GTEST_SKIP() << test::kNoSharedData;
    std::size_t seen = 0;
    for (const auto& entry : fs::directory_iterator(*folder)) {
        SCOPED_TRACE(entry.path().filename());
        ++seen;
        const auto file = RasterFile::open(entry.path());
        if (!file) {
            EXPECT_EQ(file.error().code, ErrorCode::Unreadable);
            EXPECT_FALSE(file.error().remedy.empty());
            continue;
        }
        const RasterInfo& info = file->info();
        std::vector<float> heights(std::size_t(info.columns) * std::size_t(info.rows));
        const auto read = file->readHeights(0, 0, info.columns, info.rows, heights.data());
        ASSERT_FALSE(read) << "its pixels cannot be read";
        EXPECT_EQ(read.error().code, ErrorCode::Unreadable) << read.error().message();
        const glm::dvec2 a = info.at(0, 0);
        const glm::dvec2 b = info.at(info.columns, info.rows);
        const auto picture = file->readPicture(std::nullopt, glm::min(a, b), glm::max(a, b),
                                               info.columns, info.rows);
        ASSERT_FALSE(picture);
        EXPECT_FALSE(picture.error().remedy.empty());
    }
    EXPECT_EQ(seen, 5U);
}

TEST(RasterFile, PostsStandAtTheCentresOfPixelsWhateverTheFileSaysOfPointsAndAreas) {
    const test::TemporaryFolder folder;
    GDALAllRegister();
    for (const char* kind : {"Area", "Point"}) {
        const fs::path path = folder.path() / (std::string(kind) + ".tif");
        auto* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
        auto* dataset = driver->Create(path.c_str(), 3, 2, 1, GDT_Float32, nullptr);
        double transform[6] = {1000.0, 10.0, 0.0, 2000.0, 0.0, -10.0};
        dataset->SetGeoTransform(transform);
        dataset->SetMetadataItem("AREA_OR_POINT", kind);
        GDALClose(dataset);
        const auto file = RasterFile::open(path);
        ASSERT_TRUE(file);
        EXPECT_EQ(file->info().at(0.5, 0.5), glm::dvec2(1005.0, 1995.0)) << kind;
    }
}

TEST(RasterFile, HonoursNoDataScaleOffsetAndUnit) {
    const test::TemporaryFolder folder;
    GDALAllRegister();
    const fs::path path = folder.path() / "scaled.tif";
    auto* dataset = GetGDALDriverManager()->GetDriverByName("GTiff")->Create(path.c_str(), 2, 2, 1,
                                                                             GDT_Int16, nullptr);
    auto& band = *dataset->GetRasterBand(1);
    std::int16_t values[4] = {100, -32768, 250, 0};
    ASSERT_EQ(band.RasterIO(GF_Write, 0, 0, 2, 2, values, 2, 2, GDT_Int16, 0, 0, nullptr), CE_None);
    band.SetNoDataValue(-32768);
    band.SetScale(0.1);
    band.SetOffset(5.0);
    band.SetUnitType("ft");
    GDALClose(dataset);
    const auto file = RasterFile::open(path);
    ASSERT_TRUE(file);
    const std::vector<float> heights = allHeights(*file);
    EXPECT_FLOAT_EQ(heights[0], 15.0F);
    EXPECT_TRUE(std::isnan(heights[1]));
    EXPECT_FLOAT_EQ(heights[2], 30.0F);
    EXPECT_FLOAT_EQ(heights[3], 5.0F);
    EXPECT_EQ(file->info().heightUnit, 0.3048);
}

TEST(RasterFile, HonoursAMask) {
    const test::TemporaryFolder folder;
    GDALAllRegister();
    const fs::path path = folder.path() / "masked.tif";
    CPLSetThreadLocalConfigOption("GDAL_TIFF_INTERNAL_MASK", "YES");
    auto* dataset = GetGDALDriverManager()->GetDriverByName("GTiff")->Create(path.c_str(), 2, 1, 1,
                                                                             GDT_Float32, nullptr);
    float values[2] = {7.0F, 8.0F};
    auto& band = *dataset->GetRasterBand(1);
    ASSERT_EQ(band.RasterIO(GF_Write, 0, 0, 2, 1, values, 2, 1, GDT_Float32, 0, 0, nullptr),
              CE_None);
    ASSERT_EQ(dataset->CreateMaskBand(GMF_PER_DATASET), CE_None);
    std::uint8_t mask[2] = {255, 0};
    ASSERT_EQ(
        band.GetMaskBand()->RasterIO(GF_Write, 0, 0, 2, 1, mask, 2, 1, GDT_Byte, 0, 0, nullptr),
        CE_None);
    GDALClose(dataset);
    const auto file = RasterFile::open(path);
    ASSERT_TRUE(file);
    const std::vector<float> heights = allHeights(*file);
    EXPECT_EQ(heights[0], 7.0F);
    EXPECT_TRUE(std::isnan(heights[1]));
}

TEST(RasterFile, ReadsAsciiGridsXyzAndVrt) {
    const test::TemporaryFolder folder;
    const fs::path grid =
        folder.write("g.asc",
                     "ncols 3\nnrows 2\nxllcorner 100\nyllcorner 200\ncellsize 10\n"
                     "NODATA_value -1\n1 2 3\n4 -1 6\n");
    const auto ascii = RasterFile::open(grid);
    ASSERT_TRUE(ascii) << ascii.error().message();
    EXPECT_EQ(ascii->info().at(0.5, 0.5), glm::dvec2(105.0, 215.0));
    EXPECT_EQ(allHeights(*ascii)[5], 6.0F);
    EXPECT_TRUE(std::isnan(allHeights(*ascii)[4]));

    const auto xyz = RasterFile::open(folder.write("p.xyz", "5 25 1\n15 25 2\n5 15 3\n15 15 4\n"));
    ASSERT_TRUE(xyz) << xyz.error().message();
    EXPECT_EQ(xyz->info().at(0.5, 0.5), glm::dvec2(5.0, 25.0)) << "points are centres";
    EXPECT_EQ(allHeights(*xyz), (std::vector<float>{1.0F, 2.0F, 3.0F, 4.0F}));

    const auto vrtText = [](const std::string& source) {
        return "<VRTDataset rasterXSize=\"3\" rasterYSize=\"2\"><GeoTransform>100,10,0,220,0,-10"
               "</GeoTransform><VRTRasterBand dataType=\"Float32\" band=\"1\"><SimpleSource>"
               "<SourceFilename relativeToVRT=\"1\">" +
               source +
               "</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand>"
               "</VRTDataset>";
    };
    const auto vrt = RasterFile::open(folder.write("v.vrt", vrtText("g.asc")));
    ASSERT_TRUE(vrt) << vrt.error().message();
    EXPECT_EQ(allHeights(*vrt)[2], 3.0F);
    for (const char* far :
         {"/vsicurl/http://example.org/a.tif", "http://example.org/a.tif", "&lt;VRTDataset/&gt;"}) {
        const auto refused = RasterFile::open(folder.write("w.vrt", vrtText(far)));
        ASSERT_FALSE(refused) << far;
        EXPECT_EQ(refused.error().code, ErrorCode::Refused);
    }
}

TEST(RasterFile, WhatIsNoRasterIsUnreadable) {
    const test::TemporaryFolder folder;
    for (const auto& [name, text] :
         {std::pair{"empty.tif", ""}, {"text.tif", "not a raster"}, {"city.json", "{}"}}) {
        const fs::path path = folder.write(name, text);
        const auto file = RasterFile::open(path);
        ASSERT_FALSE(file) << name;
        EXPECT_EQ(file.error().code, ErrorCode::Unreadable);
        EXPECT_FALSE(RasterFile::recognises(path));
    }
    EXPECT_EQ(RasterFile::open(folder.path()).error().code, ErrorCode::Unreadable);
    EXPECT_EQ(RasterFile::open(folder.path() / "none.tif").error().code, ErrorCode::Unreadable);
    EXPECT_EQ(RasterFile::openBytes("", "a.tif").error().code, ErrorCode::Unreadable);
}

}  // namespace
}  // namespace reflet
