// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/vec3.hpp>

namespace reflet {

/// The colour of a coverage (0..1), display values: from dark blue over grey to yellow, with a
/// lightness that rises evenly, so that it reads the same for any kind of colour vision and in grey
/// (after cividis: Nuñez, Anderton and Renslow 2018). What lies outside takes the colour of the
/// end, what is no number that of 0.
[[nodiscard]] glm::vec3 coverageColor(double coverage);

}  // namespace reflet
