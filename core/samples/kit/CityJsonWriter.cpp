// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/samples/kit/CityJsonWriter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <unordered_map>

namespace reflet::kit {

namespace {

struct PointHash {
    std::size_t operator()(const glm::ivec3& p) const {
        const auto mix = [](std::uint64_t h, int v) {
            return (h ^ std::uint32_t(v)) * 0x9e3779b97f4a7c15ULL;
        };
        const std::uint64_t h = mix(mix(mix(0x243f6a8885a308d3ULL, p.x), p.y), p.z);
        return std::size_t(h ^ (h >> 29U));
    }
};

/// Points numbered in the order in which they are first asked for.
class PointTable {
public:
    std::uint32_t index(const glm::ivec3& p) {
        const auto [place, isNew] = m_index.try_emplace(p, std::uint32_t(m_points.size()));
        if (isNew) {
            m_points.push_back(p);
        }
        return place->second;
    }
    [[nodiscard]] const std::vector<glm::ivec3>& points() const { return m_points; }

private:
    std::unordered_map<glm::ivec3, std::uint32_t, PointHash> m_index;
    std::vector<glm::ivec3> m_points;
};

using Text = fmt::memory_buffer;

template <class... Args>
void put(Text& text, fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
}

/// The materials that a city uses, numbered in the palette's order.
class MaterialTable {
public:
    explicit MaterialTable(const SampleCity& city) {
        std::array<bool, kPaintCount> used{};
        const auto mark = [&](const Mesh& mesh) {
            for (const MeshFace& face : mesh.faces()) {
                if (face.skin.paint != Paint::None) {
                    used[std::size_t(face.skin.paint)] = true;
                }
            }
        };
        for (const SampleObject& object : city.objects) {
            mark(object.mesh);
        }
        std::for_each(city.templates.begin(), city.templates.end(), mark);
        for (std::size_t i = 0; i < kPaintCount; ++i) {
            if (used[i]) {
                m_number[i] = m_paints.size();
                m_paints.push_back(Paint(i));
            }
        }
    }
    [[nodiscard]] std::size_t number(Paint paint) const { return m_number[std::size_t(paint)]; }

    void write(Text& text) const {
        put(text, "\"appearance\":{{\"materials\":[");
        for (std::size_t i = 0; i < m_paints.size(); ++i) {
            const PaintRecord& record = paintRecord(m_paints[i]);
            const auto channel = [&](unsigned shift) {
                return double((record.srgb >> shift) & 0xffU) / 255.0;
            };
            const double r = channel(16), g = channel(8), b = channel(0);
            put(text, "{}{{\"name\":\"{}\",\"diffuseColor\":[{:.4f},{:.4f},{:.4f}]",
                i == 0 ? "" : ",\n", record.name, r, g, b);
            if (record.emission > 0.0) {
                const double e = record.emission;
                put(text, ",\"emissiveColor\":[{:.4f},{:.4f},{:.4f}]", e * r, e * g, e * b);
            }
            put(text, "}}");
        }
        put(text, "]}},\n");
    }

private:
    std::array<std::size_t, kPaintCount> m_number{};
    std::vector<Paint> m_paints;
};

void writeBoundaries(Text& text, const Mesh& mesh, PointTable& table) {
    put(text, "\"boundaries\":[");
    for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
        const MeshFace& face = mesh.faces()[f];
        put(text, "{}[[", f == 0 ? "" : ",");
        for (std::uint32_t k = 0; k < face.count; ++k) {
            put(text, "{}{}", k == 0 ? "" : ",", table.index(mesh.points()[face.first + k]));
        }
        put(text, "]]");
    }
    put(text, "]");
}

void writeSemantics(Text& text, const Mesh& mesh) {
    std::vector<SurfaceType> kinds;
    std::vector<std::optional<std::size_t>> values;
    for (const MeshFace& face : mesh.faces()) {
        const SurfaceType kind = face.skin.surface;
        if (kind == SurfaceType::Unknown) {
            values.emplace_back();
            continue;
        }
        const auto place = std::find(kinds.begin(), kinds.end(), kind);
        values.emplace_back(std::size_t(place - kinds.begin()));
        if (place == kinds.end()) {
            kinds.push_back(kind);
        }
    }
    if (kinds.empty()) {
        return;
    }
    put(text, ",\"semantics\":{{\"surfaces\":[");
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        put(text, "{}{{\"type\":\"{}\"}}", i == 0 ? "" : ",", toString(kinds[i]));
    }
    put(text, "],\"values\":[");
    for (std::size_t i = 0; i < values.size(); ++i) {
        put(text, "{}{}", i == 0 ? "" : ",", values[i] ? fmt::to_string(*values[i]) : "null");
    }
    put(text, "]}}");
}

void writeMaterials(Text& text, const Mesh& mesh, const MaterialTable& materials) {
    put(text, ",\"material\":{{\"reflet\":{{\"values\":[");
    for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
        const Paint paint = mesh.faces()[f].skin.paint;
        put(text, "{}{}", f == 0 ? "" : ",",
            paint == Paint::None ? "null" : fmt::to_string(materials.number(paint)));
    }
    put(text, "]}}}}");
}

