// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/AmbientVolume.h"
#include "core/gpu/Frame.h"
#include "widgets/viewport/camera/CameraMoves.h"
#include "widgets/viewport/camera/Ground.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace reflet {

/// Everything that a picture of the viewport depends on: what the interface hands to who draws.
struct SceneState {
    std::shared_ptr<const DrawnCity> city;
    std::shared_ptr<const Ground> ground = std::make_shared<const Ground>();
    Lighting lighting;
    std::shared_ptr<const AmbientVolume> ambient;
    RemSet rems;
    std::shared_ptr<const Traffic> traffic;
    MemSettings tuning;
    float exposure = 1.0F;
    Method left = Method::Mem;
    std::optional<Method> right;
    float wipe = 0.5F;
    std::shared_ptr<const GivenMaps> given;
    Overlays overlays;

    Camera camera;
    std::string followed;  ///< a reflector with which the camera goes; empty = none
    FollowOffset followOffset;

    double seconds = 0.0;  ///< of the drive, when `clock` was set
    bool playing = false;
    double speed = 1.0;         ///< seconds of the drive a second
    int width = 0, height = 0;  ///< device pixels
    double framesPerSecond = 30.0;
    bool visible = false;

    std::uint64_t lightRevision = 0;  ///< grows when lighting changes
    std::uint64_t clock = 0;          ///< grows when seconds, playing or speed are set
    /// Grow when something changes: that goes on changing (a drag), or once (a selection).
    std::uint64_t motion = 0;
    std::uint64_t touch = 0;

    /// Grows with every change.
    [[nodiscard]] std::uint64_t revision() const { return motion + touch; }
};

/// A finished picture: a texture of the context that drew it, and of all that share with it; or
/// pixels, 0xFFRRGGBB each, rows from the top, which stay until the next picture is acquired.
struct DrawnFrame {
    unsigned texture = 0;
    const std::uint32_t* pixels = nullptr;
    int width = 0, height = 0;
    FrameStatistics statistics;
    double framesPerSecond = 0.0;
    double seconds = 0.0;  ///< of the drive
    Camera camera;
    double scale = 1.0;          ///< of the full size
    bool settled = false;        ///< nothing is left to refine
    std::uint64_t number = 0;    ///< 1, 2, 3 … of its source
    std::uint64_t revision = 0;  ///< of the state that it shows
};

}  // namespace reflet
