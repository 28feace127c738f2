// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/ParallelFor.h"
#include "tests/unit/heightfield/SpanCities.h"

#include <random>

namespace reflet::test {
namespace {

using Tetrahedron = std::array<glm::vec3, 4>;

/// Ground, and tetrahedra of all sizes and attitudes that hang above it; one object each.
struct HangingBodies {
    explicit HangingBodies(int count, unsigned seed) : random(seed) {
        city.ground(0, 0, 24, 24, 0);
        for (int n = 0; n < count; ++n)
            add();
    }

    void add() {
        const float size = std::pow(10.0F, in(-0.5F, 0.9F));
        const glm::vec3 center(in(2.0F, 22.0F), in(2.0F, 22.0F), in(2.0F, 30.0F));
        Tetrahedron t;
        for (glm::vec3& corner : t) {
            corner = center + size * glm::vec3(in(-1, 1), in(-1, 1), in(-1, 1));
            // On quarters, so that corners and edges meet borders and centres of cells.
            corner = round(corner * 4.0F) * 0.25F;
            corner.z = std::max(corner.z, 0.5F);
        }
        const glm::vec3 base = glm::cross(t[1] - t[0], t[2] - t[0]);
        if (glm::dot(base, t[3] - t[0]) > 0.0F)
            std::swap(t[1], t[2]);
        city.object(CityObjectType::Bridge);
        city.triangle(t[0], t[1], t[2]).triangle(t[0], t[3], t[1]);
        city.triangle(t[1], t[3], t[2]).triangle(t[0], t[2], t[3]);
        bodies.push_back(t);
    }

    float in(float from, float to) {
        return std::uniform_real_distribution<float>(from, to)(random);
    }
    glm::dvec3 pointIn(const Tetrahedron& t) {
        std::array<double, 4> weight{};
        double sum = 0.0;
        for (double& w : weight) {
            w = -std::log(double(in(1e-6F, 1.0F)));
            sum += w;
        }
        glm::dvec3 p(0.0);
        for (std::size_t n = 0; n < 4; ++n)
            p += weight[n] / sum * glm::dvec3(t[n]);
        return p;
    }

