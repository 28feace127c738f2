// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/kit/Ground.h"

#include <algorithm>
#include <cmath>

namespace reflet::kit {

namespace {

constexpr Skin kKerb{Paint::Granite, SurfaceType::AuxiliaryTrafficArea};

Skin flagSkin(Random& random) {
    static constexpr std::array kTones{Paint::PaveGreyA, Paint::PaveGreyB, Paint::PaveGreyC};
    return {random.pick(kTones), SurfaceType::AuxiliaryTrafficArea};
}

glm::dvec2 leftOf(const glm::dvec2& d) {
    return {-d.y, d.x};
}

}  // namespace

void pavement(Mesh& mesh, const Plot& plot, double z0, double z1, double flag, Random& random) {
    const double border = std::min(0.3, 0.25 * std::min(plot.width(), plot.depth()));
    const Plot inner = plot.grown(-border);
    const std::array<glm::dvec2, 4> out{
        {{plot.x0, plot.y0}, {plot.x1, plot.y0}, {plot.x1, plot.y1}, {plot.x0, plot.y1}}};
    const std::array<glm::dvec2, 4> in{
        {{inner.x0, inner.y0}, {inner.x1, inner.y0}, {inner.x1, inner.y1}, {inner.x0, inner.y1}}};
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t k = (i + 1) % 4;
        mesh.polygon({{out[i], z0}, {out[k], z0}, {out[k], z1}, {out[i], z1}}, kKerb);
        mesh.polygon({{out[i], z1}, {out[k], z1}, {in[k], z1}, {in[i], z1}}, kKerb);
    }
    if (flag <= 0.0) {
        slab(mesh, inner, z1, flagSkin(random));
        return;
    }
    const int rows = std::max(1, int(std::lround(inner.depth() / (0.5 * flag))));
    const int columns = std::max(1, int(std::lround(inner.width() / flag)));
    const double h = inner.depth() / rows, w = inner.width() / columns;
    for (int j = 0; j < rows; ++j) {
        const double shift = j % 2 == 0 ? 0.0 : 0.5 * w;  // laid in bond
        for (int i = 0; i <= columns; ++i) {
            const double x0 = std::max(inner.x0, inner.x0 + i * w - shift);
            const double x1 = std::min(inner.x1, inner.x0 + (i + 1) * w - shift);
            if (x1 - x0 > 1e-6) {
                slab(mesh, {x0, inner.y0 + j * h, x1, inner.y0 + (j + 1) * h}, z1,
                     flagSkin(random));
            }
        }
    }
}

void checkerboard(Mesh& mesh, const Plot& plot, double z, double square, Paint light, Paint dark,
                  SurfaceType surface) {
    const int columns = std::max(1, int(std::lround(plot.width() / square)));
    const int rows = std::max(1, int(std::lround(plot.depth() / square)));
    const double w = plot.width() / columns, h = plot.depth() / rows;
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            slab(mesh,
                 {plot.x0 + i * w, plot.y0 + j * h, plot.x0 + (i + 1) * w, plot.y0 + (j + 1) * h},
                 z, {(i + j) % 2 == 0 ? light : dark, surface});
        }
    }
}

void zebra(Mesh& mesh, const Plot& plot, double z, bool stripesAlongX) {
    const double across = stripesAlongX ? plot.depth() : plot.width();
    const int stripes = std::max(1, int(across / 1.0));
    for (int i = 0; i < stripes; ++i) {
        const double a = across * (i + 0.25) / stripes, b = across * (i + 0.75) / stripes;
        const Plot stripe = stripesAlongX ? Plot{plot.x0, plot.y0 + a, plot.x1, plot.y0 + b}
                                          : Plot{plot.x0 + a, plot.y0, plot.x0 + b, plot.y1};
        slab(mesh, stripe, z, {Paint::Marking, SurfaceType::TrafficArea});
    }
}

