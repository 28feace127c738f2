// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/MipTexture.h"
#include "core/baking/RayScene.h"
#include "core/baking/SurfaceLook.h"

#include <memory>
#include <vector>

namespace reflet {

/// What a RadianceScene is made of that neither the light nor the vehicles change: shared by all
/// scenes of a city, also between threads. None of the pointers is null.
struct SceneParts {
    std::shared_ptr<const CityModel> city;
    std::shared_ptr<const SurfaceLooks> looks;                ///< of the city
    std::shared_ptr<const std::vector<MipTexture>> textures;  ///< one per CityModel::textures
    std::shared_ptr<const RayScene> rays;                     ///< the city without occluders
};

/// Builds the BVH and the textures' halved copies. images: one per CityModel::textures; they are
/// shared, not copied.
[[nodiscard]] Result<SceneParts> makeSceneParts(
    std::shared_ptr<const CityModel> city, std::shared_ptr<const SurfaceLooks> looks,
    const std::shared_ptr<const std::vector<TextureImage>>& images, const JobContext& job);

}  // namespace reflet