    TestCity city;
    std::vector<Tetrahedron> bodies;
    std::mt19937 random;
};

const HeightRules& tight() {
    static const HeightRules rules = [] {
        HeightRules r;
        r.clearance = 0.0;
        return r;
    }();
    return rules;
}

/// Where the vertical line through (x, y) is inside of the tetrahedron, by its four half-spaces.
std::optional<std::array<double, 2>> chord(const Tetrahedron& t, double x, double y) {
    constexpr std::array<std::array<std::size_t, 4>, 4> faces{
        {{0, 1, 2, 3}, {0, 3, 1, 2}, {1, 3, 2, 0}, {0, 2, 3, 1}}};
    double low = -1e30, high = 1e30;
    for (const auto& f : faces) {
        const glm::dvec3 a(t[f[0]]), b(t[f[1]]), c(t[f[2]]);
        const glm::dvec3 n = glm::cross(b - a, c - a);
        // n·(p - a) <= 0 inside.
        const double rest = n.x * (x - a.x) + n.y * (y - a.y);
        if (n.z == 0.0) {
            if (rest > 0.0)
                return std::nullopt;
        } else if (n.z > 0.0) {
            high = std::min(high, a.z - rest / n.z);
        } else {
            low = std::max(low, a.z - rest / n.z);
        }
    }
    return low <= high ? std::optional(std::array{low, high}) : std::nullopt;
}

TEST(SpanProperty, EveryPointOfABodyLiesInASolidOverItsCell) {
    HangingBodies model(60, 3);
    for (const double s : {1.0, 0.5, 0.3}) {
        const int count = int(std::lround(24.0 / s));
        const GridSpec grid{0.0, 0.0, s, count, count};
        const Heightfield field = builtField(model.city.city, grid, tight());
        ASSERT_FALSE(field.spans.empty());
        int hanging = 0;
        for (int n = 0; n < 60000; ++n) {
            const glm::dvec3 p = model.pointIn(model.bodies[std::size_t(n) % model.bodies.size()]);
            const int i = grid.column(p.x), j = grid.row(p.y);
            if (!grid.contains(i, j))
                continue;
            const std::size_t cell = grid.index(i, j);
            ASSERT_TRUE(isSolidAt(field.spans, field.topMax, cell, p.z, 1e-9));
            hanging += field.spans.at(cell).empty() ? 0 : 1;
        }
        EXPECT_GT(hanging, 20000);
    }
}

TEST(SpanProperty, TheCentresColumnIsWhatEachBodySaysOfItself) {
    HangingBodies model(60, 5);
    const GridSpec grid{0.0, 0.0, 0.5, 48, 48};
    const Heightfield field = builtField(model.city.city, grid, tight());
    int solid = 0, open = 0;
    for (int j = 0; j < grid.rows; ++j) {
        for (int i = 0; i < grid.columns; ++i) {
            const double x = grid.xMin(i) + 0.25, y = grid.yMin(j) + 0.25;
            for (int k = 0; k < 40; ++k) {
                const double z = double(model.in(-1.0F, 34.0F));
                bool inside = z <= 0.0;
                bool near = std::abs(z) < 1e-4;
                for (const Tetrahedron& t : model.bodies) {
                    const auto c = chord(t, x, y);
                    inside = inside || (c && z >= (*c)[0] && z <= (*c)[1]);
                    near = near ||
                           (c && (std::abs(z - (*c)[0]) < 1e-4 || std::abs(z - (*c)[1]) < 1e-4));
                }
                if (near)
                    continue;
                ASSERT_EQ(isSolidAt(field.centerSpans, field.topCenter, grid.index(i, j), z, 0.0),
                          inside)
                    << i << " " << j << " at " << z;
                ++(inside ? solid : open);
            }
        }
    }
    EXPECT_GT(solid, 2000);
    EXPECT_GT(open, 20000);
}

TEST(SpanProperty, TheColumnsEndAtTheTopLayersAndAreContainedInOneAnother) {
    HangingBodies model(80, 9);
    const GridSpec grid{0.0, 0.0, 0.5, 48, 48};
    for (const double clearance : {0.0, 1.0, 4.0}) {
        HeightRules rules;
        rules.clearance = clearance;
        const Heightfield field = builtField(model.city.city, grid, rules);
        for (const std::uint32_t cell : field.centerSpans.cells()) {
            const auto column = field.centerSpans.at(cell);
            ASSERT_GE(column.size(), 2U);
            ASSERT_EQ(column.back().high, field.topCenter[cell]);
            ASSERT_EQ(column.front().low, -kInfinity);
            for (std::size_t n = 1; n < column.size(); ++n)
                ASSERT_GT(double(column[n].low) - double(column[n - 1].high), clearance);
            for (const HeightSpan& span : column) {
                // What is solid at the centre is solid over the cell.
                ASSERT_TRUE(isSolidAt(field.spans, field.topMax, cell, double(span.high), 0.0));
                const float low = std::isfinite(span.low) ? span.low : span.high;
                ASSERT_TRUE(isSolidAt(field.spans, field.topMax, cell, double(low), 0.0));
            }
        }
        for (const std::uint32_t cell : field.spans.cells())
            ASSERT_EQ(field.spans.at(cell).back().high, field.topMax[cell]);
        EXPECT_FALSE(field.spans.empty());
    }
}

TEST(SpanProperty, AnAddedBodyNeverMakesASolidHollow) {
    HangingBodies model(10, 13);
    const GridSpec grid{0.0, 0.0, 0.5, 48, 48};
    Heightfield before = builtField(model.city.city, grid);
    for (int round = 0; round < 6; ++round) {
        for (int n = 0; n < 8; ++n)
            model.add();
        const Heightfield after = builtField(model.city.city, grid);
        for (std::size_t cell = 0; cell < grid.cellCount(); ++cell) {
            for (int k = 0; k < 30; ++k) {
                const double z = double(k) * 1.1 - 1.0;
                ASSERT_LE(isSolidAt(before.spans, before.topMax, cell, z, 0.0),
                          isSolidAt(after.spans, after.topMax, cell, z, 0.0));
                ASSERT_LE(isSolidAt(before.centerSpans, before.topCenter, cell, z, 0.0),
                          isSolidAt(after.centerSpans, after.topCenter, cell, z, 0.0));
            }
        }
        before = after;
    }
}

TEST(SpanProperty, NeitherTheOrderOfTrianglesNorTheNumberOfThreadsChangesABit) {
    HangingBodies model(120, 17);
    append(model.city.city, randomTriangles(300, 24.0F, 4).city);
    CityModel city = model.city.city;
    const GridSpec grid{0.0, 0.0, 0.25, 96, 96};
    const Heightfield field = builtField(city, grid);
    ASSERT_FALSE(field.spans.empty());
    std::mt19937 random(5);
    for (const int threads : {1, 2, 8}) {
        setThreadLimit(threads);
        std::shuffle(city.triangles.begin(), city.triangles.end(), random);
        for (CityTriangle& triangle : city.triangles)
            std::rotate(triangle.vertex.begin(), triangle.vertex.begin() + random() % 3,
                        triangle.vertex.end());
        const Heightfield again = builtField(city, grid);
        EXPECT_EQ(again.spans, field.spans);
        EXPECT_EQ(again.centerSpans, field.centerSpans);
        EXPECT_EQ(again.topMax, field.topMax);
    }
    setThreadLimit(0);
}

TEST(SpanProperty, ACityFarFromTheOriginOfItsCrsHasTheSameSpans) {
    CityModel city = HangingBodies(60, 21).city.city;
    for (const double s : {0.5, 0.1, 0.3}) {
        HeightfieldSettings settings;
        settings.cellSize = s;
        city.frame.origin = {0.0, 0.0, 0.0};
        const Heightfield near = builtField(city, gridFor(city, settings).value());
        city.frame.origin = {390000.0, s == 0.3 ? 5799000.0 : 5800000.0, 0.0};
        const Heightfield far = builtField(city, gridFor(city, settings).value());
        EXPECT_FALSE(near.spans.empty());
        EXPECT_EQ(near.grid, far.grid);
        EXPECT_EQ(near.spans, far.spans);
        EXPECT_EQ(near.centerSpans, far.centerSpans);
    }
}

}  // namespace
}  // namespace reflet::test
