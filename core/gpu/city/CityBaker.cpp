// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/city/CityBaker.h"

#include "core/base/ParallelFor.h"

#include <epoxy/gl.h>

#include <vector>

namespace reflet {

namespace {

template <class T>
std::vector<T> read(const Texture& texture, unsigned format) {
    std::vector<T> out(std::size_t(texture.width()) * std::size_t(texture.height()));
    glGetTextureImage(texture.id(), 0, format, GL_FLOAT, GLsizei(out.size() * sizeof(T)),
                      out.data());
    return out;
}

/// Means of samples × samples pixels, as a face of a map.
void average(const std::vector<glm::vec3>& pixels, int samples, int face,
             CubeMap<glm::vec3>& radiance) {
    const int n = radiance.resolution();
    const auto width = std::size_t(n) * std::size_t(samples);
    const float share = 1.0F / float(samples * samples);
    parallelFor(0, std::size_t(n), 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row) {
            for (std::size_t column = 0; column < std::size_t(n); ++column) {
                glm::vec3 sum(0.0F);
                for (std::size_t k = 0; k < std::size_t(samples * samples); ++k) {
                    const std::size_t x = column * std::size_t(samples) + k % std::size_t(samples);
                    const std::size_t y = row * std::size_t(samples) + k / std::size_t(samples);
                    sum += pixels[y * width + x];
                }
                radiance.at(face, int(column), int(row)) = share * sum;
            }
        }
    });
}

}  // namespace

Result<ReferenceEnvironmentMap> CityBaker::bake(CityPass& pass, const std::string& id,
                                                const glm::dvec3& position,
                                                const BakeSettings& settings) {
    const int n = settings.resolution;
    const int samples = settings.samplesPerEdge;
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (n * samples > largest) {
        return fail(ErrorCode::ResourceLimit,
                    "a face of " + std::to_string(n * samples) +
                        " samples along its edge is more than OpenGL draws here (" +
                        std::to_string(largest) + ")",
                    id,
                    "Lower bake.resolution or bake.samplesPerEdge, or bake with --backend cpu.");
    }
    ReferenceEnvironmentMap map{id, position, CubeMap<glm::vec3>(n), CubeMap<float>(n)};
    static_cast<void>(pass.prepareShadows(position, {}));
    const std::size_t texels = std::size_t(n) * std::size_t(n);
    for (int face = 0; face < 6; ++face) {
        draw(pass, position, face, n * samples, m_samples);
        average(read<glm::vec3>(m_samples.radiance, GL_RGB), samples, face, map.radiance);
        // The rays through the centres are among the samples only where those are odd.
        if (samples > 1)
            draw(pass, position, face, n, m_centers);
        const Texture& distance = samples > 1 ? m_centers.distance : m_samples.distance;
        const std::vector<float> distances = read<float>(distance, GL_RED);
        std::copy(distances.begin(), distances.end(),
                  map.distance.texels().begin() + std::ptrdiff_t(std::size_t(face) * texels));
    }
    return map;
}

void CityBaker::draw(CityPass& pass, const glm::dvec3& position, int face, int edge,
                     Targets& targets) {
    if (targets.radiance.width() != edge) {
        targets = {Texture::make2D(GL_RGBA32F, edge, edge),
                   Texture::make2D(GL_DEPTH32F_STENCIL8, edge, edge),
                   Texture::make2D(GL_R32F, edge, edge)};
    }
    CityView view = cityFaceView(position, face, edge);
    view.smallestPart = 0.0F;
    static_cast<void>(
        pass.draw(view, {targets.radiance.id(), targets.depth.id(), targets.distance.id()}));
}

}  // namespace reflet
