// SPDX-License-Identifier: GPL-3.0-or-later
// Coverage against a brute force with ten times the samples that shares no code with it but the
// formula, and its figures against what they are by definition.
#include "core/coverage/CoverageFigures.h"
#include "core/environment/CubeDirection.h"
#include "core/reconstruction/MemVertexTracer.h"
#include "tests/unit/reconstruction/BoxCity.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace reflet::test {
namespace {

constexpr int kResolution = 64;

class CoverageFiguresTest : public testing::Test {
protected:
    CoverageFiguresTest() {
        for (const double x : {-30.0, 0.0, 32.0}) {
            centers.emplace_back(x, 0.5, 1.7);
            rems.add(sightFrom(tracer, centers.back(), kResolution, std::to_string(x)));
        }
    }
    /// The rule written once more: visibility by rays along the four texels around the point,
    /// each through traceReference.
    [[nodiscard]] double serviceByRays(const glm::dvec3& vehicle, const glm::dvec3& direction,
                                       const glm::dvec3& center) const {
        const GridSpec& grid = city.heightfield().grid;
        const auto meet = [&](const glm::dvec3& from, const glm::dvec3& along) {
            return traceReference(grid, city.heightfield().topCenter,
                                  {from, glm::normalize(along)});
        };
        if (glm::distance(vehicle, center) > 80.0)
            return 0.0;
        const HeightfieldHit hit = meet(vehicle, direction);
        const glm::dvec3 point = vehicle + hit.t * direction;
        const glm::dvec3 towards = hit.hit ? point - center : direction;
        double seen = 0.0;
        const BilinearFootprint around = bilinearFootprint(kResolution, towards);
        for (const Texel& texel : around.texel) {
            const HeightfieldHit one =
                meet(center, texelDirection(kResolution, texel.face, texel.column, texel.row));
            seen = std::max(seen, one.hit ? one.t : double(INFINITY));
        }
        if (!hit.hit)
            return std::isinf(seen) ? 1.0 : 0.0;
        const double far = glm::length(towards);
        const double tolerance = std::sqrt(0.5) * grid.cellSize;
        if (far > tolerance && seen < far - tolerance)
            return 0.0;
        const glm::dvec3 normal(
            surfaceNormal(tracer, std::uint32_t(grid.index(hit.i, hit.j)), point, vehicle));
        const double cosP = std::max(1e-3, -glm::dot(normal, direction));
        const double cosC = glm::dot(normal, -towards / far);
        if (cosC <= 0.0)
            return 0.0;
        const double blur = far / hit.t * std::sqrt(cosP / cosC);
        const double angle = std::acos(std::clamp(glm::dot(direction, towards / far), -1.0, 1.0));
        const double shift =
            0.5 * grid.cellSize * std::sin(angle) / far / (std::numbers::pi / 2.0 / kResolution);
        const double left = std::min(1.0, 4.0 / blur) * std::min(1.0, 4.0 / shift);
        return left < 0.05 ? 0.0 : left;
    }

