// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/city/CityLight.h"

#include "core/base/ParallelFor.h"
#include "core/environment/CubeDirection.h"
#include "core/gpu/city/CityPass.h"

#include <epoxy/gl.h>
#include <glm/gtc/type_precision.hpp>

#include <algorithm>

namespace reflet {

namespace {

constexpr int kSkyEdge = 128;
/// Share of the nodes' distance that a surface's light is looked up before it: nodes behind the
/// surface then hardly count.
constexpr double kOffSurface = 0.5;

}  // namespace

CityLight::CityLight() : m_sky(Texture::makeCube(GL_RGBA16F, kSkyEdge)), m_buffer(sizeof(Block)) {
    m_sky.filter(GL_LINEAR, GL_LINEAR);
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    setSky(Sky(Lighting{}));
}

void CityLight::setSky(const Sky& sky) {
    std::vector<glm::vec3> texels(std::size_t(6) * kSkyEdge * kSkyEdge);
    parallelFor(0, std::size_t(6) * kSkyEdge, 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t line = first; line < last; ++line) {
            for (int column = 0; column < kSkyEdge; ++column) {
                const glm::dvec3 d =
                    texelDirection(kSkyEdge, int(line / kSkyEdge), column, int(line % kSkyEdge));
                texels[line * kSkyEdge + std::size_t(column)] =
                    sky.radiance(glm::vec3(glm::normalize(d)));
            }
        }
    });
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTextureSubImage3D(m_sky.id(), 0, 0, 0, 0, kSkyEdge, kSkyEdge, 6, GL_RGB, GL_FLOAT,
                        texels.data());
    m_block.sunDirection = glm::vec4(sky.sunDirection(), sky.night());
    m_block.sunRadiance = glm::vec4(sky.sunRadiance(), 1.0F);

    m_openSky.columns = m_openSky.rows = m_openSky.layers = 1;
    m_openSky.light.clear();
    for (int side = 0; side < 6; ++side) {
        glm::vec3 normal{0.0F};
        normal[side / 2] = side % 2 == 0 ? 1.0F : -1.0F;
        m_openSky.light.push_back(sky.ambient(normal));
    }
    if (!m_hasVolume) {
        upload(m_openSky);
    }
}

void CityLight::setAmbient(const AmbientVolume* ambient) {
    GLint largest = 0;
    glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &largest);
    m_hasVolume = ambient != nullptr && !ambient->light.empty() &&
                  std::max({ambient->columns, ambient->rows, 6 * ambient->layers}) <= largest;
    upload(m_hasVolume ? *ambient : m_openSky);
}

void CityLight::upload(const AmbientVolume& volume) {
    const auto nodes = volume.light.size() / 6;
    const int depth = 6 * volume.layers;
    float brightest = 1e-6F;
    for (const glm::vec3& light : volume.light) {
        brightest = std::max({brightest, light.r, light.g, light.b});
    }
    // A slab of layers for each side. Square roots in 8 bits: steps are as fine as a display's, and
    // software filters such texels three times as fast as floats.
    std::vector<glm::u8vec4> bySide(volume.light.size());
    for (std::size_t node = 0; node < nodes; ++node) {
        for (std::size_t side = 0; side < 6; ++side) {
            const glm::vec3 light = glm::max(volume.light[6 * node + side], glm::vec3(0.0F));
            bySide[side * nodes + node] =
                glm::u8vec4(glm::vec4(255.0F * glm::sqrt(light / brightest) + 0.5F, 255.0F));
        }
    }
    if (m_lattice.width() != volume.columns || m_lattice.height() != volume.rows ||
        m_lattice.layers() != depth) {
        m_lattice = Texture::make3D(GL_RGBA8, volume.columns, volume.rows, depth);
        m_lattice.filter(GL_LINEAR, GL_LINEAR);
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTextureSubImage3D(m_lattice.id(), 0, 0, 0, 0, volume.columns, volume.rows, depth, GL_RGBA,
                        GL_UNSIGNED_BYTE, bySide.data());
    const glm::dvec3 size(volume.columns, volume.rows, volume.layers);
    const double spacing = std::min({volume.spacing.x, volume.spacing.y, volume.spacing.z});
    m_block.ambientOrigin = glm::vec4(volume.origin, float(volume.layers));
    m_block.ambientScale =
        glm::vec4(1.0 / (volume.spacing.x * size.x), 1.0 / (volume.spacing.y * size.y),
                  1.0 / volume.spacing.z, kOffSurface * spacing);
    m_block.ambientHalf = glm::vec4(0.5 / size.x, 0.5 / size.y, 1.0 / depth, brightest);
}

void CityLight::bind(const SunShadow& shadow, bool bodies) const {
    m_block.shadow = shadow.lookup(bodies);
    m_buffer.write(0, sizeof(Block), &m_block);
    m_buffer.bindBase(GL_UNIFORM_BUFFER, CityPass::kLightBinding);
    m_sky.bind(CityPass::kFirstLightUnit);
    m_lattice.bind(CityPass::kFirstLightUnit + 1);
    shadow.bind(CityPass::kFirstLightUnit + 2, CityPass::kFirstLightUnit + 3);
}

}  // namespace reflet
