// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/GltfDocument.h"

#include <algorithm>
#include <meshoptimizer.h>

namespace reflet::gltf {

namespace {

// Collapsing edges takes 150 bytes and a microsecond for a triangle: what is finer than this, about
// 5 mm on a car, is first gathered in the cells of a grid, which takes a tenth.
constexpr std::size_t kMostCollapsed = 1'500'000;
constexpr float kLargestError = 0.02F;  // of the primitive's size

template <class T>
void keep(std::vector<T>& values, std::size_t perVertex, const std::vector<unsigned int>& remap,
          std::size_t count) {
    if (values.size() != perVertex * remap.size())
        return;
    std::vector<T> kept(perVertex * count);
    meshopt_remapVertexBuffer(kept.data(), values.data(), remap.size(), perVertex * sizeof(T),
                              remap.data());
    values = std::move(kept);
}

void replace(Primitive& primitive, const std::vector<unsigned int>& indices) {
    primitive.triangles.clear();
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
        primitive.triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
    primitive.triangles.shrink_to_fit();
    compact(primitive);
}

/// By the cells of a grid: any mesh becomes as small as asked for, or stays if nothing would
/// remain.
void gather(Primitive& primitive, std::size_t triangles) {
    std::vector<unsigned int> indices(primitive.triangles.size() * 3);
    indices.resize(meshopt_simplifySloppy(indices.data(), &primitive.triangles.front().x,
                                          indices.size(), &primitive.positions.front().x,
                                          primitive.positions.size(), sizeof(glm::vec3),
                                          3 * triangles, 1.0F, nullptr));
    if (!indices.empty())
        replace(primitive, indices);
}

void collapse(Primitive& primitive, std::size_t triangles) {
    std::vector<unsigned int> indices(primitive.triangles.size() * 3);
    indices.resize(meshopt_simplify(indices.data(), &primitive.triangles.front().x, indices.size(),
                                    &primitive.positions.front().x, primitive.positions.size(),
                                    sizeof(glm::vec3), 3 * triangles, kLargestError, 0, nullptr));
    replace(primitive, indices);
}

}  // namespace

void compact(Primitive& primitive) {
    if (primitive.triangles.empty())
        return;
    std::vector<unsigned int> remap(primitive.positions.size());
    const std::size_t count = meshopt_optimizeVertexFetchRemap(
        remap.data(), &primitive.triangles.front().x, primitive.triangles.size() * 3, remap.size());
    for (glm::uvec3& t : primitive.triangles)
        t = {remap[t.x], remap[t.y], remap[t.z]};
    keep(primitive.normals, 1, remap, count);
    keep(primitive.uv, 2, remap, count);
    keep(primitive.uv1, 2, remap, count);
    keep(primitive.colors, 1, remap, count);
    keep(primitive.features, 1, remap, count);
    keep(primitive.positions, 1, remap, count);
}

void simplify(Primitive& primitive, std::size_t triangles) {
    if (primitive.triangles.size() > kMostCollapsed)
        gather(primitive, std::max(kMostCollapsed, triangles));
    if (primitive.triangles.size() > triangles)
        collapse(primitive, triangles);
    // Where edges cannot be collapsed, for lack of neighbours or within the error.
    if (primitive.triangles.size() > 2 * triangles)
        gather(primitive, triangles);
}

}  // namespace reflet::gltf
