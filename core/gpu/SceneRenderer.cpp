// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/SceneRenderer.h"

#include "core/gpu/base/GlVersion.h"
#include "core/gpu/base/ShaderLibrary.h"

#include <epoxy/gl.h>

#include <chrono>

namespace reflet {

struct SceneRenderer::Impl {
    std::shared_ptr<const DrawnCity> city;
    Lighting lighting;
    std::shared_ptr<const AmbientVolume> ambient;
    RemSet rems;
};

SceneRenderer::SceneRenderer() : m_impl(std::make_unique<Impl>()) {}
SceneRenderer::~SceneRenderer() = default;

Result<std::unique_ptr<SceneRenderer>> SceneRenderer::create() {
    if (auto sound = requireOpenGl45(); !sound)
        return tl::unexpected(sound.error());
    return std::unique_ptr<SceneRenderer>(new SceneRenderer);
}

void SceneRenderer::setCity(std::shared_ptr<const DrawnCity> city) {
    m_impl->city = std::move(city);
}
void SceneRenderer::setLighting(const Lighting& lighting) {
    m_impl->lighting = lighting;
}
void SceneRenderer::setAmbient(std::shared_ptr<const AmbientVolume> ambient) {
    m_impl->ambient = std::move(ambient);
}
void SceneRenderer::setRems(const RemSet& rems) {
    m_impl->rems = rems;
}

FrameStatistics SceneRenderer::draw(const FrameRequest& request, unsigned framebuffer) {
    const auto start = std::chrono::steady_clock::now();
    const Sky sky(m_impl->lighting);
    const glm::vec3 shown = toDisplay(sky.radiance({0.0F, 0.7F, 0.714F}), request.exposure);
    const float color[] = {shown.x, shown.y, shown.z, 1.0F};
    glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, color);
    FrameStatistics statistics;
    statistics.milliseconds =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return statistics;
}

DisplayImage SceneRenderer::drawImage(const FrameRequest& request, FrameStatistics* statistics) {
    const Texture target = Texture::make2D(GL_RGBA8, request.width, request.height);
    Framebuffer framebuffer = Framebuffer::make();
    framebuffer.attach(GL_COLOR_ATTACHMENT0, target);
    const FrameStatistics drawn = draw(request, framebuffer.id());
    if (statistics != nullptr)
        *statistics = drawn;
    const auto width = std::size_t(request.width);
    const auto height = std::size_t(request.height);
    std::vector<unsigned char> bytes(width * height * 4);
    glGetTextureImage(target.id(), 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(bytes.size()),
                      bytes.data());
    DisplayImage image{request.width, request.height, std::vector<glm::vec3>(width * height)};
    for (std::size_t row = 0; row < height; ++row) {
        for (std::size_t column = 0; column < width; ++column) {
            const unsigned char* texel = &bytes[4 * ((height - 1 - row) * width + column)];
            image.pixels[row * width + column] = glm::vec3(texel[0], texel[1], texel[2]) / 255.0F;
        }
    }
    return image;
}

LocalEnvironmentMap SceneRenderer::localMap(Method, const glm::dvec3& position,
                                            const MemSettings& settings) {
    LocalEnvironmentMap map;
    map.center = position;
    map.radiance = CubeMap<glm::vec3>(settings.resolution);
    map.distance = CubeMap<float>(settings.resolution, kInfinity);
    map.uncovered = CubeMap<unsigned char>(settings.resolution, 1);
    return map;
}

}  // namespace reflet
