// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geo/Crs.h"
#include "core/io/GeoFile.h"

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>
#include <ogrsf_frmts.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>
#include <unistd.h>

namespace reflet {
namespace {

namespace fs = std::filesystem;

/// A folder of the test's own, removed with it.
class GeoFileTest : public testing::Test {
protected:
    void SetUp() override {
        GDALAllRegister();
        std::string pattern = (fs::temp_directory_path() / "reflet-geofile-XXXXXX").string();
        ASSERT_NE(mkdtemp(pattern.data()), nullptr);
        m_folder = pattern;
    }
    void TearDown() override { fs::remove_all(m_folder); }

    [[nodiscard]] fs::path file(const std::string& name) const { return m_folder / name; }
    fs::path write(const std::string& name, const std::string& text) const {
        std::ofstream(file(name), std::ios::binary) << text;
        return file(name);
    }
    [[nodiscard]] std::size_t filesInFolder() const {
        return std::size_t(std::distance(fs::directory_iterator(m_folder), {}));
    }

private:
    fs::path m_folder;
};

using HeightfieldFile = GeoFileTest;
using LineFile = GeoFileTest;

struct Closer {
    void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
std::unique_ptr<GDALDataset, Closer> reopened(const fs::path& path) {
    return std::unique_ptr<GDALDataset, Closer>(GDALDataset::Open(path.c_str(), GDAL_OF_RASTER));
}

/// 3 × 2 cells of 2 m; heights tell their place: 10 j + i, plus 100 a layer.
Heightfield smallField() {
    Heightfield field;
    field.grid = {120.0, -40.0, 2.0, 3, 2};
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 3; ++i) {
            const auto z = float(10 * j + i);
            field.ground.push_back(z);
            field.topMax.push_back(z + 100.0F);
            field.topCenter.push_back(z + 200.0F);
        }
    field.topMax[4] = kMissingHeight;
    return field;
}

ProjectFrame delft() {
    ProjectFrame frame;
    frame.crs = "EPSG:28992";
    frame.vertical = "EPSG:5709";
    frame.origin = {85000, 446000, 0};
    return frame;
}

std::vector<std::string> bandNames(GDALDataset& dataset) {
    std::vector<std::string> names;
    for (int b = 1; b <= dataset.GetRasterCount(); ++b)
        names.emplace_back(dataset.GetRasterBand(b)->GetDescription());
    return names;
}

float pixel(GDALDataset& dataset, int band, int column, int row) {
    float value = 0.0F;
    EXPECT_EQ(dataset.GetRasterBand(band)->RasterIO(GF_Read, column, row, 1, 1, &value, 1, 1,
                                                    GDT_Float32, 0, 0, nullptr),
              CE_None);
    return value;
}

TEST_F(HeightfieldFile, IsPlacedNorthUpWithItsFirstRowInTheNorth) {
    ASSERT_TRUE(writeHeightfield(smallField(), delft(), 3, file("h.tif")));
    const auto dataset = reopened(file("h.tif"));
    ASSERT_TRUE(dataset);
    EXPECT_EQ(dataset->GetRasterXSize(), 3);
    EXPECT_EQ(dataset->GetRasterYSize(), 2);
    double t[6];
    ASSERT_EQ(dataset->GetGeoTransform(t), CE_None);
    EXPECT_EQ(t[0], 85120.0);
    EXPECT_EQ(t[1], 2.0);
    EXPECT_EQ(t[2], 0.0);
    EXPECT_EQ(t[3], 445964.0);  // 446000 - 40 + 2 · 2
    EXPECT_EQ(t[4], 0.0);
    EXPECT_EQ(t[5], -2.0);
    EXPECT_EQ(pixel(*dataset, 1, 0, 1), 0.0F);   // south-west
    EXPECT_EQ(pixel(*dataset, 1, 2, 1), 2.0F);   // south-east
    EXPECT_EQ(pixel(*dataset, 1, 0, 0), 10.0F);  // north-west
    EXPECT_EQ(pixel(*dataset, 3, 2, 0), 212.0F);
    EXPECT_STREQ(dataset->GetMetadataItem(GDALMD_AREA_OR_POINT), GDALMD_AOP_AREA);
}

TEST_F(HeightfieldFile, NamesItsBandsAndDeclaresMissingCellsAsNoData) {
    ASSERT_TRUE(writeHeightfield(smallField(), delft(), 3, file("h.tif")));
    const auto dataset = reopened(file("h.tif"));
    ASSERT_TRUE(dataset);
    EXPECT_EQ(bandNames(*dataset), (std::vector<std::string>{"ground", "top_max", "top_center",
                                                             "ceil_min", "over_top", "base_top"}));
    for (int b = 1; b <= 6; ++b) {
        int has = 0;
        EXPECT_TRUE(std::isnan(dataset->GetRasterBand(b)->GetNoDataValue(&has)));
        EXPECT_EQ(has, 1);
        EXPECT_EQ(dataset->GetRasterBand(b)->GetRasterDataType(), GDT_Float32);
    }
    EXPECT_TRUE(std::isnan(pixel(*dataset, 2, 1, 0)));
    unsigned char mask = 255;
    ASSERT_EQ(dataset->GetRasterBand(2)->GetMaskBand()->RasterIO(GF_Read, 1, 0, 1, 1, &mask, 1, 1,
                                                                 GDT_Byte, 0, 0, nullptr),
              CE_None);
    EXPECT_EQ(mask, 0);
}

TEST_F(HeightfieldFile, HoldsTheLayersAskedFor) {
    ASSERT_TRUE(writeHeightfield(smallField(), delft(), 1, file("1.tif")));
    ASSERT_TRUE(writeHeightfield(smallField(), delft(), 2, file("2.tif")));
    const auto one = reopened(file("1.tif"));
    const auto two = reopened(file("2.tif"));
    EXPECT_EQ(bandNames(*one), std::vector<std::string>{"top_max"});
    EXPECT_EQ(bandNames(*two),
              (std::vector<std::string>{"ground", "top_max", "ceil_min", "over_top"}));
    for (const int layers : {0, 4, -1}) {
        const auto refused = writeHeightfield(smallField(), delft(), layers, file("no.tif"));
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::Usage);
    }
    EXPECT_EQ(filesInFolder(), 2U);
}

TEST_F(HeightfieldFile, HoldsWhatHangsOverTheGround) {
    Heightfield field = smallField();
    constexpr auto bridge = CityObjectType::Bridge;
    // The south-west cell lies under a bridge of two levels, the one beside it under one level.
    field.spans = CellSpans(6, {0, 1}, {0, 3, 5},
                            {{-kInfinity, 0.5F, CityObjectType::TinRelief, false},
                             {6, 7, bridge, false},
                             {90, 100, bridge, false},
                             {-kInfinity, 1, CityObjectType::TinRelief, false},
                             {8, 101, bridge, true}});
    ProjectFrame frame = delft();
    frame.origin.z = 1000.0;
    ASSERT_TRUE(writeHeightfield(field, frame, 2, file("2.tif")));
    ASSERT_TRUE(writeHeightfield(field, frame, 3, file("n.tif")));
    const auto two = reopened(file("2.tif"));
    EXPECT_EQ(pixel(*two, 3, 0, 1), 1006.0F);
    EXPECT_EQ(pixel(*two, 4, 0, 1), 1007.0F);
    EXPECT_EQ(pixel(*two, 3, 1, 1), 1008.0F);
    EXPECT_EQ(pixel(*two, 4, 1, 1), 1101.0F);
    EXPECT_TRUE(std::isnan(pixel(*two, 3, 2, 1)));
    EXPECT_TRUE(std::isnan(pixel(*two, 4, 0, 0)));
    const auto all = reopened(file("n.tif"));
    EXPECT_EQ(bandNames(*all),
              (std::vector<std::string>{"ground", "top_max", "top_center", "ceil_min", "over_top",
                                        "base_top", "low_3", "high_3"}));
    EXPECT_EQ(pixel(*all, 6, 0, 1), 1000.5F);
    EXPECT_EQ(pixel(*all, 6, 2, 1), pixel(*all, 2, 2, 1));
    EXPECT_EQ(pixel(*all, 7, 0, 1), 1090.0F);
    EXPECT_EQ(pixel(*all, 8, 0, 1), 1100.0F);
    EXPECT_TRUE(std::isnan(pixel(*all, 7, 1, 1)));
}

TEST_F(HeightfieldFile, CarriesTheCompoundSystemWhereTheHeightsDatumIsKnown) {
    ASSERT_TRUE(writeHeightfield(smallField(), delft(), 2, file("h.tif")));
    const auto dataset = reopened(file("h.tif"));
    const OGRSpatialReference* const system = dataset->GetSpatialRef();
    ASSERT_NE(system, nullptr);
    EXPECT_TRUE(system->IsCompound());
    char* wkt = nullptr;
    const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
    ASSERT_EQ(system->exportToWkt(&wkt, options), OGRERR_NONE);
    const auto crs = Crs::parse(wkt);
    CPLFree(wkt);
    ASSERT_TRUE(crs) << crs.error().message();
    EXPECT_EQ(crs->horizontal(), "EPSG:28992");
    EXPECT_EQ(crs->vertical(), "EPSG:5709");
}

TEST_F(HeightfieldFile, CarriesTheHorizontalSystemAloneWhereTheDatumIsUnknown) {
    ProjectFrame frame = delft();
    frame.crs = "EPSG:25832";
    frame.vertical.reset();
    ASSERT_TRUE(writeHeightfield(smallField(), frame, 2, file("h.tif")));
    const auto dataset = reopened(file("h.tif"));
    const OGRSpatialReference* const system = dataset->GetSpatialRef();
    ASSERT_NE(system, nullptr);
    EXPECT_FALSE(system->IsCompound());
    EXPECT_STREQ(system->GetAuthorityCode(nullptr), "25832");
}

TEST_F(HeightfieldFile, ALocalFrameHasNoSystemButItsPlace) {
    ProjectFrame frame;
    frame.origin = {1000, 2000, 0};
    ASSERT_TRUE(writeHeightfield(smallField(), frame, 2, file("h.tif")));
    const auto dataset = reopened(file("h.tif"));
    EXPECT_EQ(dataset->GetSpatialRef(), nullptr);
    double t[6];
    ASSERT_EQ(dataset->GetGeoTransform(t), CE_None);
    EXPECT_EQ(t[0], 1120.0);
}

TEST_F(HeightfieldFile, TellsWhatMadeIt) {
    ASSERT_TRUE(writeHeightfield(smallField(), delft(), 2, file("h.tif")));
    const auto dataset = reopened(file("h.tif"));
    EXPECT_EQ(std::string(dataset->GetMetadataItem("TIFFTAG_SOFTWARE")).substr(0, 7), "Reflet ");
    EXPECT_STREQ(dataset->GetMetadataItem("REFLET_CELL_SIZE"), "2");
    EXPECT_STREQ(dataset->GetMetadataItem("REFLET_ORIGIN"), "85000 446000 0");
    EXPECT_STREQ(dataset->GetMetadataItem("REFLET_VERTICAL"), "EPSG:5709");
}

TEST_F(HeightfieldFile, KeepsEveryHeightOfALargerFieldBitByBit) {
    Heightfield field;
    field.grid = {0.5, 0.5, 0.5, 701, 403};
    for (std::size_t k = 0; k < field.grid.cellCount(); ++k)
        field.topMax.push_back(50.0F + 40.0F * std::sin(float(k) * 0.37F));
    ASSERT_TRUE(writeHeightfield(field, delft(), 1, file("h.tif")));
    const auto dataset = reopened(file("h.tif"));
    std::vector<float> row(701);
    for (int j = 0; j < 403; ++j) {
        ASSERT_EQ(dataset->GetRasterBand(1)->RasterIO(GF_Read, 0, 402 - j, 701, 1, row.data(), 701,
                                                      1, GDT_Float32, 0, 0, nullptr),
                  CE_None);
        for (int i = 0; i < 701; ++i)
            ASSERT_EQ(row[std::size_t(i)], field.topMax[field.grid.index(i, j)]);
    }
}

TEST_F(HeightfieldFile, LeavesNothingBehindWhereItCannotBeWritten) {
    const auto missing = writeHeightfield(smallField(), delft(), 2, file("none") / "h.tif");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, ErrorCode::WriteFailed);
    ProjectFrame frame = delft();
    frame.crs = "EPSG:999999";
    EXPECT_EQ(writeHeightfield(smallField(), frame, 2, file("h.tif")).error().code,
              ErrorCode::Refused);
    Heightfield hollow = smallField();
    hollow.ground.clear();
    EXPECT_EQ(writeHeightfield(hollow, delft(), 2, file("h.tif")).error().code, ErrorCode::Refused);
    EXPECT_EQ(filesInFolder(), 0U);
}

