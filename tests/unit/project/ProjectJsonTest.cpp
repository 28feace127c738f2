// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/project/Project.h"
#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace reflet {
namespace {

using nlohmann::json;

std::string versionOne() {
    return test::bytesOf(REFLET_SOURCE_DIR "/tests/unit/project/data/version-1.reflet");
}

json minimal() {
    return {{"schema", "reflet-project"},
            {"version", 1},
            {"crs", {{"horizontal", nullptr}, {"vertical", nullptr}, {"origin", {0, 0, 0}}}},
            {"models", json::array()}};
}

/// The minimal project with one JSON pointer set.
std::string with(const std::string& pointer, const json& value) {
    json root = minimal();
    root[json::json_pointer(pointer)] = value;
    return root.dump();
}

void expectRefusal(const std::string& text, ErrorCode code, const std::string& part) {
    const auto project = projectFromJson(text, "a.reflet");
    ASSERT_FALSE(project.has_value()) << text;
    EXPECT_EQ(project.error().code, code);
    EXPECT_NE(project.error().what.find(part), std::string::npos) << project.error().what;
    EXPECT_EQ(project.error().subject, "a.reflet");
    EXPECT_FALSE(project.error().remedy.empty());
}

TEST(ProjectJson, ReadsEveryValueOfSchemaVersionOne) {
    const auto read = projectFromJson(versionOne(), "version-1.reflet");
    ASSERT_TRUE(read.has_value()) << read.error().message();
    const Project& p = *read;
    EXPECT_EQ(p.name, "version one");
    EXPECT_EQ(p.frame, (ProjectFrame{"EPSG:28992", "EPSG:5709", {85000, 446000, 0}}));
    ASSERT_EQ(p.models.size(), 1U);
    ReadingOptions reading;
    reading.lod = "2.2";
    reading.types = {"Building", "Road"};
    reading.bbox = {84900, 445900, 85100, 446100};
    EXPECT_EQ(p.models[0], (ModelReference{reading, "city.city.json", "00ff"}));
    EXPECT_EQ(p.bake, (BakeSettings{256, 3}));
    EXPECT_EQ(p.heightfield.cellSize, 0.5);
    EXPECT_EQ(p.heightfield.maxCells, 1'000'000U);
    EXPECT_TRUE(std::isinf(p.tuning.depthRatio));
    EXPECT_EQ(p.tuning.meshSize, 12);
    EXPECT_EQ(p.tuning.interpolation, Interpolation::AsInPaper);
    EXPECT_FALSE(p.tuning.refineAtValidity);
    EXPECT_FALSE(p.tuning.traceEdgeTexels);
    EXPECT_FALSE(p.tuning.refineHits);
    EXPECT_FALSE(p.tuning.parallax);
    EXPECT_EQ(p.tuning.errorBound, 0.5);
    EXPECT_EQ(p.tuning.weighting, Weighting::AsInPaper);
    EXPECT_EQ(p.tuning.remsPerVehicle, 5);
    EXPECT_EQ(p.tuning.lod, (LodSettings{false, 20.0, 0.25}));
    ASSERT_EQ(p.probes.size(), 1U);
    EXPECT_EQ(p.probes[0], (Probe{"p001", {85010.5, 446020.25, 3.75}, 64, true}));
    ASSERT_EQ(p.routes.size(), 1U);
    EXPECT_EQ(p.routes[0].points[1], glm::dvec3(85100, 446050, 2.5));
    EXPECT_EQ(p.routes[0].attributes, (std::map<std::string, std::string>{{"owner", "city"}}));
    ASSERT_EQ(p.noProbes.size(), 1U);
    EXPECT_EQ(p.noProbes[0], (NoProbeArea{"square", {85050, 446030}, 12.5}));
    ASSERT_EQ(p.reflectors.size(), 1U);
    EXPECT_EQ(p.reflectors[0], (Reflector{"tram1", "tram", "line-1", 7.5, 12, 2.5}));
    ASSERT_EQ(p.views.size(), 1U);
    EXPECT_NEAR(p.views[0].verticalFov, 40.0 * kPi / 180.0, 1e-12);
    EXPECT_EQ(p.date, (DateTime{2026, 6, 21, 18, 30, 0.0, 2.0}));
    EXPECT_EQ(p.turbidity, 3.5F);
    EXPECT_EQ(p.exposure, 1.25F);
    EXPECT_FALSE(p.generatedGround);
}

TEST(ProjectJson, WritesVehiclesOfTheUserInDegreesAndReadsThemBackExactly) {
    Project project;
    project.vehicles.push_back({"citybus",
                                "vehicles/bus.glb",
                                "00ff",
                                VehicleUp::MinusZ,
                                0.0254,
                                -kPi / 2.0,
                                {0.5, -0.25, 1.125},
                                false});
    json written = json::parse(projectToJson(project));
    EXPECT_EQ(written["vehicles"][0]["heading"], json(-90.0));
    EXPECT_EQ(written["vehicles"][0]["up"], json("-z"));
    written["vehicles"][0]["note"] = "from the operator";
    const auto read = projectFromJson(written.dump(), "a.reflet");
    ASSERT_TRUE(read.has_value()) << read.error().message();
    EXPECT_EQ(read->vehicles, project.vehicles);
    EXPECT_EQ(json::parse(projectToJson(*read)), written);
    Project emptied = *read;
    emptied.vehicles.clear();
    EXPECT_EQ(json::parse(projectToJson(emptied))["vehicles"], json::array());
}

TEST(ProjectJson, HasNoVehiclesOfTheUserInAFileThatNamesNone) {
    const auto read = projectFromJson(versionOne(), "version-1.reflet");
    ASSERT_TRUE(read.has_value());
    EXPECT_TRUE(read->vehicles.empty());
    EXPECT_FALSE(json::parse(projectToJson(*read)).contains("vehicles"));
}

TEST(ProjectJson, RefusesVehiclesThatCannotBeMeant) {
    const auto vehicles = [](const json& vehicle) {
        return with("/vehicles", json::array({vehicle}));
    };
    expectRefusal(vehicles({{"id", "tram"}, {"path", "a.glb"}}), ErrorCode::Unreadable,
                  "/vehicles/0/id should be a name that no built-in vehicle has");
    expectRefusal(vehicles({{"id", "a"}}), ErrorCode::Unreadable, "/vehicles/0/path");
    expectRefusal(vehicles({{"id", "a"}, {"path", "a.glb"}, {"up", "north"}}),
                  ErrorCode::Unreadable, "/vehicles/0/up should be one of \"+y\"");
    expectRefusal(vehicles({{"id", "a"}, {"path", "a.glb"}, {"scale", 0}}), ErrorCode::Unreadable,
                  "/vehicles/0/scale");
    const json one{{"id", "a"}, {"path", "a.glb"}};
    expectRefusal(with("/vehicles", json::array({one, one})), ErrorCode::Unreadable,
                  "\"a\" is taken");
}

TEST(ProjectJson, RefusesALevelOfDetailThatCannotBeMeant) {
    const auto lod = [](const char* key, const json& value) {
        return with("/tuning", {{"levelOfDetail", {{key, value}}}});
    };
    for (const json& budget : {json(3.9), json(501), json("fast"), json(nullptr)})
        expectRefusal(lod("frameBudget", budget), ErrorCode::Unreadable,
                      "/tuning/levelOfDetail/frameBudget should be");
    for (const json& blur : {json(-0.1), json(1.1)})
        expectRefusal(lod("blur", blur), ErrorCode::Unreadable,
                      "/tuning/levelOfDetail/blur should be");
    expectRefusal(lod("on", 1), ErrorCode::Unreadable, "/tuning/levelOfDetail/on should be");
    for (const json& interest : {json(-1), json(10.5)}) {
        json root = json::parse(versionOne());
        root["reflectors"][0]["interest"] = interest;
        expectRefusal(root.dump(), ErrorCode::Unreadable, "/reflectors/0/interest should be");
    }
}

TEST(ProjectJson, WritesTheInterestInAVehicleOnlyWhereItIsNotTheUsual) {
    auto project = *projectFromJson(versionOne(), "a");
    project.reflectors[0].interest = 1.0;
    EXPECT_FALSE(json::parse(projectToJson(project))["reflectors"][0].contains("interest"));
}

TEST(ProjectJson, WritesWhatItReadAndKeepsUnknownKeysAtEveryLevel) {
    const auto read = projectFromJson(versionOne(), "version-1.reflet");
    ASSERT_TRUE(read.has_value());
    json expected = json::parse(versionOne());
    // What the sample does not say yet is written as it is without a choice.
    const json fresh = json::parse(projectToJson(Project{}))["heightfield"];
    for (const char* key : {"clearance", "classes"})
        expected["heightfield"][key] = fresh[key];
    EXPECT_EQ(json::parse(projectToJson(*read)), expected);
}

TEST(ProjectJson, IsAFixedPointAfterOneRoundTrip) {
    const std::string once = projectToJson(*projectFromJson(versionOne(), "a"));
    const std::string twice = projectToJson(*projectFromJson(once, "a"));
    EXPECT_EQ(once, twice);
    EXPECT_EQ(once.back(), '\n');
}

TEST(ProjectJson, KeepsTheExtraKeysOfAProbeThatMovedInTheList) {
    auto project = *projectFromJson(versionOne(), "a");
    project.probes.insert(project.probes.begin(), {"p000", {1, 2, 3}, std::nullopt, false});
    const json written = json::parse(projectToJson(project));
    EXPECT_FALSE(written["probes"][0].contains("note"));
    EXPECT_EQ(written["probes"][1]["note"], "by hand");
}

TEST(ProjectJson, FillsDefaultsForWhatIsAbsent) {
    const auto project = projectFromJson(minimal().dump(), "a");
    ASSERT_TRUE(project.has_value());
    EXPECT_EQ(project->tuning, MemSettings{});
    EXPECT_EQ(project->bake, BakeSettings{});
    EXPECT_TRUE(project->generatedGround);
    EXPECT_FALSE(project->frame.crs.has_value());
}

TEST(ProjectJson, RefusesTextThatIsNoProject) {
    expectRefusal("", ErrorCode::Unreadable, "not JSON");
    expectRefusal("{\"schema\": \"reflet-pro", ErrorCode::Unreadable, "not JSON");
    expectRefusal("[1, 2]", ErrorCode::Unreadable, "not a Reflet project");
    expectRefusal("{\"type\": \"CityJSON\"}", ErrorCode::Unreadable, "not a Reflet project");
    expectRefusal(std::string(100'000, '['), ErrorCode::Unreadable, "not JSON");
}

TEST(ProjectJson, RefusesANewerSchemaVersionAndNamesBoth) {
    expectRefusal(with("/version", 2), ErrorCode::Refused,
                  "schema version 2, this Reflet knows up to 1");
    expectRefusal(with("/version", "1"), ErrorCode::Unreadable, "/version");
    expectRefusal(with("/version", 0), ErrorCode::Unreadable, "/version");
}

TEST(ProjectJson, NamesTheJsonPointerOfAWrongValue) {
    expectRefusal(with("/exposure", "bright"), ErrorCode::Unreadable,
                  "/exposure should be a number");
    expectRefusal(with("/bake/resolution", 16), ErrorCode::Unreadable,
                  "/bake/resolution should be a whole number from 32 to 2048");
    expectRefusal(with("/bake/resolution", 128.5), ErrorCode::Unreadable, "/bake/resolution");
    expectRefusal(with("/tuning/interpolation", "cubic"), ErrorCode::Unreadable,
                  "/tuning/interpolation");
    expectRefusal(with("/tuning/weighting", "best"), ErrorCode::Unreadable, "/tuning/weighting");
    expectRefusal(with("/tuning/probesPerVehicle", 9), ErrorCode::Unreadable,
                  "/tuning/probesPerVehicle");
    expectRefusal(with("/tuning/errorBound", -1), ErrorCode::Unreadable, "/tuning/errorBound");
    expectRefusal(with("/light/date", "tomorrow"), ErrorCode::Unreadable, "/light/date");
    expectRefusal(with("/crs/origin", {0, 0}), ErrorCode::Unreadable,
                  "/crs/origin should be three finite numbers");
    expectRefusal(with("/probes", 7), ErrorCode::Unreadable, "/probes should be a list of objects");
    expectRefusal(with("/models", {{{"lod", "2"}}}), ErrorCode::Unreadable, "/models/0/path");
    expectRefusal(with("/models", {{{"path", "a"}, {"bbox", {1, 2, 3}}}}), ErrorCode::Unreadable,
                  "/models/0/bbox");
}

TEST(ProjectJson, RefusesIdsThatAreTakenAndPositionsFromOuterSpace) {
    const json probe{{"id", "p1"}, {"position", {0, 0, 0}}};
    expectRefusal(with("/probes", {probe, probe}), ErrorCode::Unreadable, "\"p1\" is taken");
    expectRefusal(with("/probes", {{{"id", "p1"}, {"position", {1e300, 0, 0}}}}),
                  ErrorCode::Unreadable, "/probes/0/position");
}

TEST(ProjectJson, RefusesARouteThatGoesNowhereAndAVehicleWithoutItsRoute) {
    expectRefusal(with("/routes", {{{"id", "r"}, {"points", {{1, 1, 0}, {1, 1, 5}}}}}),
                  ErrorCode::Unreadable,
                  "/routes/0/points should be at least two different places");
    expectRefusal(with("/reflectors", {{{"id", "t"}, {"route", "absent"}}}), ErrorCode::Unreadable,
                  "/reflectors/0/route should be the id of a route");
}

TEST(ProjectJson, KeepsWhatEachClassCountsAsInTheHeightfield) {
    Project project;
    project.heightfield.rules.clearance = 2.25;
    auto& policies = project.heightfield.rules.policies;
    for (std::size_t n = 0; n < policies.size(); ++n)
        policies[n] = HeightPolicy((n * 3 + 1) % kHeightPolicyCount);
    const auto again = projectFromJson(projectToJson(project), "test");
    ASSERT_TRUE(again.has_value()) << again.error().message();
    EXPECT_EQ(again->heightfield, project.heightfield);
}

TEST(ProjectJson, AProjectThatDoesNotSayWhatClassesCountAsHasTheDefaults) {
    const auto project = projectFromJson(R"({"schema": "reflet-project", "version": 1,
                            "heightfield": {"classes": {"Bridge": "solid", "Airship": "float"}}})",
                                         "test");
    ASSERT_TRUE(project.has_value()) << project.error().message();
    HeightRules expected;
    expected.policies[std::size_t(CityObjectType::Bridge)] = HeightPolicy::Solid;
    EXPECT_EQ(project->heightfield.rules, expected);
    // A class that this version does not know is kept.
    EXPECT_NE(projectToJson(*project).find("Airship"), std::string::npos);
}

TEST(ProjectJson, RefusesAPolicyThatDoesNotExist) {
    for (const std::string value : {"\"arch\"", "3", "null", "{}"}) {
        const auto project = projectFromJson(R"({"schema": "reflet-project", "version": 1,
                                "heightfield": {"classes": {"Bridge": )" +
                                                 value + "}}}",
                                             "test");
        ASSERT_FALSE(project.has_value()) << value;
        EXPECT_NE(project.error().message().find("/heightfield/classes/Bridge"), std::string::npos)
            << project.error().message();
    }
}

}  // namespace
}  // namespace reflet
