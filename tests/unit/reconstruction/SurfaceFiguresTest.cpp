// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/environment/CubeDirection.h"
#include "core/reconstruction/SurfaceFigures.h"
#include "tests/unit/baking/BakingScenes.h"
#include "tests/unit/reconstruction/BoxCity.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace reflet {
namespace {

constexpr int kResolution = 24;
const glm::dvec3 kLow{-6.0, -4.0, 0.0}, kHigh{9.0, 5.0, 4.0};

/// Where a ray leaves the room between kLow and kHigh, and by which of its six sides.
struct Exit {
    glm::dvec3 point{0.0};
    int side = 0;
};
Exit leave(const glm::dvec3& origin, const glm::dvec3& direction) {
    double least = kInfinity;
    Exit exit;
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0.0)
            continue;
        const bool up = direction[axis] > 0.0;
        const double t = ((up ? kHigh : kLow)[axis] - origin[axis]) / direction[axis];
        if (t < least) {
            least = t;
            exit = {origin + t * direction, 2 * axis + (up ? 1 : 0)};
        }
    }
    return exit;
}

std::unique_ptr<RadianceScene> roomScene() {
    testing::SceneBuilder b;
    b.box(b.object("room", CityObjectType::Building), glm::vec3(kLow), glm::vec3(kHigh), kNone,
          true);
    static std::vector<std::unique_ptr<CityModel>> kept;  // a scene refers to its city
    kept.push_back(std::make_unique<CityModel>(b.city));
    return std::move(*RadianceScene::create(*kept.back(), {}, testing::sunAt(40.0), {}, {}));
}

RemSet remsAt(std::initializer_list<glm::dvec3> centers) {
    RemSet rems;
    for (const glm::dvec3& center : centers)
        rems.add(test::plainMap("rem", center, 1, glm::vec3(1.0F), 1.0F));
    return rems;
}

/// lookup(direction) for each texel, all from REM 0.
template <class Lookup>
TexelSources sourcesOf(const Lookup& lookup) {
    TexelSources sources(kResolution);
    for (int face = 0; face < 6; ++face) {
        for (int i = 0; i < kResolution * kResolution; ++i) {
            const glm::dvec3 d =
                glm::normalize(texelDirection(kResolution, face, i % kResolution, i / kResolution));
            sources.at(face, i % kResolution, i / kResolution)[0] = {0, 1.0F, glm::vec3(lookup(d))};
        }
    }
    return sources;
}

const test::BoxCity& plainField() {
    static const test::BoxCity city(-50.0, -50.0, 200, 200, 0.5);
    return city;
}

TEST(SurfaceFigures, FindNothingWrongWithExactLookups) {
    const auto scene = roomScene();
    const HeightfieldTracer field(plainField().heightfield());
    const glm::dvec3 position{1.0, 0.5, 1.5}, center{-3.0, 2.0, 2.0};
    SurfaceTally tally(*scene, field);
    tally.add(remsAt({center}),
              sourcesOf([&](const glm::dvec3& d) { return leave(position, d).point - center; }),
              position);
    const SurfaceFigures figures = tally.figures();
    EXPECT_EQ(figures.wrong, 0.0);
    ASSERT_TRUE(figures.wrongSeen);
    EXPECT_EQ(*figures.wrongSeen, 0.0);
    ASSERT_TRUE(figures.texelError);
    EXPECT_LT(figures.texelError->p95, 1e-3);
}

TEST(SurfaceFigures, CountsLookupsAtInfinityAsGeometryDoes) {
    const auto scene = roomScene();
    const HeightfieldTracer field(plainField().heightfield());
    const glm::dvec3 position{1.0, 0.5, 1.5}, center{-3.0, 2.0, 2.0};
    SurfaceTally tally(*scene, field);
    tally.add(remsAt({center}), sourcesOf([](const glm::dvec3& d) { return d; }), position);
    const double texel = 0.5 * kPi / kResolution;
    double wrong = 0.0;
    std::vector<double> errors;
    for (int face = 0; face < 6; ++face) {
        for (int i = 0; i < kResolution * kResolution; ++i) {
            const glm::dvec3 d =
                glm::normalize(texelDirection(kResolution, face, i % kResolution, i / kResolution));
            const Exit truth = leave(position, d), shown = leave(center, d);
            const double near = std::max(0.5, 2.0 * texel * glm::distance(truth.point, position));
            wrong += truth.side != shown.side && glm::distance(truth.point, shown.point) > near;
            errors.push_back(
                std::acos(std::min(1.0, glm::dot(d, glm::normalize(shown.point - position)))) /
                texel);
        }
    }
    std::sort(errors.begin(), errors.end());
    const double texels = double(errors.size());
    EXPECT_GT(wrong / texels, 0.05);
    const SurfaceFigures figures = tally.figures();
    EXPECT_NEAR(figures.wrong, wrong / texels, 2.0 / texels);
    EXPECT_NEAR(*figures.wrongSeen, figures.wrong, 1e-12) << "inside a room all is seen";
    EXPECT_NEAR(figures.texelError->median, errors[errors.size() / 2], 0.02);
    double sum = 0.0;
    for (const double error : errors)
        sum += error;
    EXPECT_NEAR(figures.texelError->mean, sum / texels, 0.01);
}

