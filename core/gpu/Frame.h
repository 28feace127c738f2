// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/RadianceScene.h"
#include "core/baking/SurfaceLook.h"
#include "core/environment/RemSet.h"
#include "core/heightfield/HeightfieldTracer.h"
#include "core/reconstruction/Method.h"
#include "core/reconstruction/Reconstruction.h"
#include "core/rendering/ViewRenderer.h"
#include "core/traffic/Traffic.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

// What the window and `render --gl` draw, as values. All positions are in the project frame.

namespace reflet {

struct CityMesh;
struct CoverageOverlay;

/// A city as it is drawn: never changes, shared between threads. None of the pointers is null but
/// the last.
struct DrawnCity {
    std::shared_ptr<const CityModel> model;
    std::shared_ptr<const SurfaceLooks> looks;  ///< of the model
    /// One per CityModel::textures; an empty image is a missing one.
    std::shared_ptr<const std::vector<TextureImage>> textures;
    std::shared_ptr<const Heightfield> heightfield;
    std::shared_ptr<const HeightfieldTracer> tracer;
    double diameter = 1000.0;  ///< metres across: the distance that sky counts as
    /// See CityPass.h; where it is null, who draws the city builds it.
    std::shared_ptr<const CityMesh> mesh = nullptr;
};

/// What is known about a probe's map.
enum class ProbeState {
    Missing,  ///< never baked
    Fresh,
    Stale,  ///< baked at another place, in another light, or with other settings
    Baking,
    Refused,  ///< it cannot be baked there (inside a solid)
};

/// A probe in the viewport: a ball on a stem down to the ground, its state by colour and shape.
struct ProbeGlyph {
    std::string id;
    glm::dvec3 position{0.0};
    ProbeState state = ProbeState::Missing;
    bool selected = false;
    bool hovered = false;
    bool preview = false;  ///< a larger ball that mirrors the probe's own map
    friend bool operator==(const ProbeGlyph&, const ProbeGlyph&) = default;
};

/// A route in the viewport: a ribbon on the ground; its corners as handles when it is selected.
struct RouteGlyph {
    std::string id;
    std::vector<glm::dvec3> line;     ///< as driven, corners rounded
    std::vector<glm::dvec3> handles;  ///< as drawn by the user
    bool selected = false;
    friend bool operator==(const RouteGlyph&, const RouteGlyph&) = default;
};

/// What is drawn over the city for people who work on it.
struct Overlays {
    std::vector<ProbeGlyph> probes;
    std::vector<RouteGlyph> routes;
    bool heightfield = false;          ///< the columns of the heightfield as a translucent relief
    std::optional<glm::dvec3> cursor;  ///< where a tool would put something
    std::string selectedReflector;     ///< outlined; empty = none
    std::shared_ptr<const CoverageOverlay> coverage;  ///< null: not shown
    friend bool operator==(const Overlays&, const Overlays&) = default;
};

/// Local maps that were made elsewhere (ray traced), for Method::RayTrace: by reflector id, one per
/// body. They are shown wherever the reflector is: the caller sees to it that it stands still.
using GivenMaps = std::map<std::string, std::vector<std::shared_ptr<const LocalEnvironmentMap>>>;

/// One picture.
struct FrameRequest {
    int width = 1280;
    int height = 720;
    int samplesPerEdge = 1;  ///< supersampling: 2 = four samples a pixel
    /// Edge of this picture as a share of that in which it is shown, 0..1: marks of a fixed size
    /// (probes, handles, outlines) are sized in pixels of the latter.
    float scale = 1.0F;
    /// One picture of a movement: what nobody sees while it passes is left out (fine parts of the
    /// city), and local maps are drawn by the level of detail of the tuning.
    bool moving = false;
    Camera camera;
    float exposure = 1.0F;
    std::vector<PlacedReflector> reflectors;
    MemSettings tuning;
    Method method = Method::Mem;  ///< everywhere, or left of the wipe
    std::optional<Method> right;  ///< right of the wipe
    float wipe = 0.5F;            ///< share of the width that is left of it
    GivenMaps given;
    Overlays overlays;
};

/// What the level of detail did in a picture: bodies in the view by how their reflections are made.
struct LodStatistics {
    bool on = false;          ///< the rest counts where it is
    int coarse = 0;           ///< steps by which all give way, 0..kMostCoarse
    double allowed = 0.0;     ///< milliseconds for reflections
    std::size_t full = 0;     ///< as tuned
    std::size_t reduced = 0;  ///< smaller maps, or larger quads
    std::size_t blended = 0;  ///< the blend of two REMs
    std::size_t shared = 0;   ///< of the above, those that show another body's map
    std::size_t waiting = 0;  ///< of the above, those whose maps are due but drawn later
    std::size_t hidden = 0;   ///< behind the city: no map
};

/// What a picture cost. Milliseconds of wall time, the GPU's work included.
struct FrameStatistics {
    double milliseconds = 0.0;  ///< all of it
    double city = 0.0;
    double tracing = 0.0;  ///< waited for rays and meshes, after the city was drawn
    double maps = 0.0;     ///< local maps: drawing, or filling and uploading
    double inMaps = 0.0;   ///< other vehicles drawn into local maps
    double bodies = 0.0;
    double overlays = 0.0;
    std::size_t triangles = 0;  ///< of the city that were handed to the GPU
    std::size_t localMaps = 0;  ///< drawn in this frame
    std::size_t quads = 0;      ///< of those maps, left of the wipe
    std::size_t rays = 0;
    std::size_t vertices = 0;
    std::size_t uncovered = 0;
    /// Ray traced maps were asked for, but not given: Method::Mem was shown in their place.
    bool referenceMissing = false;
    LodStatistics lod;
};

}  // namespace reflet
