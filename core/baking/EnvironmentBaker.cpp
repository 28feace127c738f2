// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/EnvironmentBaker.h"

#include "core/baking/FlushToZero.h"
#include "core/base/ParallelFor.h"
#include "core/environment/CubeDirection.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <string>

namespace reflet {

namespace {

constexpr int kTile = 4;  ///< texels along an edge of a packet of 16 rays
constexpr int kMinResolution = 32;
constexpr int kMaxResolution = 2048;
constexpr int kMaxSamples = 16;
constexpr std::size_t kPacket = std::size_t(kTile) * kTile;

/// The part of a face that one packet covers.
struct Tile {
    int face = 0, column = 0, row = 0;  ///< of its first texel
};

/// Rays of a tile through the same place (s, t in [0, 1]²) of each texel.
struct TileRays {
    std::array<glm::vec3, kPacket> origins;
    std::array<glm::vec3, kPacket> directions;
    std::array<SceneHit, kPacket> hits;
    std::size_t count = 0;
};

class TileBaker {
public:
    TileBaker(const RadianceScene& scene, const glm::dvec3& center, const BakeSettings& settings,
              ReferenceEnvironmentMap& map, SightRecorder* sight)
        : m_scene(scene),
          m_center(center),
          m_resolution(settings.resolution),
          m_samples(settings.samplesPerEdge),
          m_tilesPerEdge((settings.resolution + kTile - 1) / kTile),
          m_map(map),
          m_sight(sight) {}

    [[nodiscard]] std::size_t tileCount() const {
        return 6 * std::size_t(m_tilesPerEdge) * std::size_t(m_tilesPerEdge);
    }

    void bakeTile(std::size_t index) const {
        const auto perEdge = std::size_t(m_tilesPerEdge);
        const Tile tile{int(index / (perEdge * perEdge)), int(index % perEdge) * kTile,
                        int(index / perEdge % perEdge) * kTile};
        TileRays rays;
        trace(tile, {0.5, 0.5}, rays);
        eachTexel(tile, [&](int column, int row, std::size_t k) {
            m_map.distance.at(tile.face, column, row) = rays.hits[k].distance;
        });

        // A texel spans about 90° / resolution; each of its samples stands for its share.
        const float spread = float(0.5 * kPi / m_resolution / m_samples);
        std::array<glm::vec3, kPacket> sum{};
        std::array<glm::vec3, kPacket> radiance;
        for (int y = 0; y < m_samples; ++y) {
            for (int x = 0; x < m_samples; ++x) {
                if (m_samples > 1) {
                    trace(tile, {(x + 0.5) / m_samples, (y + 0.5) / m_samples}, rays);
                }
                m_scene.shade({rays.hits.data(), rays.count}, {rays.origins.data(), rays.count},
                              {rays.directions.data(), rays.count}, spread,
                              {radiance.data(), rays.count});
                for (std::size_t k = 0; k < rays.count; ++k) {
                    sum[k] += radiance[k];
                }
            }
        }
        const float share = 1.0F / float(m_samples * m_samples);
        eachTexel(tile, [&](int column, int row, std::size_t k) {
            m_map.radiance.at(tile.face, column, row) = sum[k] * share;
        });
    }

private:
    template <class Visit>
    void eachTexel(const Tile& tile, const Visit& visit) const {
        std::size_t k = 0;
        for (int row = tile.row; row < std::min(tile.row + kTile, m_resolution); ++row) {
            for (int column = tile.column; column < std::min(tile.column + kTile, m_resolution);
                 ++column) {
                visit(column, row, k++);
            }
        }
    }

    void trace(const Tile& tile, const glm::dvec2& place, TileRays& rays) const {
        const glm::vec3 origin(m_center);
        rays.count = 0;
        eachTexel(tile, [&](int column, int row, std::size_t k) {
            const glm::dvec2 st(2.0 * (column + place.x) / m_resolution - 1.0,
                                2.0 * (row + place.y) / m_resolution - 1.0);
            rays.origins[k] = origin;
            rays.directions[k] = glm::vec3(glm::normalize(faceDirection(tile.face, st)));
            rays.count = k + 1;
        });
        m_scene.intersect({rays.origins.data(), rays.count}, {rays.directions.data(), rays.count},
                          {rays.hits.data(), rays.count});
        if (m_sight != nullptr)
            m_sight->add({rays.directions.data(), rays.count}, {rays.hits.data(), rays.count});
    }

