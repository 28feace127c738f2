// SPDX-License-Identifier: GPL-3.0-or-later
// CityJSON text sequences: what they say must be what the same city says as CityJSON.
#include "importers/cityjsonseq/CityJsonSeqImporter.h"
#include "importers/cityjsonseq/LineReader.h"
#include "tests/support/TestData.h"
#include "tests/unit/importers/CityJsonText.h"

namespace reflet {

using namespace test;

namespace {

/// The first line of a sequence in the frame of emptyCity().
json header() {
    return emptyCity();
}

json feature(const std::string& id, json vertices = boxVertices()) {
    return {{"type", "CityJSONFeature"},
            {"id", id},
            {"CityObjects", {{id, object("Building", json::array({solid("2")}))}}},
            {"vertices", std::move(vertices)}};
}

std::string lines(const std::vector<json>& values) {
    std::string text;
    for (const json& value : values)
        text += value.dump() + "\n";
    return text;
}

Imported<CityImport> importLines(const std::string& text, const ImportOptions& options = {}) {
    auto result = importCityJsonSeqText(text, "city.city.jsonl", options, {});
    if (!result) {
        ADD_FAILURE() << result.error().message();
        return {};
    }
    return *std::move(result);
}

/// `count` boxes in a row, 20 m apart; each feature is padded to some hundred bytes.
std::string row(int count, std::size_t padding) {
    std::string text = header().dump() + "\n";
    for (int i = 0; i < count; ++i) {
        json box = feature("b" + std::to_string(i), boxVertices(i * 20000));
        box["note"] = std::string(padding, 'x');
        text += box.dump() + "\n";
    }
    return text;
}

}  // namespace

TEST(CityJsonSeq, SaysWhatTheSameCitySaysAsCityJson) {
    json whole = boxCity();
    for (const json& corner : boxVertices(20000))
        whole["vertices"].push_back(corner);
    whole["CityObjects"]["b"] = object("Building", json::array({solid("2", boxShell(8))}));
    const auto single = import(whole);
    const auto sequence =
        importLines(lines({header(), feature("a"), feature("b", boxVertices(20000))}));
    EXPECT_EQ(sequence.value.city.frame.origin, single.value.city.frame.origin);
    EXPECT_EQ(sequence.value.city.vertices, single.value.city.vertices);
    ASSERT_EQ(sequence.value.city.triangles.size(), single.value.city.triangles.size());
    for (std::size_t t = 0; t < single.value.city.triangles.size(); ++t)
        EXPECT_EQ(sequence.value.city.triangles[t].vertex, single.value.city.triangles[t].vertex);
    EXPECT_EQ(sequence.value.summary.format, "CityJSONSeq");
    EXPECT_EQ(sequence.value.summary.byType, single.value.summary.byType);
    EXPECT_EQ(countsOf(sequence), "2 loaded, 0 repaired, 0 skipped");
}

TEST(CityJsonSeq, FeaturesBeyondOneBatchAreAllLoadedIntoOneFrame) {
    const auto result = importLines(row(1500, 8000));  // 12 MB
    EXPECT_EQ(countsOf(result), "1500 loaded, 0 repaired, 0 skipped");
    const CityModel& city = result.value.city;
    EXPECT_EQ(city.triangles.size(), 1500U * 12U);
    EXPECT_NEAR(enclosedVolume(city), 1500 * 480.0, 1.0);
    // The middle of the row, not of its first batch, makes the frame: 85 000 + 15 000.
    EXPECT_EQ(city.frame.origin.x, 100000.0);
    EXPECT_NEAR(city.bounds().max.x + city.frame.origin.x, 85000.0 + 1499 * 20.0 + 10.0, 1e-3);
    EXPECT_EQ(result.value.summary.surfaces, 1500U * 6U);
}

TEST(CityJsonSeq, ALineThatCannotBeReadCostsItsFeatureAlone) {
    const std::string text = lines({header(), feature("a")}) +
                             "{\"type\": \"CityJSONFeature\", oops\n" +
                             lines({json{{"type", "Feature"}}, feature("b", boxVertices(20000))});
    const auto result = importLines(text);
    EXPECT_EQ(countsOf(result), "2 loaded, 0 repaired, 2 skipped");
    std::vector<std::string> told;
    for (const Diagnostic& diagnostic : result.diagnostics) {
        if (diagnostic.code == "line-unreadable")
            told.push_back(diagnostic.text);
    }
    ASSERT_EQ(told.size(), 2U);
    EXPECT_EQ(told[0].substr(0, 43), "skipped: is no valid JSON at line 3, column");
    EXPECT_EQ(told[1], "skipped: is no CityJSONFeature: its \"type\" is \"Feature\" (line 4)");
}

TEST(CityJsonSeq, AFeatureMayHaveATransformOfItsOwn) {
    json finer = feature("b", boxVertices(20000));
    finer["transform"] = {{"scale", {0.0005, 0.0005, 0.0005}},
                          {"translate", {85000.0, 446000.0, 0.0}}};
    const auto result =
        importLines(lines({header(), feature("a"), finer, feature("c", boxVertices(40000))}));
    EXPECT_EQ(countsOf(result), "3 loaded, 0 repaired, 0 skipped");
    EXPECT_NEAR(enclosedVolume(result.value.city), 480.0 + 480.0 / 8.0 + 480.0, 1e-2);
}

TEST(CityJsonSeq, EachFeatureHasItsOwnAppearance) {
    std::vector<json> all{header()};
    for (const char* colour : {"a", "b"}) {
        json part = feature(colour);
        part["appearance"] = {
            {"materials", json::array({{{"name", colour}, {"diffuseColor", {1, 0, 0}}}})}};
        part["CityObjects"][colour]["geometry"][0]["material"] = {{"look", {{"value", 0}}}};
        all.push_back(part);
    }
    const auto result = importLines(lines(all));
    const CityModel& city = result.value.city;
    ASSERT_EQ(city.materials.size(), 2U);
    for (const CitySurface& surface : city.surfaces)
        EXPECT_EQ(city.materials.at(surface.material).name, city.objects[surface.object].id);
}

TEST(CityJsonSeq, WithoutAFirstLineOfItsKindNothingCanBePlaced) {
    const auto errorOf = [](const std::string& text) {
        const auto result = importCityJsonSeqText(text, "city.city.jsonl", {}, {});
        return result ? std::string("loaded") : result.error().what;
    };
    EXPECT_EQ(errorOf(lines({feature("a")})),
              "begins with a feature; the line with the transform is missing before it (line 1)");
    EXPECT_EQ(errorOf(" \n\n"), "is empty");
    json old = header();
    old["version"] = "0.9";
    EXPECT_EQ(errorOf(lines({old, feature("a")})),
              "is CityJSON of version \"0.9\", which is unknown (line 1)");
}

TEST(CityJsonSeq, BadFilesOfTheSharedDataAreAccountedFor) {
    const auto unclosed = sharedData("bad/cityjsonseq/unclosed-bracket.city.jsonl");
    const auto twice = sharedData("bad/cityjsonseq/duplicate-feature-ids.city.jsonl");
    if (!unclosed || !twice)
        GTEST_SKIP() << kNoSharedData;
    const auto broken = importCityJsonSeq(*unclosed, {}, {});
    ASSERT_FALSE(broken);
    EXPECT_EQ(broken.error().code, ErrorCode::Unreadable);
    EXPECT_EQ(broken.error().what.substr(0, 34), "is no valid JSON at line 1, column");
    EXPECT_EQ(broken.error().subject, unclosed->string());
    const auto result = importCityJsonSeq(*twice, {}, {});
    ASSERT_TRUE(result) << result.error().message();
    EXPECT_EQ(countsOf(*result), "1 loaded, 0 repaired, 2 skipped");
    EXPECT_EQ(textOf(*result, "duplicate-id"), "skipped: an earlier object has the same id");
}

TEST(CityJsonSeq, LinesAreSplitWhateverTheyEndWith) {
    const auto source = importers::openBytes("\xef\xbb\xbf{1}\r\n\x1e{2}\n\n  {3} \n{4}");
    cityjsonseq::LineReader reader(*source);
    std::string line;
    std::vector<std::pair<std::string, std::size_t>> read;
    while (reader.next(line).value_or(false))
        read.emplace_back(line, reader.number());
    EXPECT_EQ(read, (std::vector<std::pair<std::string, std::size_t>>{
                        {"{1}", 1}, {"{2}", 2}, {"{3}", 4}, {"{4}", 5}}));
}

}  // namespace reflet
