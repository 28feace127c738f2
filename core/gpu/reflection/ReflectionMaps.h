// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/reflection/LocalMapPass.h"
#include "core/reconstruction/LevelOfDetail.h"

#include <future>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

namespace reflet {

/// The local maps of the bodies in a picture, kept from picture to picture.
///
/// A map without a level of detail is drawn anew when its body has moved by more than
/// kReuseDistance, when its tuning or given map is another, and after invalidate(). One with a
/// level of detail serves as long as that says, and bodies whose maps would hardly differ share
/// one; maps that are due may wait for a later picture, and go with their bodies until then.
class ReflectionMaps {
public:
    /// Metres. At 2 m from a wall the parallax of 2 cm is half a degree: a texel of a 128² face.
    static constexpr double kReuseDistance = 0.02;

    /// Something that everything depends on has changed: city, light or REMs.
    void invalidate() { m_maps.clear(); }

    struct Wanted {
        std::string reflector;
        std::size_t body = 0;
        Method asked = Method::Mem;  ///< for all bodies; the request may have a simpler one
        LocalMapRequest request;
        /// The settings of all bodies, before the level of detail.
        MemSettings tuned;
        std::optional<Detail> detail = std::nullopt;
        double weight = 1.0;  ///< MapUpdate::weight
        double units = 0.0;   ///< MapUpdate::units
        bool hidden = false;  ///< a map is kept if there is one, and never drawn
    };
    static constexpr double kAll = std::numeric_limits<double>::infinity();
    /// Chooses which maps are drawn, with a level of detail no more than `units` (unitsOf()), and
    /// lets another thread trace them: between this and finish() nothing of the pass may be set. In
    /// place of a map that is not there yet and does not fit, a body gets the blend of two REMs.
    /// Maps that are not wanted this time are dropped.
    void begin(std::span<const Wanted> wanted, const LocalMapPass& pass, double units = kAll);
    /// One map for each that was wanted, in order.
    [[nodiscard]] std::vector<GpuLocalMap> finish(LocalMapPass& pass, CityPass* city);

    /// Of the last begin() and finish().
    struct Report {
        std::vector<std::size_t> drawn;   ///< indices of those that were drawn
        std::vector<std::size_t> shared;  ///< that show the map of another body
        std::size_t waiting = 0;          ///< were due and are drawn later
        double units = 0.0;               ///< unitsOf() those drawn
        double waited = 0.0;              ///< milliseconds in which finish() waited for rays
    };
    [[nodiscard]] const Report& report() const { return m_report; }

private:
    using Key = std::tuple<std::string, std::size_t, Method>;
    struct Entry {
        Wanted wanted;
        GpuLocalMap map;
    };
    /// Where the map of a wanted body comes from.
    struct Source {
        enum class Kind { None, Kept, Drawn, Same } kind = Kind::None;
        std::size_t index = 0;  ///< Drawn: among the requests; Same: as that of this body
    };
    [[nodiscard]] static bool sameQuality(const Entry& entry, const Wanted& wanted);
    [[nodiscard]] static bool serves(const Entry& entry, const Wanted& wanted);
    [[nodiscard]] static bool isBase(const Entry& entry, const Wanted& wanted);
    [[nodiscard]] MapUpdate updateOf(const Wanted& wanted, const Entry* entry) const;
    void choose(std::span<const Wanted> wanted, double units);
    /// The first of `candidates` whose map may stand for that of wanted[i].
    [[nodiscard]] std::optional<std::size_t> sharing(std::span<const Wanted> wanted, std::size_t i,
                                                     std::span<const std::size_t> candidates) const;
    void draw(const Wanted& wanted, std::size_t i);

    /// What begin() leaves to finish().
    struct Update {
        std::vector<Key> keys;  ///< of what was wanted
        std::vector<Source> sources;
        std::vector<glm::dvec3> positions;
        std::vector<Wanted> drawn;
        std::vector<LocalMapRequest> requests;  ///< of the same
        std::future<LocalMapPass::Traced> traced;
    };

    std::map<Key, Entry> m_maps;
    Update m_update;
    Report m_report;
};

}  // namespace reflet
