// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/SceneParts.h"

#include "core/base/ParallelFor.h"

#include <algorithm>

namespace reflet {

Result<SceneParts> makeSceneParts(std::shared_ptr<const CityModel> city,
                                  std::shared_ptr<const SurfaceLooks> looks,
                                  const std::shared_ptr<const std::vector<TextureImage>>& images,
                                  const JobContext& job) {
    auto rays = RayScene::build(*city, {}, job);
    if (!rays) {
        return tl::unexpected(rays.error());
    }
    auto textures = std::make_shared<std::vector<MipTexture>>(city->textures.size());
    parallelFor(0, std::min(images->size(), textures->size()), 1,
                [&](std::size_t first, std::size_t last) {
                    for (std::size_t i = first; i < last; ++i) {
                        const std::shared_ptr<const TextureImage> image(images, &(*images)[i]);
                        (*textures)[i] = MipTexture(image, city->textures[i].repeat);
                    }
                });
    return SceneParts{std::move(city), std::move(looks), std::move(textures), std::move(*rays)};
}

}  // namespace reflet
