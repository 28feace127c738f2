// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/BoxCity.h"
#include "widgets/viewport/input/PointDrag.h"

#include <gtest/gtest.h>

namespace reflet {
namespace {

using test::BoxCity;

class PointDragTest : public testing::Test {
protected:
    std::unique_ptr<PointDrag> drag(const glm::dvec2& pressed, PointDrag::Snap snap = {}) {
        return std::make_unique<PointDrag>(
            view, pressed, start, ground,
            [this](const glm::dvec3& place, DragPhase phase) {
                places.push_back(place);
                phases.push_back(phase);
            },
            std::move(snap));
    }
    [[nodiscard]] glm::dvec3 onPlane(const glm::dvec2& pixel, double z) const {
        const Ray ray = view.ray(pixel);
        return ray.at((z - ray.origin.z) / ray.direction.z);
    }

    ViewGeometry view{{{0, -30, 25}, {0, 0, 0}, 0.9}, 1000, 700};
    glm::dvec3 start{-5, 2, 1.75};
    std::shared_ptr<const Ground> ground = std::make_shared<const Ground>(BoxCity::make());
    std::vector<glm::dvec3> places;
    std::vector<DragPhase> phases;
};

TEST_F(PointDragTest, MovesAPointInTheLevelPlaneThroughIt) {
    const glm::dvec2 at = view.project(start).pixel;
    const auto dragging = drag(at);
    dragging->move(view, {at + glm::dvec2(70, 20)});
    dragging->move(view, {at + glm::dvec2(120, 40)});
    dragging->end();
    ASSERT_EQ(phases, (std::vector{DragPhase::Begin, DragPhase::Move, DragPhase::End}));
    EXPECT_LT(glm::distance(places[1], onPlane(at + glm::dvec2(120, 40), 1.75)), 1e-6);
    EXPECT_EQ(places[2], places[1]);
}

TEST_F(PointDragTest, KeepsThePlaceWhereThePointWasGrabbed) {
    const glm::dvec2 at = view.project(start).pixel;
    const auto dragging = drag(at + glm::dvec2(6, -4));
    dragging->move(view, {at + glm::dvec2(56, 26)});
    EXPECT_LT(glm::distance(places[0], onPlane(at + glm::dvec2(50, 30), 1.75)), 1e-6);
}

TEST_F(PointDragTest, MovesUpAndDownWithShiftAndKeepsThatHeight) {
    const glm::dvec2 at = view.project(start).pixel;
    const auto dragging = drag(at);
    dragging->move(view, {at + glm::dvec2(0, -30), true});
    EXPECT_EQ(places[0].x, start.x);
    EXPECT_EQ(places[0].y, start.y);
    EXPECT_GT(places[0].z, start.z + 0.5);
    const double height = places[0].z;
    dragging->move(view, {at + glm::dvec2(40, -30)});
    EXPECT_NEAR(places[1].z, height, 1e-9);
    dragging->move(view, {at + glm::dvec2(40, 300), true});
    EXPECT_GT(places[2].z, 0.0) << "the point went into the ground";
}

TEST_F(PointDragTest, GoesBackToWhereItWasWhenItIsCancelled) {
    const glm::dvec2 at = view.project(start).pixel;
    const auto dragging = drag(at);
    dragging->move(view, {at + glm::dvec2(70, 20)});
    dragging->cancel();
    ASSERT_EQ(phases, (std::vector{DragPhase::Begin, DragPhase::Cancel}));
    EXPECT_EQ(places[1], start);
}

TEST_F(PointDragTest, SaysNothingWhenNothingMoved) {
    const auto dragging = drag(view.project(start).pixel);
    dragging->end();
    dragging->cancel();
    EXPECT_TRUE(places.empty());
}

TEST_F(PointDragTest, SnapsUnlessAltIsHeld) {
    const glm::dvec3 magnet{1, 2, 3};
    const glm::dvec2 at = view.project(start).pixel;
    const auto dragging = drag(at, [&](const ViewGeometry&, const glm::dvec3&) { return magnet; });
    dragging->move(view, {at + glm::dvec2(70, 20)});
    EXPECT_EQ(places[0], magnet);
    dragging->move(view, {at + glm::dvec2(70, 20), false, true});
    EXPECT_NE(places[1], magnet);
}

TEST_F(PointDragTest, StaysWhereItIsWhileTheMouseIsInTheSky) {
    view = ViewGeometry({{0, -30, 3}, {0, 0, 3}, 0.9}, 1000, 700);
    const auto dragging = drag(view.project(start).pixel);
    dragging->move(view, {{400, 10}});
    EXPECT_TRUE(places.empty());
}

}  // namespace
}  // namespace reflet
