// SPDX-License-Identifier: GPL-3.0-or-later
// What CityGML can say, in small: each case has an answer that is known beforehand.
#include "tests/unit/importers/CityGmlText.h"
#include "tests/unit/importers/CityJsonText.h"

#include <map>

namespace reflet {

using namespace test;

namespace {

std::string element(const std::string& name, const std::string& content,
                    const std::string& attributes = {}) {
    return "<" + name + (attributes.empty() ? "" : " " + attributes) + ">" + content + "</" + name +
           ">";
}

std::string lod1Box(double x, double y) {
    return element("bldg:lod1Solid", solidOf(boxFaces(x, y)));
}

std::map<SurfaceType, std::size_t> surfaceCounts(const CityModel& city) {
    std::map<SurfaceType, std::size_t> counts;
    for (const CitySurface& surface : city.surfaces)
        ++counts[surface.type];
    return counts;
}

/// The faces of a box as boundary surfaces: ground, roof and four walls with the faces' ids.
std::string boundaries(const std::string& id, const std::string& property,
                       const std::string& prefix, const std::string& geometry) {
    const auto faces = boxFaces(0, 0, id);
    const std::array<const char*, 6> types{"GroundSurface", "RoofSurface", "WallSurface",
                                           "WallSurface",   "WallSurface", "WallSurface"};
    std::string text;
    for (std::size_t i = 0; i < 6; ++i)
        text += element(property,
                        element(prefix + types[i], element(geometry, multiSurface({faces[i]}))));
    return text;
}

/// A solid whose faces are those of other geometries.
std::string solidOfReferences(const std::string& id) {
    std::string text;
    for (int i = 0; i < 6; ++i)
        text += fmt::format("<gml:surfaceMember xlink:href=\"#{}{}\"/>", id, i);
    return "<gml:Solid><gml:exterior><gml:CompositeSurface>" + text +
           "</gml:CompositeSurface></gml:exterior></gml:Solid>";
}

std::string tree(const std::string& id, double x, double y, const std::string& geometry) {
    return element(
        "cityObjectMember",
        element(
            "veg:SolitaryVegetationObject",
            element(
                "veg:lod2ImplicitRepresentation",
                element("ImplicitGeometry",
                        element("transformationMatrix", "2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1") +
                            geometry +
                            element("referencePoint",
                                    element("gml:Point",
                                            element("gml:pos", fmt::format("{} {} 5", x, y)))))),
            "gml:id=\"" + id + "\""));
}

}  // namespace

class CityGmlVersions : public testing::TestWithParam<const char*> {};

TEST_P(CityGmlVersions, BoundarySurfacesGiveTheSameCityInEach) {
    const std::string version = GetParam();
    const bool three = version == "3.0";
    const auto result = importGml(cityGml(
        building("a", three ? boundaries("f", "boundary", "con:", "lod2MultiSurface")
                            : boundaries("f", "bldg:boundedBy", "bldg:", "bldg:lod2MultiSurface")),
        "EPSG:25832", version));
    const CityModel& city = result.value.city;
    EXPECT_EQ(result.value.summary.version, version);
    EXPECT_EQ(countsOf(result), "7 loaded, 0 repaired, 0 skipped");
    EXPECT_EQ(result.value.summary.byType,
              (std::map<std::string, std::size_t>{
                  {"Building", 1}, {"GroundSurface", 1}, {"RoofSurface", 1}, {"WallSurface", 4}}));
    EXPECT_EQ(surfaceCounts(city),
              (std::map<SurfaceType, std::size_t>{
                  {SurfaceType::Ground, 1}, {SurfaceType::Roof, 1}, {SurfaceType::Wall, 4}}));
    EXPECT_NEAR(enclosedVolume(city), 480.0, 1e-6);
    for (const CityObject& object : city.objects) {
        EXPECT_EQ(object.type, CityObjectType::Building);
        EXPECT_EQ(object.parent.has_value(), object.typeName != "Building");
    }
}

INSTANTIATE_TEST_SUITE_P(All, CityGmlVersions, testing::Values("1.0", "2.0", "3.0"),
                         [](const auto& version) { return std::string(version.param, 1); });

TEST(CityGml, ASolidOfReferencesAddsNothingToTheSurfacesItNames) {
    // The references come before what they name.
    const std::string content = element("bldg:lod2Solid", solidOfReferences("f")) +
                                boundaries("f", "bldg:boundedBy", "bldg:", "bldg:lod2MultiSurface");
    const auto result = importGml(cityGml(building("a", content)));
    EXPECT_EQ(result.value.city.triangles.size(), 12U);
    EXPECT_EQ(countsOf(result), "7 loaded, 0 repaired, 0 skipped");
}

TEST(CityGml, SurfacesOfAnotherMemberOrLevelAreCopied) {
    const std::string named =
        building("later", element("bldg:lod1Solid", solidOf(boxFaces(100, 0, "g"))));
    const std::string naming = building("first", element("bldg:lod2Solid", solidOfReferences("g")));
    const auto result = importGml(cityGml(naming + named));
    EXPECT_EQ(countsOf(result), "2 loaded, 0 repaired, 0 skipped");
    EXPECT_NEAR(enclosedVolume(result.value.city), 2 * 480.0, 1e-3);

    const auto levels =
        importGml(cityGml(building("a", element("bldg:lod1Solid", solidOf(boxFaces(0, 0, "h"))) +
                                            element("bldg:lod2Solid", solidOfReferences("h")))));
    EXPECT_NEAR(enclosedVolume(levels.value.city), 480.0, 1e-6);
    EXPECT_EQ(levels.value.summary.lods, std::vector<std::string>{"2"});
}

TEST(CityGml, AnObjectIsShownAtTheHighestLevelOfItselfAndItsSurfaces) {
    const std::string content =
        lod1Box(0, 0) + boundaries("f", "bldg:boundedBy", "bldg:", "bldg:lod2MultiSurface");
    const std::string text = cityGml(building("a", content));
    EXPECT_EQ(importGml(text).value.city.triangles.size(), 12U);
    EXPECT_EQ(importGml(text).value.summary.lods, std::vector<std::string>{"2"});
    ImportOptions low;
    low.lod = "1";
    const auto block = importGml(text, low);
    EXPECT_EQ(block.value.city.triangles.size(), 12U);
    EXPECT_EQ(block.value.city.objects.size(), 1U);
    ImportOptions none;
    none.lod = "3";
    EXPECT_EQ(gmlError(text, none).remedy, "It has: 1, 2.");
}

TEST(CityGml, ABoxKeepsWholeBuildings) {
    ImportOptions options;
    options.bbox = {-1.0, -1.0, 1.0, 1.0};  // touches one corner of the first
    const auto result = importGml(
        cityGml(building("a", boundaries("f", "bldg:boundedBy", "bldg:", "bldg:lod2MultiSurface")) +
                    building("b", lod1Box(50, 0)),
                ""),
        options);
    EXPECT_NEAR(enclosedVolume(result.value.city), 480.0, 1e-6);
    EXPECT_EQ(result.value.city.objects.size(), 7U);
    EXPECT_EQ(textOf(result, "filtered-by-box"), "1 objects outside the box were left out");
}

TEST(CityGml, ASurfaceOfTheOppositeOrientationIsTurned) {
    auto faces = boxFaces(0, 0);
    // Face 1 is written upside down and turned by the orientation.
    const std::string upsideDown = polygon({{0, 8, 6}, {10, 8, 6}, {10, 0, 6}, {0, 0, 6}});
    faces[1] = element("gml:OrientableSurface", element("gml:baseSurface", upsideDown),
                       "orientation=\"-\"");
    const auto result =
        importGml(cityGml(building("a", element("bldg:lod1Solid", solidOf(faces)))));
    EXPECT_NEAR(enclosedVolume(result.value.city), 480.0, 1e-6);
}

TEST(CityGml, HolesAreCutOut) {
    std::string wall = polygon({{0, 0, 0}, {10, 0, 0}, {10, 0, 10}, {0, 0, 10}});
    wall.insert(
        wall.find("</gml:Polygon>"),
        element("gml:interior", element("gml:LinearRing",
                                        element("gml:posList", "2 0 2 2 0 4 4 0 4 4 0 2 2 0 2"))));
    const auto result =
        importGml(cityGml(building("a", element("bldg:lod2MultiSurface", multiSurface({wall})))));
    EXPECT_NEAR(areaOf(result.value.city), 96.0, 1e-6);
    EXPECT_EQ(result.value.summary.triangles, 8U);
}

TEST(CityGml, CoordinatesAreReadInAllTheirSpellings) {
    const std::array<std::string, 5> rings{
        "<gml:posList srsDimension=\"2\">0 0 10 0 10 10 0 10 0 0</gml:posList>",
        "<gml:posList>0 0 0\n10 0 0 <!-- a corner --> 10 10 0 0 +10 0 0 0 0</gml:posList>",
        "<gml:pos>0 0 0</gml:pos><gml:pos>1e1 0 0</gml:pos><gml:pos>10 10 0</gml:pos>"
        "<gml:pos>0 10.0 0</gml:pos><gml:pos>0 0 0</gml:pos>",
        "<gml:coordinates>0,0,0 10,0,0 10,10,0 0,10,0 0,0,0</gml:coordinates>",
        "<gml:pointProperty><gml:Point><gml:pos>0 0 0</gml:pos></gml:Point></gml:pointProperty>"
        "<gml:pointProperty><gml:Point><gml:pos>10 0 0</gml:pos></gml:Point></gml:pointProperty>"
        "<gml:pointProperty><gml:Point><gml:pos>10 10 0</gml:pos></gml:Point></gml:pointProperty>"
        "<gml:pointProperty><gml:Point><gml:pos>0 10 0</gml:pos></gml:Point></gml:pointProperty>"
        "<gml:pointProperty><gml:Point><gml:pos>0 0 0</gml:pos></gml:Point></gml:pointProperty>"};
    for (const std::string& ring : rings) {
        const std::string surface =
            element("gml:Polygon", element("gml:exterior", element("gml:LinearRing", ring)));
        const auto result = importGml(
            cityGml(building("a", element("bldg:lod0FootPrint", multiSurface({surface})))));
        EXPECT_NEAR(areaOf(result.value.city), 100.0, 1e-6) << ring;
        EXPECT_EQ(countsOf(result), "1 loaded, 0 repaired, 0 skipped") << ring;
    }
}

TEST(CityGml, TemplatesArePlacedWhereverTheyAreWritten) {
    const std::string inside = "<relativeGMLGeometry><gml:MultiSurface gml:id=\"crown\">" +
                               members(boxFaces(0, 0)) +
                               "</gml:MultiSurface></relativeGMLGeometry>";
    const std::string named = "<relativeGMLGeometry xlink:href=\"#crown\"/>";
    const auto result = importGml(cityGml(tree("t1", 100, 0, named) + tree("t2", 200, 0, inside) +
                                          tree("t3", 300, 0, named)));
    const CityModel& city = result.value.city;
    EXPECT_EQ(countsOf(result), "3 loaded, 0 repaired, 0 skipped");
    EXPECT_EQ(result.value.summary.instances, 3U);
    EXPECT_EQ(result.value.summary.surfaces, 0U);
    EXPECT_EQ(result.value.summary.instanceTriangles, 36U);
    EXPECT_NEAR(enclosedVolume(city), 3 * 8 * 480.0, 1e-1);
    EXPECT_NEAR(city.bounds().min.x + city.frame.origin.x, 100.0, 1e-3);
    EXPECT_NEAR(city.bounds().max.x + city.frame.origin.x, 320.0, 1e-3);
    EXPECT_NEAR(city.bounds().min.z, 5.0, 1e-3);
    for (const CitySurface& surface : city.surfaces)
        EXPECT_TRUE(surface.instance);
}

TEST(CityGml, LibraryObjectsAreNotFetched) {
    const auto result =
        importGml(cityGml(tree("t", 0, 0, element("libraryObject", "file:///etc/passwd")) +
                          building("a", lod1Box(0, 0))));
    EXPECT_EQ(countsOf(result), "1 loaded, 0 repaired, 1 skipped");
    EXPECT_EQ(textOf(result, "library-object", "t"),
              "an instance of a model in another file was left out (1 in all): file:///etc/passwd");
}

TEST(CityGml, TerrainIsReadAsATin) {
    std::string patches;
    for (int i = 0; i < 4; ++i)
        patches += element(
            "gml:Triangle",
            element("gml:exterior",
                    element("gml:LinearRing",
                            element("gml:posList", fmt::format("{0} 0 0 {1} 0 0 {0} 10 0 {0} 0 0",
                                                               10 * i, 10 * i + 10)))));
    const auto result = importGml(cityGml(element(
        "cityObjectMember",
        element("dem:ReliefFeature",
                element("dem:lod", "1") +
                    element("dem:reliefComponent",
                            element("dem:TINRelief",
                                    element("dem:tin",
                                            element("gml:TriangulatedSurface",
                                                    element("gml:trianglePatches", patches)))))))));
    EXPECT_EQ(countsOf(result), "2 loaded, 0 repaired, 0 skipped");
    EXPECT_NEAR(areaOf(result.value.city), 200.0, 1e-6);
    for (const CitySurface& surface : result.value.city.surfaces)
        EXPECT_TRUE(isTerrain(result.value.city.objects[surface.object].type));
}

TEST(CityGml, MembersBeyondOneBatchComeIntoOneFrame) {
    std::string content;
    for (int i = 0; i < 2000; ++i)
        content += building("b" + std::to_string(i),
                            lod1Box(20 * i, 0) + "<!--" + std::string(4000, 'x') + "-->");
    const auto result = importGml(cityGml(content, ""));  // 12 MB
    EXPECT_EQ(countsOf(result), "2000 loaded, 0 repaired, 0 skipped");
    EXPECT_NEAR(enclosedVolume(result.value.city), 2000 * 480.0, 20.0);
    EXPECT_EQ(result.value.city.frame.origin.x, 20000.0);
}

}  // namespace reflet
