// SPDX-License-Identifier: GPL-3.0-or-later
// Where CityGML lies: reference systems, the order of axes, encodings of the text.
#include "importers/FormatRegistry.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/unit/importers/CityGmlText.h"
#include "tests/unit/importers/CityJsonText.h"

#include <fstream>

namespace reflet {

using namespace test;

namespace {

std::string squareAt(double first, double second, double size, const std::string& srsName,
                     const std::string& more = {}) {
    const std::vector<Corner> ring{{first, second, 5},
                                   {first + size, second, 5},
                                   {first + size, second + size, 5},
                                   {first, second + size, 5}};
    return cityGml(building("a", "<bldg:lod2MultiSurface>" + multiSurface({polygon(ring)}) +
                                     "</bldg:lod2MultiSurface>") +
                       more,
                   srsName);
}

glm::dvec3 middleOf(const CityModel& city) {
    return city.bounds().center() + city.frame.origin;
}

std::string utf16(std::string_view ascii, bool bigEndian, bool mark) {
    std::string text = mark ? (bigEndian ? "\xfe\xff" : "\xff\xfe") : "";
    for (const char c : ascii) {
        text += bigEndian ? '\0' : c;
        text += bigEndian ? c : '\0';
    }
    return text;
}

}  // namespace

TEST(CityGmlPlace, TheAuthorityOfTheCrsSaysWhichAxisComesFirst) {
    // Vienna in EPSG:31256: north comes first, and its name in either form says so.
    for (const char* name : {"urn:ogc:def:crs:EPSG::31256", "EPSG:31256",
                             "http://www.opengis.net/def/crs/EPSG/0/31256"}) {
        const auto result = importGml(squareAt(341000, 2500, 100, name));
        const glm::dvec3 middle = middleOf(result.value.city);
        EXPECT_NEAR(middle.x, 2550.0, 0.01) << name;
        EXPECT_NEAR(middle.y, 341050.0, 0.01) << name;
        EXPECT_EQ(findDiagnostic(result, "outside-area-of-use"), nullptr) << name;
    }
}

TEST(CityGmlPlace, CoordinatesThatFitTheOtherOrderOnlyAreReadInIt) {
    const auto result = importGml(squareAt(2500, 341000, 100, "EPSG:31256"));
    EXPECT_NEAR(middleOf(result.value.city).x, 2550.0, 0.01);
    EXPECT_NEAR(middleOf(result.value.city).y, 341050.0, 0.01);
    EXPECT_EQ(textOf(result, "axis-order"),
              "the coordinates have east first and were read that way");
    const auto lonLat = importGml(squareAt(139.7, 35.26, 0.001, "EPSG:6697"));
    EXPECT_EQ(textOf(lonLat, "axis-order"),
              "the coordinates have the longitude first and were read that way");
}

TEST(CityGmlPlace, GermanNamesAndCompoundSystemsAreUnderstood) {
    const auto result =
        importGml(squareAt(500000, 5700000, 100, "urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH"));
    EXPECT_EQ(result.value.summary.crsHorizontal.value_or(""), "EPSG:25832");
    EXPECT_EQ(result.value.summary.crsVertical.value_or(""), "EPSG:7837");
    EXPECT_NEAR(middleOf(result.value.city).x, 500050.0, 0.01);
}

TEST(CityGmlPlace, AReferenceSystemOfAGeometryCountsWhenTheFileHasNone) {
    std::string text = squareAt(500000, 5700000, 100, "");
    text.replace(text.find("<gml:MultiSurface>"), 18, "<gml:MultiSurface srsName=\"EPSG:25832\">");
    EXPECT_EQ(importGml(text).value.summary.crsHorizontal.value_or(""), "EPSG:25832");
    std::string mixed = squareAt(500000, 5700000, 100, "EPSG:25833");
    mixed.replace(mixed.find("<gml:MultiSurface>"), 18,
                  "<gml:MultiSurface srsName=\"EPSG:25832\">");
    EXPECT_NE(findDiagnostic(importGml(mixed), "crs-mixed"), nullptr);
}

TEST(CityGmlPlace, AllEncodingsGiveTheSameCity) {
    const std::string city = squareAt(500000, 5700000, 100, "EPSG:25832");
    const std::string withoutDeclaration = city.substr(city.find('\n') + 1);
    const auto plain = importGml(city);
    const std::vector<std::string> others{
        "\xef\xbb\xbf" + city,
        utf16(city, false, true),
        utf16(city, true, true),
        utf16(city, false, false),
        utf16(withoutDeclaration, true, false),
        "<?xml version='1.0' encoding='ISO-8859-1'?>" + withoutDeclaration};
    for (const std::string& text : others) {
        const auto result = importGml(text);
        EXPECT_EQ(result.value.city.vertices, plain.value.city.vertices);
    }
    std::string umlaut = "<?xml version='1.0' encoding='iso-8859-1'?>" + withoutDeclaration;
    umlaut.replace(umlaut.find("gml:id=\"a\""), 10, "gml:id=\"B\xe4r\"");
    EXPECT_EQ(importGml(umlaut).value.city.objects.at(0).id, "B\xc3\xa4r");
    EXPECT_EQ(gmlError("<?xml version='1.0' encoding='EBCDIC-US'?>" + withoutDeclaration).what,
              "is written in the encoding \"EBCDIC-US\", which is not known");
}

TEST(CityGmlPlace, TheRegistryKnowsItByItsContent) {
    const TemporaryFolder folder;
    const std::string city = squareAt(500000, 5700000, 100, "EPSG:25832");
    for (const auto& [name, text] : {std::pair("a.gml", city), std::pair("b.txt", city),
                                     std::pair("c.xml", utf16(city, false, true))}) {
        const auto path = folder.path() / name;
        std::ofstream(path, std::ios::binary) << text;
        const auto format = cityFormatOf(path);
        ASSERT_TRUE(format) << name;
        EXPECT_EQ((*format)->name, "CityGML");
    }
}

}  // namespace reflet
