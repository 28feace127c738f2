// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/heightfield/HeightfieldBuilder.h"
#include "tests/unit/heightfield/TestCity.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace reflet::test {

/// A closed body over a convex outline (counter-clockwise seen from above) between two heights.
inline TestCity& addPrism(TestCity& city, const std::vector<glm::vec2>& outline, float low,
                          float high) {
    const std::size_t count = outline.size();
    for (std::size_t n = 1; n + 1 < count; ++n) {
        city.triangle({outline[0], high}, {outline[n], high}, {outline[n + 1], high});
        city.triangle({outline[0], low}, {outline[n + 1], low}, {outline[n], low});
    }
    for (std::size_t n = 0; n < count; ++n) {
        const glm::vec2 a = outline[n];
        const glm::vec2 b = outline[(n + 1) % count];
        city.quad({a, low}, {b, low}, {b, high}, {a, high});
    }
    return city;
}

inline TestCity& addBlock(TestCity& city, glm::vec3 low, glm::vec3 high) {
    return addPrism(city, {{low.x, low.y}, {high.x, low.y}, {high.x, high.y}, {low.x, high.y}},
                    low.z, high.z);
}

/// A closed body whose section in x and z is the polygon (counter-clockwise, seen towards +y),
/// given as convex parts that together have the polygon's outline, between two y.
inline TestCity& addVault(TestCity& city, float y0, float y1, float from, float to, float springing,
                          float top, int steps) {
    // An arch over [from, to]: half an ellipse from the springing to a metre below the top.
    const auto soffit = [&](int n) {
        const float angle = float(n) / float(steps) * 3.14159265F;
        const float middle = 0.5F * (from + to), half = 0.5F * (to - from);
        return glm::vec2(middle - half * std::cos(angle),
                         springing + (top - 1.0F - springing) * std::sin(angle));
    };
    for (int n = 0; n < steps; ++n) {
        const glm::vec2 a = soffit(n), b = soffit(n + 1);
        city.quad({a.x, y0, a.y}, {a.x, y1, a.y}, {b.x, y1, b.y}, {b.x, y0, b.y});  // underside
        city.quad({a.x, y0, top}, {b.x, y0, top}, {b.x, y1, top}, {a.x, y1, top});
        city.quad({a.x, y0, a.y}, {b.x, y0, b.y}, {b.x, y0, top}, {a.x, y0, top});
        city.quad({b.x, y1, b.y}, {a.x, y1, a.y}, {a.x, y1, top}, {b.x, y1, top});
    }
    city.quad({from, y1, springing}, {from, y0, springing}, {from, y0, top}, {from, y1, top});
    return city.quad({to, y0, springing}, {to, y1, springing}, {to, y1, top}, {to, y0, top});
}

/// The same with every triangle turned over.
inline CityModel insideOut(CityModel city) {
    for (CityTriangle& triangle : city.triangles)
        std::swap(triangle.vertex[1], triangle.vertex[2]);
    return city;
}

inline Heightfield builtField(const CityModel& city, const GridSpec& grid,
                              const HeightRules& rules = {}) {
    auto field = buildHeightfield(city, grid, rules, {});
    EXPECT_TRUE(field) << field.error().message();
    return field ? std::move(*field) : Heightfield{};
}

/// (low, high) of a column's solids; empty for a plain column.
inline std::vector<std::array<float, 2>> solidsAt(const CellSpans& spans, const GridSpec& grid,
                                                  int i, int j) {
    std::vector<std::array<float, 2>> out;
    for (const HeightSpan& span : spans.at(grid.index(i, j)))
        out.push_back({span.low, span.high});
    return out;
}

/// Whether the height lies in a solid of the column, `layer` being the top of plain ones.
inline bool isSolidAt(const CellSpans& spans, const std::vector<float>& layer, std::size_t cell,
                      double z, double slack) {
    const auto column = spans.at(cell);
    if (column.empty())
        return !isMissing(layer[cell]) && z <= double(layer[cell]) + slack;
    for (const HeightSpan& span : column) {
        if (z >= double(span.low) - slack && z <= double(span.high) + slack)
            return true;
    }
    return false;
}

}  // namespace reflet::test
