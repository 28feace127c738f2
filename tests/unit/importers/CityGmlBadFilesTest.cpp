// SPDX-License-Identifier: GPL-3.0-or-later
// Malformed CityGML: what exactly becomes of each file of the shared data, and of made-up ones.
#include "tests/support/TestData.h"
#include "tests/unit/importers/CityGmlText.h"
#include "tests/unit/importers/CityJsonText.h"

#include <set>

namespace reflet {

using namespace test;

namespace {

struct OddGml {
    const char* path;
    const char* counts;
    std::size_t triangles;
    const char* diagnostic;  ///< beside "no-crs"; nullptr = none
    const char* text;
};

constexpr std::array<OddGml, 13> kOddGml{{
    {"qie-i101-1.gml", "0 loaded, 1 repaired, 0 skipped", 10, "degenerate-surface",
     "left out: 1 surface without area (fewer than three distinct points)"},
    {"qie-i103-1.gml", "0 loaded, 1 repaired, 0 skipped", 12, "ring-closed",
     "closed: 1 surface with a ring that does not end where it begins"},
    {"qie-i104-1.gml", "0 loaded, 1 repaired, 0 skipped", 12, "polygon-repaired",
     "mended: 1 surface with repeated points, crossing edges or odd rings"},
    {"qie-i201-1.gml", "0 loaded, 1 repaired, 0 skipped", 23, "polygon-repaired",
     "mended: 1 surface with repeated points, crossing edges or odd rings"},
    {"qie-i206-1.gml", "1 loaded, 0 repaired, 0 skipped", 14, nullptr, ""},
    {"qie-i301-1.gml", "1 loaded, 0 repaired, 0 skipped", 6, nullptr, ""},
    {"qie-i302-1.gml", "1 loaded, 0 repaired, 0 skipped", 10, nullptr, ""},
    {"qie-i303-1.gml", "1 loaded, 0 repaired, 0 skipped", 13, nullptr, ""},
    {"qie-i305-1.gml", "1 loaded, 0 repaired, 0 skipped", 13, nullptr, ""},
    {"qie-i307-1.gml", "1 loaded, 0 repaired, 0 skipped", 12, nullptr, ""},
    {"qie-t203-1.gml", "1 loaded, 0 repaired, 0 skipped", 12, nullptr, ""},
    {"qie-v004.gml", "1 loaded, 0 repaired, 0 skipped", 12, nullptr, ""},
    {"malformed-poslist.gml", "0 loaded, 0 repaired, 1 skipped", 0, "bad-coordinates",
     "left out: 1 surface whose coordinates cannot be read (5 numbers make no points of 3)"},
}};

class OddCityGml : public testing::TestWithParam<OddGml> {};

}  // namespace

TEST_P(OddCityGml, IsLoadedWithAnAccountOfItsObjects) {
    const auto path = sharedData(std::string("bad/citygml/") + GetParam().path);
    if (!path)
        GTEST_SKIP() << kNoSharedData;
    const auto result = importCityGml(*path, {}, {});
    ASSERT_TRUE(result) << result.error().message();
    EXPECT_EQ(countsOf(*result), GetParam().counts);
    EXPECT_EQ(result->value.city.triangles.size(), GetParam().triangles);
    if (GetParam().diagnostic != nullptr) {
        EXPECT_EQ(textOf(*result, GetParam().diagnostic), GetParam().text);
    }
}

INSTANTIATE_TEST_SUITE_P(SharedData, OddCityGml, testing::ValuesIn(kOddGml));

TEST(BadCityGml, EveryFileOfTheSharedDataIsCovered) {
    const auto folder = sharedData("bad/citygml");
    if (!folder)
        GTEST_SKIP() << kNoSharedData;
    std::set<std::string> covered;
    for (const OddGml& file : kOddGml)
        covered.insert(file.path);
    for (const auto& entry : std::filesystem::directory_iterator(*folder))
        EXPECT_TRUE(covered.contains(entry.path().filename().string())) << entry.path();
}

TEST(BadCityGml, FarCoordinatesKeepTheirShape) {
    const auto path = sharedData("bad/citygml/qie-v004.gml");
    if (!path)
        GTEST_SKIP() << kNoSharedData;
    const auto result = importCityGml(*path, {}, {});
    ASSERT_TRUE(result) << result.error().message();
    EXPECT_NEAR(enclosedVolume(result->value.city), 1.0, 1e-9);
    EXPECT_EQ(result->value.city.frame.origin.x, 1e8);
}

TEST(BadCityGml, WhatIsNoXmlIsUnreadableWithItsLine) {
    const auto whatOf = [](const std::string& text) { return gmlError(text).what; };
    const std::string city =
        cityGml(building("a", "<bldg:lod1Solid>" + solidOf(boxFaces(0, 0)) + "</bldg:lod1Solid>"));
    EXPECT_EQ(whatOf(""), "is empty");
    EXPECT_EQ(whatOf("no XML at all"), "is no valid XML at line 1: it has no root element");
    EXPECT_EQ(whatOf(city.substr(0, city.size() - 13)),
              "is no valid XML at line 5: it ends before its root does; the file is cut off");
    EXPECT_EQ(whatOf(city.substr(0, city.size() / 2)).substr(0, 25), "is no valid XML at line 4");
    std::string crossed = city;
    crossed.replace(crossed.find("</bldg:lod1Solid>"), 17, "</bldg:lod2Solid>");
    EXPECT_EQ(whatOf(crossed), "is no valid XML at line 4: Start-end tags mismatch");
    EXPECT_EQ(whatOf("<kml xmlns=\"http://www.opengis.net/kml/2.2\"/>"),
              "is no CityGML: its root is <kml>, without a namespace of CityGML 1.0, 2.0 or 3.0");
    EXPECT_EQ(gmlError("").code, ErrorCode::Unreadable);
}

TEST(BadCityGml, EntitiesAreNotExpandedAndFilesNotFetched) {
    std::string laughs =
        "<?xml version=\"1.0\"?>\n<!DOCTYPE lolz [\n<!ENTITY lol \"lol\">\n"
        "<!ENTITY f SYSTEM \"file:///etc/passwd\">\n";
    for (int i = 1; i < 10; ++i) {
        laughs += fmt::format("<!ENTITY lol{} \"", i);
        for (int j = 0; j < 10; ++j)
            laughs += i == 1 ? "&lol;" : fmt::format("&lol{};", i - 1);
        laughs += "\">\n";
    }
    laughs += "]>\n";
    const std::string city = cityGml(
        building("&lol9;&f;", "<bldg:lod1Solid>" + solidOf(boxFaces(0, 0)) + "</bldg:lod1Solid>"));
    const auto result = importGml(laughs + city.substr(city.find('\n') + 1));
    ASSERT_EQ(result.value.city.objects.size(), 1U);
    EXPECT_EQ(result.value.city.objects[0].id, "&lol9;&f;");
    EXPECT_EQ(result.value.city.triangles.size(), 12U);
}

TEST(BadCityGml, NestingBeyondAllReasonIsALimitNotACrash) {
    std::string deep;
    for (int i = 0; i < 100'000; ++i)
        deep += "<gml:MultiSurface><gml:surfaceMember>";
    const Error error = gmlError(cityGml(building("a", "<bldg:lod1MultiSurface>" + deep)));
    EXPECT_EQ(error.code, ErrorCode::ResourceLimit);
    EXPECT_EQ(error.what, "has an object in line 4 that is nested too deeply");
}

TEST(BadCityGml, ReferencesThatRunInACircleEnd) {
    const std::string circle =
        "<gml:MultiSurface gml:id=\"m\"><gml:surfaceMember xlink:href=\"#m\"/>"
        "<gml:surfaceMember xlink:href=\"#m\"/><gml:surfaceMember xlink:href=\"#absent\"/>"
        "<gml:surfaceMember xlink:href=\"other.gml#x\"/></gml:MultiSurface>";
    const auto result = importGml(cityGml(
        building("a", "<bldg:lod1MultiSurface>" + circle + "</bldg:lod1MultiSurface>" +
                          "<bldg:lod1Solid>" + solidOf(boxFaces(0, 0)) + "</bldg:lod1Solid>")));
    EXPECT_EQ(countsOf(result), "0 loaded, 1 repaired, 0 skipped");
    EXPECT_EQ(textOf(result, "reference-missing"),
              "a surface or template that is named is not in the file (2 in all): #absent");
    EXPECT_EQ(result.value.city.triangles.size(), 12U);
}

TEST(BadCityGml, OneBadObjectDoesNotCostTheOthers) {
    const std::string bad =
        "<gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>1 2 three</gml:posList>"
        "</gml:LinearRing></gml:exterior></gml:Polygon>";
    const auto result = importGml(cityGml(
        building("bad",
                 "<bldg:lod2MultiSurface>" + multiSurface({bad}) + "</bldg:lod2MultiSurface>") +
        building("good", "<bldg:lod1Solid>" + solidOf(boxFaces(0, 0)) + "</bldg:lod1Solid>") +
        building("good", "<bldg:lod1Solid>" + solidOf(boxFaces(50, 0)) + "</bldg:lod1Solid>")));
    EXPECT_EQ(countsOf(result), "1 loaded, 0 repaired, 2 skipped");
    EXPECT_EQ(textOf(result, "bad-coordinates", "bad"),
              "left out: 1 surface whose coordinates cannot be read (number 3 is none)");
    EXPECT_EQ(textOf(result, "duplicate-id", "good"), "skipped: an earlier object has the same id");
}

}  // namespace reflet
