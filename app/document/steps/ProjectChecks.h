// SPDX-License-Identifier: GPL-3.0-or-later
// What a change may put into a project, so that it can be read again: the same limits as in
// core/project. Internal to app/document.
#pragma once

#include "core/project/Project.h"

#include <optional>

namespace reflet {

/// Numbers brought into the range that a project file may hold; what is no number becomes `now`'s.
[[nodiscard]] MemSettings withinRange(MemSettings tuning, const MemSettings& now);
[[nodiscard]] BakeSettings withinRange(BakeSettings bake);
[[nodiscard]] HeightfieldSettings withinRange(HeightfieldSettings heightfield,
                                              const HeightfieldSettings& now);
[[nodiscard]] float turbidityWithinRange(float turbidity, float now);
[[nodiscard]] float exposureWithinRange(float exposure, float now);
[[nodiscard]] Reflector withinRange(Reflector reflector, const Reflector& now);
[[nodiscard]] View withinRange(View view);
[[nodiscard]] VehicleModel withinRange(VehicleModel vehicle, const VehicleModel& now);

/// Why the value cannot be part of a project; nullopt when it can.
[[nodiscard]] std::optional<Error> faultOf(const Probe& probe);
[[nodiscard]] std::optional<Error> faultOf(const RouteSpec& route);
[[nodiscard]] std::optional<Error> faultOf(const View& view);
[[nodiscard]] std::optional<Error> faultOf(const VehicleModel& vehicle);
[[nodiscard]] std::optional<Error> faultOf(const DateTime& date);

}  // namespace reflet
