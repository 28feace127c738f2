// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/Picker.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reflet {
namespace {

class PickerTest : public testing::Test {
protected:
    PickerTest() {
        auto vehicle = std::make_shared<Vehicle>();
        VehicleBody body;  // 4.4 m long, 1.8 m wide, 1.5 m high
        body.vertices = {{-2.2F, -0.9F, 0.0F}, {2.2F, 0.9F, 1.5F}};
        vehicle->bodies = {body};
        PlacedReflector car;
        car.id = "car";
        car.vehicle = vehicle;
        car.poses = {RigidTransform::atHeading({0, 10, 0}, 0.25 * kPi)};
        cars = boxes.boxed(std::vector{car});
    }
    [[nodiscard]] std::optional<Picked> at(const glm::dvec2& pixel) const {
        return pick(view, {&probes, &routes, &cars}, pixel, 8.0);
    }
    [[nodiscard]] glm::dvec2 pixelOf(const glm::dvec3& point) const {
        return view.project(point).pixel;
    }

    ViewGeometry view{{{0, -20, 15}, {0, 5, 0}, 0.9}, 1000, 700};
    std::vector<ProbeGlyph> probes;
    std::vector<RouteGlyph> routes;
    ReflectorBoxes boxes;
    std::vector<BoxedReflector> cars;
};

TEST_F(PickerTest, FindsNothingWhereNothingIs) {
    EXPECT_FALSE(at({5, 5}));
    EXPECT_FALSE(at({900, 650}));
}

TEST_F(PickerTest, FindsAProbeByItsBallWithSomeReach) {
    probes.push_back({.id = "p", .position = {4, 3, 1.75}});
    const glm::dvec2 pixel = pixelOf({4, 3, 1.75});
    ASSERT_TRUE(at(pixel));
    EXPECT_EQ(at(pixel)->item(), (ProjectItem{ProjectItem::Kind::Probe, "p"}));
    EXPECT_TRUE(at(pixel + glm::dvec2(12, 0)));
    EXPECT_FALSE(at(pixel + glm::dvec2(60, 0)));
}

TEST_F(PickerTest, TakesTheNearerOfTwoProbesBehindOneAnother) {
    const Ray ray = view.ray({300, 300});
    probes.push_back({.id = "far", .position = ray.at(40)});
    probes.push_back({.id = "near", .position = ray.at(20)});
    ASSERT_TRUE(at({300, 300}));
    EXPECT_EQ(at({300, 300})->id, "near");
}

TEST_F(PickerTest, TakesTheProbeThatIsNearerToTheMouseOfTwoBesideOneAnother) {
    probes.push_back({.id = "left", .position = view.ray({300, 300}).at(20)});
    probes.push_back({.id = "right", .position = view.ray({340, 300}).at(60)});
    EXPECT_EQ(at({338, 301})->id, "right");
    EXPECT_EQ(at({301, 301})->id, "left");
}

TEST_F(PickerTest, DoesNotFindAProbeBehindTheCamera) {
    probes.push_back({.id = "p", .position = {0, -60, 20}});
    EXPECT_FALSE(at({500, 20}));
}

TEST_F(PickerTest, FindsACarByABoxThatTurnsWithIt) {
    const auto picked = at(pixelOf({0, 10, 0.7}));
    ASSERT_TRUE(picked);
    EXPECT_EQ(picked->kind, Picked::Kind::Reflector);
    EXPECT_EQ(picked->item(), (ProjectItem{ProjectItem::Kind::Reflector, "car"}));
    // Along its diagonal heading the car is long, across it is not.
    const glm::dvec3 down(0, 0, -1);
    EXPECT_NEAR(cars[0].hit({{1.4, 11.4, 9}, down}).value_or(0), 7.5, 1e-6);
    EXPECT_FALSE(cars[0].hit({{-1.4, 11.4, 9}, down}));
    EXPECT_EQ(cars[0].hit({{0, 10, 1}, down}), 0.0);
    EXPECT_NEAR(cars[0].bounds().max.x, 3.1 * std::sqrt(0.5), 1e-6);
}

TEST_F(PickerTest, PrefersAProbeInFrontOfACar) {
    probes.push_back({.id = "p", .position = {0, 10, 1.75}});
    EXPECT_EQ(at(pixelOf({0, 10, 1.75}))->kind, Picked::Kind::Probe);
}

TEST_F(PickerTest, FindsTheHandlesOfSelectedRoutesOnly) {
    RouteGlyph route{.id = "r", .line = {{-10, 0, 0}, {0, 0, 0}, {10, 2, 0}}, .handles = {}};
    route.handles = route.line;
    routes = {route};
    EXPECT_EQ(at(pixelOf({-10, 0, 0}))->kind, Picked::Kind::RouteLine);
    routes[0].selected = true;
    const auto handle = at(pixelOf({-10, 0, 0}));
    ASSERT_TRUE(handle);
    EXPECT_EQ(handle->kind, Picked::Kind::RouteHandle);
    EXPECT_EQ(handle->index, 0);
}

TEST_F(PickerTest, TellsWhereOnALineTheMouseIsAndBetweenWhichHandles) {
    RouteGlyph route{.id = "r", .line = {{-10, 0, 0}, {0, 0, 0}, {10, 2, 0}}, .handles = {}};
    route.handles = route.line;
    routes = {route};
    const auto first = at(pixelOf({-4, 0, 0}));
    ASSERT_TRUE(first);
    EXPECT_EQ(first->index, 1);
    EXPECT_LT(glm::distance(first->point, glm::dvec3(-4, 0, 0)), 1e-6);
    const auto second = at(pixelOf({5, 1, 0}));
    ASSERT_TRUE(second);
    EXPECT_EQ(second->index, 2);
    EXPECT_LT(glm::distance(second->point, glm::dvec3(5, 1, 0)), 1e-6);
}

TEST_F(PickerTest, FindsTheNearestStationOfALine) {
    const std::vector<glm::dvec3> line{{0, 0, 0}, {10, 0, 0}, {10, 20, 0}};
    EXPECT_NEAR(nearestStation(line, {4, 3, 9}), 4.0, 1e-9);
    EXPECT_NEAR(nearestStation(line, {14, 5, 0}), 15.0, 1e-9);
    EXPECT_NEAR(nearestStation(line, {10, 90, 0}), 30.0, 1e-9);
    EXPECT_EQ(nearestStation({}, {1, 2, 3}), 0.0);
}

}  // namespace
}  // namespace reflet