    BoxCity city = streetCity();
    HeightfieldTracer tracer{city.heightfield()};
    ServiceRule rule{city.heightfield().grid};
    std::vector<DemandLine> lines{
        {"street",
         std::make_shared<Route>(std::vector<glm::dvec3>{{-40.0, 0.0, 0.0}, {40.0, 0.0, 0.0}}),
         std::make_shared<const BodyReflections>(*builtInVehicle("car")), 1.0}};
    std::vector<glm::dvec3> centers;
    RemSet rems;
};

TEST_F(CoverageFiguresTest, AgreesWithBruteForceOnTenTimesTheSamples) {
    constexpr std::size_t count = 8000;
    const Demand demand = sampleDemand(tracer, lines, {}, count, 1);
    const SampleCoverage coverage = coverageOf(demand, rule, rems);
    const Estimate ours = estimateOf(coverage.best);
    // Random numbers in place of the sequence, and the direction by choosing from the weights.
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    double sum = 0.0;
    for (std::size_t i = 0; i < 10 * count; ++i) {
        const glm::dvec3 vehicle(-40.0 + 80.0 * unit(random), 0.0,
                                 lines[0].reflections->centerHeight());
        const double side = unit(random) < 0.5 ? -1.0 : 1.0;
        const glm::dvec3 eye(25.0 * (2.0 * unit(random) - 1.0), side * (3.0 + 6.0 * unit(random)),
                             1.6);
        const glm::dvec3 direction =
            lines[0].reflections->direction(eye, {unit(random), unit(random)});
        double best = 0.0;
        for (const glm::dvec3& center : centers)
            best = std::max(best, serviceByRays(vehicle, direction, center));
        sum += best;
    }
    const double theirs = sum / double(10 * count);
    EXPECT_NEAR(ours.mean, theirs, 0.005);
    EXPECT_LE(ours.error, 0.005);
    EXPECT_GT(theirs, 0.3) << "a case that says something";
    EXPECT_LT(theirs, 0.98);
}

TEST_F(CoverageFiguresTest, TellsWhichRemServesAndHowManySee) {
    const Demand demand = sampleDemand(tracer, lines, {}, 2000, 2);
    const SampleCoverage coverage = coverageOf(demand, rule, rems);
    for (std::size_t i = 0; i < demand.samples.size(); ++i) {
        double best = 0.0;
        std::uint32_t which = SampleCoverage::kNoRem;
        int seen = 0;
        for (std::uint32_t k = 0; k < rems.size(); ++k) {
            const double service = rule.service(demand.samples[i], rems[k]);
            seen += service > 0.0 ? 1 : 0;
            if (float(service) > float(best)) {
                best = service;
                which = k;
            }
        }
        EXPECT_EQ(coverage.best[i], float(best));
        EXPECT_EQ(coverage.rem[i], which);
        EXPECT_EQ(int(coverage.seenBy[i]), seen);
    }
}

TEST_F(CoverageFiguresTest, TheRunTimeServesAtMostTheBestAndNearlyAsMuch) {
    const Demand demand = sampleDemand(tracer, lines, {}, 4000, 3);
    const SampleCoverage coverage = coverageOf(demand, rule, rems);
    const PreparedRems prepared(std::make_shared<const HeightfieldTracer>(city.heightfield()),
                                rems);
    const std::vector<float> served = coverageAtRunTime(demand, rule, tracer, prepared, {});
    double best = 0.0, shown = 0.0;
    for (std::size_t i = 0; i < served.size(); ++i) {
        EXPECT_LE(served[i], coverage.best[i] + 1e-6F) << i;
        best += double(coverage.best[i]);
        shown += double(served[i]);
    }
    EXPECT_GT(shown, 0.85 * best);
}

TEST_F(CoverageFiguresTest, StretchesAddUpToTheWhole) {
    const Demand demand = sampleDemand(tracer, lines, {}, 16000, 4);
    const SampleCoverage coverage = coverageOf(demand, rule, rems);
    const auto stretches = coveredStretches(demand, coverage, lines, 12.0);
    ASSERT_EQ(stretches.size(), 7U) << "80 m in stretches of at most 12 m";
    EXPECT_DOUBLE_EQ(stretches.front().from, 0.0);
    EXPECT_DOUBLE_EQ(stretches.back().to, 80.0);
    std::size_t samples = 0;
    for (const CoveredStretch& s : stretches) {
        samples += s.samples;
        EXPECT_LE(s.coverage, s.seen + 1e-9);
        EXPECT_LE(s.seenTwice, s.seen);
    }
    EXPECT_EQ(samples, demand.samples.size());
    const LineFigures figures = lineFigures(stretches);
    EXPECT_NEAR(figures.length, 80.0, 1e-9);
    EXPECT_NEAR(figures.coverage, estimateOf(coverage.best).mean, 0.005);
    EXPECT_LE(figures.worst, figures.p05);
    EXPECT_LE(figures.p05, figures.coverage);
}

TEST(LineFiguresTest, AreWhatTheySay) {
    // 20 stretches of 10 m; two bad ones in a row, one alone, and an empty one.
    std::vector<CoveredStretch> stretches;
    for (int k = 0; k < 20; ++k)
        stretches.push_back({0, 10.0 * k, 10.0 * (k + 1), 100, 0.9, 1.0, 0.5});
    stretches[4].coverage = 0.4;
    stretches[5].coverage = 0.1;
    stretches[12].coverage = 0.3;
    stretches[15].samples = 0;
    const LineFigures figures = lineFigures(stretches);
    EXPECT_NEAR(figures.length, 190.0, 1e-9);
    EXPECT_NEAR(figures.coverage, (16 * 0.9 + 0.8) / 19.0, 1e-9);
    EXPECT_NEAR(figures.worst, 0.1, 1e-12);
    EXPECT_NEAR(figures.worstStation, 55.0, 1e-9);
    EXPECT_NEAR(figures.p05, 0.1, 1e-12) << "9.5 m are the least twentieth";
    EXPECT_NEAR(figures.largestGap, 20.0, 1e-9);
    EXPECT_NEAR(figures.seenTwice, 0.5, 1e-9);
    EXPECT_EQ(lineFigures({}).length, 0.0);

    const std::vector<DemandLine> lines{
        {"a", std::make_shared<Route>(std::vector<glm::dvec3>{{0, 0, 0}, {200, 0, 0}}), nullptr,
         1.0}};
    const auto worst = worstStretches(stretches, lines, 3, 25.0);
    ASSERT_EQ(worst.size(), 3U);
    EXPECT_EQ(worst[0].from, 50.0);
    EXPECT_EQ(worst[1].from, 120.0) << "that at 40 m is too near to the worst";
    EXPECT_NEAR(worst[2].coverage, 0.9, 1e-12);
}

TEST(SurfacePatchesTest, AreasOfPlanesAreRightOnAverage) {
    // Points all over a slanted plane.
    Demand demand;
    SampleCoverage coverage;
    const glm::dvec3 u = glm::normalize(glm::dvec3(1.0, 2.0, 0.3));
    const glm::dvec3 v = glm::normalize(glm::cross(u, glm::dvec3(0.2, -0.1, 1.0)));
    const glm::dvec3 normal = glm::cross(u, v);
    for (int i = 0; i < 400; ++i) {
        for (int j = 0; j < 400; ++j) {
            DemandSample s;
            s.vehicle = 0.1 * i * u + 0.1 * j * v;
            s.direction = glm::vec3(0.0F);
            s.cell = 0;
            s.normal = glm::vec3(normal);
            demand.samples.push_back(s);
            coverage.best.push_back(i < 200 ? 1.0F : 0.0F);
        }
    }
    double area = 0.0, covered = 0.0;
    for (const SurfacePatch& patch : surfacePatches(demand, coverage, 2.0)) {
        area += patch.area;
        covered += patch.area * patch.coverage;
        EXPECT_EQ(patch.wall, std::abs(normal.z) < std::sqrt(0.5));
    }
    // 40 m × 40 m, and what the cubes at its border hold more.
    EXPECT_NEAR(area, 1600.0, 160.0);
    EXPECT_NEAR(covered / area, 0.5, 0.03);
}

}  // namespace
}  // namespace reflet::test
