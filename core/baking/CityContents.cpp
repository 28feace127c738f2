// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/CityContents.h"

#include "core/baking/AmbientLight.h"
#include "core/base/ContentHash.h"
#include "core/base/HashMix.h"
#include "core/base/ParallelFor.h"

#include <glm/ext/vector_int3_sized.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <optional>
#include <string>

namespace reflet {

namespace {

constexpr double kMargin = 0.01;  ///< metres that a triangle counts as thicker: room for rounding
constexpr std::int64_t kMostVisits = std::int64_t(1) << 28;  ///< cells of all triangles together
constexpr std::size_t kGrain = 1024;

/// Numbers one behind the other.
class Digest {
public:
    Digest& add(std::uint64_t value) {
        m_value = joined(m_value, value);
        return *this;
    }
    Digest& add(float value) {  // 0 and -0 draw alike
        return add(std::uint64_t(std::bit_cast<std::uint32_t>(value + 0.0F)));
    }
    Digest& add(const glm::vec2& v) { return add(v.x).add(v.y); }
    Digest& add(const glm::vec3& v) { return add(v.x).add(v.y).add(v.z); }
    [[nodiscard]] std::uint64_t value() const { return m_value; }

private:
    std::uint64_t m_value = 1;
};

/// The corners of a triangle; nothing when one is missing or not finite.
std::optional<std::array<glm::vec3, 3>> cornersOf(const CityModel& city, std::size_t triangle) {
    std::array<glm::vec3, 3> corners;
    std::size_t n = 0;
    eachVertex(city, triangle, [&](const glm::vec3& p) { corners[n++] = p; });
    return n == 3 ? std::optional(corners) : std::nullopt;
}

/// What of a building's look its surfaces of a kind are drawn with.
void addBuilding(Digest& digest, LookKind kind, const BuildingLook& building) {
    switch (kind) {
        case LookKind::Facade:
        case LookKind::Foliage:
            digest.add(std::uint64_t(building.seed)).add(building.base).add(building.top);
            digest.add(building.center).add(building.radius);
            digest.add(std::uint64_t(building.hasOpenings) << 1U |
                       std::uint64_t(building.inPieces));
            break;
        case LookKind::FlatRoof:
        case LookKind::TiledRoof:
            digest.add(std::uint64_t(building.seed));
            break;
        default:
            break;
    }
}

/// Cells around a triangle.
struct CellRange {
    glm::ivec3 low, high;  ///< both belong to it

    [[nodiscard]] std::int64_t count() const {
        const glm::i64vec3 size(high - low + 1);
        return size.x * size.y * size.z;
    }
};

CellRange rangeOf(const CellGrid& grid, const std::array<glm::vec3, 3>& corners) {
    Box box;
    for (const glm::vec3& corner : corners)
        box.add(glm::dvec3(corner));
    return {grid.cellAt(box.min - kMargin), grid.cellAt(box.max + kMargin)};
}

/// Calls visit(cell) for each cell of the range that the triangle may touch, and few others.
template <class Visit>
void eachCell(const CellGrid& grid, const CellRange& range, const std::array<glm::vec3, 3>& corners,
              const Visit& visit) {
    const glm::dvec3 a(corners[0]);
    const glm::dvec3 normal = glm::cross(glm::dvec3(corners[1]) - a, glm::dvec3(corners[2]) - a);
    const double half =
        0.5 * grid.size * (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z)) +
        kMargin * glm::length(normal);
    glm::ivec3 cell;
    for (cell.z = range.low.z; cell.z <= range.high.z; ++cell.z) {
        for (cell.y = range.low.y; cell.y <= range.high.y; ++cell.y) {
            for (cell.x = range.low.x; cell.x <= range.high.x; ++cell.x) {
                const bool outermost =
                    grid.clamped(cell - 1) != cell - 1 || grid.clamped(cell + 1) != cell + 1;
                const glm::dvec3 middle = grid.origin + grid.size * (glm::dvec3(cell) + 0.5);
                if (outermost || std::abs(glm::dot(middle - a, normal)) <= half)
                    visit(cell);
            }
        }
    }
}

/// The most cells that one triangle may have, so that all of them are told in time: the same for
/// the same city.
std::int64_t mostCellsOfOne(const CityModel& city, const CellGrid& grid) {
    std::atomic<std::int64_t> all{0};
    parallelFor(0, city.triangles.size(), kGrain, [&](std::size_t first, std::size_t last) {
        std::int64_t sum = 0;
        for (std::size_t t = first; t < last; ++t) {
            if (const auto corners = cornersOf(city, t))
                sum += rangeOf(grid, *corners).count();
        }
        all += sum;
    });
    return all <= kMostVisits ? kMostVisits : kMostVisits / std::int64_t(city.triangles.size());
}

}  // namespace