TEST_F(HeightfieldFile, ReplacesAnOlderFileAndLeavesNoOtherBesideIt) {
    write("h.tif", "old");
    ASSERT_TRUE(writeHeightfield(smallField(), delft(), 2, file("h.tif")));
    EXPECT_TRUE(reopened(file("h.tif")));
    EXPECT_EQ(filesInFolder(), 1U);
}

// ---- lines ----

std::string geoJson(const std::string& geometry, const std::string& head = "") {
    return "{\"type\":\"FeatureCollection\"," + head +
           "\"features\":[{\"type\":\"Feature\",\"properties\":{\"name\":\"Line 1\"},"
           "\"geometry\":" +
           geometry + "}]}";
}
const std::string kDegrees =
    R"({"type":"LineString","coordinates":[[4.36778561,52.00245561],[4.37,52.003]]})";
const std::string kMetres =
    R"({"type":"LineString","coordinates":[[85000,446500,1.5],[85100,446600,2.5]]})";

TEST_F(LineFile, TransformsGeoJsonFromDegreesIntoTheProjectsSystem) {
    const auto lines = readLines(write("a.geojson", geoJson(kDegrees)), delft());
    ASSERT_TRUE(lines) << lines.error().message();
    ASSERT_EQ(lines->size(), 1U);
    EXPECT_EQ(lines->front().name, "Line 1");
    ASSERT_EQ(lines->front().points.size(), 2U);
    EXPECT_NEAR(lines->front().points[0].x, 85000.0, 0.02);
    EXPECT_NEAR(lines->front().points[0].y, 446500.0, 0.02);
    EXPECT_TRUE(std::isnan(lines->front().points[0].z));
}

