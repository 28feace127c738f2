// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/TemporaryFolder.h"
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

namespace {

/// A floor of 10 by 10 m at (500000, 5700000), by which the corner's coordinates are told.
std::string floorOf(const std::string& looks, bool northFirst = false) {
    std::vector<Corner> ring{
        {500000, 5700000, 3}, {500010, 5700000, 3}, {500010, 5700010, 3}, {500000, 5700010, 3}};
    for (Corner& corner : ring) {
        if (northFirst)
            std::swap(corner[0], corner[1]);
    }
    return cityGml(building("a", "<bldg:lod2MultiSurface>" + multiSurface({polygon(ring, "w")}) +
                                     "</bldg:lod2MultiSurface>") +
                       beside(appearance("summer", looks)),
                   northFirst ? "EPSG:31467" : "EPSG:25832");
}

std::string georeferenced(const std::string& more = {}) {
    return "<app:GeoreferencedTexture><app:imageURI>plan.bmp</app:imageURI>" + more +
           "<app:target>#w</app:target></app:GeoreferencedTexture>";
}

/// A BMP of 4 by 2 pixels of 24 bits.
std::string picture() {
    const auto word = [](std::uint32_t value) {
        return std::string{char(value & 255U), char(value >> 8U), 0, 0};
    };
    const std::string head = word(40) + word(4) + word(2) + std::string{1, 0, 24, 0} + word(0) +
                             word(24) + word(0) + word(0) + word(0) + word(0);
    return "BM" + word(54 + 24) + word(0) + word(54) + head + std::string(24, 'x');
}

/// The texture coordinate of the corner that lies most to the given side of the floor.
glm::vec2 uvTowards(const CityModel& city, const glm::dvec2& direction) {
    glm::vec2 best(-99.0F);
    double most = -1e9;
    for (std::size_t t = 0; t < city.uv.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 p(city.vertices[city.triangles[t].vertex[k]]);
            if (const double along = glm::dot(glm::dvec2(p), direction); along > most) {
                most = along;
                best = city.uv[t][k];
            }
        }
    }
    return best;
}

void expectUv(const CityModel& city, const glm::dvec2& direction, const glm::vec2& uv) {
    EXPECT_LT(glm::distance(uvTowards(city, direction), uv), 1e-5F);
}

bool isTold(const Imported<CityImport>& result, const std::string& code) {
    return std::any_of(result.diagnostics.begin(), result.diagnostics.end(),
                       [&](const Diagnostic& d) { return d.code == code; });
}

}  // namespace

TEST(CityGmlAppearance, AGeoreferencedTextureLiesWhereItSaysAndElseWhereItsImageSays) {
    TemporaryFolder folder;
    folder.write("plan.bmp", picture());
    // Pixels of 5 m: 20 by 10 m from (499990, 5700010) on, their first centre 2.5 m inside.
    const std::string inside =
        "<app:referencePoint><gml:Point><gml:pos>499992.5 5700007.5</gml:pos></gml:Point>"
        "</app:referencePoint><app:orientation>5 0 0 -5</app:orientation>";
    folder.write("city.gml", floorOf(georeferenced(inside)));
    const auto own = importCityGml(folder / "city.gml", {}, {});
    ASSERT_TRUE(own);
    EXPECT_TRUE(own->diagnostics.empty());
    expectUv(own->value.city, {-1, -1}, {0.5F, 0.0F});
    expectUv(own->value.city, {1, 1}, {1.0F, 1.0F});
    expectUv(own->value.city, {-1, 1}, {0.5F, 1.0F});
    // By its world file: the same, but 10 m further west; the order of the axes is the file's.
    folder.write("plan.wld", "5\n0\n0\n-5\n499982.5\n5700007.5\n");
    for (const bool northFirst : {false, true}) {
        folder.write("city.gml", floorOf(georeferenced(), northFirst));
        const auto outside = importCityGml(folder / "city.gml", {}, {});
        ASSERT_TRUE(outside);
        EXPECT_FALSE(isTold(*outside, "texture-missing"));
        expectUv(outside->value.city, {-1, -1}, {1.0F, 0.0F});
        expectUv(outside->value.city, {1, 1}, {1.5F, 1.0F});
    }
}

