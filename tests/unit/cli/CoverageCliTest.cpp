// SPDX-License-Identifier: GPL-3.0-or-later
// probes, coverage, suggest and bench suggest on a street of twelve houses.
#include "core/io/ImageText.h"
#include "tests/support/Program.h"
#include "tests/support/StreetCity.h"
#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>

namespace reflet {
namespace {

using nlohmann::json;
using test::ProgramResult;

ProgramResult cli(const std::string& arguments) {
    return test::runProgram(std::string("'") + REFLET_CLI + "' " + arguments);
}

json jsonOf(const ProgramResult& result) {
    json parsed = json::parse(result.output, nullptr, false);
    EXPECT_FALSE(parsed.is_discarded()) << result.output << result.errors;
    return parsed;
}

/// A street with a car on it, and no probe.
class CoverageCli : public testing::Test {
protected:
    void SetUp() override {
        test::StreetCity street;
        folder.write("street.city.json", street.cityJson());
        folder.write("route.geojson", street.routeGeoJson());
        const auto imported = cli("import " + path("street.city.json") + " -o " + project() +
                                  " --routes " + path("route.geojson") + " --vehicle car --quiet");
        ASSERT_EQ(imported.exitCode, 0) << imported.errors;
        const auto edited = cli("edit " + project() +
                                " --set bake.resolution=32 --set tuning.resolution=32 --quiet");
        ASSERT_EQ(edited.exitCode, 0) << edited.errors;
    }
    [[nodiscard]] std::string path(const std::string& name) const {
        return "'" + (folder / name).string() + "'";
    }
    [[nodiscard]] std::string project() const { return path("street.reflet"); }
    [[nodiscard]] json probes() const {
        return json::parse(test::bytesOf(folder / "street.reflet"))["probes"];
    }

