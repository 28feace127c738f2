// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/PreparedCity.h"
#include "core/reconstruction/Method.h"
#include "core/reconstruction/TexelSources.h"

namespace reflet {

/// The local map at a frame position. `scene` is only used by RayTrace; null is allowed otherwise.
/// sources: where each texel was looked up, of methods that need probes; empty for others.
[[nodiscard]] Result<LocalEnvironmentMap> reconstruct(const PreparedCity& city, const RemSet& rems,
                                                      const RadianceScene* scene, Method method,
                                                      const glm::dvec3& position,
                                                      const JobContext& job,
                                                      TexelSources* sources = nullptr);

}  // namespace reflet
