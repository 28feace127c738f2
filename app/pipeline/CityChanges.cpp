// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/CityChanges.h"

#include "core/base/HashMix.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <tuple>

namespace reflet {

namespace {

std::uint64_t hashed(double value, double perUnit) {
    return mixed(std::bit_cast<std::uint64_t>(std::round(value * perUnit) + 0.0));
}

std::uint64_t hashed(const std::string& text) {
    return mixed(std::hash<std::string>{}(text));
}

/// A point in whole millimetres.
using Corner = std::array<std::int64_t, 3>;

Corner cornerOf(const glm::vec3& p) {
    constexpr double kPerMetre = 1e3;
    return {std::llround(double(p.x) * kPerMetre), std::llround(double(p.y) * kPerMetre),
            std::llround(double(p.z) * kPerMetre)};
}

/// What can be told of an object apart from its id; sums, so that no order matters.
struct Signature {
    std::uint64_t geometry = 0;
    std::uint64_t appearance = 0;
    std::uint64_t description = 0;
    std::string type;
    Box box;
};

class Signatures {
public:
    explicit Signatures(const CityModel& city) : m_city(city) {
        for (const CityObject& object : city.objects) {
            Signature& of = m_signatures[object.id];
            of.type = object.typeName;
            of.description += joined(hashed(object.typeName),
                                     object.parent ? hashed(city.objects[*object.parent].id) : 0);
            of.geometry += hashed(object.lod);
        }
        // The triangles of a surface lie one behind the other.
        for (std::size_t t = 0; t < city.triangles.size();) {
            std::size_t end = t + 1;
            while (end < city.triangles.size() &&
                   city.triangles[end].surface == city.triangles[t].surface)
                ++end;
            addSurface(t, end);
            t = end;
        }
    }
    [[nodiscard]] const std::map<std::string, Signature>& all() const { return m_signatures; }

private:
    void addSurface(std::size_t first, std::size_t end) {
        constexpr double kPerSquareMetre = 1e2;
        const CitySurface& surface = m_city.surfaces[m_city.triangles[first].surface];
        Signature& of = m_signatures[m_city.objects[surface.object].id];
        m_corners.clear();
        double area = 0.0;
        for (std::size_t t = first; t < end; ++t) {
            std::array<glm::dvec3, 3> p;
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::vec3& v = m_city.vertices[m_city.triangles[t].vertex[k]];
                m_corners.push_back(cornerOf(v));
                p[k] = glm::dvec3(v);
                of.box.add(p[k]);
            }
            area += 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
        }
        std::sort(m_corners.begin(), m_corners.end());
        m_corners.erase(std::unique(m_corners.begin(), m_corners.end()), m_corners.end());
        std::uint64_t shape = hashed(area, kPerSquareMetre);
        for (const Corner& corner : m_corners) {
            for (const std::int64_t c : corner)
                shape = joined(shape, std::uint64_t(c));
        }
        of.geometry += shape;
        of.appearance += joined(shape, lookOf(surface));
    }

    [[nodiscard]] std::uint64_t lookOf(const CitySurface& surface) const {
        std::uint64_t look = mixed(std::uint64_t(surface.type));
        if (surface.texture != kNone)
            look = joined(look, hashed(m_city.textures[surface.texture].reference));
        if (surface.material == kNone)
            return look;
        constexpr double kFine = 1e4;
        const CityMaterial& m = m_city.materials[surface.material];
        for (const float value :
             {m.diffuse.x, m.diffuse.y, m.diffuse.z, m.tint.x, m.tint.y, m.tint.z, m.emission.x,
              m.emission.y, m.emission.z, m.shininess, m.transparency})
            look = joined(look, hashed(double(value), kFine));
        return look;
    }

    const CityModel& m_city;
    std::map<std::string, Signature> m_signatures;
    std::vector<Corner> m_corners;
};

}  // namespace

const char* toString(ObjectChange::Kind kind) {
    switch (kind) {
        case ObjectChange::Kind::Added:
            return "added";
        case ObjectChange::Kind::Removed:
            return "removed";
        case ObjectChange::Kind::Changed:
            break;
    }
    return "changed";
}

std::size_t CityChanges::count(ObjectChange::Kind kind) const {
    return std::size_t(std::count_if(objects.begin(), objects.end(),
                                     [&](const ObjectChange& c) { return c.kind == kind; }));
}

void CityChanges::sort() {
    std::sort(objects.begin(), objects.end(), [](const ObjectChange& a, const ObjectChange& b) {
        return std::tie(a.kind, a.id) < std::tie(b.kind, b.id);
    });
}

CityChanges changesBetween(const CityModel& before, const CityModel& after) {
    using enum ObjectChange::Kind;
    const Signatures old(before), now(after);
    CityChanges changes;
    for (const auto& [id, is] : now.all()) {
        const auto found = old.all().find(id);
        if (found == old.all().end()) {
            changes.objects.push_back({Added, id, is.type, false, false, false, false, {}, is.box});
            continue;
        }
        ++changes.common;
        const Signature& was = found->second;
        ObjectChange change{Changed, id,
                            is.type, was.geometry != is.geometry,
                            false,   was.description != is.description,
                            false,   was.box,
                            is.box};
        // Another shape has other surfaces: their looks cannot be compared.
        change.appearance = !change.geometry && was.appearance != is.appearance;
        if (change.geometry || change.appearance || change.description)
            changes.objects.push_back(std::move(change));
        else
            ++changes.unchanged;
    }
    for (const auto& [id, was] : old.all()) {
        if (!now.all().contains(id))
            changes.objects.push_back(
                {Removed, id, was.type, false, false, false, false, was.box, {}});
    }
    changes.sort();
    return changes;
}

}  // namespace reflet