TEST(CityGmlAppearance, AGeoreferencedTextureWithoutAPlaceOrAnImageIsTold) {
    TemporaryFolder folder;
    folder.write("city.gml", floorOf(georeferenced()));
    const auto missing = importCityGml(folder / "city.gml", {}, {});
    ASSERT_TRUE(missing);
    EXPECT_TRUE(isTold(*missing, "texture-missing"));
    folder.write("plan.bmp", picture());
    const auto placeless = importCityGml(folder / "city.gml", {}, {});
    ASSERT_TRUE(placeless);
    ASSERT_EQ(placeless->diagnostics.size(), 1U);
    EXPECT_EQ(placeless->diagnostics[0].object, "a");
    EXPECT_NE(placeless->diagnostics[0].text.find("does not say where it lies"), std::string::npos);
    EXPECT_EQ(placeless->value.city.surfaces[0].texture, kNone);
    EXPECT_EQ(placeless->value.city.triangles.size(), 2U) << "the surface stays";
}

TEST(CityGmlAppearance, ATexturedSurfaceOfTheFirstCityGmlBringsItsLook) {
    const auto surface = [](const std::string& coordinates, const std::string& orientation) {
        return cityGml(
            building("a",
                     "<bldg:lod2MultiSurface>" +
                         multiSurface({"<TexturedSurface orientation=\"" + orientation +
                                       "\"><gml:baseSurface>" + squareOf("w") +
                                       "</gml:baseSurface><appearance><Material><diffuseColor>1 0 0"
                                       "</diffuseColor></Material></appearance><appearance>"
                                       "<SimpleTexture><textureMap>wall.jpg</textureMap>"
                                       "<textureCoordinates>" +
                                       coordinates +
                                       "</textureCoordinates><repeat>true</repeat></SimpleTexture>"
                                       "</appearance></TexturedSurface>"}) +
                         "</bldg:lod2MultiSurface>"),
            "", "1.0");
    };
    const auto result = importGml(surface("0 0 2 0 2 1 0 1 0 0", "+"));
    const CityModel& city = result.value.city;
    ASSERT_EQ(city.textures.size(), 1U);
    EXPECT_EQ(city.textures[0].reference, "wall.jpg");
    EXPECT_TRUE(city.textures[0].repeat);
    ASSERT_EQ(city.materials.size(), 1U);
    EXPECT_EQ(city.materials[0].diffuse, glm::vec3(1.0F, 0.0F, 0.0F));
    EXPECT_EQ(city.surfaces[0].texture, 0U);
    EXPECT_EQ(uvAt(city, 10, 10), glm::vec2(2.0F, 1.0F));
    EXPECT_EQ(uvAt(city, 10, 0), glm::vec2(2.0F, 0.0F));
    const auto normalOf = [](const CityModel& model) {
        const auto& t = model.triangles[0].vertex;
        const glm::vec3 a = model.vertices[t[0]];
        return glm::cross(glm::vec3(model.vertices[t[1]]) - a, glm::vec3(model.vertices[t[2]]) - a);
    };
    const auto turned = importGml(surface("0 0 2 0 2 1 0 1 0 0", "-"));
    EXPECT_LT(glm::dot(normalOf(city), normalOf(turned.value.city)), 0.0F);
    EXPECT_EQ(uvAt(turned.value.city, 10, 10), glm::vec2(2.0F, 1.0F));
    const auto broken = importGml(surface("0 0 2 0", "+"));
    EXPECT_EQ(broken.value.city.surfaces[0].texture, kNone);
    EXPECT_EQ(broken.value.city.surfaces[0].material, 0U) << "its colour stays";
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
