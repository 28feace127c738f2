// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/FormatRegistry.h"
#include "importers/osm/OsmImporter.h"
#include "tests/support/ClosedCity.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/support/TestData.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <GeographicLib/UTMUPS.hpp>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <zlib.h>

namespace reflet {
namespace {

using namespace test;
namespace fs = std::filesystem;

/// OSM XML of nodes on a grid of 0.0001 degrees at 9.99 E, 53.55 N: about 6.6 m by 11.1 m.
class OsmText {
public:
    int node(int column, int row) {
        m_nodes += fmt::format(R"(<node id="{}" lat="{:.7f}" lon="{:.7f}"/>)", ++m_last,
                               53.55 + 1e-4 * row, 9.99 + 1e-4 * column);
        return m_last;
    }
    int way(const std::vector<int>& nodes, const std::string& tags) {
        m_ways += fmt::format(R"(<way id="{}">)", ++m_last);
        for (const int n : nodes)
            m_ways += fmt::format(R"(<nd ref="{}"/>)", n);
        m_ways += tags + "</way>\n";
        return m_last;
    }
    int box(int column, int row, int width, int height, const std::string& tags) {
        const int a = node(column, row), b = node(column + width, row),
                  c = node(column + width, row + height), d = node(column, row + height);
        return way({a, b, c, d, a}, tags);
    }
    int relation(const std::vector<std::pair<int, const char*>>& members, const std::string& tags) {
        m_relations += fmt::format(R"(<relation id="{}">)", ++m_last);
        for (const auto& [way, role] : members)
            m_relations += fmt::format(R"(<member type="way" ref="{}" role="{}"/>)", way, role);
        m_relations += tags + "</relation>\n";
        return m_last;
    }
    [[nodiscard]] std::string text() const {
        return "<?xml version='1.0'?><osm version='0.6'>\n" + m_nodes + m_ways + m_relations +
               "</osm>";
    }

private:
    int m_last = 0;
    std::string m_nodes, m_ways, m_relations;
};

std::string tag(const char* key, const char* value) {
    return fmt::format(R"(<tag k="{}" v="{}"/>)", key, value);
}

Imported<CityImport> imported(const OsmText& osm, const ImportOptions& options = {}) {
    auto result = importOsmBytes(osm.text(), "test.osm", options, {});
    if (!result) {
        ADD_FAILURE() << result.error().message();
        return {};
    }
    return *std::move(result);
}

const Diagnostic* remark(const std::vector<Diagnostic>& diagnostics, const std::string& code) {
    const auto found = std::find_if(diagnostics.begin(), diagnostics.end(),
                                    [&](const Diagnostic& d) { return d.code == code; });
    return found == diagnostics.end() ? nullptr : &*found;
}

/// Square metres of a box of the grid, on the grid of UTM zone 32.
double boxArea(int width, int height) {
    int zone = 0;
    bool north = false;
    double x0 = 0, y0 = 0, x1 = 0, y1 = 0, x2 = 0, y2 = 0;
    GeographicLib::UTMUPS::Forward(53.55, 9.99, zone, north, x0, y0);
    GeographicLib::UTMUPS::Forward(53.55, 9.99 + 1e-4 * width, zone, north, x1, y1);
    GeographicLib::UTMUPS::Forward(53.55 + 1e-4 * height, 9.99, zone, north, x2, y2);
    return std::abs((x1 - x0) * (y2 - y0) - (y1 - y0) * (x2 - x0));
}

TEST(OsmImporter, BuildsAHouseInTheUtmZone) {
    OsmText osm;
    const int way = osm.box(0, 0, 3, 1, tag("building", "yes") + tag("height", "8"));
    const auto result = imported(osm);
    const CityModel& city = result.value.city;
    EXPECT_EQ(city.frame.crs, "EPSG:32632");
    ASSERT_EQ(city.objects.size(), 1U);
    EXPECT_EQ(city.objects[0].id, fmt::format("way/{}", way));
    EXPECT_EQ(openEdges(city), 0U);
    EXPECT_NEAR(volume(city), boxArea(3, 1) * 8.0, 0.2);
    EXPECT_EQ(result.value.aboveGround.size(), 1U);
    EXPECT_NE(remark(result.diagnostics, "credit"), nullptr);
}

TEST(OsmImporter, PutsRingsTogetherFromWaysInAnyOrderAndDirection) {
    OsmText osm;
    const int a = osm.node(0, 0), b = osm.node(6, 0), c = osm.node(6, 4), d = osm.node(0, 4);
    const int first = osm.way({a, b, c}, ""), second = osm.way({a, d, c}, "");
    const int hole = osm.box(2, 1, 2, 2, "");
    osm.relation({{hole, "inner"}, {second, "outer"}, {first, "outer"}},
                 tag("type", "multipolygon") + tag("building", "yes") + tag("height", "10"));
    const auto result = imported(osm);
    EXPECT_EQ(result.counts.loaded, 1U);
    EXPECT_EQ(openEdges(result.value.city), 0U);
    EXPECT_NEAR(volume(result.value.city), (boxArea(6, 4) - boxArea(2, 2)) * 10.0, 2.0);
}

TEST(OsmImporter, AccountsForWhatIsMissingOrOpen) {
    OsmText osm;
    osm.box(0, 0, 2, 2, tag("building", "yes"));
    const int a = osm.node(5, 0), b = osm.node(7, 0), c = osm.node(7, 2), d = osm.node(5, 2);
    osm.way({a, b, 9999, c, d, a}, tag("building", "yes"));  // a node is missing: mended
    osm.way({a, b, c}, tag("building", "yes"));              // open: skipped
    osm.way({a, 9998, 9997, a}, tag("building", "yes"));     // nothing left: skipped
    osm.relation({{9996, "outer"}}, tag("type", "multipolygon") + tag("building", "yes"));
    osm.box(9, 0, 2, 2, tag("building", "yes") + tag("location", "underground"));
    const auto result = imported(osm);
    EXPECT_EQ(result.counts.loaded, 1U);
    EXPECT_EQ(result.counts.repaired, 1U);
    EXPECT_EQ(result.counts.skipped, 4U);
    EXPECT_EQ(openEdges(result.value.city), 0U);
    const Diagnostic* mended = remark(result.diagnostics, "footprint-repaired");
    ASSERT_NE(mended, nullptr);
    EXPECT_NE(mended->text.find("1 of its nodes"), std::string::npos) << mended->text;
}

TEST(OsmImporter, ShowsABuildingByItsPartsOnceTheyCoverIt) {
    OsmText osm;
    osm.box(0, 0, 6, 4, tag("building", "yes") + tag("height", "20"));
    osm.box(0, 0, 3, 4, tag("building:part", "yes") + tag("height", "8"));
    osm.box(3, 0, 3, 4, tag("building:part", "yes") + tag("height", "12") + tag("min_height", "4"));
    osm.box(10, 0, 6, 4, tag("building", "yes") + tag("height", "10"));
    osm.box(10, 0, 1, 1, tag("building:part", "yes") + tag("height", "15"));
    const auto result = imported(osm);
    const CityModel& city = result.value.city;
    ASSERT_EQ(city.objects.size(), 5U);
    EXPECT_EQ(result.value.summary.byType.at("BuildingPart"), 3U);
    EXPECT_EQ(city.objects[1].parent, 0U);
    EXPECT_EQ(city.objects[2].parent, 0U);
    EXPECT_EQ(city.objects[4].parent, 3U);
    EXPECT_NE(remark(result.diagnostics, "shown-by-parts"), nullptr);
    EXPECT_NEAR(volume(city),
                boxArea(3, 4) * (8.0 + 8.0) + boxArea(6, 4) * 10.0 + boxArea(1, 1) * 15.0, 5.0);
}

TEST(OsmImporter, BuildsGables) {
    OsmText osm;
    osm.box(0, 0, 4, 1,
            tag("building", "yes") + tag("height", "9") + tag("roof:shape", "gabled") +
                tag("roof:height", "3"));
    const auto result = imported(osm);
    EXPECT_EQ(result.value.city.objects.at(0).lod, "2");
    EXPECT_EQ(openEdges(result.value.city), 0U);
    EXPECT_NEAR(volume(result.value.city), boxArea(4, 1) * 7.5, 0.5);
}

TEST(OsmImporter, RefusesGuessedHeightsUnderStrict) {
    OsmText osm;
    osm.box(0, 0, 3, 1, tag("building", "yes"));
    ImportOptions options;
    options.strict = true;
    const auto result = importOsmBytes(osm.text(), "test.osm", options, {});
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::Refused);
}

Imported<SourceSummary> inspected(const fs::path& path) {
    auto result = inspectOsm(path, {}, {});
    if (!result) {
        ADD_FAILURE() << result.error().message();
        return {};
    }
    return *std::move(result);
}

TEST(OsmFiles, MonacoHasItsCounts) {
    const auto path = sharedData("osm/monaco.osm.pbf");
    if (!path)
        GTEST_SKIP() << kNoSharedData;
    const auto info = inspected(*path);
    const SourceSummary& s = info.value;
    EXPECT_EQ(s.format, "OpenStreetMap");
    EXPECT_EQ(s.crsHorizontal, "EPSG:4326");
    // 1183 ways and 24 relations with building=*; of the 15 ways with building:part=* one says
    // "no" or is a building too.
    // 415 nodes are trees, counted in the file's dense nodes without libosmium.
    EXPECT_EQ(s.byType.at("SolitaryVegetationObject"), 415U);
    EXPECT_EQ(s.byType.at("Building") + s.byType.at("BuildingPart") + 415U, s.objects);
    EXPECT_EQ(info.counts.loaded + info.counts.repaired + info.counts.skipped, s.objects);
    EXPECT_EQ(s.objects, 1183U + 24U + 13U + 415U);
    EXPECT_EQ(s.byType.at("Building"), 1183U + 24U);
    EXPECT_EQ(info.counts.skipped, 0U);
    EXPECT_EQ(info.counts.repaired, 1U);  // a ring of relation 11384697 crosses itself
    // Within the box of the nodes.
    EXPECT_GE(s.bounds.min.x, 7.4016897);
    EXPECT_GE(s.bounds.min.y, 43.5165358);
    EXPECT_LE(s.bounds.max.x, 7.5002447);
    EXPECT_LE(s.bounds.max.y, 43.7543341);

    auto result = importOsm(*path, {}, {});
    ASSERT_TRUE(result);
    EXPECT_EQ(result->value.city.frame.crs, "EPSG:32632");
    EXPECT_EQ(openEdges(result->value.city), 0U);
    EXPECT_GT(volume(result->value.city), 0.0);
}

TEST(OsmFiles, NuernbergHasItsCounts) {
    const auto path = sharedData("osm/nuernberg-laufamholz.osm");
    if (!path)
        GTEST_SKIP() << kNoSharedData;
    const auto info = inspected(*path);
    EXPECT_EQ(info.value.objects, 117U + 1U + 1U);  // buildings, and a tree
    EXPECT_EQ(info.counts.skipped, 0U);
    EXPECT_EQ(info.value.lods, (std::vector<std::string>{"1", "2"}));  // ten gables
    auto result = importOsm(*path, {}, {});
    ASSERT_TRUE(result);
    EXPECT_EQ(result->value.city.frame.crs, "EPSG:32632");
    EXPECT_EQ(openEdges(result->value.city), 0U);
}

TEST(OsmFiles, OfferTheirStreetsAsRoutes) {
    const auto path = sharedData("osm/nuernberg-laufamholz.osm");
    if (!path)
        GTEST_SKIP() << kNoSharedData;
    const ProjectFrame frame{"EPSG:32632", std::nullopt, glm::dvec3(656000, 5481000, 0)};
    const auto routes = readOsmRoutes(*path, frame, {});
    ASSERT_TRUE(routes);
    EXPECT_EQ(routes->trams, 0U);
    ASSERT_FALSE(routes->lines.empty());
    EXPECT_TRUE(std::any_of(routes->lines.begin(), routes->lines.end(), [](const GeoLine& line) {
        return line.name.find("Laufamholzstra") == 0;
    }));
    for (const GeoLine& line : routes->lines) {
        ASSERT_GE(line.points.size(), 2U);
        EXPECT_NEAR(line.points[0].x, 656000.0, 5000.0);
        EXPECT_NEAR(line.points[0].y, 5481000.0, 5000.0);
        EXPECT_TRUE(std::isnan(line.points[0].z));
    }
    const auto local = readOsmRoutes(*path, ProjectFrame{}, {});
    ASSERT_FALSE(local);
    EXPECT_EQ(local.error().code, ErrorCode::Refused);
}

TEST(OsmFiles, DamagedOnesGiveAnErrorOrNothing) {
    const auto folder = sharedData("bad/osm");
    if (!folder)
        GTEST_SKIP() << kNoSharedData;
    for (const char* name : {"broken-multipolygon.osm", "invalid-location.osm",
                             "missing-node-in-way.osm", "same-coordinate-nodes.osm"}) {
        const auto format = cityFormatOf(*folder / name);
        ASSERT_TRUE(format) << name;
        EXPECT_EQ((*format)->name, "OpenStreetMap") << name;
        const auto info = inspected(*folder / name);
        EXPECT_EQ(info.value.objects, 0U) << name;  // none of them has a building
    }
}

TEST(OsmFiles, CutOffAnywhereAreUnreadable) {
    OsmText osm;
    osm.box(0, 0, 3, 1, tag("building", "yes"));
    const std::string text = osm.text();
    for (std::size_t size = 1; size < text.size(); size += 37) {
        const auto result = importOsmBytes(text.substr(0, size), "cut.osm", {}, {});
        ASSERT_FALSE(result) << size;
        EXPECT_EQ(result.error().code, ErrorCode::Unreadable) << size;
    }
}

TEST(OsmFiles, PackedWithGzipAreTheSame) {
    OsmText osm;
    osm.box(0, 0, 3, 1, tag("building", "yes") + tag("height", "8"));
    const TemporaryFolder folder;
    const auto pack = [&](const std::string& name, const std::string& bytes) {
        const fs::path path = folder / name;
        gzFile out = gzopen(path.c_str(), "wb");
        EXPECT_EQ(gzwrite(out, bytes.data(), unsigned(bytes.size())), int(bytes.size()));
        gzclose(out);
        return path;
    };
    const fs::path packed = pack("town.osm.gz", osm.text());
    const auto format = cityFormatOf(packed);
    ASSERT_TRUE(format);
    EXPECT_EQ((*format)->name, "OpenStreetMap");
    const auto city = (*format)->read(packed, {}, {});
    ASSERT_TRUE(city) << city.error().message();
    EXPECT_EQ(city->value.city.vertices, imported(osm).value.city.vertices);
    // Cut off, it is damaged.
    const std::string bytes = bytesOf(packed);
    const auto cut =
        importOsm(folder.write("cut.osm.gz", bytes.substr(0, bytes.size() / 2)), {}, {});
    ASSERT_FALSE(cut);
    EXPECT_EQ(cut.error().code, ErrorCode::Unreadable);
    if (const auto monaco = sharedData("osm/monaco.osm.pbf")) {
        const auto plain = importOsm(*monaco, {}, {});
        const auto zipped = importOsm(pack("monaco.osm.pbf.gz", bytesOf(*monaco)), {}, {});
        ASSERT_TRUE(plain && zipped) << (zipped ? "" : zipped.error().message());
        EXPECT_EQ(zipped->value.city.vertices, plain->value.city.vertices);
    }
}

TEST(OsmFiles, OfDamagedBlocksAreUnreadable) {
    const auto path = sharedData("osm/monaco.osm.pbf");
    if (!path)
        GTEST_SKIP() << kNoSharedData;
    std::ifstream file(*path, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(file)), {});
    ASSERT_GT(bytes.size(), 100'000U);
    const auto cut = importOsmBytes(std::string_view(bytes).substr(0, 100'000), "cut.pbf", {}, {});
    ASSERT_FALSE(cut);
    EXPECT_EQ(cut.error().code, ErrorCode::Unreadable);
    std::fill(bytes.begin() + 2000, bytes.begin() + 4000, '\0');
    const auto damaged = importOsmBytes(bytes, "damaged.pbf", {}, {});
    ASSERT_FALSE(damaged);
    EXPECT_EQ(damaged.error().code, ErrorCode::Unreadable);
}

}  // namespace
}  // namespace reflet
