// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/ImportTypes.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

// What must hold whatever bytes an importer of cities is given: a model that holds together, or an
// error with a text.
namespace reflet::fuzz {

inline void require(bool condition, const char* what) {
    if (condition)
        return;
    std::fprintf(stderr, "broken invariant: %s\n", what);
    std::abort();
}

inline void checkModel(const CityModel& city) {
    for (const CityObject& object : city.objects)
        require(!object.parent || *object.parent < city.objects.size(), "parent exists");
    for (const CitySurface& surface : city.surfaces) {
        require(surface.object < city.objects.size(), "object exists");
        require(surface.material == kNone || surface.material < city.materials.size(),
                "material exists");
        require(surface.texture == kNone || surface.texture < city.textures.size(),
                "texture exists");
    }
    for (const CityTriangle& triangle : city.triangles) {
        require(triangle.surface < city.surfaces.size(), "surface exists");
        for (const std::uint32_t vertex : triangle.vertex)
            require(vertex < city.vertices.size(), "vertex exists");
    }
    for (const glm::vec3& vertex : city.vertices)
        require(std::isfinite(vertex.x + vertex.y + vertex.z), "vertices are finite");
    require(city.uv.empty() || city.uv.size() == city.triangles.size(), "one uv for each triangle");
}

/// The length chooses among ways to import, so that the corpus stays plain files.
inline ImportOptions optionsFor(std::size_t size) {
    ImportOptions options;
    if (size % 4 == 1)
        options.lod = "all";
    if (size % 4 == 2)
        options.bbox = {-1000.0, -1000.0, 1000.0, 1000.0};
    if (size % 4 == 3)
        options.frame = ProjectFrame{"EPSG:28992", "EPSG:5709", {85000.0, 446000.0, 0.0}};
    return options;
}

inline void check(const Result<Imported<CityImport>>& result) {
    if (!result) {
        require(!result.error().what.empty() && !result.error().remedy.empty(),
                "an error has a text and a remedy");
        return;
    }
    checkModel(result->value.city);
    for (const std::uint32_t object : result->value.aboveGround)
        require(object < result->value.city.objects.size(), "object above the ground exists");
    for (const Diagnostic& diagnostic : result->diagnostics)
        require(!diagnostic.code.empty() && !diagnostic.text.empty(), "a diagnostic has a text");
}

}  // namespace reflet::fuzz
