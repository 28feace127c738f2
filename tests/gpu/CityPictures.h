// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/RadianceScene.h"
#include "core/environment/ImageMetrics.h"
#include "core/gpu/base/GlObjects.h"
#include "core/gpu/city/CityPass.h"
#include "tests/gpu/GlFixture.h"
#include "tests/unit/baking/BakingScenes.h"

namespace reflet::test {

/// A view of linear radiance, rows from the top.
struct RadiancePicture {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> radiance;
    std::vector<float> distance;
    [[nodiscard]] const glm::vec3& at(int x, int y) const {
        return radiance[std::size_t(y) * std::size_t(width) + std::size_t(x)];
    }
    [[nodiscard]] DisplayImage display() const;
};

/// The same view by OpenGL and by rays.
class CityPictures : public GlFixture {
protected:
    void SetUp() override;
    /// Uploads a city (and keeps it); textures: one per CityModel::textures.
    void show(const CityModel& city, const Lighting& lighting,
              std::vector<TextureImage> textures = {});
    /// Gathers soft light for OpenGL, as the window does; without, it takes the open sky.
    void gatherLight(std::size_t nodes);
    [[nodiscard]] RadiancePicture drawn(const CityView& view,
                                        std::span<const ShadowCaster> casters = {});
    [[nodiscard]] RadiancePicture traced(const CityView& view) const;

    std::unique_ptr<CityPass> m_pass;
    std::shared_ptr<DrawnCity> m_city;
    std::unique_ptr<RadianceScene> m_scene;
    CityStatistics m_statistics;  ///< of the last drawn()
};

/// Decibels between two pictures in display values; 99 when they are identical.
[[nodiscard]] double decibels(const RadiancePicture& a, const RadiancePicture& b);

}  // namespace reflet::test
