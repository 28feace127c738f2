// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/kit/Facade.h"
#include "core/samples/paper/Paper.h"
#include "core/samples/paper/PaperPlan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

namespace reflet::paper {

namespace {

using namespace kit;

constexpr Skin kWall{Paint::None, SurfaceType::Wall};
constexpr Skin kRoof{Paint::FlatRoof, SurfaceType::Roof};
constexpr Skin kPlant{Paint::Steel, SurfaceType::Roof};  ///< machines on the roof

constexpr std::size_t kBoxTriangles = 10;
constexpr std::size_t kClosedBoxTriangles = 12;

/// A storeyed body with a parapet about its flat roof: 8 + 8 + 8 + 2 = 26 triangles.
void tier(Mesh& mesh, const Plot& plot, double z0, double z1) {
    constexpr double kThick = 0.35;
    constexpr double kParapet = 0.9;
    const Plot inner = plot.grown(-kThick);
    const std::array<glm::dvec2, 4> out{
        {{plot.x0, plot.y0}, {plot.x1, plot.y0}, {plot.x1, plot.y1}, {plot.x0, plot.y1}}};
    const std::array<glm::dvec2, 4> in{
        {{inner.x0, inner.y0}, {inner.x1, inner.y0}, {inner.x1, inner.y1}, {inner.x0, inner.y1}}};
    const double top = z1 + kParapet;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t k = (i + 1) % 4;
        mesh.polygon({{out[i], z0}, {out[k], z0}, {out[k], top}, {out[i], top}}, kWall);
        mesh.polygon({{out[i], top}, {out[k], top}, {in[k], top}, {in[i], top}},
                     {Paint::Concrete, SurfaceType::Roof});
        mesh.polygon({{in[k], z1}, {in[i], z1}, {in[i], top}, {in[k], top}},
                     {Paint::Concrete, SurfaceType::Wall});
    }
    slab(mesh, inner, z1, kRoof);
}

/// Fills up to the exact count with machine rooms, ducts and skylights on a flat roof: any even
/// rest that is a sum of tens and twelves.
void roofPlant(Mesh& mesh, const Plot& roof, double z, std::size_t triangles, Random& random) {
    std::size_t closed = 0;
    while (closed < 5 && (triangles - closed * kClosedBoxTriangles) % kBoxTriangles != 0) {
        ++closed;
    }
    assert(triangles >= closed * kClosedBoxTriangles);
    const std::size_t boxes = (triangles - closed * kClosedBoxTriangles) / kBoxTriangles + closed;
    const int columns = std::max(1, int(std::ceil(std::sqrt(double(boxes)))));
    const double w = roof.width() / columns, h = roof.depth() / columns;
    for (std::size_t i = 0; i < boxes; ++i) {
        const double cx = roof.x0 + (double(i % std::size_t(columns)) + 0.5) * w;
        const double cy = roof.y0 + (double(i / std::size_t(columns)) + 0.5) * h;
        const double a = w * random.between(0.16, 0.36), b = h * random.between(0.16, 0.36);
        const double high = i == 0 ? 3.0 : random.between(0.6, 2.2);
        const Stand stand{{cx, cy, z}};
        // A skylight stands on feet, so its underside is seen; a machine room stands on the roof.
        const bool skylight = i < closed;
        const double low = skylight ? 0.3 : 0.0;
        box(mesh, stand, {-a, -b, low}, {a, b, low + high},
            i % 3 == 0 ? Skin{Paint::Concrete, SurfaceType::Roof} : kPlant, skylight);
    }
}

/// A tower over a podium, a stepped block or a plain one, of 100 triangles each.
void building(Mesh& mesh, const Plot& plot, double height, int setbacks, Random& random) {
    Plot body = plot;
    double z = kPavementHeight;
    const std::array<double, 3> shares = setbacks == 0   ? std::array<double, 3>{1, 0, 0}
                                         : setbacks == 1 ? std::array<double, 3>{0.35, 1, 0}
                                                         : std::array<double, 3>{0.3, 0.75, 1};
    for (int t = 0; t <= setbacks; ++t) {
        const double top = kPavementHeight + height * shares[std::size_t(t)];
        tier(mesh, body, z, top);
        z = top;
        if (t < setbacks) {
            const double in = std::min(body.width(), body.depth()) * random.between(0.09, 0.17);
            body = body.grown(-in);
        }
    }
    roofPlant(mesh, body.grown(-1.5), z, kTrianglesPerBuilding - mesh.triangleCount(), random);
}

double heightAt(const glm::dvec2& at, Random& random) {
    const double centre =
        std::exp(-glm::dot(at, at) / (2.0 * 190.0 * 190.0));  // towers in the middle
    return 11.0 + random.between(0.0, 14.0) + centre * random.between(4.0, 52.0);
}

/// The lots of a block: two rows back to back along x, none on a green.
std::vector<Plot> lots(int number, std::size_t count) {
    const Plot b = blockPlot(number / 5, number % 5);
    const bool green =
        std::find(kGreenBlocks.begin(), kGreenBlocks.end(), number) != kGreenBlocks.end();
    const double y0 = green ? b.y0 + 34.0 : b.y0 + 2.0;
    const std::size_t south = count / 2, north = count - south;
    const double middle = 0.5 * (y0 + b.y1);
    std::vector<Plot> plots;
    for (const auto& [n, low, high] :
         {std::tuple{south, y0, middle - 6.0}, std::tuple{north, middle + 6.0, b.y1 - 2.0}}) {
        const double w = (b.width() - 4.0) / double(n);
        for (std::size_t i = 0; i < n; ++i) {
            const double x0 = b.x0 + 2.0 + double(i) * w;
            plots.push_back({x0, low, x0 + w, high});
        }
    }
    return plots;
}

}  // namespace

void addBuildings(SampleCity& city, Random random) {
    std::size_t left = kBuildings;
    int number = 0;
    for (int block = 0; block < 25; ++block) {
        const std::size_t here = left / std::size_t(25 - block);
        left -= here;
        for (const Plot& lot : lots(block, here)) {
            const Plot plot{lot.x0 + random.between(1.0, 4.0), lot.y0 + random.between(0.0, 5.0),
                            lot.x1 - random.between(1.0, 4.0), lot.y1 - random.between(0.0, 5.0)};
            const double height = heightAt(plot.center(), random);
            const int setbacks = height > 34.0   ? 2
                                 : height > 21.0 ? random.integer(0, 2)
                                                 : random.integer(0, 1);
            Mesh& mesh =
                city.add(fmt::format("building-{:03}", ++number), CityObjectType::Building).mesh;
            building(mesh, plot, height, setbacks, random);
        }
    }
}

}  // namespace reflet::paper
