// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"
#include "core/base/JobContext.h"
#include "core/city/CityModel.h"

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

/// Where a file says that its zero lies: asset.extras.georeference, or the same in a file of its
/// name with ".geo.json" behind it.
struct Georeference {
    std::string crs;  ///< as Crs::parse() reads it, with the vertical part
    glm::dvec3 origin{0.0};
    bool zUp = false;
};

/// The triangles of a glTF file as a part of a city, all nodes in place, in double.
struct CityMesh {
    static constexpr std::uint32_t kNoFeature = std::numeric_limits<std::uint32_t>::max();

    struct Part {
        std::string name;  ///< of the node, or of its material
        std::uint32_t firstTriangle = 0;
        std::uint32_t triangleCount = 0;
    };
    struct Triangle {
        std::array<std::uint32_t, 3> vertex{};
        std::uint32_t material = 0;
        std::uint32_t feature = kNoFeature;
    };
    std::vector<glm::dvec3> vertices;  ///< in the axes of the file: y up as glTF says
    std::vector<Triangle> triangles;
    std::vector<Part> parts;
    std::vector<CityMaterial> materials;
    std::vector<std::string> featureNames;  ///< by number; shorter where they have no names
    std::optional<glm::dvec3> rtcCenter;    ///< CESIUM_RTC
    std::optional<Georeference> georeference;
    std::size_t outOfRange = 0;  ///< triangles left out because a vertex does not exist
    bool textures = false;  ///< there were some; each triangle has the mean of its part of them
    std::vector<Diagnostic> remarks;
};

/// Reads a glTF 2.0 file (.gltf, .glb). Errors as importVehicleBytes(), but for a file without
/// triangles, which is an empty mesh.
[[nodiscard]] Result<CityMesh> readCityMesh(std::string_view bytes,
                                            const std::filesystem::path& path,
                                            std::size_t maxTriangles, const JobContext& job);

}  // namespace reflet::gltf
