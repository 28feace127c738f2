// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/traffic/GltfModel.h"
#include "core/traffic/PartMesh.h"
#include "importers/gltf/GltfDocument.h"

#include <array>

namespace reflet::gltf {

/// A texture as a material uses it.
struct TextureUse {
    int texture = -1;              ///< of the document; -1: none
    const Image* image = nullptr;  ///< null: none, not decoded, or it cannot be
    int set = 0;                   ///< of texture coordinates
    // KHR_texture_transform: uv' = offset + rotation * (scale * uv)
    glm::vec2 offset{0.0F};
    glm::vec2 scale{1.0F};
    float rotation = 0.0F;

    [[nodiscard]] glm::vec2 at(const glm::vec2& uv) const;
};

/// A material with its textures.
struct Look {
    GltfMaterial material;  ///< factors alone
    TextureUse base;
    TextureUse metallicRoughness;
    TextureUse emissive;
};
/// `index` names it where it has no name. Nothing is decoded without `images`.
[[nodiscard]] Look readLook(const tinygltf::Material& material, int index, Images* images);

/// A mesh whose triangles have colours of their own; surface = texture coordinates.
struct PaintedMesh {
    PartMesh mesh;
    std::vector<glm::vec3> color;  ///< linear, one per triangle
};

/// Cuts triangles where the base texture changes within them until each is of one colour, no edge
/// is longer than `finest`, or `budget` triangles are reached: so a window that is only painted on
/// becomes triangles of its own. `tint` are linear colours of vertices, or empty.
[[nodiscard]] PaintedMesh paintTriangles(PartMesh mesh, const std::vector<glm::vec3>& tint,
                                         const Look& look, float finest, std::size_t budget);

/// Gathers the colours of a material into at most `kMostColors`, by area.
class Palette {
public:
    static constexpr std::size_t kMostColors = 24;
    void add(const glm::vec3& linear, double area);
    void close();
    [[nodiscard]] const std::vector<glm::vec3>& colors() const { return m_colors; }
    [[nodiscard]] std::size_t nearest(const glm::vec3& linear) const;

private:
    struct Bin {
        glm::dvec3 sum{0.0};
        double area = 0.0;
    };
    std::map<std::array<int, 3>, Bin> m_bins;
    std::vector<glm::vec3> m_colors;
};

}  // namespace reflet::gltf
