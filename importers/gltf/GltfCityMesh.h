// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"
#include "core/base/JobContext.h"
#include "core/city/CityModel.h"
#include "importers/gltf/GltfDocument.h"
#include "importers/gltf/GltfGeoreference.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace reflet::gltf {

/// The triangles of a glTF file as a part of a city, all nodes in place, in double.
struct CityMesh {
    static constexpr std::uint32_t kNoFeature = std::numeric_limits<std::uint32_t>::max();

    struct Part {
        std::string name;  ///< of the node, or of its material
        std::uint32_t firstTriangle = 0;
        std::uint32_t triangleCount = 0;
    };
    struct Texture {
        std::size_t number = 0;  ///< of the image in its document
        ImagePlace image;
        bool repeat = true;  ///< along both axes
        TextureAlpha alpha = TextureAlpha::Ignored;
    };
    struct Triangle {
        std::array<std::uint32_t, 3> vertex{};
        std::uint32_t material = 0;
        std::uint32_t texture = kNone;  ///< index into textures
        std::uint32_t feature = kNoFeature;
    };
    std::vector<glm::dvec3> vertices;  ///< in the axes of the file: y up as glTF says
    std::vector<glm::dmat4> file_from_mesh{glm::dmat4(1.0)};  ///< one for each place it stands at
    bool instanced = false;  ///< they are instances of a node (EXT_mesh_gpu_instancing)
    std::vector<Triangle> triangles;
    std::vector<std::array<glm::vec2, 3>> uv;  ///< empty, or one per triangle; v up
    std::vector<Part> parts;
    std::vector<CityMaterial> materials;
    std::vector<Texture> textures;
    std::vector<std::string> featureNames;  ///< by number; shorter where they have no names
    std::optional<glm::dvec3> rtcCenter;    ///< CESIUM_RTC
    std::optional<Georeference> georeference;
    std::size_t outOfRange = 0;  ///< triangles left out because a vertex does not exist
    std::vector<Diagnostic> remarks;
};

/// Reads a glTF 2.0 file (.gltf, .glb): all of it as one mesh, but for each node that is instanced,
/// which follows as a mesh of its own. `maxTriangles` counts instances. Errors as
/// importVehicleBytes(), but for a file without triangles, which is an empty mesh.
[[nodiscard]] Result<std::vector<CityMesh>> readCityMeshes(std::string_view bytes,
                                                           const std::filesystem::path& path,
                                                           std::size_t maxTriangles,
                                                           const JobContext& job);

}  // namespace reflet::gltf
