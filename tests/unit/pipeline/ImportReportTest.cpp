// SPDX-License-Identifier: GPL-3.0-or-later
// What an import tells of each object and each file.
#include "app/pipeline/Import.h"
#include "app/pipeline/ImportReportJson.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/unit/importers/CityJsonText.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>

namespace reflet {
namespace {

using test::json;

/// "good" is a box; of "holed" one surface has a vertex that does not exist; "lost" has no other.
json oddCity() {
    json city = test::boxCity();
    city["CityObjects"]["good"] = city["CityObjects"]["a"];
    city["CityObjects"].erase("a");
    json holed = test::solid("2");
    holed["boundaries"][0][1] = json::array({json::array({4, 5, 999})});
    city["CityObjects"]["holed"] = test::object("Building", json::array({holed}));
    city["CityObjects"]["lost"] =
        test::object("Bridge", json::array({test::surfaces("1", {{{997, 998, 999}}})}));
    return city;
}

class ImportReportTest : public testing::Test {
protected:
    Result<ImportReport> import(const json& city, ImportRequest request = {}) {
        std::ofstream(folder / "town.city.json") << city.dump();
        request.files = {folder / "town.city.json"};
        return importProject(request, {});
    }
    static json documentOf(const ImportReport& report) {
        return json::parse(importReportText(
            {"town", report.project.frame, report.city->generatedGround, report.city->groundFit,
             report.remarks, report.city->files, report.city->city.objects}));
    }
    test::TemporaryFolder folder;
};

TEST_F(ImportReportTest, AccountsForEachObjectOnceWithClassLevelAndOutcome) {
    const auto report = import(oddCity());
    ASSERT_TRUE(report) << report.error().message();
    const json document = documentOf(*report);
    EXPECT_EQ(document["schema"], "reflet-import-report");
    EXPECT_EQ(document["schemaVersion"], kImportReportVersion);
    const json& file = document["files"][0];
    std::map<std::string, json> byId;
    std::map<std::string, int> results;
    for (const json& account : file["accounts"]) {
        EXPECT_TRUE(byId.emplace(account["id"], account).second) << account["id"];
        ++results[account["result"]];
    }
    EXPECT_EQ(byId.size(), 3U);
    for (const char* result : {"loaded", "repaired", "skipped"})
        EXPECT_EQ(results[result], file["counts"][result]) << result;
    EXPECT_EQ(byId["good"]["result"], "loaded");
    EXPECT_EQ(byId["good"]["lod"], "2");
    EXPECT_TRUE(byId["good"]["remarks"].empty());
    EXPECT_EQ(byId["holed"]["result"], "repaired");
    EXPECT_EQ(byId["holed"]["type"], "Building");
    EXPECT_EQ(byId["holed"]["lod"], "2");
    EXPECT_EQ(byId["holed"]["remarks"][0]["code"], "index-out-of-range");
    EXPECT_EQ(byId["lost"]["result"], "skipped");
    EXPECT_EQ(byId["lost"]["type"], "Bridge");
    EXPECT_TRUE(byId["lost"]["lod"].is_null()) << "nothing of it was loaded";
    EXPECT_FALSE(byId["lost"]["remarks"].empty());
}

TEST_F(ImportReportTest, TellsOfEachRemarkWhatBecameOfItsObject) {
    const auto report = import(oddCity());
    ASSERT_TRUE(report) << report.error().message();
    const json file = fileReportJson(report->city->files[0]);
    std::size_t ofObjects = 0;
    for (const json& remark : file["diagnostics"]) {
        const std::string object = remark["object"];
        EXPECT_EQ(remark.contains("result"), !object.empty()) << remark;
        if (object.empty())
            continue;
        ++ofObjects;
        EXPECT_EQ(remark["result"], object == "lost" ? "skipped" : "repaired") << remark;
    }
    EXPECT_GE(ofObjects, 2U);
}

TEST_F(ImportReportTest, SaysHowTheCrsWasFoundAndWhichOperationWasUsed) {
    const auto declared = import(test::boxCity());
    ASSERT_TRUE(declared) << declared.error().message();
    json crs = fileReportJson(declared->city->files[0])["crs"];
    EXPECT_EQ(crs["rule"], "declared");
    EXPECT_EQ(crs["written"], "https://www.opengis.net/def/crs/EPSG/0/7415");
    EXPECT_EQ(crs["horizontal"], "EPSG:28992");
    EXPECT_TRUE(crs["operation"].is_null()) << "the project takes the file's own CRS";

    ImportRequest request;
    request.projectCrs = "EPSG:32631";
    const auto moved = import(test::boxCity(), request);
    ASSERT_TRUE(moved) << moved.error().message();
    crs = fileReportJson(moved->city->files[0])["crs"];
    EXPECT_FALSE(crs["operation"]["name"].get<std::string>().empty());
    EXPECT_EQ(crs["operation"]["ballpark"], false);
    // RD New is tied to ETRS89 to better than a metre, and to WGS 84 to about one.
    ASSERT_TRUE(crs["operation"]["accuracy"].is_number()) << crs;
    EXPECT_GT(crs["operation"]["accuracy"], 0.0);
    EXPECT_LE(crs["operation"]["accuracy"], 5.0);

    json silent = test::boxCity();
    silent.erase("metadata");
    const auto assumed = import(silent);
    ASSERT_TRUE(assumed) << assumed.error().message();
    EXPECT_EQ(fileReportJson(assumed->city->files[0])["crs"]["rule"], "assumed");
    request = {};
    request.crs = "EPSG:28992";
    const auto given = import(silent, request);
    ASSERT_TRUE(given) << given.error().message();
    EXPECT_EQ(fileReportJson(given->city->files[0])["crs"]["rule"], "given");
    json wrong = test::boxCity();
    wrong["metadata"]["referenceSystem"] = "the town's own";
    const auto replaced = import(wrong, request);
    ASSERT_TRUE(replaced) << replaced.error().message();
    crs = fileReportJson(replaced->city->files[0])["crs"];
    EXPECT_EQ(crs["rule"], "replaced");
    EXPECT_EQ(crs["written"], "the town's own");
}

TEST_F(ImportReportTest, ListsTheTexturesThatAreMissing) {
    json city = test::boxCity();
    city["appearance"] = {
        {"textures",
         {{{"type", "PNG"}, {"image", "here.png"}}, {{"type", "PNG"}, {"image", "not/there.png"}}}},
        {"vertices-texture", {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}}};
    json values = json::array();
    for (int face = 0; face < 6; ++face)
        values.push_back(json::array({json::array({face % 2, 0, 1, 2, 3})}));
    city["CityObjects"]["a"]["geometry"][0]["texture"]["default"]["values"] = json::array({values});
    std::ofstream(folder / "here.png") << "picture";
    const auto report = import(city);
    ASSERT_TRUE(report) << report.error().message();
    const json textures = fileReportJson(report->city->files[0])["textures"];
    EXPECT_EQ(textures["referenced"], 2);
    EXPECT_EQ(textures["resolved"], 1);
    EXPECT_EQ(textures["missing"], json::array({"not/there.png"}));
}

TEST_F(ImportReportTest, AProjectThatIsOpenedTellsTheSameOfItsObjects) {
    ImportRequest request;
    request.output = folder / "town.reflet";
    const auto report = import(oddCity(), request);
    ASSERT_TRUE(report) << report.error().message();
    const auto loaded = loadCity(report->project, folder.path(), {});
    ASSERT_TRUE(loaded) << loaded.error().message();
    EXPECT_EQ(fileReportJson(loaded->files[0])["diagnostics"],
              fileReportJson(report->city->files[0])["diagnostics"]);
    EXPECT_EQ(loaded->files[0].objectCount, report->city->files[0].objectCount);
}

TEST_F(ImportReportTest, IdsOfNoEncodingAreStillWrittenAsJson) {
    FileReport file;
    file.file = "bad\xff.json";
    file.diagnostics.push_back({Severity::Error, "bad-vertex", "\xc3(", "skipped", ""});
    const std::vector<FileReport> files{file};
    const json document =
        json::parse(importReportText({"p", {}, false, {}, {}, files, {}}), nullptr, false);
    EXPECT_FALSE(document.is_discarded());
}

}  // namespace
}  // namespace reflet
