// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes must give a model that holds together, or an error with a text: never a crash, a hang
// or a memory beyond a multiple of the input.
#include "core/traffic/VehicleProposal.h"
#include "importers/gltf/GltfImporter.h"

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

void checkModel(const reflet::GltfModel& model) {
    require(model.normals.size() == model.positions.size(), "one normal for each vertex");
    require(model.triangleMaterial.size() == model.triangles.size(), "one material for each");
    for (const glm::uvec3& t : model.triangles)
        require(std::max({t.x, t.y, t.z}) < model.positions.size(), "vertex exists");
    for (const std::uint16_t material : model.triangleMaterial)
        require(material < model.materials.size(), "material exists");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    reflet::GltfOptions options;
    options.maxTriangles = 20'000;
    options.mostKept = 2'000;
    const auto result = reflet::importVehicleBytes(bytes, "/nonexistent/fuzz.gltf", options, {});
    if (!result) {
        require(!result.error().what.empty() && !result.error().remedy.empty(),
                "an error has a text and a remedy");
        return 0;
    }
    checkModel(result->value);
    const reflet::VehicleProposal proposal = reflet::proposeFit(result->value);
    require(std::isfinite(proposal.length) && proposal.model.scale > 0.0, "a size is proposed");
    return 0;
}