    test::TemporaryFolder folder;
};

TEST_F(CoverageCli, ImportsProbesAndWritesThemAgain) {
    folder.write("p.csv", "id,x,y,z\na,690010,5335000,1.75\nb,690030,5335000,\nbad,here,there,1\n");
    const std::string import = "probes import " + project() + " " + path("p.csv");
    const auto dry = cli(import + " --dry-run --json");
    EXPECT_EQ(dry.exitCode, 1) << "a row was left out";
    EXPECT_EQ(jsonOf(dry)["added"], json::array({"a", "b"}));
    EXPECT_TRUE(probes().empty());
    const auto done = cli(import);
    EXPECT_EQ(done.exitCode, 1);
    EXPECT_NE(done.errors.find("line 4"), std::string::npos) << done.errors;
    EXPECT_NE(done.output.find("2 of 2 probes added"), std::string::npos) << done.output;
    ASSERT_EQ(probes().size(), 2U);
    EXPECT_EQ(probes()[0]["locked"], true);
    const auto again = jsonOf(cli(import + " --json"));
    EXPECT_EQ(again["added"], json::array()) << "they stand there already";
    const auto written =
        cli("probes export " + project() + " -o " + path("out.gpkg") + " -o " + path("out.csv"));
    EXPECT_EQ(written.exitCode, 0) << written.errors;
    EXPECT_TRUE(std::filesystem::exists(folder / "out.gpkg"));
    EXPECT_NE(test::bytesOf(folder / "out.csv").find("a,690010.0000,5335000.0000,1.7500,"),
              std::string::npos);
}

TEST_F(CoverageCli, TellsWhatIsWrongWithProbeFiles) {
    EXPECT_EQ(cli("probes import " + project()).exitCode, 2);
    EXPECT_EQ(cli("probes export " + project()).exitCode, 2);
    EXPECT_EQ(cli("probes export " + project() + " -o " + path("out.doc")).exitCode, 2);
    EXPECT_EQ(cli("probes import " + project() + " " + path("absent.csv")).exitCode, 3);
    folder.write("head.csv", "a,b\n1,2\n");
    const auto result = cli("probes import " + project() + " " + path("head.csv"));
    EXPECT_EQ(result.exitCode, 3);
    EXPECT_NE(result.errors.find("head.csv"), std::string::npos);
    EXPECT_NE(result.errors.find("id, x, y, z"), std::string::npos);
    folder.write("far.csv", "x,y\n1,2\n");
    EXPECT_EQ(cli("probes import " + project() + " " + path("far.csv")).exitCode, 4);
    EXPECT_TRUE(probes().empty());
}

TEST_F(CoverageCli, SuggestsProbesAndReportsTheCoverageThatTheyGive) {
    const auto suggested =
        cli("suggest " + project() + " --coverage 0.9 --write --json -o " + path("new.geojson"));
    ASSERT_EQ(suggested.exitCode, 0) << suggested.errors;
    const json told = jsonOf(suggested);
    EXPECT_EQ(told["schemaVersion"], 1);
    EXPECT_GT(told["probes"].size(), 0U);
    EXPECT_EQ(probes().size(), told["probes"].size());
    EXPECT_EQ(told["coverage"]["before"], 0.0);
    EXPECT_LE(told["certificate"]["ratio"].get<double>(), 1.0 + 1e-9);
    EXPECT_TRUE(told["baselines"]["uniform"].is_number());
    const json drawn = json::parse(test::bytesOf(folder / "new.geojson"));
    EXPECT_EQ(drawn["features"].size(), told["probes"].size());
    const auto reported = cli("coverage " + project() + " --json -o " + path("c.gpkg") + " -o " +
                              path("c.tif") + " -o " + path("c.csv"));
    ASSERT_EQ(reported.exitCode, 0) << reported.errors;
    const json report = jsonOf(reported);
    EXPECT_NEAR(report["coverage"]["total"].get<double>(), told["coverage"]["after"].get<double>(),
                0.02);
    EXPECT_LE(report["coverage"]["error"].get<double>(), 0.005);
    EXPECT_EQ(report["routes"][0]["attributes"]["name"], "street");
    for (const char* name : {"c.gpkg", "c.tif", "c.csv"})
        EXPECT_GT(std::filesystem::file_size(folder / name), 100U) << name;
    const auto text = cli("coverage " + project());
    EXPECT_NE(text.output.find("worst 1:"), std::string::npos) << text.output;
    const auto again = jsonOf(cli("suggest " + project() + " --coverage 0.9 --seed 0 --json"));
    EXPECT_EQ(again["probes"].size(), 0U) << "it is reached already";
}

TEST_F(CoverageCli, ReadsItsOwnSuggestionAndPlacesAfresh) {
    const auto first = cli("suggest " + project() + " --count 2 --no-baselines --json");
    ASSERT_EQ(first.exitCode, 0) << first.errors;
    EXPECT_TRUE(jsonOf(first)["baselines"]["uniform"].is_null());
    EXPECT_TRUE(probes().empty()) << "nothing is written unless asked for";
    folder.write("s.json", first.output);
    EXPECT_EQ(cli("probes import " + project() + " " + path("s.json") + " --movable").exitCode, 0);
    ASSERT_EQ(probes().size(), 2U);
    EXPECT_EQ(probes()[0]["id"], jsonOf(first)["probes"][0]["id"]);
    const auto afresh =
        cli("suggest " + project() + " --count 1 --afresh --write --no-baselines --json");
    ASSERT_EQ(afresh.exitCode, 0) << afresh.errors;
    EXPECT_EQ(probes().size(), 1U) << "what was not locked has made way";
}

TEST_F(CoverageCli, AnUnreachableTargetExitsWithOneAndTheBest) {
    const auto result = cli("suggest " + project() + " --coverage 0.9999 --no-baselines --json");
    EXPECT_EQ(result.exitCode, 1) << result.errors;
    EXPECT_EQ(jsonOf(result)["reached"], false);
    EXPECT_GT(jsonOf(result)["probes"].size(), 0U);
}

TEST_F(CoverageCli, TellsWhatIsWrongWithWhatIsAskedFor) {
    EXPECT_EQ(cli("suggest " + project()).exitCode, 2);
    EXPECT_EQ(cli("suggest " + project() + " --coverage 1.5").exitCode, 2);
    EXPECT_EQ(cli("suggest " + project() + " --count 3 -o " + path("p.xls")).exitCode, 2);
    EXPECT_EQ(cli("coverage " + project() + " -o " + path("c.xls")).exitCode, 2);
    EXPECT_EQ(cli("coverage " + project() + " --on air").exitCode, 2);
    EXPECT_EQ(cli("coverage " + project() + " --error 7").exitCode, 2);
    EXPECT_EQ(cli("coverage " + path("absent.reflet")).exitCode, 3);
    EXPECT_EQ(cli("bench suggest " + path("absent.reflet")).exitCode, 3);
    if (textWidth("x", 12)) {
        const auto early = cli("coverage " + project() + " --thumbnails " + path("t.png"));
        EXPECT_EQ(early.exitCode, 4);
        EXPECT_NE(early.errors.find("reflet-cli bake"), std::string::npos) << early.errors;
    }
}

TEST_F(CoverageCli, WritesAFolderWithAllThatThereIs) {
    if (!textWidth("x", 12))
        GTEST_SKIP() << "no font";
    ASSERT_EQ(cli("edit " + project() + " --probe p=690010,5335000 --quiet").exitCode, 0);
    const auto written = cli("coverage " + project() + " -o " + path("out/"));
    ASSERT_EQ(written.exitCode, 0) << written.errors;
    EXPECT_NE(written.errors.find("bake"), std::string::npos) << "why there are no thumbnails";
    for (const char* name : {"coverage.json", "coverage.csv", "coverage.geojson", "coverage.gpkg",
                             "coverage.tif", "coverage.png"})
        EXPECT_TRUE(std::filesystem::exists(folder / "out" / name)) << name;
    ASSERT_EQ(cli("bake " + project() + " --quiet").exitCode, 0);
    ASSERT_EQ(cli("coverage " + project() + " -o " + path("out") + " --quiet").exitCode, 0);
    EXPECT_TRUE(std::filesystem::exists(folder / "out" / "worst-places.png"));
}

TEST_F(CoverageCli, MeasuresASuggestion) {
    const auto result = cli("bench suggest " + project() +
                            " --candidates 100 --samples 8192 --count 3 --json --quiet");
    ASSERT_EQ(result.exitCode, 0) << result.errors;
    const json bench = jsonOf(result);
    for (const char* key : {"seconds", "candidates", "samples", "moveOne"})
        EXPECT_GT(bench[key].get<double>(), 0.0) << key;
}

}  // namespace
}  // namespace reflet
