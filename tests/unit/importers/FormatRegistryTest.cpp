// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/FormatRegistry.h"
#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <fstream>

namespace reflet {

namespace {

class FormatRegistry : public testing::Test {
protected:
    std::string nameOf(const std::string& fileName, std::string_view content) {
        const auto format = cityFormatOf(write(fileName, content));
        return format ? std::string((*format)->name) : "error";
    }
    Error errorOf(const std::string& fileName, std::string_view content) {
        const auto format = cityFormatOf(write(fileName, content));
        return format ? Error{} : format.error();
    }

private:
    std::filesystem::path write(const std::string& fileName, std::string_view content) {
        const auto path = m_folder.path() / fileName;
        std::ofstream(path, std::ios::binary) << content;
        return path;
    }
    test::TemporaryFolder m_folder;
};

constexpr std::string_view kCityJson = R"( {"CityObjects": {}, "type": "CityJSON"})";
constexpr std::string_view kSequence =
    "{\"type\":\"CityJSON\",\"version\":\"2.0\"}\n{\"type\":\"CityJSONFeature\"}\n";

}  // namespace

TEST_F(FormatRegistry, TheContentDecidesWhateverTheSuffix) {
    EXPECT_EQ(nameOf("a.city.json", kCityJson), "CityJSON");
    EXPECT_EQ(nameOf("a.txt", kCityJson), "CityJSON");
    EXPECT_EQ(nameOf("a.gml", kCityJson), "CityJSON");
    EXPECT_EQ(nameOf("a.city.jsonl", kSequence), "CityJSONSeq");
    EXPECT_EQ(nameOf("a.city.json", kSequence), "CityJSONSeq");
}

TEST_F(FormatRegistry, FootprintsAndOpenStreetMapAreKnownByTheirContent) {
    EXPECT_EQ(nameOf("a.json", R"({"type": "FeatureCollection", "features": []})"), "GeoJSON");
    EXPECT_EQ(nameOf("a.json", R"({"type": "Feature", "geometry": null})"), "GeoJSON");
    EXPECT_EQ(nameOf("a.geojson", R"({"type": "Polygon", "coordinates": []})"), "GeoJSON");
    EXPECT_EQ(nameOf("a.geojson", kCityJson), "CityJSON");
    EXPECT_EQ(nameOf("a.xml", "<?xml version='1.0'?>\n<osm version='0.6'></osm>"), "OpenStreetMap");
    EXPECT_EQ(nameOf("a", std::string_view("\0\0\0\x0d\x0a\x09OSMHeader\x18", 16)),
              "OpenStreetMap");
    EXPECT_EQ(nameOf("a", std::string_view("\0\0\x27\x0a", 4)), "Shapefile");
    EXPECT_EQ(nameOf("a", std::string_view("fgb\x03"
                                           "fgb\0",
                                           8)),
              "FlatGeobuf");
    EXPECT_EQ(nameOf("a.gpkg", std::string_view("SQLite format 3\0", 16)), "GeoPackage");
}

TEST_F(FormatRegistry, ADamagedFileGoesToTheReaderOfItsSuffix) {
    EXPECT_EQ(nameOf("a.city.json", ""), "CityJSON");
    EXPECT_EQ(nameOf("a.json", "[[["), "CityJSON");
    EXPECT_EQ(nameOf("a.city.jsonl", "oops"), "CityJSONSeq");
}

TEST_F(FormatRegistry, ForeignFormatsAreNamedWithAWayOut) {
    const struct {
        const char* file;
        std::string_view content;
        const char* name;
    } foreign[] = {
        {"a.ifc", "ISO-10303-21;\nHEADER;", "IFC"},
        {"renamed.json", "ISO-10303-21;\nHEADER;", "IFC"},
        {"a.fbx", std::string_view("Kaydara FBX Binary  \0", 21), "FBX"},
        {"a.skp", std::string_view("\xff\xfe\xff\x0eS\0k\0", 8), "SketchUp"},
        {"a.dwg", "AC1032", "AutoCAD drawing (DWG)"},
        {"a.dxf", "0\nSECTION", "AutoCAD drawing (DXF)"},
        {"a.3ds", "MM\x10", "3D Studio (3DS)"},
        {"a.BLEND", "BLENDER-v300", "Blender"},
        {"a.dae", "<?xml version=\"1.0\"?>\n<COLLADA>", "Collada"},
        {"a.kml", "<kml>", "KML"},
        {"a.rvt", "\xd0\xcf\x11\xe0", "Revit"},
        {"a.las", "LASF", "point cloud (LAS)"},
    };
    for (const auto& each : foreign) {
        const Error error = errorOf(each.file, each.content);
        EXPECT_EQ(error.code, ErrorCode::Unreadable) << each.file;
        EXPECT_EQ(error.what, std::string("is a file of the format ") + each.name +
                                  ", which Reflet does not read");
        EXPECT_GT(error.remedy.size(), 40U) << each.file;
    }
}

TEST_F(FormatRegistry, WhatIsOfNoKindIsToldWhatThereIs) {
    const Error error = errorOf("a.txt", "Dear planner,");
    EXPECT_EQ(error.what, "is of no format that Reflet knows");
    EXPECT_NE(error.remedy.find("CityJSON (.city.json, .json)"), std::string::npos);
    const auto absent = cityFormatOf("/nonexistent/a.city.json");
    ASSERT_FALSE(absent);
    EXPECT_EQ(absent.error().code, ErrorCode::Unreadable);
    EXPECT_FALSE(cityFormatOf("/"));
}

TEST_F(FormatRegistry, NamesOfCityModelsAreKnownByTheirSuffix) {
    EXPECT_TRUE(hasCitySuffix("Town.CITY.JSON"));
    EXPECT_TRUE(hasCitySuffix("/a/b/tile.city.jsonl"));
    EXPECT_FALSE(hasCitySuffix("json"));
    EXPECT_FALSE(hasCitySuffix("a.skp"));
}

}  // namespace reflet
