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
/// Indices of 32 bits. Each body has several levels of detail, the exact mesh first.
struct VehicleMesh {
    /// A range of the indices: first the triangles of opaque materials, then those of glass.
    struct Level {
        float error = 0.0F;  ///< metres by which surfaces may lie elsewhere, about
        int first = 0;
        int opaqueCount = 0;
        int glassCount = 0;
        [[nodiscard]] int count() const { return opaqueCount + glassCount; }
    };
    struct Body {
        Buffer vertices, indices;
        VertexArray array;
        std::vector<Level> levels;  ///< at least one; errors rise
        Box bounds;                 ///< body frame
        double squeeze = 0.0;       ///< squeezeOf()
        /// The coarsest level with no more than this error, metres; the exact one at least.
        [[nodiscard]] const Level& levelWithin(float error) const;
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