TEST_F(LineFile, TakesGeoJsonInMetresWithoutACrsForTheProjectsSystem) {
    const auto lines = readLines(write("a.geojson", geoJson(kMetres)), delft());
    ASSERT_TRUE(lines) << lines.error().message();
    EXPECT_EQ(lines->front().points[0], glm::dvec3(85000, 446500, 1.5));
    EXPECT_EQ(lines->front().points[1], glm::dvec3(85100, 446600, 2.5));
}

TEST_F(LineFile, HonoursTheCrsMemberOfOlderGeoJson) {
    const std::string head =
        R"("crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::28992"}},)";
    ProjectFrame utm = delft();
    utm.crs = "EPSG:25831";
    const auto lines = readLines(write("a.geojson", geoJson(kMetres, head)), utm);
    ASSERT_TRUE(lines) << lines.error().message();
    EXPECT_NEAR(lines->front().points[0].x, 593891.94, 0.5);
    EXPECT_NEAR(lines->front().points[0].y, 5762194.57, 0.5);
    EXPECT_EQ(lines->front().points[0].z, 1.5);
}

TEST_F(LineFile, GivesEveryPartOfAMultiLineAndOfACollectionAndSkipsTheRest) {
    const std::string multi =
        R"({"type":"GeometryCollection","geometries":[
           {"type":"MultiLineString","coordinates":[[[1000,2000],[1001,2000]],[[1002,2000],[1003,2000],[1004,2000]]]},
           {"type":"Point","coordinates":[1005,2000]},
           {"type":"Polygon","coordinates":[[[1000,2000],[1001,2000],[1001,2001],[1000,2000]]]}]})";
    const auto lines = readLines(write("a.geojson", geoJson(multi)), delft());
    ASSERT_TRUE(lines) << lines.error().message();
    ASSERT_EQ(lines->size(), 2U);
    EXPECT_EQ((*lines)[0].name, "Line 1");
    EXPECT_EQ((*lines)[1].name, "Line 1 (2)");
    EXPECT_EQ((*lines)[1].points.size(), 3U);
}

