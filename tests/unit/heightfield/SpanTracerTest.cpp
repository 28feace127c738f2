// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/RadianceScene.h"
#include "core/heightfield/HeightfieldTracer.h"
#include "tests/unit/heightfield/SpanCities.h"
#include "tests/unit/heightfield/TracerFields.h"

#include <glm/vector_relational.hpp>

#include <map>

namespace reflet::test {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

/// Asks each solid of each column by itself, in no order, and keeps the earliest hit.
class BruteForce {
public:
    explicit BruteForce(const Heightfield& field) : m_field(field) {}

    [[nodiscard]] HeightfieldHit trace(const Ray& ray) const {
        const GridSpec& grid = m_field.grid;
        HeightfieldHit best;
        best.t = kForever;
        for (int j = 0; j < grid.rows; ++j) {
            const auto y = between(grid.yMin(j), grid.yMin(j + 1), ray.origin.y, ray.direction.y);
            for (int i = 0; i < grid.columns; ++i) {
                const auto x =
                    between(grid.xMin(i), grid.xMin(i + 1), ray.origin.x, ray.direction.x);
                const double enter = std::max({0.0, x[0], y[0]});
                const double leave = std::min(x[1], y[1]);
                if (!(enter < leave))
                    continue;
                const double t = first(ray, grid.index(i, j), enter, leave);
                if (t < best.t)
                    best = {true, t, i, j};
            }
        }
        return best.hit ? best : HeightfieldHit{};
    }

private:
    [[nodiscard]] double first(const Ray& ray, std::size_t cell, double enter, double leave) const {
        const auto column = m_field.centerSpans.at(cell);
        if (column.empty()) {
            const float top = m_field.topCenter[cell];
            return isMissing(top) ? kForever : first(ray, -kForever, double(top), enter, leave);
        }
        double t = kForever;
        for (const HeightSpan& s : column)
            t = std::min(t, first(ray, double(s.low), double(s.high), enter, leave));
        return t;
    }
    static double first(const Ray& ray, double low, double high, double enter, double leave) {
        const double z = ray.origin.z + enter * ray.direction.z;
        if (z >= low && z <= high)
            return enter;
        const double inverse = 1.0 / ray.direction.z;
        if (ray.direction.z < 0.0 && z > high) {
            const double down = (high - ray.origin.z) * inverse;
            return down < leave ? std::max(enter, down) : kForever;
        }
        if (ray.direction.z > 0.0 && z < low) {
            const double up = (low - ray.origin.z) * inverse;
            return up < leave ? std::max(enter, up) : kForever;
        }
        return kForever;
    }
    static std::array<double, 2> between(double low, double high, double origin, double direction) {
        const double inverse = 1.0 / direction;
        if (std::isinf(inverse)) {
            return low <= origin && origin < high ? std::array{-kForever, kForever}
                                                  : std::array{0.0, 0.0};
        }
        const double a = (low - origin) * inverse;
        const double b = (high - origin) * inverse;
        return direction > 0.0 ? std::array{a, b} : std::array{b, a};
    }

    const Heightfield& m_field;
};

const std::array<GridSpec, 4> kGrids{{
    {0.0, 0.0, 1.0, 13, 9},
    {-4.2, 17.7, 0.3, 11, 12},
    {123.1, -987.6, 0.1, 16, 8},
    {-1000.0, 500.0, 2.5, 1, 20},
}};

TEST(SpanTracer, FindsWhatAskingEverySolidFindsOnEveryKindOfRay) {
    constexpr int perKind = REFLET_TRACER_RAYS / 10 / int(kGrids.size()) / int(RayKind::Count);
    std::map<bool, int> undersides;
    int misses = 0;
    for (const GridSpec& grid : kGrids) {
        const Heightfield field = blockyColumns(grid, 7);
        const HeightfieldTracer tracer(field);
        const BruteForce truth(field);
        RaySource rays(grid, field.topCenter, 11);
        for (int kind = 0; kind < int(RayKind::Count); ++kind) {
            for (int n = 0; n < perKind; ++n) {
                Ray ray = rays.next(RayKind(kind));
                if (n % 2 == 0)
                    ray.direction.z = std::abs(ray.direction.z);
                const HeightfieldHit expected = truth.trace(ray);
                ASSERT_TRUE(sameBits(traceReference(grid, field.topCenter, field.centerSpans, ray),
                                     expected))
                    << "kind " << kind;
                ASSERT_TRUE(sameBits(tracer.trace(ray), expected)) << "kind " << kind;
                misses += expected.hit ? 0 : 1;
                if (expected.hit && expected.t > 0.0)
                    ++undersides[ray.direction.z > 0.0];
            }
        }
    }
    constexpr int rayCount = REFLET_TRACER_RAYS / 10;
    EXPECT_GT(misses, rayCount / 100);
    EXPECT_GT(undersides[true], rayCount / 20);
    EXPECT_GT(undersides[false], rayCount / 20);
}

/// A bridge of a deck and two piers over a street, a house with a passage, a gate with an arch of
/// steps, a tunnel's shell in the open: all of it on borders of cells, where columns are exact.
struct SquareTown {
    TestCity city;
    std::vector<Box> solids;

