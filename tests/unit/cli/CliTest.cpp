// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/EglDisplays.h"
#include "core/io/ImageFile.h"
#include "tests/support/Program.h"
#include "tests/support/StreetCity.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/unit/importers/GltfText.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <sstream>

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

/// A folder with a street city, its route, and commands that run in it.
class Cli : public testing::Test {
protected:
    void SetUp() override {
        test::StreetCity street;
        folder.write("street.city.json", street.cityJson());
        folder.write("route.geojson", street.routeGeoJson());
    }

    [[nodiscard]] std::string path(const std::string& name) const {
        return "'" + (folder / name).string() + "'";
    }

    /// A project with a car on the street and probes of 32² every 15 m.
    void makeProject() {
        const auto imported =
            cli("import " + path("street.city.json") + " -o " + path("street.reflet") +
                " --routes " + path("route.geojson") + " --vehicle car --quiet");
        ASSERT_EQ(imported.exitCode, 0) << imported.errors;
        const auto edited =
            cli("edit " + path("street.reflet") +
                " --probes-every 15 --set bake.resolution=32 --set tuning.resolution=32 --quiet");
        ASSERT_EQ(edited.exitCode, 0) << edited.errors;
    }

    test::TemporaryFolder folder;
};

TEST_F(Cli, TellsWhatIsInAFile) {
    const auto result = cli("info " + path("street.city.json") + " --json");
    EXPECT_EQ(result.exitCode, 0) << result.errors;
    const json info = jsonOf(result);
    EXPECT_EQ(info["format"], "CityJSON");
    EXPECT_EQ(info["version"], "2.0");
    EXPECT_EQ(info["crs"]["horizontal"], "EPSG:25832");
    EXPECT_TRUE(info["crs"]["vertical"].is_null());
    EXPECT_EQ(info["objects"], 13);
    EXPECT_EQ(info["byType"]["Building"], 12);
    EXPECT_EQ(info["surfaces"], 1 + 12 * 6);
    EXPECT_EQ(info["triangles"], 2 + 12 * 12);
    EXPECT_EQ(info["counts"]["loaded"], 13);
    EXPECT_EQ(info["bounds"]["min"][0], 689'960.0);
    EXPECT_EQ(info["schemaVersion"], 1);
}

TEST_F(Cli, TakesSeveralFilesAndListsThem) {
    std::filesystem::copy_file(folder / "street.city.json", folder / "other.city.json");
    const auto result = cli("info " + path("street.city.json") + " " + path("other.city.json") +
                            " " + path("street.city.json") + " --json");
    EXPECT_EQ(jsonOf(result)["files"].size(), 2U) << "one that is named twice counts once";
}

TEST_F(Cli, GoesFromACityToAMeasuredReflection) {
    makeProject();
    const auto compared =
        cli("compare " + path("street.reflet") + " --poses 2 -o " + path("comparison") + " --json");
    ASSERT_EQ(compared.exitCode, 0) << compared.errors;
    const json report = jsonOf(compared);
    EXPECT_EQ(report["maps"], 2);
    const double mem = report["methods"]["mem"]["psnr"];
    EXPECT_GT(mem, report["methods"]["blend"]["psnr"].get<double>());
    EXPECT_GT(mem, report["methods"]["nearest"]["psnr"].get<double>());
    for (const char* name : {"compare.json", "index.html", "pose-01-mem.png",
                             "pose-01-mem-flip.png", "pose-02-raytrace.png"}) {
        EXPECT_TRUE(std::filesystem::exists(folder / "comparison" / name)) << name;
    }
}

TEST_F(Cli, BakesOnceAndThenReusesTheCache) {
    makeProject();
    const json first = jsonOf(cli("bake " + path("street.reflet") + " --json"));
    EXPECT_GE(first["probes"], 4);
    EXPECT_EQ(first["baked"], first["probes"]);
    const json second = jsonOf(cli("bake " + path("street.reflet") + " --json"));
    EXPECT_EQ(second["reused"], first["probes"]);
    EXPECT_EQ(second["baked"], 0);
    EXPECT_EQ(second["bytes"], first["bytes"]);
}

TEST_F(Cli, SplitsABakeIntoShardsThatTogetherAreTheWhole) {
    makeProject();
    const std::size_t all =
        jsonOf(cli("bake " + path("street.reflet") + " --shard 1/2 --json"))["probes"]
            .get<std::size_t>() +
        jsonOf(cli("bake " + path("street.reflet") + " --shard 2/2 --json"))["probes"]
            .get<std::size_t>();
    const json rest = jsonOf(cli("bake " + path("street.reflet") + " --json"));
    EXPECT_EQ(rest["probes"], all);
    EXPECT_EQ(rest["reused"], all);
}

TEST_F(Cli, ReportsAProbeInsideAHouseAndBakesTheOthers) {
    makeProject();
    const auto edited =
        cli("edit " + path("street.reflet") + " --probe inside=690004,5335010,2 --quiet");
    ASSERT_EQ(edited.exitCode, 0) << edited.errors;
    const auto baked = cli("bake " + path("street.reflet") + " --json");
    EXPECT_EQ(baked.exitCode, 1);
    const json report = jsonOf(baked);
    ASSERT_EQ(report["failures"].size(), 1U);
    EXPECT_EQ(report["failures"][0]["object"], "inside");
    EXPECT_FALSE(report["failures"][0]["remedy"].get<std::string>().empty());
    EXPECT_EQ(report["baked"], report["probes"].get<int>() - 1);
}

TEST_F(Cli, WritesLocalMapsAsStripsOfSixFaces) {
    makeProject();
    for (const std::string method : {"nearest", "blend", "box", "mem", "raytrace"}) {
        const auto result =
            cli("reconstruct " + path("street.reflet") + " --at 690020,5335000,1.5 --method " +
                method + " -o " + path(method + ".exr"));
        ASSERT_EQ(result.exitCode, 0) << result.errors;
        const auto map = readEnvironmentMap(folder / (method + ".exr"));
        ASSERT_TRUE(map.has_value()) << map.error().message();
        EXPECT_EQ(map->radiance.resolution(), 32);
        EXPECT_EQ(map->center, glm::dvec3(690'020, 5'335'000, 1.5));
    }
}

TEST_F(Cli, DrawsAViewOfEachVehicleWhenTheProjectHasNoViews) {
    makeProject();
    const auto result = cli("render " + path("street.reflet") +
                            " --all --size 160x90 --samples 1 -o " + path("pictures") + " --json");
    ASSERT_EQ(result.exitCode, 0) << result.errors;
    const json report = jsonOf(result);
    ASSERT_EQ(report["pictures"].size(), 1U);
    const auto picture = readTexture(report["pictures"][0]["file"].get<std::string>());
    ASSERT_TRUE(picture.has_value());
    EXPECT_EQ(picture->width, 160);
    EXPECT_EQ(picture->height, 90);
}

TEST_F(Cli, AWipeShowsTwoMethodsAndRefusesAnyOtherNumberOfThem) {
    makeProject();
    const std::string render =
        "render " + path("street.reflet") + " --all --size 64x36 --samples 1 --json -o ";
    const auto result = cli(render + path("wipe") + " --wipe sky,mem --wipe-at 0.25");
    ASSERT_EQ(result.exitCode, 0) << result.errors;
    EXPECT_EQ(jsonOf(result)["method"], "sky");
    EXPECT_EQ(jsonOf(result)["right"], "mem");
    EXPECT_TRUE(readTexture(jsonOf(result)["pictures"][0]["file"].get<std::string>()).has_value());
    for (const char* wrong : {"--wipe sky", "--wipe sky,mem,blend", "--wipe sky,magic",
                              "--wipe sky,mem --method mem", "--wipe sky,mem --wipe-at 2"})
        EXPECT_EQ(cli(render + path("x") + " " + wrong).exitCode, 2) << wrong;
}

TEST_F(Cli, WritesAHeightfieldThatStandsWhereTheCityStands) {
    makeProject();
    const auto result = cli("heightfield " + path("street.reflet") + " --cell 1 -o " +
                            path("heights.tif") + " --json");
    ASSERT_EQ(result.exitCode, 0) << result.errors;
    EXPECT_EQ(jsonOf(result)["cellSize"], 1.0);
    EXPECT_TRUE(std::filesystem::exists(folder / "heights.tif"));
}

TEST_F(Cli, SaysWhatAClassCountsAs) {
    makeProject();
    const std::string project = path("street.reflet");
    ASSERT_EQ(cli("edit " + project + " --set heightfield.classes.Bridge=column" +
                  " --set heightfield.clearance=2.5")
                  .exitCode,
              0);
    const json saved = json::parse(test::bytesOf(folder / "street.reflet"));
    EXPECT_EQ(saved["heightfield"]["classes"]["Bridge"], "column");
    EXPECT_EQ(saved["heightfield"]["classes"]["Tunnel"], "tunnel");
    EXPECT_EQ(saved["heightfield"]["clearance"], 2.5);
    EXPECT_EQ(cli("validate " + project).exitCode, 0);
}

TEST_F(Cli, ValidatesAProjectAndSeesAMissingAndAChangedModel) {
    makeProject();
    EXPECT_EQ(cli("validate " + path("street.reflet")).exitCode, 0);
    folder.write("street.city.json", test::StreetCity(5).cityJson());
    const json changed = jsonOf(cli("validate " + path("street.reflet") + " --json"));
    EXPECT_TRUE(changed["valid"]);
    EXPECT_EQ(changed["findings"][0]["code"], "model-changed");
    std::filesystem::remove(folder / "street.city.json");
    const auto missing = cli("validate " + path("street.reflet") + " --json");
    EXPECT_EQ(missing.exitCode, 1);
    EXPECT_EQ(jsonOf(missing)["findings"][0]["code"], "model-missing");
}

TEST_F(Cli, ValidateNamesTheJsonPointerThatBreaksTheSchema) {
    folder.write(
        "bad.reflet",
        R"({"schema":"reflet-project","version":1,"crs":{"horizontal":7,"vertical":null,"origin":[0,0,0]},"models":[]})");
    const auto result = cli("validate " + path("bad.reflet") + " --json");
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_NE(result.output.find("/crs/horizontal"), std::string::npos) << result.output;
}

TEST_F(Cli, EditsSettingsProbesAndVehiclesAndRefusesWhatIsUnknown) {
    makeProject();
    const std::string project = path("street.reflet");
    EXPECT_EQ(cli("edit " + project +
                  " --set light.date=2026-12-01T15:00+01:00 --set tuning.depthRatio=0.5")
                  .exitCode,
              0);
    const json saved = json::parse(test::bytesOf(folder / "street.reflet"));
    EXPECT_EQ(saved["tuning"]["depthRatio"], 0.5);
    EXPECT_EQ(saved["light"]["date"].get<std::string>().substr(0, 16), "2026-12-01T15:00");
    const std::string before = test::bytesOf(folder / "street.reflet");
    for (const std::string bad :
         {"--set tuning.colour=3", "--set tuning=3", "--set schema=x", "--remove nobody",
          "--vehicle x=rocket,street", "--vehicle x=tram,nowhere", "--probe p", "--probe p=1",
          "--probe p=a,b", "--probes-every 0"}) {
        const auto result = cli("edit " + project + " " + bad);
        EXPECT_EQ(result.exitCode, 2) << bad << result.errors;
        EXPECT_FALSE(result.errors.empty());
    }
    EXPECT_EQ(cli("edit " + project + " --set bake.resolution=7").exitCode, 3);
    EXPECT_EQ(cli("edit " + project + " --set heightfield.classes.Bridge=arch").exitCode, 3);
    EXPECT_EQ(cli("edit " + project + " --set heightfield.clearance=-1").exitCode, 3);
    EXPECT_EQ(test::bytesOf(folder / "street.reflet"), before);
}

TEST_F(Cli, EditsTheFrameBudgetAndHowMuchAVehicleMatters) {
    makeProject();
    const std::string project = path("street.reflet");
    const json made = json::parse(test::bytesOf(folder / "street.reflet"));
    const std::string id = made["reflectors"][0]["id"];
    ASSERT_EQ(cli("edit " + project + " --set tuning.levelOfDetail.frameBudget=20 --interest " +
                  id + "=2.5")
                  .exitCode,
              0);
    const std::string before = test::bytesOf(folder / "street.reflet");
    const json saved = json::parse(before);
    EXPECT_EQ(saved["tuning"]["levelOfDetail"]["frameBudget"], 20.0);
    EXPECT_EQ(saved["reflectors"][0]["interest"], 2.5);
    for (const std::string bad : {"nobody=1", "=1", id.c_str(), "11", "-1", "much"}) {
        const bool named = bad == "nobody=1" || bad == "=1" || bad == id;
        const auto result =
            cli("edit " + project + " --interest " + (named ? bad : id + "=" + bad));
        EXPECT_EQ(result.exitCode, 2) << bad;
        EXPECT_FALSE(result.errors.empty()) << bad;
    }
    EXPECT_EQ(cli("edit " + project + " --set tuning.levelOfDetail.frameBudget=1").exitCode, 3);
    EXPECT_EQ(cli("edit " + project + " --set tuning.levelOfDetail.blur=2").exitCode, 3);
    EXPECT_EQ(cli("edit " + project + " --set tuning.levelOfDetail=off").exitCode, 2);
    EXPECT_EQ(test::bytesOf(folder / "street.reflet"), before);
}

TEST_F(Cli, EndsWithTheDocumentedExitCodes) {
    EXPECT_EQ(cli("").exitCode, 2);
    EXPECT_EQ(cli("--help").exitCode, 0);
    EXPECT_EQ(cli("dance").exitCode, 2);
    EXPECT_EQ(cli("info").exitCode, 2);
    EXPECT_EQ(cli("info " + path("absent.city.json")).exitCode, 3);
    folder.write("cut.city.json", test::StreetCity().cityJson().substr(0, 500));
    EXPECT_EQ(cli("info " + path("cut.city.json")).exitCode, 3);
    EXPECT_EQ(cli("render " + path("absent.reflet") + " --all -o " + path("x")).exitCode, 3);
    folder.write("newer.reflet", R"({"schema":"reflet-project","version":99})");
    EXPECT_EQ(cli("bake " + path("newer.reflet")).exitCode, 4);
    folder.write("unknown.city.json",
                 test::StreetCity().cityJson("https://www.opengis.net/def/crs/EPSG/0/999999"));
    EXPECT_EQ(cli("import " + path("unknown.city.json") + " -o " + path("u.reflet")).exitCode, 4);
    folder.write("none.city.json", test::StreetCity().cityJson(""));
    EXPECT_EQ(
        cli("import " + path("none.city.json") + " -o " + path("n.reflet") + " --strict").exitCode,
        4);
    EXPECT_EQ(cli("import " + path("none.city.json") + " -o " + path("n.reflet")).exitCode, 0);
    EXPECT_EQ(cli("import " + path("street.city.json") + " -o " + path("no-such-folder/n.reflet"))
                  .exitCode,
              5);
    EXPECT_EQ(cli("sample atlantis " + path("atlantis")).exitCode, 2);
    EXPECT_FALSE(std::filesystem::exists(folder / "u.reflet"));
}

TEST_F(Cli, SaysThatTheModelOfAProjectIsMissing) {
    makeProject();
    std::filesystem::remove(folder / "street.city.json");
    const auto result = cli("bake " + path("street.reflet") + " --json");
    EXPECT_EQ(result.exitCode, 3);
    EXPECT_NE(result.errors.find("street.city.json"), std::string::npos);
    EXPECT_EQ(jsonOf(result)["error"]["code"], "unreadable");
}

TEST_F(Cli, SaysThatTheFileOfAVehicleIsMissingOrHasChanged) {
    makeProject();
    test::GltfText van;
    van.box({-0.9F, 0.2F, -2.2F}, {0.9F, 1.5F, 2.2F});
    folder.write("van.gltf", van.text());
    const auto edited =
        cli("edit " + path("street.reflet") + " --vehicle van=" + path("van.gltf") + ",street");
    ASSERT_EQ(edited.exitCode, 0) << edited.errors;
    ASSERT_EQ(cli("validate " + path("street.reflet")).exitCode, 0);
    const std::string draw =
        "render " + path("street.reflet") + " --all -o " + path("views") + " --size 32x16 --json";
    const auto fails = [&](const char* what, int exitCode, const char* finding) {
        const auto result = cli(draw);
        EXPECT_EQ(result.exitCode, exitCode) << result.errors;
        EXPECT_NE(result.errors.find(what), std::string::npos) << result.errors;
        EXPECT_NE(result.errors.find("van.gltf"), std::string::npos) << result.errors;
        EXPECT_NE(result.errors.find("bring it in again"), std::string::npos) << result.errors;
        EXPECT_FALSE(std::filesystem::exists(folder / "views"));
        const auto validated = cli("validate " + path("street.reflet") + " --json");
        EXPECT_EQ(validated.exitCode, 1);
        EXPECT_EQ(jsonOf(validated)["findings"][0]["code"], finding);
    };
    van.box({0, 0, 0}, {1, 1, 1});
    folder.write("van.gltf", van.text());
    fails("is not the one that was brought in", 4, "vehicle-changed");
    std::filesystem::remove(folder / "van.gltf");
    fails("is missing", 3, "vehicle-missing");
}

TEST_F(Cli, StopsOnAnInterruptWithoutAPartialFile) {
    makeProject();
    const auto result =
        test::runProgram(std::string("timeout --preserve-status -s INT 1 '") + REFLET_CLI +
                         "' bake " + path("street.reflet") + " --resolution 2048");
    EXPECT_EQ(result.exitCode, 130);
    EXPECT_NE(result.errors.find("cancelled"), std::string::npos) << result.errors;
    if (!std::filesystem::exists(folder / "street.cache" / "rem"))
        return;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "street.cache" / "rem")) {
        EXPECT_EQ(entry.path().extension(), ".exr");
    }
}

TEST_F(Cli, WritesProgressAsLinesOfJson) {
    makeProject();
    const auto result = cli("bake " + path("street.reflet") + " --progress=json --quiet");
    ASSERT_EQ(result.exitCode, 0);
    std::istringstream lines(result.errors);
    std::string line;
    int count = 0;
    while (std::getline(lines, line)) {
        const json parsed = json::parse(line, nullptr, false);
        ASSERT_FALSE(parsed.is_discarded()) << line;
        EXPECT_TRUE(parsed.contains("phase"));
        ++count;
    }
    EXPECT_GT(count, 0);
}

TEST_F(Cli, DoctorTellsVersionsAndTheRenderer) {
    const auto result = cli("doctor --json");
    const json report = jsonOf(result);
    std::vector<std::string> names;
    for (const auto& item : report["items"])
        names.push_back(item["name"]);
    for (const char* name : {"PROJ", "GDAL", "OpenImageIO", "Embree", "OpenGL", "ffmpeg"}) {
        EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
    }
    EXPECT_EQ(result.exitCode, report["healthy"].get<bool>() ? 0 : 1);
}

TEST_F(Cli, MeasuresPicturesOfADriveByPass) {
    if (eglDisplayCandidates().empty())
        GTEST_SKIP() << "EGL offers no display here.";
    makeProject();
    const auto result = cli("bench frames " + path("street.reflet") +
                            " --size 96x54 --scale 0.5 --frames 2 --budget 40 --json --quiet");
    ASSERT_EQ(result.exitCode, 0) << result.errors;
    const json report = jsonOf(result);
    EXPECT_FALSE(report.at("renderer").get<std::string>().empty());
    EXPECT_EQ(report.at("size"), json({96, 54}));
    EXPECT_EQ(report.at("budget"), 40.0);
    ASSERT_EQ(report.at("scenes").size(), 2U);
    for (const char* scene : {"orbit", "pavement"}) {
        const json& rows = report.at("scenes").at(scene);
        EXPECT_EQ(rows.at("full").at("scale"), 1.0);
        EXPECT_EQ(rows.at("scaled").at("scale"), 0.5);
        EXPECT_EQ(rows.at("still").at("localMaps"), 0) << "nothing moves between these pictures";
        EXPECT_EQ(rows.at("plain").at("levelOfDetail"), nullptr);
        EXPECT_EQ(rows.at("still").at("levelOfDetail"), nullptr);
        const json& lod = rows.at("full").at("levelOfDetail");
        EXPECT_GE(lod.at("allowed"), 0.0);
        for (const char* count : {"coarse", "full", "reduced", "blended", "shared", "waiting"})
            EXPECT_GE(lod.at(count), 0) << count;
        for (const char* row : {"full", "plain", "scaled", "adaptive", "still"}) {
            const json& costs = rows.at(row);
            EXPECT_GT(costs.at("triangles"), 0) << scene << ' ' << row;
            EXPECT_GE(costs.at("p95"), costs.at("median")) << scene << ' ' << row;
            EXPECT_GE(costs.at("worst"), costs.at("p99")) << scene << ' ' << row;
            for (const char* part : {"city", "tracing", "maps", "inMaps", "vehicles", "overlays"})
                EXPECT_GE(costs.at(part), 0.0) << scene << ' ' << row << ' ' << part;
        }
    }
}

TEST_F(Cli, MeasuresAnImportBesideTheParseAloneAndWritesNothing) {
    const auto result = cli("bench import " + path("street.city.json") + " --json --quiet");
    ASSERT_EQ(result.exitCode, 0) << result.errors;
    const json report = jsonOf(result);
    EXPECT_EQ(report.at("format"), "CityJSON");
    EXPECT_EQ(report.at("bytes"), std::filesystem::file_size(folder / "street.city.json"));
    EXPECT_EQ(report.at("triangles"), 2 + 12 * 12);
    EXPECT_DOUBLE_EQ(report.at("ours"),
                     report.at("steps").at("import").at("seconds").get<double>() +
                         report.at("steps").at("prepare").at("seconds").get<double>());
    EXPECT_DOUBLE_EQ(report.at("ratio"),
                     report.at("ours").get<double>() / report.at("reference").get<double>());
    for (const auto& entry : std::filesystem::directory_iterator(folder / ""))
        EXPECT_TRUE(entry.is_regular_file()) << entry.path() << " was left behind";
    EXPECT_EQ(cli("bench import").exitCode, 2);
    EXPECT_EQ(cli("bench import " + path("missing.city.json")).exitCode, 3);
}

TEST_F(Cli, BakesWithOpenGlBesideTheTracedMaps) {
    makeProject();
    const std::string bake = "bake " + path("street.reflet") + " --json";
    const auto drawn = cli(bake + " --backend gl");
    if (drawn.exitCode == 5)
        GTEST_SKIP() << "There is no OpenGL 4.5 here: " << drawn.errors;
    ASSERT_EQ(drawn.exitCode, 0) << drawn.errors;
    EXPECT_EQ(jsonOf(drawn)["baked"], jsonOf(drawn)["probes"]);
    EXPECT_EQ(jsonOf(cli(bake + " --backend gl"))["reused"], jsonOf(drawn)["probes"]);
    // Others take them as they are; who asks for traced ones gets those.
    const auto before = jsonOf(cli("bench memory " + path("street.reflet") + " --json --quiet"));
    const json traced = jsonOf(cli(bake));
    EXPECT_EQ(traced["baked"], traced["probes"]);
    const auto after = jsonOf(cli("bench memory " + path("street.reflet") + " --json --quiet"));
    EXPECT_EQ(before["maps"], after["maps"]);
    EXPECT_NE(before["psnr"], after["psnr"]);
    EXPECT_EQ(cli("bake " + path("street.reflet") + " --backend vulkan").exitCode, 2);
}

TEST_F(Cli, TellsWhatProbesTakeOnGraphicsCards) {
    makeProject();
    const auto result = cli("bench memory " + path("street.reflet") + " --poses 2 --json --quiet");
    ASSERT_EQ(result.exitCode, 0) << result.errors;
    const json report = jsonOf(result);
    const std::size_t texels = report.at("texels");
    EXPECT_EQ(report.at("plainBytes"), 8 * texels);
    EXPECT_LE(report.at("compressedBytes"), 8 * texels / 5);
    EXPECT_GT(report.at("psnr"), 38.0);  // of small maps; those of 128 x 128 keep 40
    EXPECT_GE(report.at("psnr"), report.at("worstPsnr"));
    EXPECT_GT(report.at("validity").at("texels"), 0);
    EXPECT_LT(report.at("validity").at("changedTexels"), 0.005);
    EXPECT_LE(report.at("validity").at("changedDecisions"),
              report.at("validity").at("changedTexels"));
    EXPECT_EQ(cli("bench memory").exitCode, 2);
    EXPECT_EQ(cli("bench memory " + path("missing.reflet")).exitCode, 3);
}

TEST_F(Cli, MeasuresLocalMapsBesideTheirTracingAnew) {
    makeProject();
    const auto result =
        cli("bench reconstruct " + path("street.reflet") + " --poses 2 --json --quiet");
    ASSERT_EQ(result.exitCode, 0) << result.errors;
    const json report = jsonOf(result);
    EXPECT_GE(report.at("maps"), 2);
    for (const auto& [name, row] : report.at("cases").items()) {
        EXPECT_GT(row.at("ours"), 0.0) << name;
        EXPECT_DOUBLE_EQ(row.at("ratio"),
                         row.at("reference").get<double>() / row.at("ours").get<double>());
    }
    const int edge = report.at("resolution");
    EXPECT_EQ(report.at("cases").at("dense").at("rays"), 6 * edge * edge);
    EXPECT_EQ(report.at("cases").at("blend").at("rays"), 0);
    EXPECT_GT(report.at("cases").at("mem").at("quads"), 600);
    EXPECT_EQ(cli("bench reconstruct").exitCode, 2);
    EXPECT_EQ(cli("bench reconstruct " + path("missing.reflet")).exitCode, 3);
}

TEST_F(Cli, MeasuresTracingBesideEmbreeAndFindsEveryAnswerRight) {
    makeProject();
    const auto result =
        cli("bench trace " + path("street.reflet") + " --poses 2 --check 20000 --json --quiet");
    ASSERT_EQ(result.exitCode, 0) << result.errors;
    const json report = jsonOf(result);
    EXPECT_GE(report.at("threads"), 1);
    ASSERT_EQ(report.at("scenes").size(), 1U);
    const json& scene = report.at("scenes").at("street");
    EXPECT_EQ(scene.at("triangles"), 2 + 12 * 12);
    EXPECT_EQ(scene.at("mismatches"), 0);
    EXPECT_EQ(scene.at("texels").at("rays"), 2 * 6 * 128 * 128);
    EXPECT_EQ(scene.at("compared"), scene.at("texels").at("rays").get<std::size_t>() +
                                        scene.at("vertices").at("rays").get<std::size_t>() + 20000);
    for (const char* rays : {"vertices", "texels"}) {
        for (const json& rates : {scene.at(rays), scene.at(rays).at("oneThread")}) {
            double best = 0.0;
            for (const char* mode : {"single", "packet8", "packet16"})
                best = std::max(best, rates.at("embree").at(mode).get<double>());
            EXPECT_GT(rates.at("scalar"), 0.0);
            EXPECT_DOUBLE_EQ(rates.at("ratio"), rates.at("heightfield").get<double>() / best);
        }
    }
    EXPECT_EQ(cli("bench trace " + path("missing.reflet")).exitCode, 3);
}

TEST_F(Cli, MeasuresAHeightfieldBesideRaysThatReadItTooLow) {
    const auto result = cli("bench heightfield --triangles 20000 --cell 0.5 --json --quiet");
    ASSERT_EQ(result.exitCode, 0) << result.errors;
    const json report = jsonOf(result);
    EXPECT_LE(report.at("triangles"), 20'000);
    EXPECT_GT(report.at("triangles"), 10'000);
    EXPECT_GT(report.at("cells"), 100'000);
    EXPECT_GT(report.at("tooLow"), 0.005) << "cells at walls, whose centres lie beside them";
    EXPECT_LT(report.at("tooLow"), 0.2);
    EXPECT_EQ(cli("bench heightfield --triangles 0").exitCode, 2);
    EXPECT_EQ(cli("bench heightfield --cell 0").exitCode, 2);
}

TEST_F(Cli, RefusesToMeasureWhatItCannotDraw) {
    makeProject();
    EXPECT_EQ(cli("bench frames " + path("street.reflet") + " --size 8x8").exitCode, 2);
    EXPECT_EQ(cli("bench frames " + path("street.reflet") + " --scale 0").exitCode, 2);
    EXPECT_EQ(cli("bench frames " + path("street.reflet") + " --frames 0").exitCode, 2);
    EXPECT_EQ(cli("bench frames " + path("street.reflet") + " --budget 1").exitCode, 2);
    EXPECT_EQ(cli("bench loops " + path("street.reflet")).exitCode, 2);
    EXPECT_EQ(cli("bench frames " + path("missing.reflet")).exitCode, 3);
    ASSERT_EQ(cli("import " + path("street.city.json") + " -o " + path("bare.reflet") + " --quiet")
                  .exitCode,
              0);
    const auto bare = cli("bench frames " + path("bare.reflet"));
    EXPECT_EQ(bare.exitCode, 2);
    EXPECT_NE(bare.errors.find("nothing drives"), std::string::npos) << bare.errors;
}

}  // namespace
}  // namespace reflet
