// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/kit/Roof.h"
#include "core/samples/kit/Tree.h"
#include "core/samples/square/SquarePlan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace reflet::square {

namespace {

using namespace kit;

constexpr double kStep = 20.0;

/// An amphitheatre of hills about the town: zero at its edge, rising to a wavy ridge.
double hillHeight(double x, double y) {
    const double dx = std::max({kTown.x0 - x, x - kTown.x1, 0.0});
    const double dy = std::max({kTown.y0 - y, y - kTown.y1, 0.0});
    const double away = std::hypot(dx, dy) / 130.0;
    const double t = std::clamp(away, 0.0, 1.0);
    const double ridge = 58.0 + 16.0 * std::sin(0.011 * x + 0.7) +
                         11.0 * std::sin(0.017 * y - 0.4) + 6.0 * std::sin(0.031 * (x + y));
    return ridge * t * t * (3.0 - 2.0 * t) + 3.0 * t * std::sin(0.09 * x) * std::cos(0.08 * y);
}

void addTerrain(SampleCity& city, Random& random) {
    Mesh& mesh = city.add("hills", CityObjectType::TinRelief).mesh;
    static constexpr std::array kTones{Paint::HillA, Paint::HillB, Paint::HillC, Paint::HillB,
                                       Paint::HillRock};
    const int columns = int(std::lround(kCountry.width() / kStep));
    const int rows = int(std::lround(kCountry.depth() / kStep));
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const double x0 = kCountry.x0 + i * kStep, x1 = x0 + kStep;
            const double y0 = kCountry.y0 + j * kStep, y1 = y0 + kStep;
            if (x0 >= kTown.x0 && x1 <= kTown.x1 && y0 >= kTown.y0 && y1 <= kTown.y1) {
                continue;
            }
            const auto p = [&](double x, double y) { return glm::dvec3(x, y, hillHeight(x, y)); };
            const Skin skin{random.pick(kTones), SurfaceType::Unknown};
            mesh.polygon({p(x0, y0), p(x1, y0), p(x1, y1)}, skin);
            mesh.polygon({p(x0, y0), p(x1, y1), p(x0, y1)}, skin);
        }
    }
}

glm::dvec2 onHills(Random& random) {
    for (;;) {
        const glm::dvec2 at(random.between(kCountry.x0 + 12, kCountry.x1 - 12),
                            random.between(kCountry.y0 + 12, kCountry.y1 - 12));
        if (!kTown.grown(14.0).contains(at.x, at.y)) {
            return at;
        }
    }
}

void addVillas(SampleCity& city, Random& random) {
    for (int i = 1; i <= 70; ++i) {
        const glm::dvec2 at = onHills(random);
        const double w = random.between(4.0, 6.0), d = random.between(3.2, 4.5);
        const Plot plot{at.x - w, at.y - d, at.x + w, at.y + d};
        double low = 1e9, high = -1e9;
        for (const double x : {plot.x0, plot.x1}) {
            for (const double y : {plot.y0, plot.y1}) {
                low = std::min(low, hillHeight(x, y));
                high = std::max(high, hillHeight(x, y));
            }
        }
        Mesh& mesh = city.add(fmt::format("villa-{:02}", i), CityObjectType::Building).mesh;
        const double eaves = high + random.between(2.8, 5.0);
        for (std::size_t s = 0; s < 4; ++s) {
            const Facade f = facadeOf(plot, Side(s), low - 0.5);
            panel(mesh, f, {0, f.length, 0, eaves - low + 0.5}, 0,
                  {Paint::None, SurfaceType::Wall});
        }
        RoofStyle roof;
        roof.course = 2.5;
        roof.patch = 8.0;
        roof.ridgeTiles = false;
        tiledRoof(mesh, plot, eaves, roof, random);
    }
}

void addWoods(SampleCity& city, Random& random) {
    const std::size_t tree = city.addTemplate(distantTree(random));
    const std::size_t other = city.addTemplate(distantTree(random));
    SampleObject& woods = city.add("woods", CityObjectType::SolitaryVegetation);
    for (int i = 0; i < 230; ++i) {
        const glm::dvec2 at = onHills(random);
        woods.placements.push_back({random.chance(0.5) ? tree : other,
                                    glm::dvec3(at, hillHeight(at.x, at.y)),
                                    random.between(0, 2 * kPi), random.between(0.7, 1.5)});
    }
}

}  // namespace

void addHills(SampleCity& city, Random random) {
    addTerrain(city, random);
    addVillas(city, random);
    addWoods(city, random);
}

}  // namespace reflet::square