CellGrid cellsOver(const Box& box) {
    const glm::dvec3 size = box.size();
    const glm::dvec3 low = box.empty() ? glm::dvec3(0.0) : box.min;
    CellGrid grid;
    grid.size = kFinestCell;
    const auto beside = [](double cell) {
        const double cells = std::ceil(AmbientLight::reach() / cell) + 1.0;
        return glm::dvec3(cells, cells, 1.0);
    };
    const auto counts = [&](double cell) {
        return glm::floor(size / cell) + 1.0 + 2.0 * beside(cell);
    };
    const auto cells = [](const glm::dvec3& n) { return n.x * n.y * n.z; };
    while (cells(counts(grid.size)) > double(kMostCells))
        grid.size *= 1.05;
    grid.count = glm::ivec3(counts(grid.size));
    grid.origin = low - grid.size * beside(grid.size);
    return grid;
}

std::uint64_t contentOf(const TextureImage& image, bool repeat) {
    if (image.rgba.empty())
        return 0;
    ContentHash hash;
    hash.add(image.width).add(image.height).add(repeat);
    hash.addBytes(std::as_bytes(std::span(image.rgba)));
    constexpr std::size_t kDigits = 16;
    constexpr int kHexadecimal = 16;
    return std::stoull(hash.hex().substr(0, kDigits), nullptr, kHexadecimal) | 1U;
}

std::vector<std::uint64_t> contentOf(std::span<const TextureImage> images, const CityModel& city) {
    std::vector<std::uint64_t> contents(images.size());
    parallelFor(0, images.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            contents[i] = contentOf(images[i], city.textures[i].repeat);
    });
    return contents;
}

CityContents::CityContents(const CityModel& city, const SurfaceLooks& looks,
                           std::span<const std::uint64_t> textures)
    : m_city(city),
      m_looks(looks),
      m_textures(textures.begin(), textures.end()),
      m_surfaces(city.surfaces.size()) {
    parallelFor(0, m_surfaces.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            m_surfaces[i] = ofSurface(std::uint32_t(i));
    });
}

std::uint64_t CityContents::ofSurface(std::uint32_t surface) const {
    const SurfaceLook& look = m_looks.surface(surface);
    Digest digest;
    digest.add(look.colour).add(look.tint).add(look.emission);
    const std::uint32_t texture = m_city.surfaces[surface].texture;
    const bool textured = texture < m_textures.size() && m_textures[texture] != 0 &&
                          m_city.uv.size() == m_city.triangles.size();
    digest.add(textured ? m_textures[texture] : 0);
    if (!textured) {
        digest.add(std::uint64_t(look.kind));
        addBuilding(digest, look.kind, m_looks.building(look.building));
    }
    const auto [first, last] = m_looks.triangles(surface);
    digest.add(std::uint64_t(look.planar));
    // The lattice of soft light lies in the plane of a whole surface, from its first corner on.
    if (look.planar && first != last) {
        const std::uint32_t anchor = m_city.triangles[*first].vertex[0];
        digest.add(look.normal);
        if (anchor < m_city.vertices.size())
            digest.add(m_city.vertices[anchor]);
    }
    if (look.kind == LookKind::Facade && !textured) {
        digest.add(look.normal).add(look.tangent).add(look.uMin).add(look.width);
        digest.add(look.bottom).add(look.top).add(std::uint64_t(look.rectangular));
        std::uint64_t wall = 0;  // windows stand where the whole wall leaves room for them
        const auto [begin, end] = m_looks.wallTriangles(surface);
        for (const auto* t = begin; !look.rectangular && t != end; ++t) {
            Digest corners;
            eachVertex(m_city, *t, [&](const glm::vec3& p) { corners.add(p); });
            wall += corners.value();
        }
        digest.add(wall);
    }
    return digest.value();
}

std::uint64_t CityContents::ofTriangle(std::size_t triangle) const {
    const std::uint32_t surface = m_city.triangles[triangle].surface;
    Digest digest;
    digest.add(surface < m_surfaces.size() ? m_surfaces[surface] : 0);
    eachVertex(m_city, triangle, [&](const glm::vec3& p) { digest.add(p); });
    if (m_city.uv.size() == m_city.triangles.size()) {
        for (const glm::vec2& uv : m_city.uv[triangle])
            digest.add(uv);
    }
    return digest.value();
}

CellContents CityContents::in(const CellGrid& grid) const {
    std::vector<std::atomic<std::uint64_t>> cells(grid.cells());
    std::atomic<std::uint64_t> everywhere{0};
    const std::int64_t most = mostCellsOfOne(m_city, grid);
    parallelFor(0, m_city.triangles.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t t = first; t < last; ++t) {
            const std::uint64_t content = ofTriangle(t);
            const auto corners = cornersOf(m_city, t);
            const CellRange range = corners ? rangeOf(grid, *corners) : CellRange{};
            if (!corners || range.count() > most) {
                everywhere.fetch_add(content, std::memory_order_relaxed);
                continue;
            }
            eachCell(grid, range, *corners, [&](const glm::ivec3& cell) {
                cells[grid.index(cell)].fetch_add(content, std::memory_order_relaxed);
            });
        }
    });
    return {grid, std::vector<std::uint64_t>(cells.begin(), cells.end()), everywhere};
}

}  // namespace reflet
