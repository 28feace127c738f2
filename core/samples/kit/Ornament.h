// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/samples/kit/Facade.h"

namespace reflet::kit {

/// A moulded band along the whole façade.
void stringCourse(Mesh& mesh, const Facade& f, double v, double height, double out, Paint paint);
/// Main cornice in three steps over modillions that stand `spacing` apart; its top is at v + 0.85.
void cornice(Mesh& mesh, const Facade& f, double v, double spacing, Paint paint);
inline constexpr double kCorniceHeight = 0.85;
/// Alternating corner stones at both ends of the façade, from v0 to v1.
void quoins(Mesh& mesh, const Facade& f, double v0, double v1, Paint paint);
/// A balcony before an opening: slab on consoles, railing of bars.
void balcony(Mesh& mesh, const Facade& f, double u0, double u1, double v, double depth,
             Paint stone);
/// Upright bars under a rail along a line, from the height of the points.
void railing(Mesh& mesh, const glm::dvec3& from, const glm::dvec3& to, double height,
             double spacing, Paint paint);

}  // namespace reflet::kit