TEST_F(LineFile, NamesALineByItsNameElseItsIdElseItsNumber) {
    const std::string line =
        R"("geometry":{"type":"LineString","coordinates":[[1000,2000],[1001,2000]]}})";
    const auto lines = readLines(write("a.geojson", R"({"type":"FeatureCollection","features":[
          {"type":"Feature","properties":{"Name":"Tram 2","id":"t2"},)" +
                                                        line + R"(,
          {"type":"Feature","properties":{"Name":null,"id":"t3"},)" +
                                                        line + R"(,
          {"type":"Feature","properties":{},)" + line + "]}"),
                                 delft());
    ASSERT_TRUE(lines) << lines.error().message();
    ASSERT_EQ(lines->size(), 3U);
    EXPECT_EQ((*lines)[0].name, "Tram 2");
    EXPECT_EQ((*lines)[1].name, "t3");
    EXPECT_EQ((*lines)[2].name, "2");
    using Attributes = std::map<std::string, std::string>;
    EXPECT_EQ((*lines)[0].attributes, (Attributes{{"Name", "Tram 2"}, {"id", "t2"}}));
    EXPECT_EQ((*lines)[1].attributes, (Attributes{{"id", "t3"}})) << "null is no value";
    EXPECT_TRUE((*lines)[2].attributes.empty());
}

