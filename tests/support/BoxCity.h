// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/Frame.h"

#include <functional>
#include <memory>

namespace reflet::test {

/// A house of 20 m × 10 m and 12 m height, x and y from (10, 10) to (30, 20), on a ground of 120 m
/// × 120 m around the origin: as a mesh and as a heightfield with cells of half a metre.
class BoxCity {
public:
    using GroundHeight = std::function<double(double, double)>;
    static constexpr double kHalf = 60.0;
    static constexpr double kCell = 0.5;
    static constexpr double kHouseHeight = 12.0;

    [[nodiscard]] static bool inHouse(double x, double y) {
        return x >= 10.0 && x < 30.0 && y >= 10.0 && y < 20.0;
    }

    [[nodiscard]] static std::shared_ptr<const DrawnCity> make(
        const GroundHeight& ground = [](double, double) { return 0.0; }) {
        auto city = std::make_shared<DrawnCity>();
        auto model = std::make_shared<CityModel>(mesh());
        city->looks = std::make_shared<const SurfaceLooks>(*model);
        city->model = model;
        city->textures = std::make_shared<const std::vector<TextureImage>>();
        auto field = std::make_shared<Heightfield>(heights(ground));
        city->tracer = std::make_shared<const HeightfieldTracer>(*field);
        city->heightfield = field;
        city->diameter = 2.0 * kHalf;
        return city;
    }

private:
    static Heightfield heights(const GroundHeight& ground) {
        Heightfield field;
        const int cells = int(2.0 * kHalf / kCell);
        field.grid = {-kHalf, -kHalf, kCell, cells, cells};
        for (int j = 0; j < cells; ++j) {
            for (int i = 0; i < cells; ++i) {
                const double x = field.grid.xMin(i) + 0.5 * kCell;
                const double y = field.grid.yMin(j) + 0.5 * kCell;
                const auto z = float(ground(x, y));
                const float top = inHouse(x, y) ? z + float(kHouseHeight) : z;
                field.ground.push_back(z);
                field.topCenter.push_back(top);
                field.topMax.push_back(top);
            }
        }
        return field;
    }

    static void addQuad(CityModel& model, std::uint32_t object, SurfaceType type,
                        const std::array<glm::vec3, 4>& corners) {
        const auto first = std::uint32_t(model.vertices.size());
        const auto surface = std::uint32_t(model.surfaces.size());
        model.vertices.insert(model.vertices.end(), corners.begin(), corners.end());
        CitySurface made;
        made.object = object;
        made.type = type;
        model.surfaces.push_back(made);
        model.triangles.push_back({{first, first + 1, first + 2}, surface});
        model.triangles.push_back({{first, first + 2, first + 3}, surface});
    }

    static CityModel mesh() {
        CityModel model;
        model.objects.push_back({"ground", CityObjectType::TinRelief, "TINRelief", "1", {}});
        model.objects.push_back({"house", CityObjectType::Building, "Building", "2", {}});
        const auto h = float(kHalf), top = float(kHouseHeight);
        addQuad(model, 0, SurfaceType::Unknown,
                {{{-h, -h, 0.0F}, {h, -h, 0.0F}, {h, h, 0.0F}, {-h, h, 0.0F}}});
        const std::array<glm::vec2, 4> plan{{{10, 10}, {30, 10}, {30, 20}, {10, 20}}};
        for (std::size_t k = 0; k < 4; ++k) {
            const glm::vec2 a = plan[k], b = plan[(k + 1) % 4];
            addQuad(model, 1, SurfaceType::Wall,
                    {{{a.x, a.y, 0.0F}, {b.x, b.y, 0.0F}, {b.x, b.y, top}, {a.x, a.y, top}}});
        }
        addQuad(model, 1, SurfaceType::Roof,
                {{{10, 10, top}, {30, 10, top}, {30, 20, top}, {10, 20, top}}});
        return model;
    }
};

}  // namespace reflet::test
