// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>

namespace reflet::extrusion {

/// A length as people write it into attributes: "12", "12.5 m", "12,5", "~9", "40 ft", "40'",
/// "7'4\"", in metres (numbers without a unit are multiplied by `unit`). nullopt for anything else,
/// and for what no building has: more than 2000 m up or down.
[[nodiscard]] std::optional<double> parseLength(std::string_view text, double unit = 1.0);

/// A number of storeys, 0..300; fractions are fine: "1.5".
[[nodiscard]] std::optional<double> parseStoreys(std::string_view text);

/// Metres of a storey where nothing but their number is known: the mean over European cities that
/// UMEP and others use.
inline constexpr double kStorey = 3.1;
/// Metres of a building of which nothing is known: about three storeys.
inline constexpr double kUnknownHeight = 9.0;

}  // namespace reflet::extrusion
