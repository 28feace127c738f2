// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/reflection/BodyPass.h"
#include "core/heightfield/Hiding.h"
#include "core/reconstruction/LevelOfDetail.h"

#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <tuple>
#include <vector>

namespace reflet {

/// The second pass of DESIGN 5.3 on the GPU: draws the bodies of other vehicles into copies of
/// local maps, with depth tested against the map's distances; core/rendering/MapBodies is the same
/// by rays. The maps of the city stay as they are, and are kept from frame to frame; so are the
/// copies, while neither the map nor a body in it has moved by more than
/// ReflectionMaps::kReuseDistance.
class MapBodiesPass {
public:
    /// Internal, with the driver's words, when a shader does not compile.
    [[nodiscard]] static Result<std::unique_ptr<MapBodiesPass>> create();

    /// Forgets all copies: the light is another.
    void invalidate() { m_kept.clear(); }

    /// A body that may be seen in maps. Its level of detail is chosen for each map.
    struct Other {
        std::string reflector;
        DrawnBody drawn;
        GpuLocalMap mirrors;  ///< without a texture: what the map shows that it is drawn into
    };
    /// A body's map that shows the city.
    struct CityMap {
        std::string reflector;
        std::size_t body = 0;
        int side = 0;  ///< of the wipe
        GpuLocalMap map;
        bool isNew = true;  ///< drawn in this frame, not kept
        /// Radians by which a body in it may have moved before it is drawn again; 0: by
        /// ReflectionMaps::kReuseDistance.
        double tolerance = 0.0;
        double weight = 1.0;  ///< MapUpdate::weight
        /// Bodies that look smaller than so many of its texels are left out.
        int smallest = 1;
    };
    /// One map for each, in order: with bodies of other vehicles in it, or the same where none
    /// fills a texel. The light must have been bound (CityPass), and `others` hold for both sides.
    /// samplesPerEdge: this squared samples a texel. hiding: bodies that it hides from a map's
    /// centre are left out; null: none are. Copies that are not asked for are dropped at the next
    /// nextFrame(). Those that show the same city map as before wait for a later frame
    /// where they do not fit into `units` (unitsOfOthers()).
    [[nodiscard]] std::vector<GpuLocalMap> draw(
        std::span<const CityMap> maps, std::span<const Other> others, BodyPass& bodies,
        int samplesPerEdge, const Hiding* hiding = nullptr,
        double units = std::numeric_limits<double>::infinity());
    void nextFrame();

    /// Copies that the draws of this frame made anew.
    [[nodiscard]] std::size_t drawn() const { return m_drawn; }
    [[nodiscard]] double drawnUnits() const { return m_drawnUnits; }  ///< of the same

private:
    struct Place {
        std::string reflector;
        std::size_t body = 0;
        RigidTransform pose;
        unsigned mirrors = 0;
    };
    struct Kept {
        std::vector<Place> places;
        unsigned city = 0;  ///< texture that it is a copy of
        glm::dvec3 center{0.0};
        int samplesPerEdge = 0;
        std::shared_ptr<Texture> texture;
        bool used = true;
    };
    using Key = std::tuple<std::string, std::size_t, int>;

    MapBodiesPass() = default;
    /// What is wanted of a map, with the bodies that it shows.
    struct Plan {
        Kept wanted;
        std::vector<std::size_t> seen;
        MapUpdate update;
    };
    [[nodiscard]] Plan planOf(const CityMap& map, std::span<const Other> others, int samplesPerEdge,
                              const Hiding* hiding) const;
    /// How far what is kept is from what is wanted: due from 1 on.
    [[nodiscard]] static double errorOf(const Kept& kept, const Kept& wanted, double tolerance);
    void drawMap(const CityMap& map, std::span<const Other> others,
                 std::span<const std::size_t> seen, BodyPass& bodies, const Kept& target);
    void drawFace(const GpuLocalMap& map, int face, std::span<const DrawnBody> drawn,
                  std::span<const GpuLocalMap> mirrored, BodyPass& bodies, const Kept& target);
    void resize(int edge);

    Program m_city, m_bodies;
    Framebuffer m_faceFramebuffer, m_mapFramebuffer;
    VertexArray m_noAttributes;
    Sampler m_unfiltered;
    Texture m_radiance, m_depth;  ///< of a face, with all samples
    std::map<Key, Kept> m_kept;
    std::size_t m_drawn = 0;
    double m_drawnUnits = 0.0;
};

}  // namespace reflet
