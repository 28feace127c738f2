// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/base/GlObjects.h"
#include "core/math/Geometry.h"
#include "core/traffic/Vehicle.h"

#include <map>
#include <memory>
#include <vector>

namespace reflet {

/// A vehicle's bodies on the GPU. Vertex inputs: 0 position, 1 normal (body frame), 2 material.
/// Indices of 32 bits: first the triangles of opaque materials, then those of glass.
struct VehicleMesh {
    struct Body {
        Buffer vertices, indices;
        VertexArray array;
        int opaqueCount = 0;  ///< indices
        int glassCount = 0;   ///< indices, behind the opaque ones
        Box bounds;           ///< body frame
    };
    std::vector<Body> bodies;
    Buffer materialTable;
    /// RGBA32F, three texels a material: base colour and clear coat; emission and metallic; glass.
    Texture materials;
};

/// Uploads a vehicle. Out-of-range material indices count as the first material.
[[nodiscard]] VehicleMesh uploadVehicle(const Vehicle& vehicle);

/// Meshes by vehicle, uploaded once; those unused for a while are dropped.
class VehicleMeshes {
public:
    /// Stays until the next nextFrame() but some.
    [[nodiscard]] const VehicleMesh& of(const std::shared_ptr<const Vehicle>& vehicle);
    void nextFrame();

private:
    struct Entry {
        std::shared_ptr<const Vehicle> vehicle;
        VehicleMesh mesh;
        int idleFrames = 0;
    };
    std::map<const Vehicle*, Entry> m_entries;
};

}  // namespace reflet
