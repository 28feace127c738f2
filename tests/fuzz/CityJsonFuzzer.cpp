// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes must give a model that holds together, or an error with a text: never a crash, a hang
// or a memory beyond a multiple of the input.
#include "importers/cityjson/CityJsonImporter.h"

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

void checkModel(const reflet::CityModel& city) {
    for (const reflet::CityObject& object : city.objects)
        require(!object.parent || *object.parent < city.objects.size(), "parent exists");
    for (const reflet::CitySurface& surface : city.surfaces) {
        require(surface.object < city.objects.size(), "object exists");
        require(surface.material == reflet::kNone || surface.material < city.materials.size(),
                "material exists");
        require(surface.texture == reflet::kNone || surface.texture < city.textures.size(),
                "texture exists");
    }
    for (const reflet::CityTriangle& triangle : city.triangles) {
        require(triangle.surface < city.surfaces.size(), "surface exists");
        for (const std::uint32_t vertex : triangle.vertex)
            require(vertex < city.vertices.size(), "vertex exists");
    }
    for (const glm::vec3& vertex : city.vertices)
        require(std::isfinite(vertex.x + vertex.y + vertex.z), "vertices are finite");
    require(city.uv.empty() || city.uv.size() == city.triangles.size(), "one uv for each triangle");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    reflet::ImportOptions options;
    // The length chooses among ways to import, so that the corpus stays plain CityJSON.
    if (size % 4 == 1)
        options.lod = "all";
    if (size % 4 == 2)
        options.bbox = {-1000.0, -1000.0, 1000.0, 1000.0};
    if (size % 4 == 3)
        options.frame = reflet::ProjectFrame{"EPSG:28992", "EPSG:5709", {85000.0, 446000.0, 0.0}};
    const auto result =
        reflet::importCityJsonText(text, "/nonexistent/fuzz.city.json", options, {});
    if (!result) {
        require(!result.error().what.empty() && !result.error().remedy.empty(),
                "an error has a text and a remedy");
        return 0;
    }
    checkModel(result->value.city);
    for (const reflet::Diagnostic& diagnostic : result->diagnostics)
        require(!diagnostic.code.empty() && !diagnostic.text.empty(), "a diagnostic has a text");
    return 0;
}
