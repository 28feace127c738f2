// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/city/CityModel.h"

#include "core/base/ParallelFor.h"

#include <cassert>
#include <limits>
#include <mutex>

namespace reflet {

const char* toString(CityObjectType type) {
    switch (type) {
        case CityObjectType::Building:
            return "Building";
        case CityObjectType::BuildingPart:
            return "BuildingPart";
        case CityObjectType::BuildingInstallation:
            return "BuildingInstallation";
        case CityObjectType::Bridge:
            return "Bridge";
        case CityObjectType::BridgePart:
            return "BridgePart";
        case CityObjectType::Tunnel:
            return "Tunnel";
        case CityObjectType::Road:
            return "Road";
        case CityObjectType::Railway:
            return "Railway";
        case CityObjectType::TransportSquare:
            return "TransportSquare";
        case CityObjectType::LandUse:
            return "LandUse";
        case CityObjectType::TinRelief:
            return "TINRelief";
        case CityObjectType::WaterBody:
            return "WaterBody";
        case CityObjectType::PlantCover:
            return "PlantCover";
        case CityObjectType::SolitaryVegetation:
            return "SolitaryVegetationObject";
        case CityObjectType::CityFurniture:
            return "CityFurniture";
        case CityObjectType::OtherConstruction:
            return "OtherConstruction";
        case CityObjectType::Generic:
            return "GenericCityObject";
        case CityObjectType::Group:
            return "CityObjectGroup";
        case CityObjectType::Other:
            break;
    }
    return "Other";
}

const char* toString(SurfaceType type) {
    switch (type) {
        case SurfaceType::Unknown:
            return "Unknown";
        case SurfaceType::Ground:
            return "GroundSurface";
        case SurfaceType::Wall:
            return "WallSurface";
        case SurfaceType::Roof:
            return "RoofSurface";
        case SurfaceType::Window:
            return "Window";
        case SurfaceType::Door:
            return "Door";
        case SurfaceType::Closure:
            return "ClosureSurface";
        case SurfaceType::OuterCeiling:
            return "OuterCeilingSurface";
        case SurfaceType::OuterFloor:
            return "OuterFloorSurface";
        case SurfaceType::InteriorWall:
            return "InteriorWallSurface";
        case SurfaceType::TrafficArea:
            return "TrafficArea";
        case SurfaceType::AuxiliaryTrafficArea:
            return "AuxiliaryTrafficArea";
        case SurfaceType::Water:
            return "WaterSurface";
        case SurfaceType::Other:
            break;
    }
    return "Other";
}

bool isTerrain(CityObjectType type) {
    switch (type) {
        case CityObjectType::TinRelief:
        case CityObjectType::Road:
        case CityObjectType::Railway:
        case CityObjectType::TransportSquare:
        case CityObjectType::LandUse:
        case CityObjectType::WaterBody:
        case CityObjectType::PlantCover:
            return true;
        default:
            return false;
    }
}

Box CityModel::bounds() const {
    constexpr std::size_t kGrain = 1U << 15U;
    std::mutex mutex;
    Box box;
    parallelFor(0, triangles.size(), kGrain, [&](std::size_t first, std::size_t last) {
        // In float, which is as exact: a walk over all triangles is often asked for.
        glm::vec3 low(std::numeric_limits<float>::infinity());
        glm::vec3 high = -low;
        for (std::size_t n = first; n < last; ++n) {
            for (const std::uint32_t v : triangles[n].vertex) {
                low = glm::min(low, vertices[v]);
                high = glm::max(high, vertices[v]);
            }
        }
        const std::scoped_lock lock(mutex);
        box.add(Box{glm::dvec3(low), glm::dvec3(high)});
    });
    return box;
}

glm::vec3 CityModel::normal(std::size_t triangle) const {
    const auto& [a, b, c] = triangles[triangle].vertex;
    // In double: a float cross product of a thin sliver is mostly rounding error.
    const glm::dvec3 origin(vertices[a]);
    const glm::dvec3 cross =
        glm::cross(glm::dvec3(vertices[b]) - origin, glm::dvec3(vertices[c]) - origin);
    const double length = glm::length(cross);
    return length > 0.0 ? glm::vec3(cross / length) : glm::vec3(0.0F);
}

namespace {

std::uint32_t shifted(std::uint32_t index, std::size_t by) {
    return index == kNone ? kNone : index + std::uint32_t(by);
}

void appendTriangles(CityModel& model, const CityModel& other, std::size_t firstVertex,
                     std::size_t firstSurface) {
    if (!model.uv.empty() || !other.uv.empty()) {
        model.uv.resize(model.triangles.size());
        model.uv.insert(model.uv.end(), other.uv.begin(), other.uv.end());
        model.uv.resize(model.triangles.size() + other.triangles.size());
    }
    model.triangles.reserve(model.triangles.size() + other.triangles.size());
    for (CityTriangle triangle : other.triangles) {
        for (std::uint32_t& v : triangle.vertex)
            v += std::uint32_t(firstVertex);
        triangle.surface += std::uint32_t(firstSurface);
        model.triangles.push_back(triangle);
    }
}

}  // namespace

void append(CityModel& model, const CityModel& other) {
    assert(model.frame.origin == other.frame.origin);  // names of the same CRS may differ
    assert(&model != &other);
    const std::size_t firstObject = model.objects.size();
    const std::size_t firstSurface = model.surfaces.size();
    const std::size_t firstMaterial = model.materials.size();
    const std::size_t firstTexture = model.textures.size();
    const std::size_t firstVertex = model.vertices.size();

    for (CityObject object : other.objects) {
        if (object.parent)
            object.parent = *object.parent + std::uint32_t(firstObject);
        model.objects.push_back(std::move(object));
    }
    for (CitySurface surface : other.surfaces) {
        surface.object += std::uint32_t(firstObject);
        surface.material = shifted(surface.material, firstMaterial);
        surface.texture = shifted(surface.texture, firstTexture);
        model.surfaces.push_back(surface);
    }
    model.materials.insert(model.materials.end(), other.materials.begin(), other.materials.end());
    model.textures.insert(model.textures.end(), other.textures.begin(), other.textures.end());
    model.vertices.insert(model.vertices.end(), other.vertices.begin(), other.vertices.end());
    appendTriangles(model, other, firstVertex, firstSurface);
}

}  // namespace reflet
