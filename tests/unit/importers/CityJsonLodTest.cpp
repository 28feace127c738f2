// SPDX-License-Identifier: GPL-3.0-or-later
// Which level of detail of an object is loaded. Levels are told apart by the height of a roof.
#include "tests/unit/importers/CityJsonText.h"

namespace reflet {

using namespace test;

namespace {

/// A square at as many metres as the level's name says, tenfold: "2.2" lies at 22 m.
json level(const std::string& lod) {
    const int z = static_cast<int>(std::lround(10.0 * std::stod(lod)));
    json geometry = surfaces(lod, {{{4 * z, 4 * z + 1, 4 * z + 2, 4 * z + 3}}});
    return geometry;
}

json cityOfLevels() {
    json city = emptyCity();
    for (int z = 0; z <= 40; ++z) {
        for (const auto& [x, y] :
             {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)})
            city["vertices"].push_back({1000 * x, 1000 * y, 1000 * z});
    }
    return city;
}

json levels(std::initializer_list<const char*> lods) {
    json geometries = json::array();
    for (const char* lod : lods)
        geometries.push_back(level(lod));
    return geometries;
}

/// Heights of all surfaces that were loaded of an object, ascending.
std::vector<int> heightsOf(const CityModel& city, const std::string& id) {
    std::vector<int> heights;
    std::uint32_t last = kNone;
    for (const CityTriangle& triangle : city.triangles) {
        if (city.objects[city.surfaces[triangle.surface].object].id != id ||
            triangle.surface == last)
            continue;
        last = triangle.surface;
        heights.push_back(static_cast<int>(std::lround(city.vertices[triangle.vertex[0]].z)));
    }
    std::sort(heights.begin(), heights.end());
    return heights;
}

using Heights = std::vector<int>;

ImportOptions withLod(const std::string& lod) {
    ImportOptions options;
    options.lod = lod;
    return options;
}

}  // namespace

TEST(CityJsonLod, HighestOfEachObjectIsLoadedByDefault) {
    json city = cityOfLevels();
    city["CityObjects"]["a"] = object("Building", levels({"1.2", "2.2", "1.3", "0"}));
    city["CityObjects"]["b"] = object("Building", levels({"0", "1"}));
    city["CityObjects"]["c"] = object("Road", levels({"2"}));
    const auto result = import(city);
    EXPECT_EQ(heightsOf(result.value.city, "a"), Heights{22});
    EXPECT_EQ(heightsOf(result.value.city, "b"), Heights{10});
    EXPECT_EQ(heightsOf(result.value.city, "c"), Heights{20});
    EXPECT_EQ(result.value.city.objects[0].lod, "2.2");
    EXPECT_EQ(result.value.summary.lods, (std::vector<std::string>{"1", "2", "2.2"}));
    EXPECT_EQ(countsOf(result), "3 loaded, 0 repaired, 0 skipped");
}

TEST(CityJsonLod, NumbersAndNullAreUnderstood) {
    json city = cityOfLevels();
    city["version"] = "1.0";
    json geometries = levels({"1", "2.1", "0"});
    geometries[0]["lod"] = 1.0;
    geometries[1]["lod"] = 2.1;
    geometries[2]["lod"] = nullptr;
    city["CityObjects"]["a"] = object("Building", geometries);
    auto result = import(city);
    EXPECT_EQ(heightsOf(result.value.city, "a"), Heights{21});
    EXPECT_EQ(result.value.city.objects[0].lod, "2.1");
    result = import(city, withLod("1"));
    EXPECT_EQ(heightsOf(result.value.city, "a"), Heights{10});
    EXPECT_EQ(result.value.city.objects[0].lod, "1");
    geometries.erase(1);
    geometries.erase(0);
    city["CityObjects"]["a"] = object("Building", geometries);  // null alone
    result = import(city);
    EXPECT_EQ(heightsOf(result.value.city, "a"), Heights{0});
    EXPECT_EQ(result.value.city.objects[0].lod, "");
}

TEST(CityJsonLod, NullAndOddNamesComeBelowEveryNumber) {
    json city = cityOfLevels();
    json geometries = levels({"3", "0", "2"});
    geometries[0].erase("lod");
    geometries[2]["lod"] = "LoD3";
    city["CityObjects"]["a"] = object("Building", geometries);
    EXPECT_EQ(heightsOf(import(city).value.city, "a"), Heights{0});
}

TEST(CityJsonLod, TenIsMoreThanTwo) {
    json city = cityOfLevels();
    json geometries = levels({"2", "3"});
    geometries[0]["lod"] = "10.0";
    geometries[1]["lod"] = "9.9";
    city["CityObjects"]["a"] = object("Building", geometries);
    EXPECT_EQ(heightsOf(import(city).value.city, "a"), Heights{20});
}

TEST(CityJsonLod, SeveralGeometriesOfTheSameLevelBelongTogether) {
    json city = cityOfLevels();
    json geometries = levels({"1", "2", "3"});
    geometries[2]["lod"] = "2";
    city["CityObjects"]["a"] = object("Building", geometries);
    EXPECT_EQ(heightsOf(import(city).value.city, "a"), (Heights{20, 30}));
}

