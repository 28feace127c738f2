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

constexpr float kLargestSmall = 16.0F;  ///< metres
constexpr float kLargestLeaf = 1.6F;    ///< metres: larger parts of plants are never thinned

/// A triangle on its way into the index buffer; sorted by kind, thinning, cell and falling size.
struct Drawn {
    std::uint64_t order = 0;
    std::uint32_t triangle = 0;

    [[nodiscard]] ShadeKind kind() const { return ShadeKind(order >> 60); }
    /// 0: of a part larger than kLargestSmall; 1: of a smaller one; n + 2: of a leaf, thinned n
    /// times. Small parts have chunks of their own, whose boxes fit them tightly.
    [[nodiscard]] int group() const { return int(order >> 57 & 7U); }
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

/// Whether a triangle belongs to a small part of a plant, of which there are many alike.
bool isLeaf(const CityModel& city, const CityTriangle& t, ShadeKind kind, float size) {
    if (kind == ShadeKind::Textured || size > kLargestLeaf || t.surface >= city.surfaces.size()) {
        return false;
    }
    const std::uint32_t object = city.surfaces[t.surface].object;
    return object < city.objects.size() &&
           (city.objects[object].type == CityObjectType::SolitaryVegetation ||
            city.objects[object].type == CityObjectType::PlantCover);
}

/// How often a part may be thinned before it goes: by chance, but always the same.
int thinningsOf(std::uint32_t part) {
    std::uint32_t h = part * 0x9e3779b1U;
    h = (h ^ (h >> 16)) * 0x85ebca6bU;
    h ^= h >> 13;
    return std::min(std::countr_zero(h | 1U << 31) / 2, kThinnings);
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
    void add(const CityTriangle& triangle, const PartScale& scale) {
        const auto number = std::uint32_t(m_mesh.indices.size() / 3);
        std::array<std::uint32_t, 3> corner{};
        for (std::size_t i = 0; i < 3; ++i) {
            corner[i] = placed(triangle.vertex[i], scale);
        }
        std::size_t last = 0;
        while (last < 3 && m_mesh.vertices[corner[last]].triangle != kNone) {
            ++last;
        }
        if (last == 3) {
            last = 2;
            corner[2] = std::uint32_t(m_mesh.vertices.size());
            m_mesh.vertices.push_back({scale(m_city.vertices[triangle.vertex[2]]), kNone});
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
    std::uint32_t placed(std::uint32_t source, const PartScale& scale) {
        Place& place = m_place[source];
        if (place.chunk != m_chunk) {
            place = {m_chunk, std::uint32_t(m_mesh.vertices.size())};
            m_mesh.vertices.push_back({scale(m_city.vertices[source]), kNone});
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
                                  const CityParts& parts) {
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
        const std::uint32_t smallness = ~std::bit_cast<std::uint32_t>(parts.size[i]);
        const std::uint64_t key =
            std::uint64_t(kind) << 60 | row << 44 | column << 32 | std::uint64_t(smallness);
        if (!isLeaf(city, t, kind, parts.size[i])) {
            const std::uint64_t group = parts.size[i] > kLargestSmall ? 0 : 1;
            order.push_back({key | group << 57, i});
            continue;
        }
        for (int n = 0; n <= thinningsOf(parts.part[i]); ++n) {
            order.push_back({key | std::uint64_t(n + 2) << 57, i});
        }
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
    const CityParts parts = cityParts(model);
    const std::vector<Drawn> order = orderTriangles(model, kinds, parts);

    IndexWriter writer(model, *mesh);
    mesh->partSize.reserve(order.size());
    mesh->firstTextured = std::uint32_t(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const CityTriangle& t = model.triangles[order[i].triangle];
        const ShadeKind kind = order[i].kind();
        const int group = order[i].group();
        if (i == 0 || cellsOf(order[i]) != cellsOf(order[i - 1])) {
            mesh->chunks.push_back(
                {{}, kind, group > 1, std::max(group - 2, 0), std::uint32_t(i), 0});
            writer.startChunk();
        }
        if (kind == ShadeKind::Textured) {
            mesh->firstTextured = std::min(mesh->firstTextured, std::uint32_t(i));
        }
        CityChunk& chunk = mesh->chunks.back();
        ++chunk.triangleCount;
        const PartScale scale{parts.center[order[i].triangle], float(1 << chunk.thinned)};
        for (const std::uint32_t v : t.vertex) {
            chunk.bounds.add(glm::dvec3(scale(model.vertices[v])));
            mesh->bounds.add(glm::dvec3(model.vertices[v]));
        }
        mesh->partSize.push_back(parts.size[order[i].triangle]);
        writer.add(t, scale);
        addTriangle(model, order[i].triangle, kind, scale, *mesh);
    }
    return mesh;
}

}  // namespace reflet
