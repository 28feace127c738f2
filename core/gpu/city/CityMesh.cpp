// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/city/CityMesh.h"

#include "core/base/ParallelFor.h"
#include "core/gpu/city/CityPass.h"
#include "core/gpu/city/CityTables.h"
#include "core/gpu/city/PartSizes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <mutex>
#include <utility>

namespace reflet {

namespace {

constexpr double kChunk = 64.0;            ///< metres
constexpr double kMaxChunksAcross = 64.0;  ///< larger cities get larger chunks
/// All that is decoded (app/pipeline), with the halved copies and borders of its images.
constexpr std::size_t kTextureBudget = std::size_t(400) << 20;

constexpr float kLargestSmall = 16.0F;  ///< metres
constexpr float kLargestLeaf = 1.6F;    ///< metres: larger parts of plants are never thinned

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

/// The triangles in the order in which they are drawn: by kind, group, cell and falling size.
/// Group 0: of a part larger than kLargestSmall; 1: of a smaller one, since small parts have chunks
/// of their own, whose boxes fit them tightly; n + 2: of a leaf, thinned n times.
class DrawOrder {
public:
    DrawOrder(const CityModel& city, const std::vector<ShadeKind>& kinds, const CityParts& parts)
        : m_city(city), m_kinds(kinds), m_parts(parts), m_binOf(city.triangles.size(), kNone) {
        if (!layOutCells())
            return;
        findBins();
        sortIntoBins();
    }

    [[nodiscard]] std::size_t count() const { return m_entries.size(); }
    /// The triangle of the city that is drawn as the n-th.
    [[nodiscard]] std::uint32_t triangle(std::size_t n) const {
        return std::uint32_t(m_entries[n]);
    }
    /// What lies together in one cell, without its bounds.
    [[nodiscard]] std::vector<CityChunk> chunks() const {
        std::vector<CityChunk> chunks;
        for (std::size_t bin = 0; bin + 1 < m_first.size(); ++bin) {
            if (m_first[bin] == m_first[bin + 1])
                continue;
            const int group = int(bin / m_cells) % kGroups;
            chunks.push_back({{},
                              ShadeKind(bin / m_cells / kGroups),
                              group > 1,
                              std::max(group - 2, 0),
                              m_first[bin],
                              m_first[bin + 1] - m_first[bin]});
        }
        return chunks;
    }

private:
    static constexpr int kGroups = kThinnings + 3;
    static constexpr std::size_t kGrain = 4096;

    /// False for a city of nothing.
    bool layOutCells() {
        std::mutex mutex;
        Box bounds;
        parallelFor(0, m_binOf.size(), kGrain, [&](std::size_t first, std::size_t last) {
            Box own;
            for (std::size_t i = first; i < last; ++i) {
                const CityTriangle& t = m_city.triangles[i];
                if (!hasArea(m_city, t))
                    continue;
                m_binOf[i] = 0;
                own.add(glm::dvec3(m_city.vertices[t.vertex[0]]));
            }
            const std::scoped_lock lock(mutex);
            if (!own.empty()) {
                bounds.add(own.min);
                bounds.add(own.max);
            }
        });
        if (bounds.empty())
            return false;
        m_origin = bounds.min;
        const glm::dvec3 size = bounds.size();
        m_cell = std::max(kChunk, std::max(size.x, size.y) / kMaxChunksAcross);
        m_columns = std::size_t(size.x / m_cell) + 1;
        m_cells = m_columns * (std::size_t(size.y / m_cell) + 1);
        return true;
    }

    void findBins() {
        parallelFor(0, m_binOf.size(), kGrain, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                if (m_binOf[i] != kNone)
                    m_binOf[i] = binOf(i);
            }
        });
    }
    [[nodiscard]] std::uint32_t binOf(std::size_t i) const {
        const CityTriangle& t = m_city.triangles[i];
        const ShadeKind kind = t.surface < m_kinds.size() ? m_kinds[t.surface] : ShadeKind::Plain;
        const glm::dvec3 offset = glm::dvec3(m_city.vertices[t.vertex[0]]) - m_origin;
        const auto cell =
            std::size_t(offset.y / m_cell) * m_columns + std::size_t(offset.x / m_cell);
        const std::size_t group = isLeaf(m_city, t, kind, m_parts.size[i]) ? 2
                                  : m_parts.size[i] > kLargestSmall        ? 0
                                                                           : 1;
        return std::uint32_t((std::size_t(kind) * kGroups + group) * m_cells + cell);
    }