TEST(SurfaceFigures, TakeOnePlaneInPiecesForOneSurfaceButNotItsNeighbours) {
    testing::SceneBuilder b;
    // One object's ground in two pieces that meet at x = 0, and another object's from x = 20 on.
    const auto ground = b.object("ground", CityObjectType::TinRelief);
    b.level(b.surface(ground), -50, -50, 0, 50, 0);
    b.level(b.surface(ground), 0, -50, 20, 50, 0);
    b.level(b.surface(b.object("road", CityObjectType::Road)), 20, -50, 80, 50, 0);
    const auto scene = std::move(*RadianceScene::create(b.city, {}, testing::sunAt(40.0), {}, {}));
    const HeightfieldTracer field(plainField().heightfield());
    const glm::dvec3 position{-2.0, 0.0, 2.0};
    const auto wrongWith = [&](const glm::dvec3& shown) {
        // One texel straight down, which shows another point of the ground.
        TexelSources sources(kResolution);
        const Texel down = texelAt(kResolution, {0.01, 0.01, -1.0});
        sources.at(down.face, down.column, down.row)[0] = {0, 1.0F, glm::vec3(shown - position)};
        SurfaceTally tally(*scene, field);
        tally.add(remsAt({position}), sources, position);
        return tally.figures().wrong;
    };
    const double one = 1.0 / double(6 * kResolution * kResolution);
    EXPECT_NEAR(wrongWith({-10.0, 3.0, 0.0}), 1.0 - one, 1e-12);  // the same surface
    EXPECT_NEAR(wrongWith({10.0, 3.0, 0.0}), 1.0 - one, 1e-12);   // the same plane and object
    EXPECT_NEAR(wrongWith({30.0, 3.0, 0.0}), 1.0, 1e-12);         // the road
    EXPECT_NEAR(wrongWith({-1.8, 0.2, 9.0}), 1.0, 1e-12);         // the sky
}

TEST(SurfaceFigures, TellApartWhatNoReferenceMapCouldShow) {
    testing::SceneBuilder b;
    const auto ground = b.surface(b.object("ground", CityObjectType::TinRelief));
    b.level(ground, -500, -500, 500, 500, 0);
    b.box(b.object("wall", CityObjectType::Building), {9, -500, 0}, {11, 500, 30});
    const auto scene = std::move(*RadianceScene::create(b.city, {}, testing::sunAt(40.0), {}, {}));
    test::BoxCity field(-50.0, -50.0, 200, 200, 0.5);
    field.addBox(9, -50, 11, 50, 30);
    const HeightfieldTracer tracer(field.heightfield());
    SurfaceTally tally(*scene, tracer);
    // The REM stands behind the wall: of what is to be seen it sees the sky alone.
    tally.add(remsAt({{20.0, 0.0, 2.0}}), sourcesOf([](const glm::dvec3& d) { return d; }),
              {0.0, 0.0, 2.0});
    const SurfaceFigures figures = tally.figures();
    EXPECT_GT(figures.wrong, 0.2);
    ASSERT_TRUE(figures.wrongSeen);
    EXPECT_EQ(*figures.wrongSeen, 0.0);
}

TEST(SurfaceFigures, CallTexelsWithoutASourceWrong) {
    const auto scene = roomScene();
    const HeightfieldTracer field(plainField().heightfield());
    SurfaceTally tally(*scene, field);
    tally.add({}, TexelSources(kResolution), {1.0, 0.5, 1.5});
    EXPECT_EQ(tally.figures().wrong, 1.0);
    EXPECT_FALSE(tally.figures().wrongSeen);
    EXPECT_FALSE(tally.figures().texelError);
}

TEST(SurfaceFigures, PartTheErrorOfTheMethodFromThatOfTheHeightfield) {
    testing::SceneBuilder b;
    b.level(b.surface(b.object("ground", CityObjectType::TinRelief)), -50, -50, 50, 50, 0);
    b.box(b.object("house", CityObjectType::Building), {10, -10, 0}, {20, 10, 8});
    const auto scene = std::move(*RadianceScene::create(b.city, {}, testing::sunAt(40.0), {}, {}));
    const glm::dvec3 position{0.0, 0.0, 2.0}, center{0.0, 3.0, 2.0};
    const auto figuresWith = [&](double wallAt) {
        test::BoxCity field(-50.0, -50.0, 200, 200, 0.5);
        field.addBox(wallAt, -10, 20, 10, 8);
        const HeightfieldTracer tracer(field.heightfield());
        SurfaceTally tally(*scene, tracer);
        // What the method does at its best: exact hits of the heightfield.
        tally.add(remsAt({center}), sourcesOf([&](const glm::dvec3& d) {
                      const auto hit = tracer.trace({position, d});
                      return hit.hit ? position + hit.t * d - center : d;
                  }),
                  position);
        return tally.figures();
    };
    const SurfaceFigures same = figuresWith(10.0);
    EXPECT_LT(same.modelWrong, 0.01);
    EXPECT_LT(same.wrong, 0.01);
    EXPECT_LT(same.algorithmWrong, 0.01);
    const SurfaceFigures off = figuresWith(4.0);
    EXPECT_GT(off.modelWrong, 0.03);
    EXPECT_LT(off.algorithmWrong, 0.01) << "the method did what it could";
    ASSERT_TRUE(off.algorithmTexelError);
    EXPECT_LT(off.algorithmTexelError->median, 0.01);
}

}  // namespace
}  // namespace reflet
