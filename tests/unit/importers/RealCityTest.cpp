// SPDX-License-Identifier: GPL-3.0-or-later
// Real city models with counts that were established independently (expected.json).
#include "importers/FormatRegistry.h"
#include "tests/support/TestData.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>

namespace reflet {

namespace {

struct RealFile {
    const char* path;
    const char* crs;       ///< horizontal, nullptr = none
    const char* vertical;  ///< nullptr = none
};

constexpr std::array<RealFile, 10> kFiles{{
    {"cityjson/rotterdam-delfshaven/rotterdam-delfshaven.city.json", "EPSG:28992", nullptr},
    {"cityjson/delft-campus.city.json", "EPSG:28992", "EPSG:5709"},
    {"cityjson/delft-terrain.city.json", "EPSG:28992", "EPSG:5709"},
    {"cityjson/zurich.city.json", "EPSG:2056", nullptr},
    {"cityjson/helsinki-multilod.city.json", nullptr, nullptr},
    {"cityjson/trees-templates.city.json", nullptr, nullptr},
    {"cityjsonseq/nl-3dbag-tile.city.jsonl", "EPSG:28992", "EPSG:5709"},
    {"cityjsonseq/delft-3dbag-10.city.jsonl", "EPSG:28992", "EPSG:5709"},
    {"cityjsonseq/montreal-4.city.jsonl", "EPSG:26918", nullptr},
    {"cityjsonseq/bridge-trees-templates.city.jsonl", nullptr, nullptr},
}};

nlohmann::json expectedOf(const std::string& path) {
    std::ifstream stream(*test::sharedData("expected.json"));
    return nlohmann::json::parse(stream).at(path).at("verified");
}

class RealCity : public testing::TestWithParam<RealFile> {
protected:
    void SetUp() override {
        const auto path = test::sharedData(GetParam().path);
        if (!path || !test::sharedData("expected.json"))
            GTEST_SKIP() << test::kNoSharedData;
        m_path = *path;
        m_expected = expectedOf(GetParam().path);
        const auto format = cityFormatOf(m_path);
        ASSERT_TRUE(format) << format.error().message();
        m_format = *format;
    }
    /// Box of everything that is shown, as counted independently.
    [[nodiscard]] Box expectedBox() const {
        Box box;
        for (const char* key : {"bbox", "bbox_of_template_instances"}) {
            if (!m_expected.contains(key) || m_expected[key].is_null())
                continue;
            for (const auto& corner : m_expected[key])
                box.add(
                    {corner[0].get<double>(), corner[1].get<double>(), corner[2].get<double>()});
        }
        return box;
    }
    const CityFormat* m_format = nullptr;
    std::filesystem::path m_path;
    nlohmann::json m_expected;
};

std::set<std::string> lodNames(const nlohmann::json& lods) {
    std::set<std::string> names;
    for (const auto& [name, count] : lods.items()) {
        if (name != "None")
            names.insert(name);
    }
    return names;
}

/// The level that is loaded by default: the highest, which in these files every object has.
std::string lodOfMost(const nlohmann::json& trianglesPerLod) {
    std::string highest;
    for (const auto& [name, count] : trianglesPerLod.items())
        highest = std::max(highest, name);
    return highest;
}

}  // namespace

TEST_P(RealCity, InspectionAgreesWithIndependentCounts) {
    const auto result = m_format->inspect(m_path, {}, {});
    ASSERT_TRUE(result) << result.error().message();
    const SourceSummary& summary = result->value;
    EXPECT_EQ(summary.format, m_expected["fmt"].get<std::string>());
    EXPECT_EQ(summary.version, m_expected["version"].get<std::string>());
    EXPECT_EQ(summary.objects, m_expected["objs"].get<std::size_t>());
    EXPECT_EQ(summary.byType, (m_expected["types"].get<std::map<std::string, std::size_t>>()));
    EXPECT_EQ(std::set<std::string>(summary.lods.begin(), summary.lods.end()),
              lodNames(m_expected["lods"]));
    EXPECT_EQ(summary.surfaces, m_expected.value("surf", std::size_t(0)));
    EXPECT_EQ(summary.triangles, m_expected.value("tri", std::size_t(0)));
    EXPECT_EQ(summary.vertices, m_expected["verts"].get<std::size_t>());
    EXPECT_EQ(summary.instances, m_expected.value("inst", std::size_t(0)));
    if (summary.instances == 0 || m_expected.contains("template_instance_triangles")) {
        EXPECT_EQ(summary.instanceTriangles,
                  m_expected.value("template_instance_triangles", std::size_t(0)));
    }
    EXPECT_EQ(summary.texturesReferenced,
              m_expected.value("texture_files_referenced", std::size_t(0)));
    EXPECT_EQ(summary.texturesResolved, m_expected.value("texture_files_present", std::size_t(0)));
    EXPECT_EQ(summary.crsHorizontal.value_or("-"), GetParam().crs ? GetParam().crs : "-");
    EXPECT_EQ(summary.crsVertical.value_or("-"), GetParam().vertical ? GetParam().vertical : "-");
    if (m_expected["bbox"].is_null()) {
        EXPECT_TRUE(summary.bounds.empty());
        return;
    }
    for (int axis = 0; axis < 3; ++axis) {  // expected to the millimetre
        EXPECT_NEAR(summary.bounds.min[axis], m_expected["bbox"][0][axis].get<double>(), 6e-4);
        EXPECT_NEAR(summary.bounds.max[axis], m_expected["bbox"][1][axis].get<double>(), 6e-4);
    }
}

TEST_P(RealCity, LoadsEveryObjectWithTheTrianglesOfItsHighestLevel) {
    const auto result = m_format->read(m_path, {}, {});
    ASSERT_TRUE(result) << result.error().message();
    const CityModel& city = result->value.city;
    const SourceSummary& summary = result->value.summary;
    EXPECT_EQ(result->counts.skipped, 0U);
    EXPECT_EQ(result->counts.loaded + result->counts.repaired, city.objects.size());
    EXPECT_EQ(city.objects.size(), m_expected["objs"].get<std::size_t>());

    const auto& perLod = m_expected["tri_per_lod"];
    const std::size_t nominal =
        perLod.empty() ? 0 : perLod.at(lodOfMost(perLod)).get<std::size_t>();
    const std::size_t instances = summary.instanceTriangles;
    EXPECT_EQ(instances, m_expected.value("template_instance_triangles", instances));
    EXPECT_EQ(instances > 0, m_expected.value("inst", std::size_t(0)) > 0);
    // Surfaces that vanish are not among the loaded ones; each of them is in the report.
    EXPECT_LE(summary.triangles, nominal);
    EXPECT_GE(summary.triangles, nominal - nominal / 25);
    // Repeated and closing points make no triangles.
    EXPECT_LE(city.triangles.size(), summary.triangles + instances);
    EXPECT_GE(city.triangles.size(), summary.triangles - summary.triangles / 100 + instances);
    if (summary.triangles != nominal || city.triangles.size() != nominal + instances) {
        EXPECT_GT(result->counts.repaired, 0U);
    }
}

TEST_P(RealCity, IsPlacedInAFrameOfWholeKilometres) {
    ImportOptions options;
    options.lod = "all";
    const auto result = m_format->read(m_path, options, {});
    ASSERT_TRUE(result) << result.error().message();
    const CityModel& city = result->value.city;
    EXPECT_EQ(city.frame.crs.value_or("-"), GetParam().crs ? GetParam().crs : "-");
    EXPECT_EQ(city.frame.vertical.value_or("-"), GetParam().vertical ? GetParam().vertical : "-");
    EXPECT_EQ(city.frame.origin.x, 1000.0 * std::round(city.frame.origin.x / 1000.0));
    EXPECT_EQ(city.frame.origin.y, 1000.0 * std::round(city.frame.origin.y / 1000.0));
    EXPECT_EQ(city.frame.origin.z, 0.0);
    const Box box = expectedBox();
    const Box bounds = city.bounds();
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(bounds.min[axis] + city.frame.origin[axis], box.min[axis], 6e-4);
        EXPECT_NEAR(bounds.max[axis] + city.frame.origin[axis], box.max[axis], 6e-4);
    }
}

INSTANTIATE_TEST_SUITE_P(SharedData, RealCity, testing::ValuesIn(kFiles), [](const auto& file) {
    return std::string(1, static_cast<char>('A' + file.index));
});

}  // namespace reflet
