// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/Geometry.h"

#include <optional>
#include <pugixml.hpp>
#include <string>
#include <vector>

namespace reflet::citygml {

/// The numbers of a text, with blanks between. False, and nothing more is read: one is no number.
[[nodiscard]] bool readNumbers(const char* text, std::vector<double>& into);

/// The points of a gml:LinearRing, gml:Ring, gml:LineString or gml:Point, in the order of the file,
/// the closing point of a ring included: posList, pos, pointProperty, coordinates, coord.
/// `dimension` is what an element further out says (3 if none does); in two, heights are 0.
/// Returns what is wrong with them; empty when nothing is.
[[nodiscard]] std::string readPoints(pugi::xml_node node, int dimension,
                                     std::vector<glm::dvec3>& into);

/// The srsDimension of an element, or `otherwise`.
[[nodiscard]] int dimensionOf(pugi::xml_node node, int otherwise);

}  // namespace reflet::citygml
