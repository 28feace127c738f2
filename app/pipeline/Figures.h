// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/ImageFigures.h"
#include "app/pipeline/Reconstruct.h"
#include "core/reconstruction/SurfaceFigures.h"
#include "core/traffic/Traffic.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

/// How steadily a method's local map changes while the reflector drives, in display values over
/// the whole map; one step is kPopStep metres (app/pipeline/Pop.h).
struct PopFigures {
    /// Mean |(I_t − I_t−1) − (R_t − R_t−1)| for each metre driven, R being the reference: flicker
    /// and pops that the city itself does not make.
    double perMetre = 0.0;
    double medianStep = 0.0;  ///< of mean |I_t − I_t−1|
    double largestStep = 0.0;
    /// The largest step over which the REMs in use change, in median steps; nullopt when they never
    /// change (or nothing moves).
    std::optional<double> atChange;
    std::size_t changes = 0;  ///< steps over which the REMs in use change
};

/// How near a method comes to the ray-traced reference, and what it costs.
struct MethodFigures {
    ImageFigures map;      ///< over whole local maps
    ImageFigures vehicle;  ///< over the reflector's pixels of a street view
    /// What the maps show against what is there; nullopt for methods without probes.
    std::optional<SurfaceFigures> surfaces;
    std::optional<PopFigures> pop;   ///< nullopt when no drive was measured
    double milliseconds = 0.0;       ///< median over the local maps
    double quads = 0.0, rays = 0.0;  ///< means over the local maps
    double uncoveredShare = 0.0;     ///< of the mesh vertices
};

/// Gathers one method's figures over local maps.
struct FigureTally {
    ImageTally map, vehicle;
    std::optional<SurfaceTally> surfaces;
    std::vector<double> milliseconds;
    double quads = 0.0, rays = 0.0, uncovered = 0.0, vertices = 0.0;

    /// Compares a local map with its reference, of one resolution; FLIP's error for each texel.
    std::vector<float> add(const LocalEnvironmentMap& ours, const LocalEnvironmentMap& truth,
                           float exposure);
    /// Traces what the method's map around a position shows; nothing for methods without probes.
    [[nodiscard]] Result<void> addSurfaces(const PreparedCity& city, const RemSet& rems,
                                           Method method, const glm::dvec3& position,
                                           const JobContext& job);
    [[nodiscard]] MethodFigures figures(std::size_t maps) const;
};

/// What was measured at one pose of one reflector.
struct PoseFigures {
    std::string reflector;
    double station = 0.0;
    int resolution = 0;  ///< of the local maps that were compared
    std::map<Method, MethodFigures> methods;
    /// The ray-traced local maps, one per body: for the wipe (DrawnCity's GivenMaps).
    std::vector<std::shared_ptr<const LocalEnvironmentMap>> references;
};

struct FiguresRequest {
    PlacedReflector placed;
    std::vector<Method> methods = {Method::Mem};
    MemSettings tuning;  ///< its resolution is that of the maps; 64 gives live figures
    /// References of an earlier measurement at this very pose and resolution, with the same others
    /// about it, to be used again.
    std::vector<std::shared_ptr<const LocalEnvironmentMap>> references = {};
    std::vector<PlacedReflector> others = {};  ///< vehicles that it may reflect, as they stand then
};

/// Compares methods with ray tracing over the local maps of all bodies of a reflector. Refused when
/// a body's centre lies inside a solid.
[[nodiscard]] Result<PoseFigures> measurePose(const PreparedCity& city, const RemSet& rems,
                                              const FiguresRequest& request, const JobContext& job);

}  // namespace reflet
