// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/unit/importers/CityGmlText.h"
#include "tests/unit/importers/CityJsonText.h"

namespace reflet {

using namespace test;

namespace {

std::string squareOf(const std::string& id) {
    return polygon({{0, 0, 0}, {10, 0, 0}, {10, 0, 10}, {0, 0, 10}}, id);
}

std::string wallOf(const std::string& id, const std::string& more = {}) {
    return building("a", more + "<bldg:lod2MultiSurface>" + multiSurface({squareOf(id)}) +
                             "</bldg:lod2MultiSurface>");
}

std::string appearance(const std::string& theme, const std::string& data) {
    return "<app:Appearance><app:theme>" + theme + "</app:theme><app:surfaceDataMember>" + data +
           "</app:surfaceDataMember></app:Appearance>";
}

std::string texture(const std::string& image, const std::string& target,
                    const std::string& mapping) {
    return "<app:ParameterizedTexture><app:imageURI>" + image +
           "</app:imageURI><app:wrapMode>clamp</app:wrapMode><app:target uri=\"#" + target + "\">" +
           mapping + "</app:target></app:ParameterizedTexture>";
}

std::string ring(const std::string& id, const std::string& numbers) {
    return "<app:TexCoordList><app:textureCoordinates ring=\"#" + id + "\">" + numbers +
           "</app:textureCoordinates></app:TexCoordList>";
}

std::string beside(const std::string& content) {
    return "<app:appearanceMember>" + content + "</app:appearanceMember>";
}

/// The texture coordinate of the corner at (x, z).
glm::vec2 uvAt(const CityModel& city, double x, double z) {
    for (std::size_t t = 0; t < city.uv.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 p = glm::dvec3(city.vertices[city.triangles[t].vertex[k]]);
            if (p.x == x && p.z == z)
                return city.uv[t][k];
        }
    }
    ADD_FAILURE() << "no corner there";
    return {};
}

}  // namespace

TEST(CityGmlAppearance, TexturesLieOnTheirSurfaceWithCoordinatesOfItsRings) {
    for (const bool inside : {true, false}) {
        const std::string look =
            appearance("summer", texture("wall.jpg", "w", ring("w-r", "0 0 2 0 2 1 0 1 0 0")));
        const auto result =
            importGml(cityGml(inside ? wallOf("w", "<app:appearance>" + look + "</app:appearance>")
                                     : wallOf("w") + beside(look),
                              ""));
        const CityModel& city = result.value.city;
        ASSERT_EQ(city.surfaces.size(), 1U);
        ASSERT_EQ(city.textures.size(), 1U);
        EXPECT_EQ(city.surfaces[0].texture, 0U);
        EXPECT_EQ(city.textures[0].reference, "wall.jpg");
        EXPECT_FALSE(city.textures[0].repeat);
        EXPECT_EQ(uvAt(city, 10, 10), glm::vec2(2.0F, 1.0F));
        EXPECT_EQ(uvAt(city, 10, 0), glm::vec2(2.0F, 0.0F));
    }
}

TEST(CityGmlAppearance, OfSeveralThemesTheFirstThatKnowsTheSurfaceCounts) {
    const auto result = importGml(cityGml(
        wallOf("w") +
            beside(appearance("summer",
                              texture("other.jpg", "elsewhere", ring("x", "0 0 1 0 1 1 0 0")))) +
            beside(appearance("summer",
                              texture("summer.jpg", "w", ring("w-r", "0 0 1 0 1 1 0 1 0 0")))) +
            beside(appearance("winter",
                              texture("winter.jpg", "w", ring("w-r", "0 0 1 0 1 1 0 1 0 0")))),
        ""));
    ASSERT_EQ(result.value.city.textures.size(), 1U);
    EXPECT_EQ(result.value.city.textures[0].reference, "summer.jpg");
}

TEST(CityGmlAppearance, MaterialsHoldForAllThatIsInTheirTarget) {
    const std::string look = appearance(
        "colours",
        "<app:X3DMaterial><app:shininess>0.5</app:shininess><app:transparency>0.25"
        "</app:transparency><app:diffuseColor>1 0 0</app:diffuseColor><app:target>#m</app:target>"
        "</app:X3DMaterial></app:surfaceDataMember><app:surfaceDataMember>"
        "<app:X3DMaterial><app:isFront>false</app:isFront><app:diffuseColor>0 1 0"
        "</app:diffuseColor><app:target>#w1</app:target></app:X3DMaterial>"
        "</app:surfaceDataMember><app:surfaceDataMember><app:X3DMaterial><app:diffuseColor>0 0 1"
        "</app:diffuseColor><app:target>#w2</app:target></app:X3DMaterial>");
    const std::string surfaces = "<bldg:lod2MultiSurface><gml:MultiSurface gml:id=\"m\">" +
                                 members({squareOf("w1"), squareOf("w2")}) +
                                 "</gml:MultiSurface></bldg:lod2MultiSurface>";
    const auto result = importGml(cityGml(building("a", surfaces) + beside(look), ""));
    const CityModel& city = result.value.city;
    ASSERT_EQ(city.surfaces.size(), 2U);
    const CityMaterial& first = city.materials.at(city.surfaces[0].material);
    EXPECT_EQ(first.diffuse, glm::vec3(1.0F, 0.0F, 0.0F));
    EXPECT_EQ(first.shininess, 0.5F);
    EXPECT_EQ(first.transparency, 0.25F);
    EXPECT_EQ(city.materials.at(city.surfaces[1].material).diffuse, glm::vec3(0.0F, 0.0F, 1.0F));
}

TEST(CityGmlAppearance, AMatrixMapsPlacesToTextures) {
    const auto result = importGml(
        cityGml(wallOf("w") +
                    beside(appearance(
                        "summer", texture("wall.jpg", "w",
                                          "<app:TexCoordGen><app:worldToTexture>0.1 0 0 0  0 0 0.2 "
                                          "0  0 0 0 1</app:worldToTexture></app:TexCoordGen>"))),
                ""));
    EXPECT_EQ(uvAt(result.value.city, 10, 10), glm::vec2(1.0F, 2.0F));
    EXPECT_EQ(uvAt(result.value.city, 10, 0), glm::vec2(1.0F, 0.0F));
}

TEST(CityGmlAppearance, CoordinatesThatDoNotFitAreReportedAndLeftOut) {
    const auto result = importGml(cityGml(
        wallOf("w") +
            beside(appearance("summer", texture("wall.jpg", "w", ring("w-r", "0 0 1 0 1 1")))),
        ""));
    EXPECT_EQ(countsOf(result), "0 loaded, 1 repaired, 0 skipped");
    EXPECT_EQ(textOf(result, "texture-malformed"),
              "loaded without texture: 1 surface (no coordinate for each point of a ring)");
    EXPECT_EQ(result.value.city.surfaces.at(0).texture, kNone);
}

TEST(CityGmlAppearance, ImagesBeyondTheFolderAreNotFollowed) {
    const auto result = importGml(cityGml(
        wallOf("w") + beside(appearance("summer", texture("../../etc/passwd", "w",
                                                          ring("w-r", "0 0 1 0 1 1 0 1 0 0")))),
        ""));
    EXPECT_NE(findDiagnostic(result, "texture-outside"), nullptr);
    EXPECT_TRUE(result.value.city.textures.at(0).path.empty());
}

}  // namespace reflet
