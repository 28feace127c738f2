// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/CubeMap.h"
#include "core/math/Geometry.h"

#include <string>

namespace reflet {

/// A reference environment map (REM): what is seen from one fixed position. Radiance is linear,
/// scene-referred, Rec. 709; distance is Euclidean from the centre in metres, +infinity for sky,
/// taken along the ray through the texel's centre and never averaged across an edge.
struct ReferenceEnvironmentMap {
    std::string id;
    glm::dvec3 center{0.0};  ///< project frame
    CubeMap<glm::vec3> radiance;
    CubeMap<float> distance;
};

/// What a local environment map cost and how sure it is.
struct ReconstructionStatistics {
    std::size_t quads = 0;      ///< leaves of the adaptive mesh over all faces
    std::size_t rays = 0;       ///< heightfield (or scene) rays
    std::size_t vertices = 0;   ///< distinct mesh vertices
    std::size_t uncovered = 0;  ///< vertices that no REM could serve validly
    double milliseconds = 0.0;
};

/// The map reconstructed (or traced) around a moving reflector.
struct LocalEnvironmentMap {
    glm::dvec3 center{0.0};  ///< project frame
    CubeMap<glm::vec3> radiance;
    CubeMap<float> distance;           ///< metres, +infinity for sky
    CubeMap<unsigned char> uncovered;  ///< 1 where a mesh vertex around the texel was uncovered
    /// To be looked up by direction alone, from everywhere on a body; else its distances tell what
    /// a ray meets that starts beside the centre (core/environment/DistanceImpostor.h).
    bool atInfinity = false;
    ReconstructionStatistics statistics;
};

}  // namespace reflet
