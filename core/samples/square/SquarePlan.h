// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/samples/kit/CityJsonWriter.h"
#include "core/samples/kit/Random.h"
#include "core/samples/kit/Shapes.h"

#include <vector>

/// The plan of the sample square: local metres, x grid east, y grid north, z = 0 the streets. The
/// square lies about the origin, arcades to its north, south and west, the park to its east; the
/// tram comes in from the avenue in the west, swings past the north arcades, passes along the
/// park and turns south behind it.
namespace reflet::square {

using kit::Plot;

// Heights of what lies on the ground.
inline constexpr double kPaving = 0.03;    ///< of the square
inline constexpr double kPavement = 0.14;  ///< of pavements, and the foot of all houses
inline constexpr double kTrackBed = 0.06;
inline constexpr double kRail = 0.08;  ///< the tram's running surface
inline constexpr double kTrackSpacing = 3.4;

// Plots.
inline constexpr Plot kPavedSquare{-56, -36, 62, 30};
inline constexpr Plot kPark{68, -40, 176, 10};
inline constexpr Plot kTown{-380, -260, 320, 260};     ///< level ground
inline constexpr Plot kCountry{-500, -400, 440, 400};  ///< with the hills around

// Fronts of the rows of houses.
inline constexpr double kNorthFront = 34;
inline constexpr double kSouthFront = -42;
inline constexpr double kWestFront = -60;
inline constexpr double kAvenueNorth = 21;
inline constexpr double kAvenueSouth = -9;

/// Axis between the two tram tracks, from the west, a point every metre or so in curves.
[[nodiscard]] std::vector<glm::dvec2> tramAxis();
/// The track that the tram takes eastwards: 480 m, on the right of the axis.
[[nodiscard]] std::vector<glm::dvec2> tramRoute();
/// Lanes that cars drive.
[[nodiscard]] std::vector<glm::dvec2> parkLane();
[[nodiscard]] std::vector<glm::dvec2> avenueLane();
/// Points at equal distances along a line, the first at `start`.
[[nodiscard]] std::vector<glm::dvec2> stationsAlong(const std::vector<glm::dvec2>& line,
                                                    double start, double step);

/// 43.6975° N 7.2705° E in RGF93 v1 / Lambert-93 (EPSG:2154), to the centimetre.
inline constexpr double kPlaceEast = 1044170.67;
inline constexpr double kPlaceNorth = 6298027.73;
/// Streets of that place lie about 9 m above sea level (NGF-IGN69, EPSG:5720).
inline constexpr double kPlaceHeight = 9.0;

// Parts of the city; each adds its objects.
void addGround(kit::SampleCity& city, kit::Random random);
void addTown(kit::SampleCity& city, kit::Random random);
void addOuterTown(kit::SampleCity& city, kit::Random random);
void addPark(kit::SampleCity& city, kit::Random random);
void addFurniture(kit::SampleCity& city, kit::Random random);
void addHills(kit::SampleCity& city, kit::Random random);

}  // namespace reflet::square
