// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/HeightfieldBuilder.h"
#include "core/heightfield/Hiding.h"
#include "tests/unit/heightfield/TestCity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace reflet::test {
namespace {

/// A box turned in the plan, whose every answer is known.
struct Block {
    glm::dvec2 middle{0.0}, half{0.0};
    double turn = 0.0, bottom = 0.0, top = 0.0;

    [[nodiscard]] glm::dvec3 local(const glm::dvec3& p) const {
        const glm::dvec2 d = glm::dvec2(p) - middle;
        return {d.x * std::cos(turn) + d.y * std::sin(turn),
                d.y * std::cos(turn) - d.x * std::sin(turn), p.z};
    }
    /// Whether the stretch between two points passes through the inside (slabs).
    [[nodiscard]] bool blocks(const glm::dvec3& from, const glm::dvec3& to) const {
        const glm::dvec3 a = local(from), d = local(to) - a;
        const glm::dvec3 low(-half.x, -half.y, bottom), high(half.x, half.y, top);
        double enter = 0.0, leave = 1.0;
        for (int k = 0; k < 3; ++k) {
            if (d[k] == 0.0) {
                if (a[k] < low[k] || a[k] > high[k])
                    return false;
                continue;
            }
            const double t0 = (low[k] - a[k]) / d[k], t1 = (high[k] - a[k]) / d[k];
            enter = std::max(enter, std::min(t0, t1));
            leave = std::min(leave, std::max(t0, t1));
        }
        return enter <= leave;
    }
    [[nodiscard]] bool holds(const glm::dvec3& p) const {
        const glm::dvec3 q = local(p);
        return std::abs(q.x) <= half.x && std::abs(q.y) <= half.y && q.z <= top && q.z >= bottom;
    }
    void addTo(TestCity& city) const {
        const auto at = [&](int x, int y, int z) {
            const double u = x != 0 ? half.x : -half.x, v = y != 0 ? half.y : -half.y;
            return glm::vec3(middle.x + u * std::cos(turn) - v * std::sin(turn),
                             middle.y + u * std::sin(turn) + v * std::cos(turn),
                             z != 0 ? top : bottom);
        };
        city.object(bottom > 0.0 ? CityObjectType::Bridge : CityObjectType::Building,
                    SurfaceType::Roof);
        city.quad(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1));
        city.surface(SurfaceType::Ground);
        city.quad(at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0));
        city.surface(SurfaceType::Wall);
        for (const auto& [a, b] : {std::pair{glm::ivec2(0, 0), glm::ivec2(1, 0)},
                                   {{1, 0}, {1, 1}},
                                   {{1, 1}, {0, 1}},
                                   {{0, 1}, {0, 0}}})
            city.quad(at(a.x, a.y, 0), at(b.x, b.y, 0), at(b.x, b.y, 1), at(a.x, a.y, 1));
    }
};

class RandomTown {
public:
    RandomTown(unsigned seed, double cellSize) : m_random(seed) {
        TestCity model;
        model.ground(0, 0, 200, 200, 0);
        for (int n = 0; n < 30; ++n) {
            const bool thin = n % 6 == 0, bridge = n % 7 == 1;
            blocks.push_back({{in(10, 190), in(10, 190)},
                              {in(2, 20), thin ? in(0.1, 0.6) : in(3, 12)},
                              in(0, 3.1),
                              bridge ? in(1.0, 4.0) : 0.0,
                              bridge ? in(5.0, 7.0) : in(1.5, 25)});
            blocks.back().addTo(model);
        }
        const int count = int(200.0 / cellSize);
        auto built = buildHeightfield(model.city, {0.0, 0.0, cellSize, count, count}, {});
        EXPECT_TRUE(built) << built.error().message();
        field = std::move(*built);
    }
    double in(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(m_random);
    }
    [[nodiscard]] bool inBlock(const glm::dvec3& p) const {
        return std::any_of(blocks.begin(), blocks.end(),
                           [&](const Block& b) { return b.holds(p); });
    }
    [[nodiscard]] bool sees(const glm::dvec3& from, const glm::dvec3& to) const {
        return std::none_of(blocks.begin(), blocks.end(),
                            [&](const Block& b) { return b.blocks(from, to); });
    }
    /// Whether any of many points of the box is seen: its corners, edges and sides.
    [[nodiscard]] bool seesAny(const glm::dvec3& from, const Box& box) const {
        constexpr int kSteps = 12;
        for (int i = 0; i <= kSteps; ++i) {
            for (int j = 0; j <= kSteps; ++j) {
                for (int side = 0; side < 6; ++side) {
                    glm::dvec3 s;
                    s[side / 2] = side % 2;
                    s[(side / 2 + 1) % 3] = double(i) / kSteps;
                    s[(side / 2 + 2) % 3] = double(j) / kSteps;
                    if (sees(from, box.min + s * box.size()))
                        return true;
                }
            }
        }
        return false;
    }

