// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes must give a ground that holds together, or an error with a text: never a crash, a hang
// or a memory beyond a multiple of the limits.
#include "importers/terrain/TerrainImporter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace {

void require(bool condition, const char* what) {
    if (condition)
        return;
    std::fprintf(stderr, "broken invariant: %s\n", what);
    std::abort();
}

void checkCity(const reflet::CityModel& city) {
    for (const reflet::CityTriangle& triangle : city.triangles) {
        require(triangle.surface < city.surfaces.size(), "surface exists");
        for (const std::uint32_t v : triangle.vertex) {
            require(v < city.vertices.size(), "vertex exists");
            const glm::vec3& p = city.vertices[v];
            require(std::isfinite(p.x) && std::isfinite(p.y) && std::abs(p.z) < 13'000.0F,
                    "corners are places on the Earth");
        }
    }
    for (const reflet::CitySurface& surface : city.surfaces)
        require(surface.object < city.objects.size(), "object exists");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    reflet::ImportOptions options;
    options.crs = "local";
    reflet::TerrainOptions terrain;
    terrain.mostPosts = 4'096;
    terrain.mostLookedAt = 65'536;
    terrain.mostTriangles = 1'000;
    const auto result = reflet::importTerrainBytes(bytes, "fuzz.tif", options, terrain, {});
    if (!result) {
        require(!result.error().what.empty() && !result.error().remedy.empty(),
                "an error has a text and a remedy");
        return 0;
    }
    checkCity(result->value.city);
    return 0;
}
