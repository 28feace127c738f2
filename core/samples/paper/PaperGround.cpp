// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/kit/Ground.h"
#include "core/samples/paper/PaperPlan.h"

#include <fmt/format.h>

#include <algorithm>

namespace reflet::paper {

using namespace kit;

kit::Plot blockPlot(int row, int column) {
    const auto span = [](int i) {
        const double edge = kRoadHalf + kPavementWidth;
        const double low = i == 0 ? -kHalf : kRoads[std::size_t(i) - 1] + edge;
        const double high = i == 4 ? kHalf : kRoads[std::size_t(i)] - edge;
        return std::pair{low, high};
    };
    const auto [x0, x1] = span(column);
    const auto [y0, y1] = span(row);
    return {x0, y0, x1, y1};
}

namespace {

/// Terrain under everything, 5 cm below the roads: a square kilometre in 100 m squares.
void addTerrain(SampleCity& city) {
    Mesh& mesh = city.add("terrain", CityObjectType::TinRelief).mesh;
    constexpr double kStep = 100.0;
    for (double y = -kHalf; y < kHalf; y += kStep) {
        for (double x = -kHalf; x < kHalf; x += kStep) {
            const Skin skin{Paint::Lawn, SurfaceType::Unknown};
            const double z = -0.05;
            mesh.polygon({{x, y, z}, {x + kStep, y, z}, {x + kStep, y + kStep, z}}, skin);
            mesh.polygon({{x, y, z}, {x + kStep, y + kStep, z}, {x, y + kStep, z}}, skin);
        }
    }
}

void addRoads(SampleCity& city) {
    const Skin asphalt{Paint::Asphalt, SurfaceType::TrafficArea};
    for (std::size_t r = 0; r < 4; ++r) {
        const double at = kRoads[r];
        // Roads that run north take the crossings; those that run east are cut there.
        Mesh& north = city.add(fmt::format("road-north-{}", r + 1), CityObjectType::Road).mesh;
        slab(north, {at - kRoadHalf, -kHalf, at + kRoadHalf, kHalf}, 0.0, asphalt);
        Mesh& east = city.add(fmt::format("road-east-{}", r + 1), CityObjectType::Road).mesh;
        double from = -kHalf;
        for (std::size_t k = 0; k <= 4; ++k) {
            const double to = k == 4 ? kHalf : kRoads[k] - kRoadHalf;
            slab(east, {from, at - kRoadHalf, to, at + kRoadHalf}, 0.0, asphalt);
            dashes(east, {from + 4.0, at}, {to - 4.0, at}, 0.02);
            from = k == 4 ? kHalf : kRoads[k] + kRoadHalf;
        }
    }
}

void addBlock(SampleCity& city, int number) {
    const Plot inner = blockPlot(number / 5, number % 5);
    const Plot plot = inner.grown(kPavementWidth);
    const Plot clipped{std::max(plot.x0, -kHalf), std::max(plot.y0, -kHalf),
                       std::min(plot.x1, kHalf), std::min(plot.y1, kHalf)};
    Mesh& mesh = city.add(fmt::format("pavement-{:02}", number + 1), CityObjectType::Road).mesh;
    block(mesh, clipped, -0.05, kPavementHeight,
          {Paint::Granite, SurfaceType::AuxiliaryTrafficArea},
          {Paint::PaveGreyA, SurfaceType::AuxiliaryTrafficArea});
    const bool green =
        std::find(kGreenBlocks.begin(), kGreenBlocks.end(), number) != kGreenBlocks.end();
    if (green) {  // a lawn along the block's southern road, where the trees stand
        slab(city.add(fmt::format("lawn-{:02}", number + 1), CityObjectType::PlantCover).mesh,
             {inner.x0 + 2, inner.y0 + 1, inner.x1 - 2, inner.y0 + 30}, kPavementHeight + 0.03,
             {Paint::Lawn, SurfaceType::Unknown});
    }
}

}  // namespace

void addGround(SampleCity& city) {
    addTerrain(city);
    addRoads(city);
    for (int number = 0; number < 25; ++number) {
        addBlock(city, number);
    }
}

}  // namespace reflet::paper
