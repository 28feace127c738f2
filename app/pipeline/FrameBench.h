// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/Traffic.h"
#include "core/gpu/Frame.h"

#include <optional>
#include <string>
#include <vector>

namespace reflet {

class PreparedCity;

/// What to measure: the pictures that the window draws while something moves.
struct FrameBenchOptions {
    int width = 1280;
    int height = 720;
    int frames = 60;                ///< measured for each row, at least 1
    std::optional<double> scale;    ///< one more row at this share of the size, 0.1..1
    double framesPerSecond = 30.0;  ///< the pace that the adaptive size aims at
    std::optional<double> budget;   ///< milliseconds, in place of the project's frame budget
};

/// What pictures cost, in milliseconds: all of a picture, until its pixels can be read, and its
/// passes (FrameStatistics; medians).
struct FrameCosts {
    double scale = 1.0;  ///< of the size, at which they were drawn
    double median = 0.0;
    double p95 = 0.0, p99 = 0.0, worst = 0.0;
    double cpu = 0.0;  ///< processor time of all threads: what a busy machine does not change much
    double city = 0.0, tracing = 0.0, maps = 0.0, inMaps = 0.0, vehicles = 0.0, overlays = 0.0;
    std::size_t triangles = 0;  ///< of the city, handed to the GPU (median)
    std::size_t localMaps = 0;  ///< drawn in a picture (median)
    LodStatistics lod;          ///< medians, each for itself
    /// The picture that took longest: its number among those measured, and its own stages.
    int worstNumber = 0;
    FrameStatistics worstStages;
};

/// One way to look at the drive.
struct FrameBenchScene {
    std::string name;  ///< "orbit", "pavement"
    FrameCosts full;   ///< by the project's level of detail
    FrameCosts plain;  ///< the same without: every map in full quality, whenever it is old
    std::optional<FrameCosts> scaled;
    FrameCosts adaptive;  ///< at the size that AdaptiveScale settles on
    FrameCosts still;     ///< the last picture once all stands: full size, 2 x 2 samples a pixel
};

struct FrameBenchReport {
    std::string renderer;  ///< the driver's words
    double budget = 0.0;   ///< milliseconds a picture, of the level of detail
    std::vector<FrameBenchScene> scenes;
};

/// Draws a drive from a camera that orbits around the first vehicle and from one that stands on
/// the pavement, in a context of its own on the calling thread. Usage when nothing drives;
/// ResourceLimit without OpenGL 4.5; Cancelled.
[[nodiscard]] Result<FrameBenchReport> benchFrames(const PreparedCity& city, const RemSet& rems,
                                                   const Traffic& traffic,
                                                   const FrameBenchOptions& options,
                                                   const JobContext& job);

}  // namespace reflet
