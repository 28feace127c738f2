// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reconstruction/TexelRays.h"

#include "core/environment/CubeDirection.h"
#include "core/environment/FaceDirections.h"

namespace reflet {

CubeMap<double> traceTexels(const HeightfieldTracer& tracer, const glm::dvec3& position,
                            int resolution) {
    CubeMap<double> t(resolution);
    const auto n = std::size_t(resolution);
    std::vector<double> coordinates(n);
    for (std::size_t k = 0; k < n; ++k)
        coordinates[k] = texelCoordinate(resolution, int(k));
    for (int face = 0; face < 6; ++face) {
        tracer.traceGrid(position, faceDirections(face, coordinates, coordinates),
                         {std::span(t.texels()).subspan(std::size_t(face) * n * n, n * n), {}});
    }
    return t;
}

}  // namespace reflet
