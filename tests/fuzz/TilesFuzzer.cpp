// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes must give meshes whose numbers hold together, or an error with a text.
#include "importers/tiles/TileContent.h"
#include "tests/fuzz/CityChecks.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace reflet;
    using fuzz::require;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    tiles::ContentLimits limits;
    limits.maxTriangles = 100'000;
    limits.maxInstances = 1000;
    const auto parts =
        tiles::readTileContent(bytes, "/nonexistent/fuzz.b3dm", size % 2 == 1, limits, {});
    if (!parts) {
        require(!parts.error().what.empty() && !parts.error().remedy.empty(),
                "an error has a text and a remedy");
        return 0;
    }
    for (const tiles::TilePart& part : *parts) {
        std::size_t triangles = 0;
        for (const auto& node : part.mesh.parts) {
            require(node.firstTriangle == triangles, "nodes follow each other");
            triangles += node.triangleCount;
        }
        require(triangles == part.mesh.triangles.size(), "each triangle is of a node");
        require(part.tile_from_mesh.size() <= limits.maxInstances, "instances are bounded");
        for (const auto& triangle : part.mesh.triangles) {
            require(triangle.material < part.mesh.materials.size(), "material exists");
            for (const std::uint32_t vertex : triangle.vertex)
                require(vertex < part.mesh.vertices.size(), "vertex exists");
        }
    }
    return 0;
}
