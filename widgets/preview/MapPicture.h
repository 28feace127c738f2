// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/CubeDirection.h"
#include "core/environment/CubeMap.h"
#include "widgets/preview/MapPreview.h"

#include <QImage>
#include <QPoint>
#include <QString>
#include <array>
#include <memory>
#include <optional>
#include <stop_token>

namespace reflet {

/// The two halves of an environment map, kept alive by whatever map they belong to.
struct MapSource {
    std::shared_ptr<const CubeMap<glm::vec3>> radiance;
    std::shared_ptr<const CubeMap<float>> distance;
    /// Of a local map: 1 where no probe sees what is there. Null: all of it is seen.
    std::shared_ptr<const CubeMap<unsigned char>> uncovered = nullptr;
};

/// The range of distances that the colours stand for, on a logarithmic scale.
struct DistanceRange {
    float nearest = 1.0F;
    float farthest = 100.0F;
};
[[nodiscard]] DistanceRange distanceRange(const CubeMap<float>& distance);
/// Dark blue near to yellow far (viridis, of even lightness steps and safe for all colour vision);
/// sky is a pale grey of its own.
[[nodiscard]] QRgb distanceColor(float distance, const DistanceRange& range);
inline constexpr QRgb kSkyColor = 0xFFDDE3EA;
/// Where no probe sees what is there; all else is a dark grey picture then.
inline constexpr QRgb kUncoveredColor = 0xFFE69F00;

/// The cube unfolded for people: north in the middle, east and south to its right, west to its
/// left, up above, down below; all side faces upright and seen from inside. Each pixel is exactly
/// one texel.
struct CrossFace {
    int column, row;  ///< in the 4 × 3 faces of the cross
    glm::dvec3 forward, right, up;
};
[[nodiscard]] const std::array<CrossFace, 6>& crossFaces();  ///< order +X −X +Y −Y +Z −Z
[[nodiscard]] QString faceName(int face);
/// The texel under a pixel of the cross; nullopt in its empty corners.
[[nodiscard]] std::optional<Texel> crossTexel(int resolution, const QPoint& pixel);
/// The direction that a mirror ball shows at a point of [-1, 1]² (y up), seen from the south from
/// afar; nullopt beside the ball.
[[nodiscard]] std::optional<glm::dvec3> ballDirection(double x, double y);

/// Any thread. A null image when stopped.
[[nodiscard]] QImage paintMap(const MapSource& source, MapProjection projection,
                              MapQuantity quantity, float exposure, const std::stop_token& stop);

}  // namespace reflet
