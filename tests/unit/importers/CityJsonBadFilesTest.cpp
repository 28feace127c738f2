// SPDX-License-Identifier: GPL-3.0-or-later
// The malformed files of the shared data: what exactly becomes of each of them.
#include "tests/support/TestData.h"
#include "tests/unit/importers/CityJsonText.h"

#include <set>

namespace reflet {

using namespace test;

namespace {

struct BadFile {
    const char* path;
    const char* what;  ///< of the Unreadable error
};

constexpr std::array<BadFile, 11> kUnreadable{{
    {"bad/cityjson/completely-empty.city.json", "is empty"},
    {"bad/cityjson/invalid-json-syntax.city.json",
     "is no valid JSON at line 3, column 11: unexpected ':'; expected '}'"},
    {"bad/cityjson/truncated-end.city.json",
     "is no valid JSON at line 1934, column 1: unexpected '}'; expected ']'"},
    {"bad/cityjson/missing-type.city.json", "is no CityJSON: \"type\" is missing at its root"},
    {"bad/cityjson/two-buildings-city-objects-key.city.json",
     "has no \"CityObjects\"; \"City Objects\" stands in its place"},
    {"bad/json/n-number-nan.json", "is no valid JSON at line 1, column 2: "},
    {"bad/json/n-object-trailing-comma.json", "is no valid JSON at line 1, column 9: "},
    {"bad/json/n-string-unescaped-newline.json", "is no valid JSON at line 1, column 6: "},
    {"bad/json/n-structure-100000-opening-arrays.json",
     "is no valid JSON at line 1, column 100001: "},
    {"bad/json/n-structure-lone-invalid-utf-8.json", "is no valid JSON at line 1, column 1: "},
    {"bad/json/n-structure-object-with-trailing-garbage.json",
     "is no valid JSON at line 1, column 15: "},
}};

class UnreadableFile : public testing::TestWithParam<BadFile> {};

struct OddFile {
    const char* path;
    const char* counts;
    std::size_t triangles;
    const char* diagnostic;  ///< beside "no-crs"; nullptr = none
    const char* text;
};

constexpr std::array<OddFile, 7> kOdd{{
    {"bad/cityjson/vertex-index-out-of-range-1.city.json", "0 loaded, 1 repaired, 0 skipped", 3,
     "index-out-of-range",
     "left out: 1 surface with a vertex that does not exist (index 22, counted from 0, of 4)"},
    {"bad/cityjson/overlapping-solids.city.json", "1 loaded, 0 repaired, 0 skipped", 36, nullptr,
     ""},
    {"bad/cityjson/overlapping-buildingparts.city.json", "3 loaded, 0 repaired, 0 skipped", 24,
     nullptr, ""},
    {"bad/cityjson/several-lods-invalid.city.json", "2 loaded, 0 repaired, 0 skipped", 190, nullptr,
     ""},
    {"bad/cityjson/empty-primitive.city.json", "0 loaded, 1 repaired, 0 skipped", 12,
     "empty-geometry", "a solid, shell or geometry has no surface (1 in all)"},
    {"bad/cityjson/texture-index-overflow-1.city.json", "0 loaded, 1 repaired, 0 skipped", 88,
     "texture-index-out-of-range",
     "loaded without texture: 2 surfaces (texture 1, counted from 0, of 1)"},
    {"bad/cityjson/material-index-overflow-1.city.json", "0 loaded, 1 repaired, 0 skipped", 12,
     "material-index-out-of-range",
     "loaded without material: 1 surface (theme main2: material 2, counted from 0, of 2)"},
}};

class OddCity : public testing::TestWithParam<OddFile> {};

}  // namespace

TEST_P(UnreadableFile, SaysWhatIsWrongWhere) {
    const auto path = sharedData(GetParam().path);
    if (!path)
        GTEST_SKIP() << kNoSharedData;
    const auto imported = importCityJson(*path, {}, {});
    const auto inspected = inspectCityJson(*path, {}, {});
    ASSERT_FALSE(imported);
    ASSERT_FALSE(inspected);
    EXPECT_EQ(imported.error().code, ErrorCode::Unreadable);
    EXPECT_EQ(imported.error().what.substr(0, std::string_view(GetParam().what).size()),
              GetParam().what);
    EXPECT_EQ(imported.error().subject, path->string());
    EXPECT_FALSE(imported.error().remedy.empty());
    EXPECT_EQ(inspected.error().what, imported.error().what);
}

INSTANTIATE_TEST_SUITE_P(SharedData, UnreadableFile, testing::ValuesIn(kUnreadable));

TEST_P(OddCity, IsLoadedWithAnAccountOfItsObjects) {
    const auto path = sharedData(GetParam().path);
    if (!path)
        GTEST_SKIP() << kNoSharedData;
    const auto result = importCityJson(*path, {}, {});
    ASSERT_TRUE(result) << result.error().message();
    EXPECT_EQ(countsOf(*result), GetParam().counts);
    EXPECT_EQ(result->value.city.triangles.size(), GetParam().triangles);
    std::set<std::string> codes;
    for (const Diagnostic& diagnostic : result->diagnostics)
        codes.insert(diagnostic.code);
    for (const char* expected : {"no-crs", "texture-missing", "not-planar"})
        codes.erase(expected);
    if (GetParam().diagnostic == nullptr) {
        EXPECT_TRUE(codes.empty()) << *codes.begin();
    } else {
        EXPECT_EQ(codes, std::set<std::string>{GetParam().diagnostic});
        EXPECT_EQ(textOf(*result, GetParam().diagnostic), GetParam().text);
    }
}

INSTANTIATE_TEST_SUITE_P(SharedData, OddCity, testing::ValuesIn(kOdd));

TEST(BadCityJson, EveryFileOfTheSharedDataIsCovered) {
    const auto folder = sharedData("bad/cityjson");
    if (!folder)
        GTEST_SKIP() << kNoSharedData;
    std::set<std::string> covered;
    for (const BadFile& file : kUnreadable)
        covered.insert(std::filesystem::path(file.path).filename().string());
    for (const OddFile& file : kOdd)
        covered.insert(std::filesystem::path(file.path).filename().string());
    for (const char* name : {"bad/cityjson", "bad/json"}) {
        for (const auto& entry : std::filesystem::directory_iterator(*sharedData(name)))
            EXPECT_TRUE(covered.contains(entry.path().filename().string())) << entry.path();
    }
}

}  // namespace reflet
