// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/RayScene.h"
#include "tests/unit/baking/BakingScenes.h"

#include <random>

namespace reflet::testing {
namespace {

struct Soup {
    SceneBuilder builder;
    std::vector<glm::vec3> origins;
    std::vector<glm::vec3> directions;
};

Soup randomSoup(std::size_t triangles, std::size_t rays) {
    Soup soup;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> place(-50.0F, 50.0F);
    std::uniform_real_distribution<float> size(-9.0F, 9.0F);
    std::normal_distribution<float> normal;
    const auto s = soup.builder.surface(soup.builder.object("soup", CityObjectType::Generic));
    for (std::size_t i = 0; i < triangles; ++i) {
        const glm::vec3 a(place(random), place(random), place(random));
        const auto edge = [&] { return glm::vec3(size(random), size(random), size(random)); };
        soup.builder.triangle(s, a, a + edge(), a + edge());
    }
    for (std::size_t i = 0; i < rays; ++i) {
        soup.origins.emplace_back(place(random), place(random), place(random));
        soup.directions.push_back(
            glm::normalize(glm::vec3(normal(random), normal(random), normal(random))));
    }
    return soup;
}

/// The nearest hit in double (Möller & Trumbore 1997). unsure: the ray passes so near an edge that
/// rounding may decide.
struct Truth {
    double distance = std::numeric_limits<double>::infinity();
    std::uint32_t triangle = kNone;
    bool unsure = false;
};

Truth bruteForce(const CityModel& city, const glm::dvec3& origin, const glm::dvec3& direction) {
    Truth truth;
    for (std::size_t i = 0; i < city.triangles.size(); ++i) {
        const auto& v = city.triangles[i].vertex;
        const glm::dvec3 a(city.vertices[v[0]]);
        const glm::dvec3 e1 = glm::dvec3(city.vertices[v[1]]) - a;
        const glm::dvec3 e2 = glm::dvec3(city.vertices[v[2]]) - a;
        const glm::dvec3 p = glm::cross(direction, e2);
        const double det = glm::dot(e1, p);
        const glm::dvec3 s = origin - a;
        const double u = glm::dot(s, p) / det;
        const glm::dvec3 q = glm::cross(s, e1);
        const double w = glm::dot(direction, q) / det;
        const double t = glm::dot(e2, q) / det;
        const double inside = std::min({u, w, 1.0 - u - w});
        truth.unsure |= std::abs(inside) < 1e-4 || std::abs(t) < 1e-4;
        if (inside >= 0.0 && t > 0.0 && t < truth.distance) {
            truth.distance = t;
            truth.triangle = std::uint32_t(i);
        }
    }
    return truth;
}

TEST(RayScene, TheNearestHitIsThatOfABruteForceSearchInDouble) {
    const Soup soup = randomSoup(400, 4000);
    const auto scene = sceneOf(soup.builder.city, sunAt(45));
    std::size_t hits = 0;
    std::size_t sky = 0;
    for (std::size_t i = 0; i < soup.origins.size(); ++i) {
        const Truth truth = bruteForce(soup.builder.city, glm::dvec3(soup.origins[i]),
                                       glm::dvec3(soup.directions[i]));
        if (truth.unsure) {
            continue;
        }
        const SceneHit hit = scene->intersect(soup.origins[i], soup.directions[i]);
        ASSERT_EQ(hit.triangle, truth.triangle) << i;
        if (truth.triangle == kNone) {
            EXPECT_EQ(hit.distance, kInfinity);
            ++sky;
        } else {
            EXPECT_NEAR(hit.distance, truth.distance, 1e-4 + 1e-5 * truth.distance);
            ++hits;
        }
    }
    EXPECT_GT(hits, 800U);
    EXPECT_GT(sky, 300U);
}

TEST(RayScene, PacketsAndSingleRaysMeetTheSameThings) {
    const Soup soup = randomSoup(400, 1003);  // not a multiple of 16
    const auto scene = sceneOf(soup.builder.city, sunAt(45));
    std::vector<SceneHit> hits(soup.origins.size());
    scene->intersect(soup.origins, soup.directions, hits);
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const SceneHit single = scene->intersect(soup.origins[i], soup.directions[i]);
        EXPECT_EQ(hits[i].triangle, single.triangle);
        if (single.triangle != kNone) {
            EXPECT_NEAR(hits[i].distance, single.distance, 1e-5F * single.distance);
        }
    }
}

TEST(RayScene, OcclusionEndsAtTheDistanceAsked) {
    SceneBuilder b;
    b.quad(b.surface(b.object("wall", CityObjectType::Generic)), {10, -5, -5}, {10, 5, -5},
           {10, 5, 5}, {10, -5, 5});
    const auto scene = sceneOf(b.city, sunAt(45));
    EXPECT_TRUE(scene->occluded({0, 0, 0}, {1, 0, 0}, 10.01F));
    EXPECT_FALSE(scene->occluded({0, 0, 0}, {1, 0, 0}, 9.99F));
    EXPECT_FALSE(scene->occluded({0, 0, 0}, {-1, 0, 0}, kInfinity));
    EXPECT_TRUE(scene->occluded({20, 0, 0}, {-1, 0, 0}, kInfinity)) << "walls have two sides";
}

TEST(RayScene, AnOccluderReportsItsOwnTriangleAndHidesTheCity) {
    SceneBuilder b;
    b.level(b.surface(b.object("ground", CityObjectType::Generic)), -50, -50, 50, 50, 0);
    const std::vector<glm::vec3> first{{-1, -1, 1}, {1, -1, 1}, {0, 1, 1}};
    const std::vector<glm::vec3> second{{9, -1, 2}, {11, -1, 2}, {11, 1, 2}, {9, 1, 2}};
    const std::vector<glm::uvec3> one{{0, 1, 2}};
    const std::vector<glm::uvec3> two{{0, 1, 2}, {0, 2, 3}};
    const std::vector<Occluder> occluders{{first, one}, {second, two}};
    const auto scene = sceneOf(b.city, sunAt(45), {}, occluders);
    const SceneHit a = scene->intersect({0, 0, 5}, {0, 0, -1});
    EXPECT_EQ(a.occluder, 0U);
    EXPECT_EQ(a.occluderTriangle, 0U);
    EXPECT_EQ(a.triangle, kNone);
    EXPECT_FLOAT_EQ(a.distance, 4.0F);
    const SceneHit c = scene->intersect({9.3F, 0.6F, 5}, {0, 0, -1});
    EXPECT_EQ(c.occluder, 1U);
    EXPECT_EQ(c.occluderTriangle, 1U);
    EXPECT_FLOAT_EQ(c.distance, 3.0F);
    EXPECT_EQ(scene->intersect({5, 0, 5}, {0, 0, -1}).occluder, kNone);
}

TEST(RayScene, BrokenTrianglesAreMetByNoRayAndBreakNothing) {
    SceneBuilder b;
    const auto s = b.surface(b.object("odd", CityObjectType::Generic));
    b.level(s, -5, -5, 5, 5, 0);
    b.triangle(s, {0, 0, 1}, {0, 0, 1}, {0, 0, 1});
    b.triangle(s, {0, 0, 2}, {1, 1, 2}, {2, 2, 2});
    const auto scene = sceneOf(b.city, sunAt(45));
    const SceneHit hit = scene->intersect({0.4F, 0.5F, 9}, {0, 0, -1});
    EXPECT_FLOAT_EQ(hit.distance, 9.0F);
    EXPECT_EQ(hit.triangle, 1U);
}

TEST(RayScene, BundlesOfAnySizeMeetWhatSingleRaysMeet) {
    const Soup soup = randomSoup(400, 1003);  // not a multiple of 8 or 16
    const auto built = RayScene::build(soup.builder.city, {}, JobContext());
    ASSERT_TRUE(built);
    const RayScene& scene = **built;
    std::vector<float> x, y, z;
    for (const glm::vec3& d : soup.directions) {
        x.push_back(d.x);
        y.push_back(d.y);
        z.push_back(d.z);
    }
    const glm::vec3 origin(3.0F, -7.0F, 11.0F);
    std::size_t hits = 0;
    for (const RayPackets& packets :
         {RayPackets{1, false}, RayPackets{1, true}, RayPackets{8, false}, RayPackets{8, true},
          RayPackets{16, false}, RayPackets{16, true}}) {
        std::vector<float> t(x.size(), -1.0F);
        scene.intersect({origin, x, y, z}, packets, t);
        for (std::size_t i = 0; i < t.size(); ++i) {
            const SceneHit single = scene.intersect(origin, soup.directions[i], kInfinity);
            if (single.triangle == kNone) {
                ASSERT_EQ(t[i], kInfinity) << packets.size;
            } else {
                ASSERT_NEAR(t[i], single.distance, 1e-5F * single.distance) << packets.size;
                ++hits;
            }
        }
    }
    EXPECT_GT(hits, 1000U);
    EXPECT_LT(hits, 5900U);
}

TEST(RayScene, AnEmptyCityIsAllSky) {
    const CityModel city;
    const auto scene = sceneOf(city, sunAt(45));
    const SceneHit hit = scene->intersect({0, 0, 0}, {0, 0, 1});
    EXPECT_EQ(hit.distance, kInfinity);
    EXPECT_EQ(hit.triangle, kNone);
    EXPECT_EQ(scene->shade(hit, {0, 0, 0}, {0, 0, 1}), scene->sky().radiance({0, 0, 1}));
    EXPECT_FALSE(scene->insideSolid({0, 0, 0}));
}

TEST(RayScene, ACancelledBuildSaysSo) {
    const Soup soup = randomSoup(5000, 0);
    std::stop_source stop;
    stop.request_stop();
    const auto scene =
        RadianceScene::create(soup.builder.city, {}, {}, {}, JobContext(nullptr, stop.get_token()));
    ASSERT_FALSE(scene.has_value());
    EXPECT_EQ(scene.error().code, ErrorCode::Cancelled);
}

}  // namespace
}  // namespace reflet::testing