    /// Calls use(bin, entry) for all that is drawn, leaves as often as they are thinned.
    template <class Use>
    void eachDrawn(const Use& use) const {
        for (std::uint32_t i = 0; i < m_binOf.size(); ++i) {
            if (m_binOf[i] == kNone)
                continue;
            const std::uint32_t smallness = ~std::bit_cast<std::uint32_t>(m_parts.size[i]);
            const std::uint64_t entry = std::uint64_t(smallness) << 32 | i;
            use(m_binOf[i], entry);
            if (m_binOf[i] / m_cells % kGroups != 2)
                continue;
            for (int n = 1; n <= thinningsOf(m_parts.part[i]); ++n)
                use(m_binOf[i] + std::size_t(n) * m_cells, entry);
        }
    }

    void sortIntoBins() {
        m_first.assign(kShadeKinds * kGroups * m_cells + 1, 0);
        eachDrawn([&](std::size_t bin, std::uint64_t) { ++m_first[bin + 1]; });
        for (std::size_t bin = 1; bin < m_first.size(); ++bin)
            m_first[bin] += m_first[bin - 1];
        m_entries.resize(m_first.back());
        std::vector<std::uint32_t> next(m_first.begin(), m_first.end() - 1);
        eachDrawn([&](std::size_t bin, std::uint64_t entry) { m_entries[next[bin]++] = entry; });
        constexpr std::size_t kBins = 64;
        parallelFor(0, next.size(), kBins, [&](std::size_t first, std::size_t last) {
            for (std::size_t bin = first; bin < last; ++bin)
                std::sort(m_entries.begin() + m_first[bin], m_entries.begin() + m_first[bin + 1]);
        });
    }

    const CityModel& m_city;
    const std::vector<ShadeKind>& m_kinds;
    const CityParts& m_parts;
    glm::dvec3 m_origin{0.0};
    double m_cell = kChunk;
    std::size_t m_columns = 1;
    std::size_t m_cells = 1;
    std::vector<std::uint32_t> m_binOf;    ///< by triangle; kNone: it is not drawn
    std::vector<std::uint32_t> m_first;    ///< by bin
    std::vector<std::uint64_t> m_entries;  ///< falling size, then triangle
};

/// The place of each vertex of the city within a chunk: an open hash table.
class PlacesInChunk {
public:
    void reset(std::size_t vertices) {
        m_mask = std::bit_ceil(2 * vertices + 2) - 1;
        m_slots.assign(m_mask + 1, {kNone, 0});
    }
    /// `otherwise`: the place of one that is not there yet.
    std::uint32_t at(std::uint32_t vertex, std::uint32_t otherwise) {
        std::size_t slot = vertex * 0x9e3779b97f4a7c15ULL >> 32 & m_mask;
        while (m_slots[slot].first != kNone && m_slots[slot].first != vertex)
            slot = (slot + 1) & m_mask;
        if (m_slots[slot].first == kNone)
            m_slots[slot] = {vertex, otherwise};
        return m_slots[slot].second;
    }

private:
    std::size_t m_mask = 0;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> m_slots;
};

/// Writes triangles into the buffers such that each has a last vertex of its own, which carries its
/// number to the fragments (flat): corners are shared as far as that allows. Consecutive chunks are
/// written side by side, each batch of them with vertices of its own at first.
class ChunkWriter {
public:
    ChunkWriter(const CityModel& city, const DrawOrder& order, const CityParts& parts,
                CityMesh& mesh)
        : m_city(city), m_order(order), m_parts(parts), m_mesh(mesh) {}

    void write() {
        makeBatches();
        parallelFor(0, m_batches.size(), 1, [&](std::size_t first, std::size_t last) {
            PlacesInChunk places;
            for (std::size_t n = first; n < last; ++n) {
                for (std::size_t c = m_batches[n].firstChunk; c < m_batches[n].lastChunk; ++c)
                    writeChunk(m_mesh.chunks[c], places, m_batches[n].vertices);
            }
        });
        joinBatches();
    }

private:
    struct Batch {
        std::size_t firstChunk = 0, lastChunk = 0;
        std::vector<CityVertex> vertices;
    };

    void makeBatches() {
        constexpr std::size_t kTriangles = 16384;
        std::size_t triangles = kTriangles;
        for (std::size_t c = 0; c < m_mesh.chunks.size(); ++c) {
            if (triangles >= kTriangles) {
                m_batches.push_back({c, c, {}});
                triangles = 0;
            }
            m_batches.back().lastChunk = c + 1;
            triangles += m_mesh.chunks[c].triangleCount;
        }
    }

    void writeChunk(CityChunk& chunk, PlacesInChunk& places, std::vector<CityVertex>& vertices) {
        places.reset(std::size_t(3) * chunk.triangleCount);
        for (std::size_t n = chunk.firstTriangle; n < chunk.firstTriangle + chunk.triangleCount;
             ++n) {
            const std::uint32_t triangle = m_order.triangle(n);
            const PartScale scale{m_parts.center[triangle], float(1 << chunk.thinned)};
            const CityTriangle& t = m_city.triangles[triangle];
            for (const std::uint32_t v : t.vertex)
                chunk.bounds.add(glm::dvec3(scale(m_city.vertices[v])));
            m_mesh.partSize[n] = m_parts.size[triangle];
            writeCorners(t, scale, n, places, vertices);
            writeTriangle(m_city, triangle, chunk.kind, scale, n, m_mesh);
        }
    }

