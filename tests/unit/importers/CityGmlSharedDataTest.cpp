// SPDX-License-Identifier: GPL-3.0-or-later
// Real CityGML with counts that were established independently (expected.json).
#include "importers/FormatRegistry.h"
#include "tests/support/TestData.h"
#include "tests/unit/importers/CityJsonText.h"

#include <fstream>
#include <map>
#include <set>

namespace reflet {

using namespace test;

namespace {

struct RealGml {
    const char* path;
    const char* version;
    const char* crs;        ///< nullptr = none
    bool latitudeFirst;     ///< in the file
    std::size_t triangles;  ///< nominal, of the highest level of each object; 0 = of all there are
};

constexpr std::array<RealGml, 9> kGml{{
    {"citygml/berlin-citygml1.gml", "1.0", "EPSG:25833", false, 0},
    {"citygml/yokosuka/yokosuka-bldg.gml", "2.0", "EPSG:6668", true, 1},
    {"citygml/yokosuka/yokosuka-dem.gml", "2.0", "EPSG:6668", true, 0},
    {"citygml/lyon-house/lyon-house-1.gml", "2.0", nullptr, false, 0},
    {"citygml/ingolstadt-lod3/4018193/4018193.gml", "2.0", "EPSG:32632", false, 0},
    {"citygml/ingolstadt-lod3/4018205/4018205.gml", "2.0", "EPSG:32632", false, 0},
    {"citygml/ingolstadt-lod3/4018209/4018209.gml", "2.0", "EPSG:32632", false, 0},
    {"citygml/ingolstadt-lod3/4018211/4018211.gml", "2.0", "EPSG:32632", false, 0},
    {"citygml/ingolstadt-lod3/4018106/4018106.gml", "2.0", "EPSG:32632", false, 0},
}};

class RealCityGml : public testing::TestWithParam<RealGml> {
protected:
    void SetUp() override {
        const auto path = sharedData(GetParam().path);
        if (!path || !sharedData("expected.json"))
            GTEST_SKIP() << kNoSharedData;
        m_path = *path;
        std::ifstream stream(*sharedData("expected.json"));
        m_expected = json::parse(stream).at(GetParam().path).at("verified");
        const auto format = cityFormatOf(m_path);
        ASSERT_TRUE(format) << format.error().message();
        m_format = *format;
    }
    std::filesystem::path m_path;
    json m_expected;
    const CityFormat* m_format = nullptr;
};

std::size_t sumOf(const json& counts) {
    std::size_t sum = 0;
    for (const auto& count : counts)
        sum += count.get<std::size_t>();
    return sum;
}

}  // namespace

TEST_P(RealCityGml, InspectionAgreesWithIndependentCounts) {
    const auto result = m_format->inspect(m_path, {}, {});
    ASSERT_TRUE(result) << result.error().message();
    const SourceSummary& summary = result->value;
    EXPECT_EQ(summary.format, "CityGML");
    EXPECT_EQ(summary.version, GetParam().version);
    EXPECT_EQ(summary.byType, (m_expected["features"].get<std::map<std::string, std::size_t>>()));
    EXPECT_EQ(summary.objects, sumOf(m_expected["features"]));
    EXPECT_EQ(summary.surfaces, m_expected["polygons"].get<std::size_t>());
    EXPECT_EQ(summary.triangles, m_expected["tri"].get<std::size_t>());
    std::set<std::string> lods;
    if (m_expected.contains("lod_elements")) {
        for (const auto& [lod, count] : m_expected["lod_elements"].items())
            lods.insert(lod);
    }
    EXPECT_EQ(std::set<std::string>(summary.lods.begin(), summary.lods.end()), lods);
    EXPECT_EQ(summary.texturesReferenced,
              m_expected.value("texture_files_referenced", std::size_t(0)));
    EXPECT_EQ(summary.texturesResolved, m_expected.value("texture_files_present", std::size_t(0)));
    EXPECT_EQ(summary.crsHorizontal.value_or("-"), GetParam().crs ? GetParam().crs : "-");
    EXPECT_EQ(result->counts.loaded + result->counts.repaired + result->counts.skipped,
              summary.objects);
    EXPECT_EQ(result->counts.skipped, 0U);
    for (int axis = 0; axis < 3; ++axis) {
        const int written = GetParam().latitudeFirst && axis < 2 ? 1 - axis : axis;
        const auto& box = m_expected["bbox_file_axis_order"];
        EXPECT_NEAR(summary.bounds.min[axis], box[0][written].get<double>(), 1e-6);
        EXPECT_NEAR(summary.bounds.max[axis], box[1][written].get<double>(), 1e-6);
    }
}

TEST_P(RealCityGml, LoadsEveryObject) {
    const auto result = m_format->read(m_path, {}, {});
    ASSERT_TRUE(result) << result.error().message();
    const CityModel& city = result->value.city;
    const SourceSummary& summary = result->value.summary;
    EXPECT_EQ(result->counts.skipped, 0U);
    EXPECT_EQ(city.objects.size(), sumOf(m_expected["features"]));
    EXPECT_EQ(summary.texturesResolved, summary.texturesReferenced);
    if (GetParam().triangles == 0) {  // one level: all there is is shown
        const auto nominal = m_expected["tri"].get<std::size_t>();
        EXPECT_LE(summary.triangles, nominal);
        EXPECT_GE(summary.triangles, nominal - nominal / 50);
    }
    EXPECT_LE(city.triangles.size(), summary.triangles);
    EXPECT_GE(city.triangles.size(), summary.triangles - summary.triangles / 50);
    // Some metres, not degrees: a city has a size, whatever its coordinates are in.
    const glm::dvec3 size = city.bounds().size();
    EXPECT_GT(size.x, 5.0);
    EXPECT_LT(size.x, 2000.0);
    EXPECT_GT(size.z, 1.0);
}

INSTANTIATE_TEST_SUITE_P(SharedData, RealCityGml, testing::ValuesIn(kGml), [](const auto& file) {
    return std::string(1, static_cast<char>('A' + file.index));
});

TEST(RealCityGmlLevels, OfYokosukaTheHighestOfEachBuildingIsShown) {
    const auto path = sharedData("citygml/yokosuka/yokosuka-bldg.gml");
    if (!path)
        GTEST_SKIP() << kNoSharedData;
    const auto result = (*cityFormatOf(*path))->read(*path, {}, {});
    ASSERT_TRUE(result) << result.error().message();
    std::map<std::string, std::size_t> levels;
    for (const CityObject& object : result->value.city.objects)
        ++levels[object.lod];
    // Nine boundary surfaces and the two buildings and the part that they bound are of level 2.
    EXPECT_EQ(levels["0"], 0U);
    EXPECT_GT(levels["1"], 0U);
    EXPECT_GE(levels["2"], 9U);
    EXPECT_EQ(result->value.city.frame.crs.value_or("-"), "EPSG:32654");
}

}  // namespace reflet
