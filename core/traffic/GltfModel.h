// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/Geometry.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace reflet {

/// A material of a glTF file, or one colour of a material that has a texture. Colours are linear
/// Rec. 709.
struct GltfMaterial {
    std::string name;       ///< as in the file; the same for all colours of a texture
    glm::vec3 color{0.8F};  ///< base colour, texture included
    float alpha = 1.0F;     ///< below 1 only where the file asks for blending
    float metallic = 1.0F;
    float roughness = 1.0F;
    float clearCoat = 0.0F;
    float transmission = 0.0F;
    glm::vec3 emission{0.0F};
    bool textured = false;
    bool doubleSided = false;
};

/// The triangles of one node of the file.
struct GltfPart {
    std::string name;  ///< of the node, of its parents and of its material: "wheel/tier TYRE"
    std::size_t firstTriangle = 0;
    std::size_t triangleCount = 0;
    Box bounds;
};

/// What a glTF file holds, all nodes in place, in the file's own axes and units. A value; normals
/// are unit, one per vertex; one material per triangle.
struct GltfModel {
    std::string name;  ///< of the file, without folder and suffix
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::uvec3> triangles;
    std::vector<std::uint16_t> triangleMaterial;
    std::vector<GltfMaterial> materials;
    std::vector<GltfPart> parts;
    Box bounds;
    std::size_t fileTriangles = 0;  ///< in the scene of the file, before anything was changed
    std::size_t fileMaterials = 0;
    std::size_t nodes = 0;
    std::size_t images = 0;
    std::size_t imagesRead = 0;
};

}  // namespace reflet
