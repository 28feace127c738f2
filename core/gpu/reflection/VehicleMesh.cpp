// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/reflection/VehicleMesh.h"

#include "core/base/ParallelFor.h"
#include "core/gpu/reflection/BodyLevels.h"
#include "core/traffic/Squeeze.h"

#include <epoxy/gl.h>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <unordered_map>

namespace reflet {

namespace {

constexpr int kIdleFrames = 600;

/// Of the levels that are coarser than the exact mesh, metres.
constexpr float kErrors[] = {0.01F, 0.03F, 0.08F, 0.25F, 0.6F};

/// Vertices are shared by triangles of one material only: the material belongs to the vertex here.
class Packer {
public:
    Packer(const Vehicle& vehicle, const VehicleBody& body) : m_vehicle(vehicle), m_body(body) {}

    BodyMesh pack() {
        BodyMesh mesh;
        for (std::size_t t = 0; t < m_body.triangles.size(); ++t) {
            const std::uint32_t material = materialOf(t);
            const bool glass = m_vehicle.materials[material].glass > 0.0F;
            for (int k = 0; k < 3; ++k)
                (glass ? mesh.glass : mesh.opaque)
                    .push_back(indexOf(mesh, m_body.triangles[t][k], material));
        }
        return mesh;
    }

private:
    [[nodiscard]] std::uint32_t materialOf(std::size_t triangle) const {
        const std::uint32_t material =
            triangle < m_body.triangleMaterial.size() ? m_body.triangleMaterial[triangle] : 0U;
        return material < m_vehicle.materials.size() ? material : 0U;
    }

    std::uint32_t indexOf(BodyMesh& mesh, std::uint32_t vertex, std::uint32_t material) {
        const std::uint64_t key = (std::uint64_t(material) << 32U) | vertex;
        const auto [entry, added] = m_known.try_emplace(key, std::uint32_t(mesh.vertices.size()));
        if (added)
            mesh.vertices.push_back({m_body.vertices[vertex], m_body.normals[vertex], material});
        return entry->second;
    }

    const Vehicle& m_vehicle;
    const VehicleBody& m_body;
    std::unordered_map<std::uint64_t, std::uint32_t> m_known;
};

/// Appends a mesh to the vertices and indices of a body.
VehicleMesh::Level append(const BodyMesh& mesh, float error, BodyMesh& all) {
    const auto base = std::uint32_t(all.vertices.size());
    VehicleMesh::Level level{error, int(all.opaque.size()), int(mesh.opaque.size()),
                             int(mesh.glass.size())};
    all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const std::vector<std::uint32_t>* indices : {&mesh.opaque, &mesh.glass}) {
        for (const std::uint32_t index : *indices)
            all.opaque.push_back(base + index);
    }
    return level;
}

/// A body's levels on this side of the GPU.
struct PackedBody {
    std::vector<VehicleMesh::Level> levels;
    BodyMesh all;  ///< every level's triangles, in `opaque`
    double squeeze = 0.0;
};

PackedBody packBody(const Vehicle& vehicle, const VehicleBody& body) {
    PackedBody packed;
    packed.squeeze = squeezeOf(vehicle, body);
    BodyMesh mesh = Packer(vehicle, body).pack();
    packed.levels.push_back(append(mesh, 0.0F, packed.all));
    for (const float error : kErrors) {
        mesh = coarser(mesh, error);
        packed.levels.push_back(append(mesh, error, packed.all));
    }
    return packed;
}

VehicleMesh::Body uploadBody(const VehicleBody& body, const PackedBody& packed) {
    VehicleMesh::Body out;
    out.levels = packed.levels;
    out.squeeze = packed.squeeze;
    const BodyMesh& all = packed.all;
    for (const glm::vec3& v : body.vertices)
        out.bounds.add(glm::dvec3(v));
    out.vertices = Buffer(std::span<const BodyVertex>(all.vertices));
    out.indices = Buffer(std::span<const std::uint32_t>(all.opaque));
    out.array = VertexArray::make();
    out.array.floats(0, 3, out.vertices, sizeof(BodyVertex), offsetof(BodyVertex, position));
    out.array.floats(1, 3, out.vertices, sizeof(BodyVertex), offsetof(BodyVertex, normal));
    out.array.integers(2, 1, out.vertices, sizeof(BodyVertex), offsetof(BodyVertex, material));
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
        std::vector<PackedBody> packed(vehicle.bodies.size());
        parallelFor(0, packed.size(), 1, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                packed[i] = packBody(vehicle, vehicle.bodies[i]);
        });
        for (std::size_t i = 0; i < packed.size(); ++i)
            mesh.bodies.push_back(uploadBody(vehicle.bodies[i], packed[i]));
    }
    return mesh;
}

const VehicleMesh::Level& VehicleMesh::Body::levelWithin(float error) const {
    const auto finer = std::find_if(levels.begin() + 1, levels.end(),
                                    [&](const Level& level) { return level.error > error; });
    return *(finer - 1);
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