void writeGeometry(Text& text, const Mesh& mesh, CityObjectType type, PointTable& table,
                   const MaterialTable& materials) {
    // The schema asks for a composite surface of the terrain, and allows a multi-surface elsewhere.
    const char* kind = type == CityObjectType::TinRelief ? "CompositeSurface" : "MultiSurface";
    put(text, "{{\"type\":\"{}\",\"lod\":\"3\",", kind);
    writeBoundaries(text, mesh, table);
    writeSemantics(text, mesh);
    writeMaterials(text, mesh, materials);
    put(text, "}}");
}

void writePlacement(Text& text, const Placement& placement, PointTable& table) {
    const double c = placement.scale * std::cos(placement.heading);
    const double s = placement.scale * std::sin(placement.heading);
    put(text,
        "{{\"type\":\"GeometryInstance\",\"template\":{},\"boundaries\":[{}],"
        "\"transformationMatrix\":"
        "[{:.6f},{:.6f},0.0,0.0,{:.6f},{:.6f},0.0,0.0,0.0,0.0,{:.6f},0.0,0.0,0.0,0.0,1.0]}}",
        placement.shape, table.index(glm::ivec3(glm::round(placement.anchor * 1000.0))), c, -s, s,
        c, placement.scale);
}

void writeObjects(Text& text, const SampleCity& city, PointTable& table,
                  const MaterialTable& materials) {
    put(text, "\"CityObjects\":{{\n");
    for (std::size_t i = 0; i < city.objects.size(); ++i) {
        const SampleObject& object = city.objects[i];
        put(text, "{}\"{}\":{{\"type\":\"{}\",\"geometry\":[", i == 0 ? "" : ",\n", object.id,
            toString(object.type));
        const bool hasMesh = !object.mesh.faces().empty();
        if (hasMesh) {
            writeGeometry(text, object.mesh, object.type, table, materials);
        }
        for (std::size_t k = 0; k < object.placements.size(); ++k) {
            put(text, "{}", k == 0 && !hasMesh ? "" : ",");
            writePlacement(text, object.placements[k], table);
        }
        put(text, "]}}");
    }
    put(text, "\n}},\n");
}

void writeTemplates(Text& text, const SampleCity& city, const MaterialTable& materials) {
    if (city.templates.empty()) {
        return;
    }
    PointTable table;
    put(text, "\"geometry-templates\":{{\"templates\":[\n");
    for (std::size_t i = 0; i < city.templates.size(); ++i) {
        put(text, "{}", i == 0 ? "" : ",\n");
        writeGeometry(text, city.templates[i], CityObjectType::Generic, table, materials);
    }
    put(text, "],\n\"vertices-templates\":[");
    for (std::size_t i = 0; i < table.points().size(); ++i) {
        const glm::dvec3 p = glm::dvec3(table.points()[i]) * 0.001;
        put(text, "{}[{:.3f},{:.3f},{:.3f}]", i == 0 ? "" : ",", p.x, p.y, p.z);
    }
    put(text, "]}},\n");
}

void writeVertices(Text& text, const PointTable& table) {
    put(text, "\"vertices\":[");
    for (std::size_t i = 0; i < table.points().size(); ++i) {
        const glm::ivec3& p = table.points()[i];
        put(text, "{}[{},{},{}]", i == 0 ? "" : ",", p.x, p.y, p.z);
    }
    put(text, "]");
}

}  // namespace

std::string writeCityJson(const SampleCity& city, const SamplePlace& place) {
    Text objects;
    PointTable table;
    const MaterialTable materials(city);
    writeObjects(objects, city, table, materials);

    glm::ivec3 low(table.points().empty() ? glm::ivec3(0) : table.points().front());
    glm::ivec3 high = low;
    for (const glm::ivec3& p : table.points()) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::dvec3 least = place.origin + glm::dvec3(low) * 0.001;
    const glm::dvec3 most = place.origin + glm::dvec3(high) * 0.001;

    Text text;
    put(text,
        "{{\"type\":\"CityJSON\",\"version\":\"2.0\",\n\"transform\":{{\"scale\":[0.001,0.001,0."
        "001],"
        "\"translate\":[{:.3f},{:.3f},{:.3f}]}},\n\"metadata\":{{\"title\":\"{}\","
        "\"geographicalExtent\":[{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f}]",
        place.origin.x, place.origin.y, place.origin.z, city.title, least.x, least.y, least.z,
        most.x, most.y, most.z);
    if (!place.referenceSystem.empty()) {
        put(text, ",\"referenceSystem\":\"{}\"", place.referenceSystem);
    }
    put(text, "}},\n");
    materials.write(text);
    writeTemplates(text, city, materials);
    text.append(objects);
    writeVertices(text, table);
    put(text, "}}\n");
    return fmt::to_string(text);
}

}  // namespace reflet::kit
