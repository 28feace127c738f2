// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/AmbientVolume.h"
#include "core/gpu/base/GlObjects.h"
#include "core/gpu/city/SunShadow.h"

namespace reflet {

/// What city_light.glsl reads but the shadow maps: sky, soft light, and the uniform block.
class CityLight {
public:
    CityLight();

    void setSky(const Sky& sky);
    /// null, or larger than the GPU's 3D textures: the open sky of setSky().
    void setAmbient(const AmbientVolume* ambient);
    /// Writes the block and binds everything. bodies: false leaves their shadows out.
    void bind(const SunShadow& shadow, bool bodies = true) const;

private:
    /// As the block CityLight in city_light.glsl (std140).
    struct Block {
        glm::vec4 sunDirection{0.0F}, sunRadiance{0.0F};
        glm::vec4 ambientOrigin{0.0F}, ambientScale{0.0F}, ambientHalf{0.0F};
        SunShadow::Lookup shadow;
    };
    void upload(const AmbientVolume& volume);

    AmbientVolume m_openSky;
    bool m_hasVolume = false;
    Texture m_sky, m_lattice;
    mutable Buffer m_buffer;
    mutable Block m_block;
};

}  // namespace reflet