    SquareTown();
    void add(glm::vec3 low, glm::vec3 high) {
        addBlock(city, low, high);
        solids.emplace_back(Box{});
        solids.back().add(glm::dvec3(low));
        solids.back().add(glm::dvec3(high));
    }
    [[nodiscard]] bool isInside(const glm::dvec3& p) const {
        return std::any_of(solids.begin(), solids.end(), [&](const Box& solid) {
            return glm::all(glm::greaterThanEqual(p, solid.min)) &&
                   glm::all(glm::lessThanEqual(p, solid.max));
        });
    }
};

SquareTown::SquareTown() {
    city.ground(0, 0, 48, 48, 0);
    city.object(CityObjectType::Bridge);
    add({18, 0, 6}, {24, 48, 7});
    add({18, 12, -1}, {24, 14, 6});
    add({18, 34, -1}, {24, 36, 6});
    city.object(CityObjectType::Building);
    add({30, 10, 0}, {34, 20, 12});
    add({34, 10, 4}, {38, 20, 12});
    add({38, 10, 0}, {42, 20, 12});
    city.object(CityObjectType::Building);
    for (int n = 0; n < 4; ++n) {
        const auto x = float(n);
        add({4 + x, 30, 2 + x}, {5 + x, 33, 9});
        add({11 - x, 30, 2 + x}, {12 - x, 33, 9});
    }
    add({3, 30, 0}, {4, 33, 9});
    add({12, 30, 0}, {13, 33, 9});
    city.object(CityObjectType::Building);
    add({4, 4, 0}, {12, 12, 15});
}

TEST(SpanTracer, SeesTheSquareTownAsEmbreeSeesItsMesh) {
    const SquareTown town;
    const CityModel& city = town.city.city;
    const auto scene = RadianceScene::create(city, {}, {}, {}, {});
    ASSERT_TRUE(scene);
    const HeightfieldTracer tracer(builtField(city, {0.0, 0.0, 0.5, 96, 96}));
    std::mt19937 random(3);
    const auto in = [&](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random);
    };
    int undersides = 0, hits = 0, sky = 0, differing = 0;
    for (int n = 0; n < 200000; ++n) {
        const glm::dvec3 origin(in(0, 48), in(0, 48), in(0.2, 14.0));
        if (town.isInside(origin))
            continue;
        const glm::dvec3 direction = glm::normalize(glm::dvec3(in(-1, 1), in(-1, 1), in(-1, 1)));
        const SceneHit mesh = (*scene)->intersect(glm::vec3(origin), glm::vec3(direction));
        const HeightfieldHit hit = tracer.trace({origin, direction});
        if (hit.hit != (mesh.triangle != kNone) ||
            (hit.hit && std::abs(hit.t - double(mesh.distance)) > 1e-3)) {
            ++differing;
            continue;
        }
        ++(hit.hit ? hits : sky);
        if (!hit.hit)
            continue;
        const glm::dvec3 point = origin + hit.t * direction;
        const bool hanging = std::abs(point.z - 6.0) < 1e-3 || std::abs(point.z - 4.0) < 1e-3;
        undersides += hanging && direction.z > 0.0 ? 1 : 0;
    }
    // Embree's single precision takes a few rays to the other side of an edge.
    EXPECT_LT(differing, 20);
    EXPECT_GT(undersides, 2000);
    EXPECT_GT(hits, 80000);
    EXPECT_GT(sky, 20000);
}

TEST(SpanTracer, AnArchAgreesWithItsMeshButForTheStepsOfItsCells) {
    TestCity model;
    model.ground(0, 0, 24, 24, 0);
    model.object(CityObjectType::Bridge);
    addVault(model, 6, 18, 4, 20, 0, 10, 32);
    const auto scene = RadianceScene::create(model.city, {}, {}, {}, {});
    ASSERT_TRUE(scene);
    const HeightfieldTracer tracer(builtField(model.city, {0.0, 0.0, 0.125, 192, 192}));
    std::mt19937 random(8);
    const auto in = [&](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random);
    };
    int close = 0, all = 0;
    for (int n = 0; n < 20000; ++n) {
        const glm::dvec3 origin(in(10, 14), in(7, 17), 1.75);
        const glm::dvec3 direction = glm::normalize(glm::dvec3(in(-1, 1), in(-1, 1), in(0.2, 1)));
        const SceneHit mesh = (*scene)->intersect(glm::vec3(origin), glm::vec3(direction));
        if (mesh.triangle == kNone)
            continue;
        const HeightfieldHit hit = tracer.trace({origin, direction});
        close += hit.hit && std::abs(hit.t - double(mesh.distance)) < 0.5 ? 1 : 0;
        ++all;
    }
    EXPECT_GT(all, 10000);
    EXPECT_GT(close, int(0.97 * all));
}

TEST(SpanTracer, RaysPassUnderTheBridgeAndMeetWhatIsThere) {
    const SquareTown town;
    const HeightfieldTracer tracer(builtField(town.city.city, {0.0, 0.0, 0.5, 96, 96}));
    const auto at = [&](glm::dvec3 from, glm::dvec3 direction) {
        return tracer.trace({from, direction});
    };
    EXPECT_FALSE(at({15, 26, 2}, {1, 0, 0}).hit) << "under the deck, beside the piers";
    EXPECT_EQ(at({15, 13, 2}, {1, 0, 0}).t, 3.0) << "the pier";
    EXPECT_EQ(at({20, 26, 2}, {0, 0, 1}).t, 4.0) << "the underside";
    EXPECT_EQ(at({20, 26, 20}, {0, 0, -1}).t, 13.0) << "the deck";
    EXPECT_EQ(at({15, 26, 6}, {1, 0, 0}).t, 3.0) << "along the underside: closed";
    EXPECT_EQ(at({15, 26, 7}, {1, 0, 0}).t, 3.0) << "along the deck: closed";
    EXPECT_FALSE(at({15, 26, 7.0001}, {1, 0, 0}).hit) << "over the deck";
    EXPECT_EQ(at({20, 26, 6.5}, {0, 1, 0}).t, 0.0) << "inside of the deck";
    EXPECT_EQ(at({20, 26, 0}, {1, 0, 0}).t, 0.0) << "on the ground";
}

}  // namespace
}  // namespace reflet::test
