// SPDX-License-Identifier: GPL-3.0-or-later
// Registers of trees as cities publish them.
#include "core/heightfield/HeightfieldBuilder.h"
#include "importers/FormatRegistry.h"
#include "importers/footprints/FootprintImporter.h"
#include "importers/osm/OsmImporter.h"
#include "importers/trees/TreeFields.h"
#include "tests/support/ClosedCity.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/unit/importers/footprints/FootprintText.h"

#include <GeographicLib/UTMUPS.hpp>
#include <cmath>

namespace reflet {
namespace {

using namespace test;

std::string point(double x, double y) {
    return fmt::format(R"({{"type": "Point", "coordinates": [{:.8f}, {:.8f}]}})", x, y);
}

Result<Imported<CityImport>> csv(const std::string& text, const ImportOptions& options = {}) {
    return importFootprintBytes(text, "trees.csv", options, {});
}

Box boxOf(const CityModel& city, const std::string& id) {
    Box box;
    for (const CityTriangle& t : city.triangles) {
        if (city.objects[city.surfaces[t.surface].object].id != id)
            continue;
        for (const std::uint32_t v : t.vertex)
            box.add(glm::dvec3(city.vertices[v]));
    }
    return box;
}

TEST(TreeRegister, EachPointIsATreeOfItsHeightAndCrownWhereItStands) {
    const auto result = imported(collection(
        {feature(point(85000, 446000), R"({"baumid": "A1", "baumhoehe": 12, "kronedurch": 8})"),
         feature(point(85020, 446000),
                 R"({"baumid": "A2", "baumhoehe": 20.5, "kronedurch": 6})")}));
    ASSERT_EQ(result.value.city.objects.size(), 2U);
    EXPECT_EQ(result.counts.loaded, 2U);
    EXPECT_EQ(result.value.city.objects[0].type, CityObjectType::SolitaryVegetation);
    EXPECT_EQ(result.value.aboveGround, (std::vector<std::uint32_t>{0, 1}));
    const glm::dvec3 origin = result.value.city.frame.origin;
    const Box a = boxOf(result.value.city, "A1");
    EXPECT_NEAR(a.min.z, 0.0, 1e-4);
    EXPECT_NEAR(a.max.z, 12.0, 1e-4);
    // An ellipsoid of eight sides and five bands is widest at its equator's nearest rings.
    EXPECT_NEAR(a.size().x, 8.0 * std::sin(0.4 * kPi), 1e-3);
    EXPECT_NEAR(0.5 * (a.min.x + a.max.x) + origin.x, 85000.0, 1e-3);
    EXPECT_NEAR(0.5 * (a.min.y + a.max.y) + origin.y, 446000.0, 1e-3);
    EXPECT_NEAR(boxOf(result.value.city, "A2").max.z, 20.5, 1e-4);
}

TEST(TreeRegister, TrunkAndCrownAreClosedAndFaceOutward) {
    const auto result = imported(
        collection({feature(point(85000, 446000), R"({"height": 12, "crown_diameter": 8})"),
                    feature(point(85050, 446000),
                            R"({"height": 12, "crown_diameter": 8, "species": "Picea abies"})")}));
    const CityModel& city = result.value.city;
    ASSERT_EQ(city.objects.size(), 2U);
    EXPECT_EQ(openEdges(city), 0U);
    std::array<double, 2> volume{};
    for (const CityTriangle& t : city.triangles) {
        const glm::dvec3 a(city.vertices[t.vertex[0]]), b(city.vertices[t.vertex[1]]),
            c(city.vertices[t.vertex[2]]);
        volume[city.surfaces[t.surface].object] += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    // Of the ellipsoid of the crown, 4 m wide and 8 m high over a third of the height, the body of
    // eight sides and five bands fills 80 to 100 %; a cone has half of that and less.
    const double ellipsoid = 4.0 / 3.0 * kPi * 4.0 * 4.0 * 4.0;
    EXPECT_GT(volume[0], 0.75 * ellipsoid);
    EXPECT_LT(volume[0], 1.01 * ellipsoid);
    EXPECT_GT(volume[1], 0.2 * ellipsoid);
    EXPECT_LT(volume[1], 0.8 * volume[0]) << "a conifer is pointed";
}

TEST(TreeRegister, AVehicleDrivesUnderTheCrown) {
    auto result = imported(collection(
        {feature(point(85000.25, 446000.25), R"({"height": 15, "crown_diameter": 12})")}));
    CityModel& city = result.value.city;
    CityObject ground;
    ground.id = "ground";
    ground.type = CityObjectType::TinRelief;
    city.objects.push_back(ground);
    const auto first = std::uint32_t(city.vertices.size());
    const glm::dvec3 middle(85000.25 - city.frame.origin.x, 446000.25 - city.frame.origin.y, 0.0);
    for (const glm::dvec3 corner : {glm::dvec3(-20, -20, 0), glm::dvec3(20, -20, 0),
                                    glm::dvec3(20, 20, 0), glm::dvec3(-20, 20, 0)})
        city.vertices.emplace_back(middle + corner);
    city.surfaces.push_back({1, SurfaceType::Unknown, kNone, kNone, false});
    const auto surface = std::uint32_t(city.surfaces.size() - 1);
    city.triangles.push_back({{first, first + 1, first + 2}, surface});
    city.triangles.push_back({{first, first + 2, first + 3}, surface});
    HeightfieldSettings settings;
    settings.cellSize = 0.5;
    const auto grid = gridFor(city, settings);
    ASSERT_TRUE(grid) << grid.error().message();
    const auto field = buildHeightfield(city, *grid, {});
    ASSERT_TRUE(field) << field.error().message();
    // 3 m from the trunk: ground, air, then the crown, whose lowest point is at 5 m.
    const int i = grid->column(middle.x + 3.0), j = grid->row(middle.y);
    const std::size_t cell = grid->index(i, j);
    EXPECT_NEAR(field->ground[cell], 0.0, 1e-3);
    EXPECT_LT(field->standingTop(cell), 0.5F) << "nothing stands there";
    EXPECT_GT(field->topMax[cell], 10.0F) << "the crown hangs over it";
}

TEST(TreeRegister, FillsInWhatIsMissingAndSaysSo) {
    const auto result = imported(
        collection({feature(point(85000, 446000), R"({"id": "none"})"),
                    feature(point(85020, 446000), R"({"id": "crown", "crown_diameter": 10})"),
                    feature(point(85040, 446000), R"({"id": "zero", "height": 0})"),
                    feature(point(85060, 446000), R"({"id": "odd", "height": "tall"})")}));
    const CityModel& city = result.value.city;
    EXPECT_NEAR(boxOf(city, "none").max.z, 10.0, 1e-4);
    EXPECT_NEAR(boxOf(city, "crown").max.z, 16.0, 1e-4);
    EXPECT_NEAR(boxOf(city, "zero").max.z, 10.0, 1e-4);
    const Diagnostic* assumed = remark(result.diagnostics, "tree-height-assumed");
    ASSERT_NE(assumed, nullptr);
    EXPECT_TRUE(assumed->text.starts_with("4 of 4 trees")) << assumed->text;
    const Diagnostic* unreadable = remark(result.diagnostics, "tree-size-unreadable");
    ASSERT_NE(unreadable, nullptr);
    EXPECT_TRUE(unreadable->text.starts_with("1 heights")) << unreadable->text;
    ImportOptions options;
    options.defaultHeight = 7.5;
    EXPECT_NEAR(
        boxOf(imported(collection({feature(point(85000, 446000))}), options).value.city, "0").max.z,
        7.5, 1e-4);
    options.strict = true;
    const auto refused =
        importFootprintBytes(collection({feature(point(85000, 446000))}), "t.geojson", options, {});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::Refused);
}

TEST(TreeRegister, TheUserNamesTheAttributesAndIsToldWhichThereAre) {
    const std::string text = collection({feature(
        point(85000, 446000), R"({"id": "t", "height": 3, "top": 21, "w": 5, "crown": 9})")});
    ImportOptions options;
    options.heightField = "top";
    options.crownField = "w";
    const Box box = boxOf(imported(text, options).value.city, "t");
    EXPECT_NEAR(box.max.z, 21.0, 1e-4);
    EXPECT_NEAR(box.size().x, 5.0 * std::sin(0.4 * kPi), 1e-3);
    options.crownField = "width";
    const auto wrong = importFootprintBytes(text, "t.geojson", options, {});
    ASSERT_FALSE(wrong);
    EXPECT_EQ(wrong.error().code, ErrorCode::Usage);
    EXPECT_NE(wrong.error().remedy.find("top"), std::string::npos) << wrong.error().remedy;
}

TEST(TreeRegister, ReadsTablesWithCoordinatesInTheirColumns) {
    // Longitude and latitude are brought into the UTM zone, as GeographicLib has it.
    const auto berlin = csv("standortnr;baumhoehe;lon;lat\nB1;14,5;13.40;52.52\nB2;;13.41;52.52\n");
    ASSERT_TRUE(berlin) << berlin.error().message();
    ASSERT_EQ(berlin->value.city.objects.size(), 2U);
    int zone = 0;
    bool north = false;
    double x = 0.0, y = 0.0;
    GeographicLib::UTMUPS::Forward(52.52, 13.40, zone, north, x, y);
    const Box box = boxOf(berlin->value.city, "B1");
    const glm::dvec3 origin = berlin->value.city.frame.origin;
    EXPECT_NEAR(0.5 * (box.min.x + box.max.x) + origin.x, x, 0.01);
    EXPECT_NEAR(0.5 * (box.min.y + box.max.y) + origin.y, y, 0.01);
    EXPECT_NEAR(box.max.z, 14.5, 1e-4);
    // In a system of the city's own: by --crs.
    ImportOptions options;
    options.crs = "EPSG:25833";
    const auto metres = csv("id,Rechtswert,Hochwert,height\n1,391780.5,5820150.25,9\n", options);
    ASSERT_TRUE(metres) << metres.error().message();
    EXPECT_EQ(metres->value.summary.crsHorizontal, "EPSG:25833");
    const Box there = boxOf(metres->value.city, "1");
    EXPECT_NEAR(0.5 * (there.min.x + there.max.x) + metres->value.city.frame.origin.x, 391780.5,
                1e-3);
    // Paris writes both into one column, New York as WKT.
    const auto paris = csv("IDBASE;HAUTEUR (m);geo_point_2d\n17;8;\"48.8566, 2.3522\"\n");
    ASSERT_TRUE(paris) << paris.error().message();
    EXPECT_NEAR(boxOf(paris->value.city, "17").max.z, 8.0, 1e-4);
    GeographicLib::UTMUPS::Forward(48.8566, 2.3522, zone, north, x, y);
    EXPECT_NEAR(boxOf(paris->value.city, "17").center().x + paris->value.city.frame.origin.x, x,
                0.05);
    const auto newYork = csv("tree_id,tree_dbh,the_geom\n180683,20,POINT (-73.8442 40.7230)\n");
    ASSERT_TRUE(newYork) << newYork.error().message();
    EXPECT_EQ(newYork->value.city.objects[0].id, "180683");
}

TEST(TreeRegister, ARowWithoutAPlaceCostsNothingButItself) {
    const auto result =
        csv("id,lon,lat,height\nA,13.40,52.52,9\nB,,,9\nC,east,52.5,9\nA,13.41,52.52,9\n");
    ASSERT_TRUE(result) << result.error().message();
    EXPECT_EQ(result->counts.loaded, 2U);
    EXPECT_EQ(result->counts.skipped, 2U);
    const auto& objects = result->value.city.objects;
    ASSERT_EQ(objects.size(), 2U);
    EXPECT_EQ(objects[0].id, "A");
    EXPECT_NE(objects[1].id, "A") << "an id is given once";
    ASSERT_EQ(result->value.summary.remarked.size(), 2U);
    EXPECT_EQ(result->value.summary.remarked[0].id, "B");
    EXPECT_EQ(result->value.summary.remarked[0].result, ObjectResult::Skipped);
}

TEST(TreeRegister, ATableWithoutAnyPlaceIsRefusedWithTheColumnsThatWouldDo) {
    const auto result = csv("name,height\nlime,9\n");
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::Unreadable);
    EXPECT_NE(result.error().remedy.find("lon and lat"), std::string::npos);
    EXPECT_FALSE(csv("")) << "an empty file";
}

TEST(TreeRegister, PolygonsBesidePointsStayFootprints) {
    const auto result = imported(collection(
        {feature(rectangle(85000, 446000), R"({"height": 5})"), feature(point(85050, 446000))}));
    ASSERT_EQ(result.value.city.objects.size(), 1U);
    EXPECT_EQ(result.value.city.objects[0].type, CityObjectType::Building);
}

TEST(TreeRegister, ATableIsKnownByItsName) {
    const TemporaryFolder folder;
    folder.write("Baumkataster.CSV", "id;lon;lat\n1;13.4;52.5\n");
    const auto format = cityFormatOf(folder / "Baumkataster.CSV");
    ASSERT_TRUE(format) << format.error().message();
    EXPECT_EQ((*format)->name, "CSV");
}

TEST(TreeRegister, NodesOfOpenStreetMapAreTreesBesideItsBuildings) {
    const std::string osm = R"(<?xml version='1.0'?><osm version='0.6'>
      <node id="1" lat="53.55" lon="9.99"><tag k="natural" v="tree"/><tag k="height" v="18"/>
        <tag k="diameter_crown" v="9"/><tag k="leaf_type" v="needleleaved"/></node>
      <node id="2" lat="53.5501" lon="9.99"><tag k="natural" v="tree"/></node>
      <node id="3" lat="53.5502" lon="9.99"><tag k="highway" v="crossing"/></node>
      <node id="4" lat="53.5510" lon="9.99"/><node id="5" lat="53.5510" lon="9.991"/>
      <node id="6" lat="53.5512" lon="9.991"/>
      <way id="7"><nd ref="4"/><nd ref="5"/><nd ref="6"/><nd ref="4"/>
        <tag k="building" v="yes"/><tag k="height" v="6"/></way></osm>)";
    const auto result = importOsmBytes(osm, "town.osm", {}, {});
    ASSERT_TRUE(result) << result.error().message();
    EXPECT_EQ(result->value.summary.byType.at("SolitaryVegetationObject"), 2U);
    EXPECT_EQ(result->value.summary.byType.at("Building"), 1U);
    const Box box = boxOf(result->value.city, "node/1");
    EXPECT_NEAR(box.max.z, 18.0, 1e-3);
    EXPECT_NEAR(box.size().x, 9.0, 0.01);
    const Diagnostic* said = remark(result->diagnostics, "tree-size-assumed");
    ASSERT_NE(said, nullptr);
    EXPECT_TRUE(said->text.starts_with("of 2 trees 1 say")) << said->text;
    const auto street = importOsmBytes(
        "<osm version='0.6'><node id='1' lat='53.55' lon='9.99'><tag k='natural' v='tree'/></node>"
        "</osm>",
        "trees.osm", {}, {});
    ASSERT_TRUE(street) << street.error().message();
    EXPECT_EQ(street->value.city.objects.size(), 1U) << "trees alone are a city too";
}