TEST_F(LineFile, TakesLocalCoordinatesForALocalProjectAndRefusesPlacedOnes) {
    ProjectFrame local;
    const auto drawn = readLines(
        write("a.geojson", geoJson(R"({"type":"LineString","coordinates":[[0,0],[30,5]]})")),
        local);
    ASSERT_TRUE(drawn) << drawn.error().message();
    EXPECT_EQ(drawn->front().points[1].x, 30.0);
    const std::string head =
        R"("crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::28992"}},)";
    const auto placed = readLines(write("b.geojson", geoJson(kMetres, head)), local);
    ASSERT_FALSE(placed);
    EXPECT_EQ(placed.error().code, ErrorCode::Refused);
    EXPECT_EQ(placed.error().subject, file("b.geojson").string());
}

/// Writes one line through OGR: what GIS programs ship.
void writeVector(const fs::path& path, const char* driver, const char* crs,
                 const std::vector<glm::dvec2>& points) {
    GDALDataset* const dataset = GetGDALDriverManager()->GetDriverByName(driver)->Create(
        path.c_str(), 0, 0, 0, GDT_Unknown, nullptr);
    ASSERT_NE(dataset, nullptr);
    OGRSpatialReference system;
    if (crs != nullptr) {
        ASSERT_EQ(system.SetFromUserInput(crs), OGRERR_NONE);
        system.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    }
    OGRLayer* const layer =
        dataset->CreateLayer("routes", crs != nullptr ? &system : nullptr, wkbLineString);
    ASSERT_NE(layer, nullptr);
    OGRFeatureUniquePtr feature(OGRFeature::CreateFeature(layer->GetLayerDefn()));
    OGRLineString line;
    for (const auto& p : points)
        line.addPoint(p.x, p.y);
    feature->SetGeometry(&line);
    ASSERT_EQ(layer->CreateFeature(feature.get()), OGRERR_NONE);
    GDALClose(dataset);
}

TEST_F(LineFile, ReadsOtherFormatsEastFirstEvenWhereTheSystemPutsNorthFirst) {
    ProjectFrame vienna;
    vienna.crs = "EPSG:31256";
    vienna.origin = {2000, 340000, 0};
    const glm::dvec2 there(16.365764692, 48.198405411);
    const glm::dvec2 grid(2500, 340000);
    struct Case {
        const char* name;
        const char* driver;
        const char* crs;
        glm::dvec2 point;
        double tolerance;
    };
    for (const Case& c : {Case{"a.gpkg", "GPKG", "EPSG:31256", grid, 1e-6},
                          Case{"a.shp", "ESRI Shapefile", "EPSG:31256", grid, 1e-6},
                          Case{"b.gpkg", "GPKG", "EPSG:4326", there, 0.01},
                          Case{"b.shp", "ESRI Shapefile", "EPSG:4326", there, 0.01},
                          Case{"b.fgb", "FlatGeobuf", "EPSG:4326", there, 0.01},
                          Case{"b.kml", "KML", "EPSG:4326", there, 0.01},
                          Case{"c.shp", "ESRI Shapefile", nullptr, grid, 1e-6}}) {
        writeVector(file(c.name), c.driver, c.crs, {c.point, c.point + glm::dvec2(0.001)});
        const auto lines = readLines(file(c.name), vienna);
        ASSERT_TRUE(lines) << c.name << ": " << lines.error().message();
        ASSERT_EQ(lines->size(), 1U) << c.name;
        EXPECT_NEAR(lines->front().points[0].x, grid.x, c.tolerance) << c.name;
        EXPECT_NEAR(lines->front().points[0].y, grid.y, c.tolerance) << c.name;
    }
}