    std::vector<Block> blocks;
    Heightfield field;

private:
    std::mt19937 m_random;
};

TEST(Hiding, NeverHidesWhatCanBeSeenInTheCityItself) {
    int hidden = 0, found = 0;
    for (unsigned seed = 1; seed <= 6; ++seed) {
        RandomTown town(seed, seed % 2 == 0 ? 0.5 : 1.0);
        const Hiding hiding(town.field);
        for (int n = 0; n < 400; ++n) {
            // On the pavement, from a roof, high above, and outside of the city.
            const double high = n % 4 == 0 ? town.in(5, 80) : town.in(0.5, 3.0);
            const glm::dvec3 eye(town.in(-30, 230), town.in(-30, 230), high);
            const glm::dvec3 low(town.in(0, 195), town.in(0, 195), 0.05);
            Box box;
            box.add(low);
            box.add(low + glm::dvec3(town.in(0.3, 12), town.in(0.3, 12), town.in(0.5, 3.5)));
            const bool hides = hiding.hides(eye, box);
            const bool seen = town.seesAny(eye, box);
            ASSERT_FALSE(hides && seen) << "seed " << seed << ", " << n;
            if (town.inBlock(eye))
                continue;
            hidden += seen ? 0 : 1;
            found += hides ? 1 : 0;
        }
    }
    ASSERT_GT(hidden, 300);
    EXPECT_GT(double(found) / hidden, 0.5)
        << "conservative, but of use: " << found << " of " << hidden;
}

TEST(Hiding, SaysNothingFromInsideABuildingOrAboutWhatStandsAtTheEye) {
    TestCity model;
    model.ground(0, 0, 100, 100, 0).box({20, 20, 0}, {60, 60, 20});
    const auto field = buildHeightfield(model.city, {0.0, 0.0, 1.0, 100, 100}, {});
    ASSERT_TRUE(field);
    const Hiding hiding(*field);
    Box car;
    car.add({80.0, 38.0, 0.0});
    car.add({84.0, 40.0, 1.5});
    EXPECT_TRUE(hiding.hides({5.0, 39.0, 1.7}, car));
    EXPECT_FALSE(hiding.hides({40.0, 39.0, 1.7}, car)) << "inside";
    EXPECT_FALSE(hiding.hides({20.5, 39.0, 1.7}, car)) << "inside, at the wall";
    EXPECT_FALSE(hiding.hides({82.0, 39.0, 1.0}, car));
    EXPECT_FALSE(hiding.hides({5.0, 39.0, 60.0}, car)) << "over the roof";
    EXPECT_TRUE(hiding.hides({5.0, 39.0, 1.7}, Box{}));
    EXPECT_FALSE(hiding.hides(glm::dvec3(std::nan("")), car));
}

TEST(Hiding, KnowsThatOneCanLookUnderABridge) {
    TestCity model;
    model.ground(0, 0, 100, 100, 0);
    Block{{50.0, 50.0}, {8.0, 45.0}, 0.0, 4.0, 6.0}.addTo(model);
    const auto field = buildHeightfield(model.city, {0.0, 0.0, 1.0, 100, 100}, {});
    ASSERT_TRUE(field);
    Box car;
    car.add({80.0, 48.0, 0.0});
    car.add({84.0, 50.0, 1.5});
    EXPECT_FALSE(Hiding(*field).hides({10.0, 49.0, 1.7}, car));
}

TEST(Hiding, OfAnEmptyGridIsNothing) {
    Box car;
    car.add({80.0, 48.0, 0.0});
    car.add({84.0, 50.0, 1.5});
    EXPECT_FALSE(Hiding(Heightfield{}).hides({10.0, 49.0, 1.7}, car));
}

}  // namespace
}  // namespace reflet::test
