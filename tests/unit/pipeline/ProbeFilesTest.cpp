// SPDX-License-Identifier: GPL-3.0-or-later
// Probes that exist already, read from files of all kinds into a street of twelve houses.
#include "app/pipeline/Edit.h"
#include "app/pipeline/ProbeFiles.h"
#include "core/project/ProjectFile.h"
#include "tests/support/StreetProject.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace reflet {
namespace {

class ProbeFilesTest : public testing::Test {
protected:
    ProbeFilesTest() : file(folder / "street.reflet") {
        EXPECT_TRUE(test::importStreetWithCar(folder, file));
        auto opened = PreparedCity::open(file, {});
        EXPECT_TRUE(opened) << opened.error().message();
        city.emplace(std::move(*opened));
    }
    [[nodiscard]] std::vector<ImportedProbe> read(const std::filesystem::path& path) {
        remarks.clear();
        auto probes = readProbes(path, city->project().frame, remarks);
        EXPECT_TRUE(probes) << probes.error().message();
        return probes ? *probes : std::vector<ImportedProbe>{};
    }
    [[nodiscard]] ProbeImport import(const std::vector<ImportedProbe>& probes,
                                     bool movable = false) const {
        auto imported = withProbes(*city, probes, movable, {});
        EXPECT_TRUE(imported) << imported.error().message();
        return imported ? *imported : ProbeImport{};
    }
    static glm::dvec3 onRoad(double along, double aside = 0.0, double up = 1.75) {
        return {690'000.0 + along, 5'335'000.0 + aside, up};
    }
    [[nodiscard]] static std::vector<Probe> twoProbes() {
        return {{"a, \"b\"", onRoad(10.0), std::nullopt, true},
                {"c", onRoad(30.0, 1.0), 64, false}};
    }

    test::TemporaryFolder folder;
    std::filesystem::path file;
    std::optional<PreparedCity> city;
    std::vector<Diagnostic> remarks;
};

TEST_F(ProbeFilesTest, ReadsBackWhatItWritesInEachForm) {
    for (const char* name : {"p.csv", "p.json", "p.geojson", "p.gpkg"}) {
        const auto written = writeProbes(twoProbes(), city->project().frame, folder / name);
        ASSERT_TRUE(written) << written.error().message();
        const auto probes = read(folder / name);
        ASSERT_EQ(probes.size(), 2U) << name;
        EXPECT_TRUE(remarks.empty()) << name;
        for (std::size_t k = 0; k < 2; ++k) {
            EXPECT_EQ(probes[k].id, twoProbes()[k].id) << name;
            EXPECT_LT(glm::length(probes[k].position - twoProbes()[k].position), 0.002) << name;
        }
    }
    const auto other = writeProbes(twoProbes(), city->project().frame, folder / "p.shp");
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().code, ErrorCode::Usage);
}

TEST_F(ProbeFilesTest, ReadsTheProbesOfAnotherProjectWithTheirResolution) {
    Project other = city->project();
    other.probes = twoProbes();
    ASSERT_TRUE(saveProject(other, folder / "other.reflet"));
    const auto probes = read(folder / "other.reflet");
    ASSERT_EQ(probes.size(), 2U);
    EXPECT_EQ(probes[1].position, onRoad(30.0, 1.0));
    EXPECT_EQ(probes[1].resolution, 64);
}

TEST_F(ProbeFilesTest, BringsOtherSystemsIntoTheProjects) {
    // 690010, 5335000 of UTM zone 32 in degrees, by gdaltransform.
    const auto degrees =
        read(folder.write("d.csv", "id;lat;lon\np;48,1398547470985;11,554206990467\n"));
    ASSERT_EQ(degrees.size(), 1U);
    EXPECT_NEAR(degrees.front().position.x, 690'010.0, 0.001);
    EXPECT_NEAR(degrees.front().position.y, 5'335'000.0, 0.001);
    const auto grid = read(folder.write("g.csv", "id,x,y,epsg\np,690010,5335000,25832\n"));
    ASSERT_EQ(grid.size(), 1U);
    EXPECT_EQ(grid.front().position.x, 690'010.0);
    EXPECT_TRUE(std::isnan(grid.front().position.z));
    const auto json = read(folder.write(
        "p.json", R"({"crs": "EPSG:4326", "probes": [{"id": "p", "position": [11.5, 48.1, 7]}]})"));
    ASSERT_EQ(json.size(), 1U);
    EXPECT_NEAR(json.front().position.x, 686'000.0, 1000.0);
    EXPECT_EQ(json.front().position.z, 7.0);
}

TEST_F(ProbeFilesTest, LeavesOutWhatIsNoPointAndTellsIt) {
    const auto probes = read(folder.write("p.geojson", R"({"type":"FeatureCollection","features":[
        {"type":"Feature","properties":{"NAME":"a","up":4.5},
         "geometry":{"type":"Point","coordinates":[690010,5335000]}},
        {"type":"Feature","properties":{},
         "geometry":{"type":"LineString","coordinates":[[0,0],[1,1]]}},
        {"type":"Feature","properties":{},"geometry":null}]})"));
    ASSERT_EQ(probes.size(), 1U);
    EXPECT_EQ(probes.front().id, "a");
    EXPECT_EQ(probes.front().position, onRoad(10.0, 0.0, 4.5)) << "plainly no degrees";
    ASSERT_EQ(remarks.size(), 1U);
    EXPECT_EQ(remarks.front().code, "shapes-skipped");
    EXPECT_EQ(remarks.front().text.substr(0, 8), "2 shapes");
}

TEST_F(ProbeFilesTest, RefusesFilesWithoutProbes) {
    const auto refused = [&](const char* name, const char* text) {
        const auto probes = readProbes(folder.write(name, text), city->project().frame, remarks);
        EXPECT_FALSE(probes) << name;
        return probes ? Error{} : probes.error();
    };
    EXPECT_EQ(refused("a.csv", "x,y\nno,number\n").code, ErrorCode::Unreadable);
    EXPECT_EQ(refused("a.json", "{\"probes\": 3}").code, ErrorCode::Unreadable);
    EXPECT_EQ(refused("b.json", "{\"probes\": [{\"position\": [1]}, 4]}").code,
              ErrorCode::Unreadable);
    EXPECT_EQ(refused("a.reflet", "{}").code, ErrorCode::Unreadable);
    EXPECT_EQ(refused("a.gpkg", "no package").code, ErrorCode::Unreadable);
    const Error system = refused("b.csv", "x,y,epsg\n1,2,31999999\n");
    EXPECT_EQ(system.code, ErrorCode::Refused);
    EXPECT_EQ(system.subject, (folder / "b.csv").string());
    const auto absent = readProbes(folder / "absent.csv", city->project().frame, remarks);
    ASSERT_FALSE(absent);
    EXPECT_EQ(absent.error().code, ErrorCode::Unreadable);
    ProjectFrame local;
    const auto onEarth = readProbes(folder.write("c.csv", "lon,lat\n11,48\n"), local, remarks);
    ASSERT_FALSE(onEarth);
    EXPECT_EQ(onEarth.error().code, ErrorCode::Refused);
}

TEST_F(ProbeFilesTest, PutsThoseWithoutHeightAtTheMiddleOfABodyAndLocksThem) {
    const glm::dvec3 flat(onRoad(20.0).x, onRoad(20.0).y, std::nan(""));
    const ProbeImport imported = import({{"p", flat, std::nullopt, "line 2"}});
    ASSERT_EQ(imported.added, std::vector<std::string>{"p"});
    const Probe& probe = imported.project.probes.back();
    EXPECT_NEAR(probe.position.z, kProbeHeight, 1e-6);
    EXPECT_TRUE(probe.locked);
    EXPECT_EQ(imported.withoutHeight, 1U);
    EXPECT_FALSE(import({{"p", flat, std::nullopt, ""}}, true).project.probes.back().locked);
}

TEST_F(ProbeFilesTest, KeepsIdsWhereTheyAreFreeAndMakesOthersUnique) {
    const ProbeImport imported = import({{"p", onRoad(10.0), std::nullopt, "line 2"},
                                         {"p", onRoad(20.0), std::nullopt, "line 3"},
                                         {"", onRoad(30.0), std::nullopt, "line 4"},
                                         {"q", onRoad(20.0, 0.003), std::nullopt, "line 5"}});
    EXPECT_EQ(imported.added, (std::vector<std::string>{"p", "p-2", "probe-1"}));
    ASSERT_EQ(imported.remarks.size(), 2U);
    EXPECT_EQ(imported.remarks[0].code, "probe-renamed");
    EXPECT_EQ(imported.remarks[1].code, "probe-twice");
    EXPECT_EQ(imported.remarks[1].object, "q (line 5)");
}

TEST_F(ProbeFilesTest, TellsThoseInWallsWithTheNearestFreePlaceAndThoseOutside) {
    const ProbeImport imported = import({{"wall", onRoad(4.0, 7.0), std::nullopt, "line 2"},
                                         {"far", onRoad(4000.0), std::nullopt, "line 3"}});
    EXPECT_EQ(imported.added, std::vector<std::string>{"wall"});
    EXPECT_EQ(imported.inSolids, 1U);
    ASSERT_EQ(imported.remarks.size(), 2U);
    EXPECT_EQ(imported.remarks[0].code, "probe-in-solid");
    EXPECT_NE(imported.remarks[0].remedy.find("nearest free place"), std::string::npos);
    EXPECT_EQ(imported.remarks[1].code, "probe-outside");
    const auto all = withProbes(*city, {{"far", onRoad(4000.0), std::nullopt, ""}}, false, {});
    ASSERT_FALSE(all);
    EXPECT_EQ(all.error().code, ErrorCode::Refused);
}

}  // namespace
}  // namespace reflet
