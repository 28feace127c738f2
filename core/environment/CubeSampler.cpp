// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/environment/CubeSampler.h"

namespace reflet {

Float4 CubeSampler::acrossEdges(const glm::vec3& direction) const {
    const bool zero = direction == glm::vec3(0.0f);
    const glm::vec3 radiance =
        sampleBilinear(*m_map, zero ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(direction));
    return Float4{radiance.x, radiance.y, radiance.z, 0.0f};
}

}  // namespace reflet