    void writeCorners(const CityTriangle& t, const PartScale& scale, std::size_t number,
                      PlacesInChunk& places, std::vector<CityVertex>& vertices) {
        std::array<std::uint32_t, 3> corner{};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto next = std::uint32_t(vertices.size());
            corner[i] = places.at(t.vertex[i], next);
            if (corner[i] == next)
                vertices.push_back({scale(m_city.vertices[t.vertex[i]]), kNone});
        }
        std::size_t last = 0;
        while (last < 3 && vertices[corner[last]].triangle != kNone)
            ++last;
        if (last == 3) {
            last = 2;
            corner[2] = std::uint32_t(vertices.size());
            vertices.push_back({scale(m_city.vertices[t.vertex[2]]), kNone});
        }
        vertices[corner[last]].triangle = std::uint32_t(number);
        for (std::size_t i = 1; i <= 3; ++i)
            m_mesh.indices[3 * number + i - 1] = corner[(last + i) % 3];
    }

    void joinBatches() {
        std::vector<std::size_t> first{0};
        for (const Batch& batch : m_batches)
            first.push_back(first.back() + batch.vertices.size());
        m_mesh.vertices.resize(first.back());
        parallelFor(0, m_batches.size(), 1, [&](std::size_t from, std::size_t to) {
            for (std::size_t n = from; n < to; ++n) {
                Batch& batch = m_batches[n];
                std::copy(batch.vertices.begin(), batch.vertices.end(),
                          m_mesh.vertices.begin() + std::ptrdiff_t(first[n]));
                batch.vertices = {};
                const CityChunk& end = m_mesh.chunks[batch.lastChunk - 1];
                for (std::size_t k = std::size_t(3) * m_mesh.chunks[batch.firstChunk].firstTriangle;
                     k < std::size_t(3) * (end.firstTriangle + end.triangleCount); ++k)
                    m_mesh.indices[k] += std::uint32_t(first[n]);
            }
        });
    }

    const CityModel& m_city;
    const DrawOrder& m_order;
    const CityParts& m_parts;
    CityMesh& m_mesh;
    std::vector<Batch> m_batches;
};

/// The number of the first triangle with a texture: those come last.
std::size_t firstTextured(const std::vector<CityChunk>& chunks, std::size_t triangles) {
    const auto found = std::find_if(chunks.begin(), chunks.end(), [](const CityChunk& chunk) {
        return chunk.kind == ShadeKind::Textured;
    });
    return found == chunks.end() ? triangles : found->firstTriangle;
}

}  // namespace

std::uint32_t trianglesOfSize(const CityMesh& mesh, const CityChunk& chunk, float size) {
    const auto begin = mesh.partSize.begin() + chunk.firstTriangle;
    const auto end = begin + chunk.triangleCount;
    return std::uint32_t(
        std::lower_bound(begin, end, size, [](float part, float least) { return part >= least; }) -
        begin);
}

std::shared_ptr<const CityMesh> buildCityMesh(const std::shared_ptr<const DrawnCity>& city,
                                              const JobContext& job) {
    auto mesh = std::make_shared<CityMesh>();
    const CityModel& model = *city->model;
    mesh->textures = layOutTextures(model, *city->textures, kTextureBudget);
    const std::vector<ShadeKind> kinds = kindsOf(*city, mesh->textures);
    if (job.cancelled())
        return nullptr;
    fillSurfaceTables(*city, kinds, *mesh);
    if (job.cancelled())
        return nullptr;
    const CityParts parts = cityParts(model);
    if (job.cancelled())
        return nullptr;
    const DrawOrder order(model, kinds, parts);
    if (job.cancelled())
        return nullptr;
    const std::size_t count = order.count();
    mesh->chunks = order.chunks();
    mesh->firstTextured = std::uint32_t(firstTextured(mesh->chunks, count));
    mesh->indices.resize(3 * count);
    mesh->partSize.resize(count);
    mesh->triangles.resize(2 * count);
    mesh->mapping.resize(2 * (count - mesh->firstTextured));
    ChunkWriter(model, order, parts, *mesh).write();
    for (const CityChunk& chunk : mesh->chunks) {
        if (chunk.thinned == 0) {  // the others are in the place of what is here
            mesh->bounds.add(chunk.bounds.min);
            mesh->bounds.add(chunk.bounds.max);
        }
    }
    return mesh;
}

}  // namespace reflet
