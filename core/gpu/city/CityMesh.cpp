// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/city/CityMesh.h"

#include "core/gpu/city/CityPass.h"
#include "core/gpu/city/CityTables.h"
#include "core/gpu/city/PartSizes.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace reflet {

namespace {

constexpr double kChunk = 64.0;            ///< metres
constexpr double kMaxChunksAcross = 64.0;  ///< larger cities get larger chunks
constexpr std::size_t kTextureBudget = std::size_t(128) << 20;

/// A triangle on its way into the index buffer; sorted by kind, cell and falling size.
struct Drawn {
    std::uint64_t order = 0;
    std::uint32_t triangle = 0;
};

std::uint32_t cellsOf(const Drawn& drawn) {
    return std::uint32_t(drawn.order >> 32);
}

bool hasArea(const CityModel& city, const CityTriangle& t) {
    for (const std::uint32_t v : t.vertex) {
        if (v >= city.vertices.size() || !std::isfinite(glm::length(city.vertices[v]))) {
            return false;
        }
    }
    const glm::dvec3 a(city.vertices[t.vertex[0]]);
    const glm::dvec3 cross = glm::cross(glm::dvec3(city.vertices[t.vertex[1]]) - a,
                                        glm::dvec3(city.vertices[t.vertex[2]]) - a);
    return glm::length(cross) > 0.0;
}

std::vector<ShadeKind> kindsOf(const DrawnCity& city, const TexturePages& textures) {
    const CityModel& model = *city.model;
    std::vector<ShadeKind> kinds(model.surfaces.size(), ShadeKind::Plain);
    const bool mapped = model.uv.size() == model.triangles.size();
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        const std::uint32_t texture = model.surfaces[i].texture;
        const bool textured =
            mapped && texture < model.textures.size() && textures.places[texture].w != 0;
        kinds[i] = shadeKind(city.looks->surface(i), textured);
    }
    return kinds;
}

/// Writes triangles into the buffers such that each has a last vertex of its own, which carries its
/// number to the fragments (flat): corners are shared as far as that allows.
class IndexWriter {
public:
    IndexWriter(const CityModel& city, CityMesh& mesh)
        : m_city(city), m_mesh(mesh), m_place(city.vertices.size()) {}

    void startChunk() { ++m_chunk; }
    void add(const CityTriangle& triangle) {
        const auto number = std::uint32_t(m_mesh.indices.size() / 3);
        std::array<std::uint32_t, 3> corner{};
        for (std::size_t i = 0; i < 3; ++i) {
            corner[i] = placed(triangle.vertex[i]);
        }
        std::size_t last = 0;
        while (last < 3 && m_mesh.vertices[corner[last]].triangle != kNone) {
            ++last;
        }
        if (last == 3) {
            last = 2;
            corner[2] = std::uint32_t(m_mesh.vertices.size());
            m_mesh.vertices.push_back({m_city.vertices[triangle.vertex[2]], kNone});
        }
        m_mesh.vertices[corner[last]].triangle = number;
        for (std::size_t i = 1; i <= 3; ++i) {
            m_mesh.indices.push_back(corner[(last + i) % 3]);
        }
    }

private:
    struct Place {
        std::uint32_t chunk = 0;
        std::uint32_t vertex = 0;
    };
    std::uint32_t placed(std::uint32_t source) {
        Place& place = m_place[source];
        if (place.chunk != m_chunk) {
            place = {m_chunk, std::uint32_t(m_mesh.vertices.size())};
            m_mesh.vertices.push_back({m_city.vertices[source], kNone});
        }
        return place.vertex;
    }

    const CityModel& m_city;
    CityMesh& m_mesh;
    std::vector<Place> m_place;
    std::uint32_t m_chunk = 0;
};

/// All triangles in the order in which they are drawn.
std::vector<Drawn> orderTriangles(const CityModel& city, const std::vector<ShadeKind>& kinds,
                                  const std::vector<float>& sizes) {
    Box bounds;
    for (const CityTriangle& t : city.triangles) {
        if (hasArea(city, t)) {
            bounds.add(glm::dvec3(city.vertices[t.vertex[0]]));
        }
    }
    std::vector<Drawn> order;
    if (bounds.empty()) {
        return order;
    }
    const double extent = std::max(bounds.size().x, bounds.size().y);
    const double cell = std::max(kChunk, extent / kMaxChunksAcross);
    order.reserve(city.triangles.size());
    for (std::uint32_t i = 0; i < city.triangles.size(); ++i) {
        const CityTriangle& t = city.triangles[i];
        if (!hasArea(city, t)) {
            continue;
        }
        const glm::dvec3 offset = glm::dvec3(city.vertices[t.vertex[0]]) - bounds.min;
        const auto column = std::uint64_t(offset.x / cell);
        const auto row = std::uint64_t(offset.y / cell);
        const ShadeKind kind = t.surface < kinds.size() ? kinds[t.surface] : ShadeKind::Plain;
        const std::uint32_t smallness = ~std::bit_cast<std::uint32_t>(sizes[i]);
        order.push_back({std::uint64_t(kind) << 60 | row << 46 | column << 32 | smallness, i});
    }
    std::sort(order.begin(), order.end(), [](const Drawn& a, const Drawn& b) {
        return a.order != b.order ? a.order < b.order : a.triangle < b.triangle;
    });
    return order;
}

}  // namespace

std::uint32_t trianglesOfSize(const CityMesh& mesh, const CityChunk& chunk, float size) {
    const auto begin = mesh.partSize.begin() + chunk.firstTriangle;
    const auto end = begin + chunk.triangleCount;
    return std::uint32_t(
        std::lower_bound(begin, end, size, [](float part, float least) { return part >= least; }) -
        begin);
}

std::shared_ptr<const CityMesh> buildCityMesh(const std::shared_ptr<const DrawnCity>& city) {
    auto mesh = std::make_shared<CityMesh>();
    const CityModel& model = *city->model;
    mesh->textures = layOutTextures(model, *city->textures, kTextureBudget);
    const std::vector<ShadeKind> kinds = kindsOf(*city, mesh->textures);
    fillSurfaceTables(*city, kinds, *mesh);
    const std::vector<float> sizes = partSizes(model);
    const std::vector<Drawn> order = orderTriangles(model, kinds, sizes);

    IndexWriter writer(model, *mesh);
    mesh->partSize.reserve(order.size());
    mesh->firstTextured = std::uint32_t(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const CityTriangle& t = model.triangles[order[i].triangle];
        const auto kind = ShadeKind(order[i].order >> 60);
        if (i == 0 || cellsOf(order[i]) != cellsOf(order[i - 1])) {
            mesh->chunks.push_back({{}, kind, std::uint32_t(i), 0});
            writer.startChunk();
        }
        if (kind == ShadeKind::Textured) {
            mesh->firstTextured = std::min(mesh->firstTextured, std::uint32_t(i));
        }
        CityChunk& chunk = mesh->chunks.back();
        ++chunk.triangleCount;
        for (const std::uint32_t v : t.vertex) {
            chunk.bounds.add(glm::dvec3(model.vertices[v]));
            mesh->bounds.add(glm::dvec3(model.vertices[v]));
        }
        mesh->partSize.push_back(sizes[order[i].triangle]);
        writer.add(t);
        addTriangle(model, order[i].triangle, kind, *mesh);
    }
    return mesh;
}

}  // namespace reflet
