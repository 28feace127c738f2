// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/gltf/GltfCityMesh.h"
#include "importers/gltf/GltfPaint.h"

#include <array>
#include <map>
#include <tuple>

namespace reflet::gltf {

/// Where the images of a document are, each looked for once.
using ImagePlaces = std::map<std::size_t, ImagePlace>;

/// The base textures of a document for a city, which are listed and not decoded.
class CityTextures {
public:
    CityTextures(const Document& document, ImagePlaces& places, CityMesh& out)
        : m_document(document), m_places(places), m_out(out) {}

    /// The texture of a material among those of the mesh, which it is added to; kNone: it has none.
    [[nodiscard]] std::uint32_t of(int material, const Look& look);
    /// Where the corners of a triangle lie on its texture, v up; nullopt where that is not told.
    [[nodiscard]] std::optional<std::array<glm::vec2, 3>> corners(const Primitive& primitive,
                                                                  const glm::uvec3& triangle,
                                                                  const TextureUse& use);
    /// What could not be shown as it is meant, among the remarks of the mesh.
    void tell() const;

private:
    const Document& m_document;
    ImagePlaces& m_places;
    CityMesh& m_out;
    std::map<std::tuple<std::size_t, bool, TextureAlpha>, std::uint32_t> m_numbers;
    std::map<int, std::uint32_t> m_ofMaterial;
    std::size_t m_closed = 0, m_withoutUv = 0, m_approximated = 0;
};

/// Moves the corners of a triangle such that an image that repeats along both axes shows there what
/// the sampler says. False where it cannot: where it clamps or mirrors within the triangle.
[[nodiscard]] bool unwrap(const Sampler& sampler, std::array<glm::vec2, 3>& uv);

}  // namespace reflet::gltf
