// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/PreparedCity.h"

#include <string>
#include <string_view>
#include <vector>

namespace reflet {

/// The ways to get a local map that can be compared at the same pose (DESIGN 5.8).
enum class Method { Nearest, Blend, Mem, RayTrace };

[[nodiscard]] const char* toString(Method method);
/// Usage for an unknown name, listing the known ones.
[[nodiscard]] Result<Method> methodFromString(std::string_view name);
[[nodiscard]] const std::vector<Method>& allMethods();

/// The local map at a frame position. `scene` is only used by RayTrace; null is allowed otherwise.
[[nodiscard]] Result<LocalEnvironmentMap> reconstruct(const PreparedCity& city,
                                                      std::span<const ReferenceEnvironmentMap> rems,
                                                      const RadianceScene* scene, Method method,
                                                      const glm::dvec3& position,
                                                      const JobContext& job);

}  // namespace reflet
