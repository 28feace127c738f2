// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/samples/Samples.h"
#include "core/samples/kit/SampleCity.h"

#include <cstdint>

namespace reflet::square {

/// The city of the sample "square" before it is written.
[[nodiscard]] kit::SampleCity makeCity(std::uint64_t seed);
/// Its project: a tram and a car, probes along the tram's route, five views.
[[nodiscard]] Project makeProject(const std::string& modelFileName);
[[nodiscard]] Sample makeSquare(std::uint64_t seed);

}  // namespace reflet::square