void dashes(Mesh& mesh, const glm::dvec2& a, const glm::dvec2& b, double z) {
    const double length = glm::length(b - a);
    const glm::dvec2 d = (b - a) / length;
    const glm::dvec2 n = 0.07 * leftOf(d);
    for (double s = 1.0; s + 1.5 < length; s += 4.5) {
        const glm::dvec2 p = a + s * d, q = a + (s + 1.5) * d;
        mesh.polygon({{p - n, z}, {q - n, z}, {q + n, z}, {p + n, z}},
                     {Paint::Marking, SurfaceType::TrafficArea});
    }
}

glm::dvec2 parallelPoint(std::span<const glm::dvec2> line, std::size_t i, double offset) {
    const glm::dvec2 before = i == 0 ? line[1] - line[0] : line[i] - line[i - 1];
    const glm::dvec2 after = i + 1 == line.size() ? before : line[i + 1] - line[i];
    const glm::dvec2 a = leftOf(glm::normalize(before)), b = leftOf(glm::normalize(after));
    const glm::dvec2 middle = glm::normalize(a + b);
    return line[i] + offset / glm::dot(middle, a) * middle;
}

void ribbon(Mesh& mesh, std::span<const glm::dvec2> line, double right, double left, double z,
            Skin skin) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        mesh.polygon({{parallelPoint(line, i, right), z},
                      {parallelPoint(line, i + 1, right), z},
                      {parallelPoint(line, i + 1, left), z},
                      {parallelPoint(line, i, left), z}},
                     skin);
    }
}

void ribbonEdge(Mesh& mesh, std::span<const glm::dvec2> line, double offset, double z0, double z1,
                bool facesLeft, Skin skin) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        glm::dvec2 a = parallelPoint(line, i, offset), b = parallelPoint(line, i + 1, offset);
        if (facesLeft) {
            std::swap(a, b);
        }
        mesh.polygon({{a, z0}, {b, z0}, {b, z1}, {a, z1}}, skin);
    }
}

void tramTracks(Mesh& mesh, std::span<const glm::dvec2> axis, const TrackStyle& style) {
    const Skin bed{Paint::TrackBed, SurfaceType::TrafficArea};
    const Skin sett{Paint::TrackSett, SurfaceType::TrafficArea};
    const Skin kerb{Paint::Granite, SurfaceType::AuxiliaryTrafficArea};
    const Skin steel{Paint::Rail, SurfaceType::TrafficArea};
    constexpr double kHalfGauge = 0.7175;
    constexpr double kRailHalf = 0.035;
    const double half = 0.5 * style.spacing;
    const double setts = kHalfGauge + 0.45;
    // From right to left: kerb, bed, setts of one track, bed, setts of the other, bed, kerb.
    const double edge = style.halfWidth - 0.25;
    ribbon(mesh, axis, -style.halfWidth, -edge, style.bed, kerb);
    ribbon(mesh, axis, -edge, -half - setts, style.bed, bed);
    ribbon(mesh, axis, -half - setts, -half + setts, style.bed, sett);
    ribbon(mesh, axis, -half + setts, half - setts, style.bed, bed);
    ribbon(mesh, axis, half - setts, half + setts, style.bed, sett);
    ribbon(mesh, axis, half + setts, edge, style.bed, bed);
    ribbon(mesh, axis, edge, style.halfWidth, style.bed, kerb);
    ribbonEdge(mesh, axis, -style.halfWidth, style.base, style.bed, false, kerb);
    ribbonEdge(mesh, axis, style.halfWidth, style.base, style.bed, true, kerb);
    for (const double track : {-half, half}) {
        for (const double side : {-kHalfGauge, kHalfGauge}) {
            const double middle = track + side;
            ribbon(mesh, axis, middle - kRailHalf, middle + kRailHalf, style.rail, steel);
            ribbonEdge(mesh, axis, middle - kRailHalf, style.bed, style.rail, false, steel);
            ribbonEdge(mesh, axis, middle + kRailHalf, style.bed, style.rail, true, steel);
        }
    }
}

}  // namespace reflet::kit