TEST_F(LineFile, RefusesASystemThatOnlyABallparkTransformationReaches) {
    const char* const unknown =
        "PROJCS[\"site\",GEOGCS[\"unknown\",DATUM[\"A surveyors "
        "word\",SPHEROID[\"own\",6377000,298]"
        "],PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]],PROJECTION[\"Transverse_"
        "Mercator\"],PARAMETER[\"latitude_of_origin\",0],PARAMETER[\"central_meridian\",9],"
        "PARAMETER[\"scale_factor\",1],PARAMETER[\"false_easting\",0],PARAMETER[\"false_northing\","
        "0],UNIT[\"metre\",1]]";
    writeVector(file("a.gpkg"), "GPKG", unknown, {{0, 0}, {10, 10}});
    const auto lines = readLines(file("a.gpkg"), delft());
    ASSERT_FALSE(lines);
    EXPECT_EQ(lines.error().code, ErrorCode::Refused) << lines.error().message();
}

TEST_F(LineFile, RefusesMoreThanAMillionPoints) {
    std::vector<glm::dvec2> points;
    for (int i = 0; i < 1'000'001; ++i)
        points.emplace_back(85000.0 + 0.01 * i, 446000.0);
    writeVector(file("a.shp"), "ESRI Shapefile", "EPSG:28992", points);
    const auto lines = readLines(file("a.shp"), delft());
    ASSERT_FALSE(lines);
    EXPECT_EQ(lines.error().code, ErrorCode::ResourceLimit);
    points.pop_back();
    writeVector(file("b.shp"), "ESRI Shapefile", "EPSG:28992", points);
    EXPECT_TRUE(readLines(file("b.shp"), delft()));
}

TEST_F(LineFile, AFileWithoutLinesIsAnErrorThatTellsWhatToDraw) {
    const auto lines =
        readLines(write("a.geojson", geoJson(R"({"type":"Point","coordinates":[1,2]})")), delft());
    ASSERT_FALSE(lines);
    EXPECT_EQ(lines.error().code, ErrorCode::Unreadable);
    EXPECT_NE(lines.error().remedy.find("LineString"), std::string::npos);
}

TEST_F(LineFile, OpensNothingButFiles) {
    for (const fs::path& path :
         {file("none.geojson"), file("."), fs::path("/vsicurl/http://127.0.0.1:1/a.geojson"),
          fs::path("{\"type\":\"LineString\",\"coordinates\":[[0,0],[1,1]]}"),
          fs::path("http://127.0.0.1:1/a.geojson")}) {
        const auto lines = readLines(path, delft());
        ASSERT_FALSE(lines) << path;
        EXPECT_EQ(lines.error().code, ErrorCode::Unreadable) << path;
    }
    const fs::path vrt =
        write("a.vrt", "<OGRVRTDataSource><OGRVRTLayer name=\"a\"><SrcDataSource>" +
                           write("a.geojson", geoJson(kDegrees)).string() +
                           "</SrcDataSource></OGRVRTLayer></OGRVRTDataSource>");
    EXPECT_FALSE(readLines(vrt, delft()));
}

TEST_F(LineFile, MalformedGeoJsonGivesAnErrorAndPrintsNothing) {
    const char* const shared = std::getenv("REFLET_SHARED_DATA");
    const fs::path folder =
        (shared != nullptr ? fs::path(shared) : fs::path(REFLET_SOURCE_DIR) / "../shared/data") /
        "bad/geojson";
    if (!fs::is_directory(folder))
        GTEST_SKIP() << "no data in " << folder;
    testing::internal::CaptureStderr();
    int files = 0;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const auto lines = readLines(entry.path(), delft());
        ASSERT_FALSE(lines) << entry.path();
        EXPECT_EQ(lines.error().code, ErrorCode::Unreadable) << entry.path();
        ++files;
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_GE(files, 9);
}

TEST_F(LineFile, SkipsALineWithBrokenCoordinatesAndKeepsTheOthers) {
    const auto lines = readLines(write("a.geojson", R"({"type":"FeatureCollection","features":[
          {"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[["a",1],[2,3]]}},
          {"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[1000,2000]]}},
          {"type":"Feature","properties":{},"geometry":null},
          {"type":"Feature","properties":{"name":"good"},"geometry":{"type":"LineString","coordinates":[[1000,2000],[1001,2000]]}}]})"),
                                 delft());
    ASSERT_TRUE(lines) << lines.error().message();
    ASSERT_EQ(lines->size(), 1U);
    EXPECT_EQ(lines->front().name, "good");
}

TEST(GdalVersion, IsThatOfTheLibrary) {
    EXPECT_EQ(gdalVersion(), GDAL_RELEASE_NAME);
}

}  // namespace
}  // namespace reflet