    const RadianceScene& m_scene;
    glm::dvec3 m_center;
    int m_resolution;
    int m_samples;
    int m_tilesPerEdge;
    ReferenceEnvironmentMap& m_map;
    SightRecorder* m_sight;
};

std::optional<Error> settingsError(const BakeSettings& settings, const std::string& id) {
    if (settings.resolution < kMinResolution || settings.resolution > kMaxResolution) {
        return Error{
            ErrorCode::Usage,
            "A resolution of " + std::to_string(settings.resolution) + " texels is out of range",
            id,
            "Choose from " + std::to_string(kMinResolution) + " to " +
                std::to_string(kMaxResolution) + ".",
            {}};
    }
    if (settings.samplesPerEdge < 1 || settings.samplesPerEdge > kMaxSamples) {
        return Error{ErrorCode::Usage,
                     std::to_string(settings.samplesPerEdge) +
                         " samples along the edge of a texel are out of range",
                     id,
                     "Choose from 1 to " + std::to_string(kMaxSamples) + ".",
                     {}};
    }
    return std::nullopt;
}

std::string metres(double value) {
    std::string text = std::to_string(std::round(value * 100.0) / 100.0);
    return text.substr(0, text.find('.') + 3);
}

}  // namespace

std::optional<Error> placeError(const RadianceScene& scene, const Heightfield* ground,
                                const std::string& id, const glm::dvec3& position) {
    if (!std::isfinite(position.x) || !std::isfinite(position.y) || !std::isfinite(position.z)) {
        return Error{ErrorCode::Refused, "The position is not finite", id, {}, {}};
    }
    const double floor = ground != nullptr ? double(ground->groundAt(position.x, position.y)) : NAN;
    std::string reason;
    if (position.z < floor) {
        reason = "The position is " + metres(floor - position.z) + " m below the ground";
    } else if (scene.insideSolid(glm::vec3(position))) {
        reason = "The position is inside a building or another solid";
    } else {
        return std::nullopt;
    }
    std::string remedy = "There is no free place within 10 m: place it on a street.";
    if (const auto free = nearestFreePosition(scene, ground, position)) {
        const glm::dvec3 at = *free + scene.city().frame.origin;
        remedy = "The nearest free place is " + metres(glm::distance(*free, position)) +
                 " m away, at " + metres(at.x) + ", " + metres(at.y) + ", " + metres(at.z) + ".";
    }
    return Error{ErrorCode::Refused, reason, id, remedy, {}};
}

Result<void> checkBaking(const RadianceScene& scene, const Heightfield* ground,
                         const std::string& id, const glm::dvec3& position,
                         const BakeSettings& settings) {
    if (auto error = settingsError(settings, id)) {
        return tl::unexpected(*std::move(error));
    }
    if (auto error = placeError(scene, ground, id, position)) {
        return tl::unexpected(*std::move(error));
    }
    return {};
}

Result<ReferenceEnvironmentMap> bakeEnvironmentMap(const RadianceScene& scene,
                                                   const Heightfield* ground, const std::string& id,
                                                   const glm::dvec3& position,
                                                   const BakeSettings& settings,
                                                   const JobContext& job, SightRecorder* sight) {
    if (auto checked = checkBaking(scene, ground, id, position, settings); !checked) {
        return tl::unexpected(checked.error());
    }
    ReferenceEnvironmentMap map;
    map.id = id;
    map.center = position;
    map.radiance = CubeMap<glm::vec3>(settings.resolution);
    map.distance = CubeMap<float>(settings.resolution);
    const TileBaker baker(scene, position, settings, map, sight);
    const std::size_t tiles = baker.tileCount();
    std::atomic<std::size_t> done{0};
    parallelFor(0, tiles, 8, [&](std::size_t first, std::size_t last) {
        const FlushToZero flush;
        for (std::size_t i = first; i < last && !job.cancelled(); ++i) {
            baker.bakeTile(i);
        }
        job.progress(double(done += last - first) / double(tiles));
    });
    if (job.cancelled()) {
        return tl::unexpected(JobContext::cancelledError());
    }
    return map;
}

}  // namespace reflet
