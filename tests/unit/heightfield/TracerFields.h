// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/heightfield/HeightfieldTracer.h"
#include "tests/unit/heightfield/TracerRays.h"

#include <bit>
#include <cstdint>
#include <sstream>
#include <string>

namespace reflet::test {

inline bool sameBits(const HeightfieldHit& a, const HeightfieldHit& b) {
    return a.hit == b.hit && a.i == b.i && a.j == b.j &&
           std::bit_cast<std::uint64_t>(a.t) == std::bit_cast<std::uint64_t>(b.t);
}

inline std::string described(const Ray& ray, const HeightfieldHit& expected,
                             const HeightfieldHit& got) {
    std::ostringstream text;
    text.precision(17);
    const auto point = [&](const glm::dvec3& p) { text << p.x << " " << p.y << " " << p.z; };
    const auto hit = [&](const HeightfieldHit& h) {
        text << h.hit << " t " << h.t << " cell " << h.i << " " << h.j;
    };
    text << "from ";
    point(ray.origin);
    text << " towards ";
    point(ray.direction);
    text << "\nexpected ";
    hit(expected);
    text << "\ngot      ";
    hit(got);
    return text.str();
}

/// Solid columns of few heights, some of them missing.
inline Heightfield blockyField(const GridSpec& grid, unsigned seed) {
    std::vector<float> layer = blockyLayer(grid, seed);
    return {grid, {}, layer, std::move(layer)};
}

/// Columns of whole and half metres, a third of them with one to three stretches above the lowest,
/// some of those as thin as a sheet; the layer holds the tops.
inline Heightfield blockyColumns(const GridSpec& grid, unsigned seed) {
    std::mt19937 random(seed);
    Heightfield field;
    field.grid = grid;
    field.topCenter = blockyLayer(grid, seed);
    std::vector<std::uint32_t> cells, first{0};
    std::vector<HeightSpan> spans;
    for (std::size_t cell = 0; cell < grid.cellCount(); ++cell) {
        if (random() % 3 != 0)
            continue;
        float height = 0.5F * float(random() % 4);
        spans.push_back({-kInfinity, height, CityObjectType::TinRelief, false});
        for (unsigned n = 1 + random() % 3; n > 0; --n) {
            const float low = height + 0.5F * float(1 + random() % 6);
            height = low + 0.5F * float(random() % 3);
            spans.push_back({low, height, CityObjectType::Bridge, false});
        }
        field.topCenter[cell] = height;
        cells.push_back(std::uint32_t(cell));
        first.push_back(std::uint32_t(spans.size()));
    }
    field.topMax = field.topCenter;
    field.centerSpans = CellSpans(grid.cellCount(), cells, first, spans);
    field.spans = field.centerSpans;
    return field;
}

}  // namespace reflet::test
