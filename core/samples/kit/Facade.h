// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/samples/kit/Shapes.h"

#include <span>

namespace reflet::kit {

/// The plane of a façade: u runs along it to the right as seen from outside, v up from its foot,
/// w out of it. All in metres.
struct Facade {
    glm::dvec3 origin{0.0};      ///< lower left corner seen from outside
    glm::dvec2 right{1.0, 0.0};  ///< unit
    double length = 0.0;

    [[nodiscard]] glm::dvec2 out() const { return {right.y, -right.x}; }
    [[nodiscard]] glm::dvec3 at(double u, double v, double w) const {
        return origin + glm::dvec3(u * right + w * out(), v);
    }
    /// The parallel façade `by` metres further out.
    [[nodiscard]] Facade moved(double by) const {
        return {origin + glm::dvec3(by * out(), 0.0), right, length};
    }
    [[nodiscard]] Facade raised(double by) const {
        return {origin + glm::dvec3(0, 0, by), right, length};
    }
    /// The part from u0 on.
    [[nodiscard]] Facade part(double u0, double partLength) const {
        return {at(u0, 0, 0), right, partLength};
    }
};

enum class Side { South, East, North, West };
/// The façade of a plot's side, its foot at height z.
[[nodiscard]] Facade facadeOf(const Plot& plot, Side side, double z);

/// A rectangle of a façade.
struct Field {
    double u0 = 0.0, u1 = 0.0, v0 = 0.0, v1 = 0.0;
};

/// A flat rectangle parallel to the façade.
void panel(Mesh& mesh, const Facade& f, const Field& field, double w, Skin skin);
/// Something that stands out of the façade from w0 to w1: front, sides, top and underside.
void relief(Mesh& mesh, const Facade& f, const Field& field, double w0, double w1, Skin skin);
/// The same without its ends: for what runs on, or is too thin for them to show.
void ledge(Mesh& mesh, const Facade& f, const Field& field, double w0, double w1, Skin skin);
/// The four inner faces of an opening that goes `depth` into the wall from w = 0.
void reveal(Mesh& mesh, const Facade& f, const Field& field, double depth, Skin skin);
/// A strip of wall from v0 to v1 over the façade's length around openings, which are sorted by u
/// and share their v range, which lies within the strip.
void pierced(Mesh& mesh, const Facade& f, double v0, double v1, std::span<const Field> openings,
             Skin skin);

}  // namespace reflet::kit
