// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/city/PartSizes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace reflet {

namespace {

/// Sets of triangles that merge (Tarjan 1975, with path halving).
class Sets {
public:
    explicit Sets(std::size_t count) : m_parent(count) {
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
    explicit FirstSeen(std::size_t count)
        : m_mask(std::bit_ceil(2 * count + 2) - 1), m_keys(m_mask + 1), m_values(m_mask + 1) {}
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
    std::size_t m_mask;
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

}  // namespace

CityParts cityParts(const CityModel& city) {
    const std::size_t count = city.triangles.size();
    Sets parts(count);
    FirstSeen corners(3 * count);
    // Most vertices belong to one object: they are looked for among the positions once.
    struct Use {
        std::uint64_t object = ~std::uint64_t(0);
        std::uint32_t triangle = 0;
    };
    std::vector<Use> uses(city.vertices.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        const CityTriangle& t = city.triangles[i];
        if (!sound(city, t)) {
            continue;
        }
        const std::uint64_t object =
            t.surface < city.surfaces.size() ? city.surfaces[t.surface].object : kNone;
        for (const std::uint32_t v : t.vertex) {
            if (uses[v].object == object) {
                parts.join(i, uses[v].triangle);
                continue;
            }
            uses[v] = {object, i};
            const glm::vec3 p = city.vertices[v] + 0.0F;  // -0 becomes 0
            std::uint64_t key = mixed(object << 32 | std::bit_cast<std::uint32_t>(p.x));
            key = mixed(key ^ (std::uint64_t(std::bit_cast<std::uint32_t>(p.y)) << 32 |
                               std::bit_cast<std::uint32_t>(p.z)));
            parts.join(i, corners.at(key, i));
        }
    }
    std::vector<Box> bounds(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        if (sound(city, city.triangles[i])) {
            for (const std::uint32_t v : city.triangles[i].vertex) {
                bounds[parts.find(i)].add(glm::dvec3(city.vertices[v]));
            }
        }
    }
    CityParts found{std::vector<float>(count, 0.0F), std::vector<std::uint32_t>(count),
                    std::vector<glm::vec3>(count, glm::vec3(0.0F))};
    for (std::uint32_t i = 0; i < count; ++i) {
        found.part[i] = parts.find(i);
        const Box& box = bounds[found.part[i]];
        if (!box.empty()) {
            found.size[i] = sizeOf(box);
            found.center[i] = glm::vec3(box.center());
        }
    }
    return found;
}

std::vector<float> partSizes(const CityModel& city) {
    return cityParts(city).size;
}

}  // namespace reflet
