// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/city/CityModel.h"

#include <algorithm>
#include <random>

namespace reflet::test {

/// Puts small cities together by hand.
class TestCity {
public:
    /// All triangles added from here on belong to a new object of this type.
    TestCity& object(CityObjectType type, SurfaceType surface = SurfaceType::Unknown) {
        CityObject object;
        object.id = std::to_string(city.objects.size());
        object.type = type;
        city.objects.push_back(std::move(object));
        return this->surface(surface);
    }
    TestCity& surface(SurfaceType type) {
        CitySurface surface;
        surface.object = std::uint32_t(city.objects.size()) - 1;
        surface.type = type;
        city.surfaces.push_back(surface);
        return *this;
    }
    TestCity& triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
        const auto first = std::uint32_t(city.vertices.size());
        city.vertices.insert(city.vertices.end(), {a, b, c});
        CityTriangle triangle;
        triangle.vertex = {first, first + 1, first + 2};
        triangle.surface = std::uint32_t(city.surfaces.size()) - 1;
        city.triangles.push_back(triangle);
        return *this;
    }
    TestCity& quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
        return triangle(a, b, c).triangle(a, c, d);
    }
    /// Level ground of one terrain object.
    TestCity& ground(float x0, float y0, float x1, float y1, float z) {
        return object(CityObjectType::TinRelief)
            .quad({x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z});
    }
    /// A closed box with wall, roof and ground surfaces, as one building.
    TestCity& box(glm::vec3 low, glm::vec3 high) {
        const auto at = [&](int x, int y, int z) {
            return glm::vec3(x ? high.x : low.x, y ? high.y : low.y, z ? high.z : low.z);
        };
        object(CityObjectType::Building, SurfaceType::Roof);
        quad(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1));
        surface(SurfaceType::Ground);
        quad(at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0));
        surface(SurfaceType::Wall);
        quad(at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1));
        quad(at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1));
        quad(at(1, 1, 0), at(0, 1, 0), at(0, 1, 1), at(1, 1, 1));
        return quad(at(0, 1, 0), at(0, 0, 0), at(0, 0, 1), at(0, 1, 1));
    }

    CityModel city;
};

/// Triangles of all sizes and slopes, walls and slivers among them, over [0, extent]².
inline TestCity randomTriangles(int count, float extent, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0.0F, 1.0F);
    const auto in = [&](float from, float to) { return from + (to - from) * unit(random); };
    TestCity city;
    city.object(CityObjectType::Building, SurfaceType::Roof);
    for (int n = 0; n < count; ++n) {
        const float size = std::pow(10.0F, in(-1.0F, 1.3F));
        const auto corner = [&](glm::vec3 center) {
            return glm::vec3(std::clamp(center.x + in(-size, size), 0.0F, extent),
                             std::clamp(center.y + in(-size, size), 0.0F, extent),
                             center.z + in(-size, size));
        };
        const glm::vec3 center(in(0.0F, extent), in(0.0F, extent), in(0.0F, 50.0F));
        const glm::vec3 a = corner(center);
        glm::vec3 b = corner(center);
        glm::vec3 c = corner(center);
        if (n % 4 == 0) {
            b = {a.x, a.y, b.z};  // an upright wall
        } else if (n % 7 == 0) {
            c = a + (b - a) * 0.5F + glm::vec3(0.0F, 1e-3F, 0.0F);  // a sliver
        } else if (n % 5 == 0) {
            b.z = c.z = a.z;  // level
        }
        city.triangle(a, b, c);
    }
    return city;
}

}  // namespace reflet::test