TEST(CityJsonLod, LowLevelOfABuildingGivesWayToItsParts) {
    json city = cityOfLevels();
    city["CityObjects"]["house"] = object("Building", levels({"0"}));
    city["CityObjects"]["house"]["children"] = {"part"};
    city["CityObjects"]["part"] = object("BuildingPart", levels({"1.2", "1.3", "2.2"}));
    city["CityObjects"]["part"]["parents"] = {"house"};
    const auto result = import(city);
    EXPECT_EQ(heightsOf(result.value.city, "house"), Heights{});
    EXPECT_EQ(heightsOf(result.value.city, "part"), Heights{22});
    EXPECT_EQ(countsOf(result), "2 loaded, 0 repaired, 0 skipped");
    EXPECT_TRUE(result.diagnostics.empty());
    EXPECT_EQ(heightsOf(import(city, withLod("0")).value.city, "house"), Heights{0});
}

TEST(CityJsonLod, PartsOfPartsSpeakForTheWholeToo) {
    json city = cityOfLevels();
    city["CityObjects"]["inner"] = object("BuildingPart", levels({"3"}));
    city["CityObjects"]["inner"]["parents"] = {"part"};
    city["CityObjects"]["part"] = object("BuildingPart", levels({"1"}));
    city["CityObjects"]["part"]["parents"] = {"house"};
    city["CityObjects"]["house"] = object("Building", levels({"2"}));
    const auto result = import(city);
    EXPECT_EQ(heightsOf(result.value.city, "inner"), Heights{30});
    EXPECT_EQ(heightsOf(result.value.city, "part"), Heights{});
    EXPECT_EQ(heightsOf(result.value.city, "house"), Heights{});
}

TEST(CityJsonLod, EqualLevelsOfWholeAndPartAreBothLoaded) {
    json city = cityOfLevels();
    city["CityObjects"]["house"] = object("Building", levels({"2"}));
    city["CityObjects"]["part"] = object("BuildingPart", levels({"2"}));
    city["CityObjects"]["part"]["parents"] = {"house"};
    const auto result = import(city);
    EXPECT_EQ(heightsOf(result.value.city, "house"), Heights{20});
    EXPECT_EQ(heightsOf(result.value.city, "part"), Heights{20});
}

TEST(CityJsonLod, BalconyOfAHigherLevelDoesNotCostTheBuilding) {
    json city = cityOfLevels();
    city["CityObjects"]["house"] = object("Building", levels({"2"}));
    city["CityObjects"]["balcony"] = object("BuildingInstallation", levels({"3"}));
    city["CityObjects"]["balcony"]["parents"] = {"house"};
    const auto result = import(city);
    EXPECT_EQ(heightsOf(result.value.city, "house"), Heights{20});
    EXPECT_EQ(heightsOf(result.value.city, "balcony"), Heights{30});
}

TEST(CityJsonLod, PointsOfAHigherLevelDoNotHideSurfaces) {
    json city = cityOfLevels();
    json geometries = levels({"1"});
    geometries.push_back({{"type", "MultiPoint"}, {"lod", "3"}, {"boundaries", {0}}});
    city["CityObjects"]["a"] = object("Building", geometries);
    const auto result = import(city);
    EXPECT_EQ(heightsOf(result.value.city, "a"), Heights{10});
    EXPECT_TRUE(result.diagnostics.empty());
}

TEST(CityJsonLod, GivenValueLoadsThatLevelAlone) {
    json city = cityOfLevels();
    city["CityObjects"]["a"] = object("Building", levels({"1.2", "2.2", "1.3"}));
    city["CityObjects"]["b"] = object("Building", levels({"2"}));
    auto result = import(city, withLod("1.2"));
    EXPECT_EQ(heightsOf(result.value.city, "a"), Heights{12});
    EXPECT_EQ(result.value.city.objects.size(), 1U);
    EXPECT_EQ(textOf(result, "filtered-by-lod"),
              "1 objects have nothing at level of detail 1.2 and were left out");
    EXPECT_EQ(countsOf(result), "1 loaded, 0 repaired, 0 skipped");

    result = import(city, withLod("1"));  // the finest of the ones
    EXPECT_EQ(heightsOf(result.value.city, "a"), Heights{13});
    result = import(city, withLod("2.0"));
    EXPECT_EQ(heightsOf(result.value.city, "b"), Heights{20});
    EXPECT_EQ(heightsOf(result.value.city, "a"), Heights{});
}

TEST(CityJsonLod, ThatNoObjectHasIsAUsageErrorWhichNamesThoseThatAreThere) {
    json city = cityOfLevels();
    city["CityObjects"]["a"] = object("Building", levels({"2.2", "1.2"}));
    const Error error = importError(city.dump(), withLod("3"));
    EXPECT_EQ(error.code, ErrorCode::Usage);
    EXPECT_EQ(error.what, "has no geometry of level of detail 3");
    EXPECT_EQ(error.remedy, "It has: 1.2, 2.2.");
    EXPECT_EQ(importError(city.dump(), withLod("x")).code, ErrorCode::Usage);
}

TEST(CityJsonLod, AllLoadsEveryLevelForInspection) {
    json city = cityOfLevels();
    city["CityObjects"]["a"] = object("Building", levels({"1.2", "2.2", "1.3"}));
    EXPECT_EQ(heightsOf(import(city, withLod("all")).value.city, "a"), (Heights{12, 13, 22}));
}

}  // namespace reflet
