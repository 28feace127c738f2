// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/coverage/DrivableGround.h"
#include "tests/unit/reconstruction/BoxCity.h"

#include <gtest/gtest.h>

namespace reflet::test {
namespace {

/// Two rows of houses with a street of 10 m between them, and a block round a courtyard, of which
/// an alley of 2 m leads out.
BoxCity blocks() {
    BoxCity city(0.0, 0.0, 240, 160, 0.5);
    city.addBox(20.0, 20.0, 60.0, 30.0, 12.0F);
    city.addBox(20.0, 40.0, 60.0, 50.0, 12.0F);
    city.addBox(75.0, 20.0, 100.0, 25.0, 12.0F);
    city.addBox(75.0, 45.0, 100.0, 50.0, 12.0F);
    city.addBox(75.0, 20.0, 80.0, 50.0, 12.0F);
    city.addBox(95.0, 20.0, 100.0, 34.0, 12.0F);
    city.addBox(95.0, 36.0, 100.0, 50.0, 12.0F);
    return city;
}

bool at(const DrivableGround& ground, double x, double y) {
    return ground.cells[ground.grid.index(ground.grid.column(x), ground.grid.row(y))] != 0;
}

TEST(DrivableGroundTest, FindsStreetsAndLeavesOutCourtyardsAndWhatLiesTooNear) {
    const BoxCity city = blocks();
    const DrivableGround ground = drivableGround(city.heightfield(), {});
    EXPECT_FALSE(ground.modelled);
    EXPECT_TRUE(at(ground, 40.0, 35.0)) << "the street";
    EXPECT_TRUE(at(ground, 40.0, 32.0)) << "2 m from the houses";
    EXPECT_FALSE(at(ground, 40.0, 31.0)) << "1 m from the houses";
    EXPECT_FALSE(at(ground, 40.0, 25.0)) << "in a house";
    EXPECT_FALSE(at(ground, 87.0, 35.0)) << "the courtyard, whose way out is too narrow";
    EXPECT_FALSE(at(ground, 2.0, 2.0)) << "18 m outside of what is built";
    EXPECT_TRUE(at(ground, 10.0, 35.0));
    EXPECT_GT(ground.squareMetres(), 500.0);
    for (const glm::dvec3& place : ground.places(city.heightfield(), 4.0)) {
        EXPECT_TRUE(at(ground, place.x, place.y));
        EXPECT_EQ(place.z, 0.0);
    }
}

TEST(DrivableGroundTest, LeavesOutWhatIsTooSteep) {
    BoxCity city(0.0, 0.0, 240, 160, 0.5);
    city.addBox(20.0, 20.0, 60.0, 30.0, 12.0F);
    city.addBox(20.0, 50.0, 60.0, 60.0, 12.0F);
    Heightfield field = city.heightfield();
    // East of x = 40 the ground climbs by a fifth.
    for (int j = 0; j < field.grid.rows; ++j) {
        for (int i = 0; i < field.grid.columns; ++i) {
            const float up = 0.2F * float(std::max(0.0, field.grid.xMin(i) - 40.0));
            for (auto* layer : {&field.ground, &field.topMax, &field.topCenter})
                (*layer)[field.grid.index(i, j)] += up;
        }
    }
    const DrivableGround ground = drivableGround(field, {});
    EXPECT_TRUE(at(ground, 30.0, 40.0));
    EXPECT_FALSE(at(ground, 50.0, 40.0));
}

TEST(DrivableGroundTest, TakesTheRoadsOfTheModelWhereItHasThem) {
    const BoxCity city = blocks();
    CityModel model;
    CityObject road;
    road.type = CityObjectType::Road;
    model.objects.push_back(road);
    for (const SurfaceType type : {SurfaceType::TrafficArea, SurfaceType::AuxiliaryTrafficArea}) {
        CitySurface surface;
        surface.type = type;
        model.surfaces.push_back(surface);
    }
    // A carriageway in the street, a pavement beside it, and a carriageway through a house.
    const auto quad = [&](float x0, float y0, float x1, float y1, std::uint32_t surface) {
        const auto first = std::uint32_t(model.vertices.size());
        for (const glm::vec3& v : {glm::vec3(x0, y0, 0), glm::vec3(x1, y0, 0), glm::vec3(x1, y1, 0),
                                   glm::vec3(x0, y1, 0)})
            model.vertices.push_back(v);
        model.triangles.push_back({{first, first + 1, first + 2}, surface});
        model.triangles.push_back({{first, first + 2, first + 3}, surface});
    };
    quad(10.0F, 33.0F, 70.0F, 37.0F, 0);
    quad(10.0F, 37.0F, 70.0F, 39.0F, 1);
    quad(30.0F, 20.0F, 34.0F, 30.0F, 0);
    const DrivableGround ground = drivableGround(city.heightfield(), model);
    EXPECT_TRUE(ground.modelled);
    EXPECT_TRUE(at(ground, 40.25, 35.25));
    EXPECT_FALSE(at(ground, 40.25, 38.25)) << "the pavement";
    EXPECT_FALSE(at(ground, 32.25, 25.25)) << "a house stands there";
    EXPECT_NEAR(ground.squareMetres(), 240.0, 8.0);
}

TEST(DrivableGroundTest, ThereMayBeNone) {
    BoxCity city(0.0, 0.0, 20, 20, 0.5);
    city.addBox(0.0, 0.0, 10.0, 10.0, 8.0F);
    const DrivableGround ground = drivableGround(city.heightfield(), {});
    EXPECT_EQ(ground.count, 0U);
    EXPECT_TRUE(ground.places(city.heightfield(), 2.0).empty());
}

}  // namespace
}  // namespace reflet::test