TEST(TreeSizes, AreReadAsCitiesWriteThem) {
    using trees::parseSize;
    EXPECT_EQ(parseSize("12"), 12.0);
    EXPECT_EQ(parseSize("12,5 m"), 12.5);
    EXPECT_EQ(parseSize("6-10 m"), 8.0);
    EXPECT_EQ(parseSize("e. 15 tot 18 m."), 16.5);
    EXPECT_EQ(parseSize(">35"), 35.0);
    EXPECT_NEAR(parseSize("40 ft").value_or(0.0), 12.192, 1e-9);
    for (const char* none : {"", "0", "unbekannt", "-3", "1 2 3", "1e400", "..", "5000"})
        EXPECT_FALSE(parseSize(none)) << none;
}

TEST(TreeKinds, NeedlesAreToldByTheName) {
    for (const char* conifer : {"Pinus nigra", "PICEA ABIES", "Waldkiefer, Pinus sylvestris",
                                "Norway spruce", "needleleaved"})
        EXPECT_TRUE(trees::hasNeedles(conifer)) << conifer;
    for (const char* other : {"Tilia cordata", "Sapindus", "Pineapple tree", "", "Acer"})
        EXPECT_FALSE(trees::hasNeedles(other)) << other;
}

TEST(TreePlaces, AreReadInBothOrders) {
    const auto degrees = trees::parsePlace("48.85, 2.35");
    ASSERT_TRUE(degrees);
    EXPECT_EQ(*degrees, glm::dvec2(2.35, 48.85));
    const auto wkt = trees::parsePlace("POINT (2.35 48.85)");
    ASSERT_TRUE(wkt);
    EXPECT_EQ(*wkt, *degrees);
    for (const char* none : {"", "POINT", "POINT ()", "48.85", ")(", "a, b", "1, nan"})
        EXPECT_FALSE(trees::parsePlace(none)) << none;
}

}  // namespace
}  // namespace reflet
