// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/city/PartSizes.h"

#include "core/base/ParallelFor.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>

namespace reflet {

namespace {

/// Sets of triangles that merge (Tarjan 1975, with path halving); the first names the set.
class Sets {
public:
    void reset(std::size_t count) {
        m_parent.resize(count);
        std::iota(m_parent.begin(), m_parent.end(), 0U);
    }
    std::uint32_t find(std::uint32_t i) {
        while (m_parent[i] != i) {
            m_parent[i] = m_parent[m_parent[i]];
            i = m_parent[i];
        }
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        m_parent[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<std::uint32_t> m_parent;
};

std::uint64_t mixed(std::uint64_t h) {  // the finaliser of MurmurHash3
    h = (h ^ (h >> 33)) * 0xff51afd7ed558ccdULL;
    h = (h ^ (h >> 33)) * 0xc4ceb9fe1a85ec53ULL;
    return h ^ (h >> 33);
}

/// The first triangle seen for each key; keys are well mixed, so equal ones mean the same corner.
class FirstSeen {
public:
    void reset(std::size_t count) {
        m_mask = std::bit_ceil(2 * count + 2) - 1;
        m_keys.assign(m_mask + 1, 0);
        m_values.resize(m_mask + 1);
    }
    std::uint32_t at(std::uint64_t key, std::uint32_t otherwise) {
        key |= 1U;  // 0 marks free places
        std::size_t place = key >> 1 & m_mask;
        while (m_keys[place] != 0 && m_keys[place] != key) {
            place = (place + 1) & m_mask;
        }
        if (m_keys[place] == 0) {
            m_keys[place] = key;
            m_values[place] = otherwise;
        }
        return m_values[place];
    }

private:
    std::size_t m_mask = 0;
    std::vector<std::uint64_t> m_keys;
    std::vector<std::uint32_t> m_values;
};

bool sound(const CityModel& city, const CityTriangle& t) {
    return std::all_of(t.vertex.begin(), t.vertex.end(), [&](std::uint32_t v) {
        return v < city.vertices.size() && std::isfinite(glm::length(city.vertices[v]));
    });
}

float sizeOf(const Box& box) {
    glm::dvec3 edges = box.size();
    std::sort(&edges.x, &edges.x + 3);
    return float(std::sqrt(edges.z * edges.y));
}

/// The triangles of each object, in their order: those of object n from first[n] to first[n + 1].
/// The last object is that of triangles without one.
struct ByObject {
    std::vector<std::size_t> first;
    std::vector<std::uint32_t> triangles;
};

ByObject groupByObject(const CityModel& city) {
    const std::size_t none = city.objects.size();
    const auto objectOf = [&](const CityTriangle& t) -> std::size_t {
        return t.surface < city.surfaces.size()
                   ? std::min<std::size_t>(city.surfaces[t.surface].object, none)
                   : none;
    };
    ByObject by{std::vector<std::size_t>(none + 2, 0),
                std::vector<std::uint32_t>(city.triangles.size())};
    for (const CityTriangle& t : city.triangles) {
        ++by.first[objectOf(t) + 1];
    }
    for (std::size_t n = 1; n < by.first.size(); ++n) {
        by.first[n] += by.first[n - 1];
    }
    std::vector<std::size_t> next(by.first.begin(), by.first.end() - 1);
    for (std::uint32_t i = 0; i < city.triangles.size(); ++i) {
        by.triangles[next[objectOf(city.triangles[i])]++] = i;
    }
    return by;
}

/// Finds the parts of one object after the other.
class PartFinder {
public:
    PartFinder(const CityModel& city, CityParts& found) : m_city(city), m_found(found) {}

    void find(std::span<const std::uint32_t> triangles) {
        join(triangles);
        measure(triangles);
        for (std::uint32_t n = 0; n < triangles.size(); ++n) {
            const std::uint32_t root = m_sets.find(n);
            m_found.part[triangles[n]] = triangles[root];
            const Box& box = m_bounds[root];
            if (!box.empty()) {
                m_found.size[triangles[n]] = sizeOf(box);
                m_found.center[triangles[n]] = glm::vec3(box.center());
            }
        }
    }

private:
    void join(std::span<const std::uint32_t> triangles) {
        m_sets.reset(triangles.size());
        m_corners.reset(3 * triangles.size());
        for (std::uint32_t n = 0; n < triangles.size(); ++n) {
            const CityTriangle& t = m_city.triangles[triangles[n]];
            if (!sound(m_city, t)) {
                continue;
            }
            for (const std::uint32_t v : t.vertex) {
                const glm::vec3 p = m_city.vertices[v] + 0.0F;  // -0 becomes 0
                const std::uint64_t key = mixed(std::bit_cast<std::uint32_t>(p.x));
                m_sets.join(
                    n, m_corners.at(
                           mixed(key ^ (std::uint64_t(std::bit_cast<std::uint32_t>(p.y)) << 32 |
                                        std::bit_cast<std::uint32_t>(p.z))),
                           n));
            }
        }
    }

    void measure(std::span<const std::uint32_t> triangles) {
        m_bounds.assign(triangles.size(), Box());
        for (std::uint32_t n = 0; n < triangles.size(); ++n) {
            const CityTriangle& t = m_city.triangles[triangles[n]];
            if (!sound(m_city, t)) {
                continue;
            }
            for (const std::uint32_t v : t.vertex) {
                m_bounds[m_sets.find(n)].add(glm::dvec3(m_city.vertices[v]));
            }
        }
    }

    const CityModel& m_city;
    CityParts& m_found;
    Sets m_sets;
    FirstSeen m_corners;
    std::vector<Box> m_bounds;
};

}  // namespace

CityParts cityParts(const CityModel& city) {
    const std::size_t count = city.triangles.size();
    CityParts found{std::vector<float>(count, 0.0F), std::vector<std::uint32_t>(count),
                    std::vector<glm::vec3>(count, glm::vec3(0.0F))};
    const ByObject by = groupByObject(city);
    constexpr std::size_t kGrain = 64;
    parallelFor(0, by.first.size() - 1, kGrain, [&](std::size_t first, std::size_t last) {
        PartFinder finder(city, found);
        for (std::size_t object = first; object < last; ++object) {
            finder.find(std::span(by.triangles)
                            .subspan(by.first[object], by.first[object + 1] - by.first[object]));
        }
    });
    return found;
}

std::vector<float> partSizes(const CityModel& city) {
    return cityParts(city).size;
}

}  // namespace reflet
