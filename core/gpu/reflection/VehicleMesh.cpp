// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/reflection/VehicleMesh.h"

#include <epoxy/gl.h>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <unordered_map>

namespace reflet {

namespace {

constexpr int kIdleFrames = 600;

struct Vertex {
    glm::vec3 position;
    glm::vec3 normal;
    std::uint32_t material;
};

/// Vertices are shared by triangles of one material only: the material belongs to the vertex here.
class Packer {
public:
    Packer(const Vehicle& vehicle, const VehicleBody& body) : m_vehicle(vehicle), m_body(body) {}

    void addTriangles(bool glass) {
        for (std::size_t t = 0; t < m_body.triangles.size(); ++t) {
            const std::uint32_t material = materialOf(t);
            if ((m_vehicle.materials[material].glass > 0.0F) != glass)
                continue;
            for (int k = 0; k < 3; ++k)
                indices.push_back(indexOf(m_body.triangles[t][k], material));
        }
    }

    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;

private:
    [[nodiscard]] std::uint32_t materialOf(std::size_t triangle) const {
        const std::uint32_t material =
            triangle < m_body.triangleMaterial.size() ? m_body.triangleMaterial[triangle] : 0U;
        return material < m_vehicle.materials.size() ? material : 0U;
    }

    std::uint32_t indexOf(std::uint32_t vertex, std::uint32_t material) {
        const std::uint64_t key = (std::uint64_t(material) << 32U) | vertex;
        const auto [entry, added] = m_known.try_emplace(key, std::uint32_t(vertices.size()));
        if (added)
            vertices.push_back({m_body.vertices[vertex], m_body.normals[vertex], material});
        return entry->second;
    }

    const Vehicle& m_vehicle;
    const VehicleBody& m_body;
    std::unordered_map<std::uint64_t, std::uint32_t> m_known;
};

VehicleMesh::Body uploadBody(const Vehicle& vehicle, const VehicleBody& body) {
    Packer packer(vehicle, body);
    packer.addTriangles(false);
    VehicleMesh::Body out;
    out.opaqueCount = int(packer.indices.size());
    packer.addTriangles(true);
    out.glassCount = int(packer.indices.size()) - out.opaqueCount;
    for (const glm::vec3& v : body.vertices)
        out.bounds.add(glm::dvec3(v));
    out.vertices = Buffer(std::span<const Vertex>(packer.vertices));
    out.indices = Buffer(std::span<const std::uint32_t>(packer.indices));
    out.array = VertexArray::make();
    out.array.floats(0, 3, out.vertices, sizeof(Vertex), offsetof(Vertex, position));
    out.array.floats(1, 3, out.vertices, sizeof(Vertex), offsetof(Vertex, normal));
    out.array.integers(2, 1, out.vertices, sizeof(Vertex), offsetof(Vertex, material));
    out.array.indices(out.indices);
    return out;
}

}  // namespace

VehicleMesh uploadVehicle(const Vehicle& vehicle) {
    VehicleMesh mesh;
    std::vector<glm::vec4> table;
    for (const VehicleMaterial& m : vehicle.materials) {
        table.emplace_back(m.baseColor, m.clearCoat);
        table.emplace_back(m.emission, m.metallic);
        table.emplace_back(m.glass, 0.0F, 0.0F, 0.0F);
    }
    mesh.materialTable = Buffer(std::span<const glm::vec4>(table));
    mesh.materials = Texture::viewOf(GL_RGBA32F, mesh.materialTable);
    if (!vehicle.materials.empty()) {
        for (const VehicleBody& body : vehicle.bodies)
            mesh.bodies.push_back(uploadBody(vehicle, body));
    }
    return mesh;
}

const VehicleMesh& VehicleMeshes::of(const std::shared_ptr<const Vehicle>& vehicle) {
    const auto [entry, added] = m_entries.try_emplace(vehicle.get());
    if (added) {
        entry->second.vehicle = vehicle;
        entry->second.mesh = uploadVehicle(*vehicle);
    }
    entry->second.idleFrames = 0;
    return entry->second.mesh;
}

void VehicleMeshes::nextFrame() {
    for (auto& [vehicle, entry] : m_entries)
        ++entry.idleFrames;
    std::erase_if(m_entries, [](const auto& e) { return e.second.idleFrames > kIdleFrames; });
}

}  // namespace reflet
