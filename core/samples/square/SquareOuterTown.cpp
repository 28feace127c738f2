// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/kit/Ground.h"
#include "core/samples/kit/House.h"
#include "core/samples/square/SquarePlan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace reflet::square {

namespace {

using namespace kit;

/// Walls left to the procedural façade under a tiled roof: houses that nobody walks past.
void simpleHouse(Mesh& mesh, const Plot& plot, double z, double height, Random& random) {
    const Skin wall{Paint::None, SurfaceType::Wall};
    for (std::size_t s = 0; s < 4; ++s) {
        const Facade f = facadeOf(plot, Side(s), z);
        panel(mesh, f, {0, f.length, 0, height}, 0, wall);
        ledge(mesh, f, {0, f.length, height - 0.5, height}, 0, 0.35,
              {Paint::Trim, SurfaceType::Wall});
    }
    RoofStyle roof;
    roof.alongX = plot.width() >= plot.depth();
    roof.pitch = random.between(0.36, 0.5);
    roof.course = 3.0;
    roof.patch = 9.0;
    roof.ridgeTiles = false;
    tiledRoof(mesh, plot, z + height, roof, random);
    if (random.chance(0.6)) {
        return;
    }
    const glm::dvec2 c = plot.center();
    chimney(mesh, c + glm::dvec2(random.between(-2, 2), random.between(-2, 2)), z + height + 1.0,
            z + height + 0.5 * roof.pitch * std::min(plot.width(), plot.depth()) + 1.4,
            Paint::PlasterCream);
}

/// Fills a block with houses around yards.
void fillBlock(SampleCity& city, int number, const Plot& block, Random& random) {
    const int columns = std::max(1, int(std::lround(block.width() / 21.0)));
    const int rows = std::max(1, int(std::lround(block.depth() / 18.0)));
    const double w = block.width() / columns, h = block.depth() / rows;
    Mesh& mesh = city.add(fmt::format("block-{:02}", number), CityObjectType::Building).mesh;
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const bool inside = i > 0 && j > 0 && i + 1 < columns && j + 1 < rows;
            if (inside && random.chance(0.55)) {
                continue;
            }
            const double gap = random.between(0.02, 0.8);
            const Plot plot{block.x0 + i * w + gap, block.y0 + j * h + gap,
                            block.x0 + (i + 1) * w - gap, block.y0 + (j + 1) * h - gap};
            simpleHouse(mesh, plot, kPavement, random.between(10.5, 18.5), random);
        }
    }
}

/// Behind the front rows, on the pavements that are already there.
constexpr Plot kInner[] = {
    {-340, 36, -262, 94},   {-250, 36, -160, 94},   {-148, 36, -62, 94},   {-58, 52, -6, 94},
    {36, 52, 61, 94},       {77, 49, 202, 94},      {229, -108, 300, 94},  {-340, -94, -262, -24},
    {-250, -94, -160, -24}, {-148, -94, -114, -22}, {-112, -94, -62, -46}, {-58, -94, -22, -58},
    {22, -94, 60, -58},     {74, -109, 176, -73},
};

/// With pavements of their own.
constexpr Plot kOuter[] = {
    {-340, 109, -262, 180},   {-250, 109, -160, 180},   {-148, 109, -66, 180},
    {-54, 109, 6, 180},       {24, 109, 62, 180},       {78, 109, 200, 180},
    {216, 109, 300, 180},     {-340, 194, -262, 252},   {-250, 194, -160, 252},
    {-148, 194, -66, 252},    {-54, 194, 6, 252},       {24, 194, 62, 252},
    {78, 194, 200, 252},      {216, 194, 300, 252},     {-340, -180, -262, -109},
    {-250, -180, -160, -109}, {-148, -180, -66, -109},  {-54, -180, -8, -109},
    {8, -180, 60, -109},      {74, -180, 176, -124},    {211, -180, 300, -124},
    {-340, -252, -262, -194}, {-250, -252, -160, -194}, {-148, -252, -66, -194},
    {-54, -252, -8, -194},    {8, -252, 60, -194},      {74, -252, 176, -194},
    {211, -252, 300, -194},   {-376, 30, -354, 180},    {-376, -180, -354, -18},
    {-376, -16, -354, 28},    {306, -250, 317, 250},
};

}  // namespace

void addOuterTown(SampleCity& city, Random random) {
    int number = 0;
    for (const Plot& plot : kInner) {
        fillBlock(city, ++number, plot, random);
    }
    for (const Plot& plot : kOuter) {
        fillBlock(city, ++number, plot, random);
        pavement(city.add(fmt::format("pavement-block-{:02}", number), CityObjectType::Road).mesh,
                 plot.grown(1.8), 0.0, kPavement, 0.0, random);
    }
}

}  // namespace reflet::square
