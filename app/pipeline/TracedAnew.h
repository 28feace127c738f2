// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/PreparedCity.h"
#include "core/gpu/Frame.h"
#include "core/reconstruction/LevelOfDetail.h"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace reflet {

/// A body that may be in the picture.
struct BodyInView {
    std::string reflector;
    std::size_t body = 0;
    glm::dvec3 center{0.0};  ///< of its local map
    double squeeze = 0.0;    ///< squeezeOf()
    double pixels = 0.0;     ///< along its longest edge
};
[[nodiscard]] std::vector<BodyInView> bodiesInView(const std::vector<PlacedReflector>& reflectors,
                                                   const Camera& camera, int width, int height);

/// Local maps of moving bodies, traced anew with Embree, with or without the level of detail that
/// local maps of REMs have (but for its frame budget): size by what is seen, and a map serves until
/// its body has moved so far that it shows. What would be blended is traced at the least size.
class TracedAnew {
public:
    /// Both must outlive this.
    TracedAnew(const PreparedCity& city, const RadianceScene& scene, bool levelOfDetail)
        : m_city(city), m_scene(scene), m_levelOfDetail(levelOfDetail) {}

    /// A map for each of the bodies.
    [[nodiscard]] Result<GivenMaps> maps(const std::vector<BodyInView>& bodies,
                                         const JobContext& job);
    /// How many the last maps() traced.
    [[nodiscard]] std::size_t traced() const { return m_traced; }

private:
    struct Kept {
        std::optional<Detail> detail;
        glm::dvec3 center{0.0};
        double nearest = 10.0;  ///< metres to what stands around
        std::shared_ptr<const LocalEnvironmentMap> map;
    };
    [[nodiscard]] Result<void> bring(Kept& kept, const BodyInView& body, const JobContext& job);

    const PreparedCity& m_city;
    const RadianceScene& m_scene;
    bool m_levelOfDetail;
    std::size_t m_traced = 0;
    std::map<std::pair<std::string, std::size_t>, Kept> m_kept;
};

}  // namespace reflet
