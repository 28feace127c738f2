// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/RayScene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

namespace reflet {

struct RayScene::Handles {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::shared_ptr<const RayScene> city;  ///< the city alone, of which `scene` has an instance

    Handles() = default;
    Handles(const Handles&) = delete;
    Handles& operator=(const Handles&) = delete;
    /// An empty scene of the device.
    void openScene();
    /// Builds its BVH.
    [[nodiscard]] Result<void> commit(const JobContext& job) const;
    /// Embree 3.13.5 never returns from some coherent packets of shadow rays into an instance
    /// (seen on AVX-512), so that scenes with one go without the coherent traversal.
    [[nodiscard]] RTCIntersectContextFlags packetFlags() const {
        return city == nullptr ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                               : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    }

    ~Handles() {
        if (scene != nullptr) {
            rtcReleaseScene(scene);
        }
        if (device != nullptr) {
            rtcReleaseDevice(device);
        }
    }
};

namespace {

constexpr unsigned kCityGeometry = 0;
constexpr std::size_t kPacket = 16;

bool finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Copies a mesh into buffers of Embree's own (padded as it needs them). A triangle with an index
/// out of range or a vertex that is not finite becomes a point at vertex 0, which no ray meets.
template <class TriangleAt>
bool attachMesh(RTCDevice device, RTCScene scene, unsigned id, std::span<const glm::vec3> vertices,
                std::size_t triangles, const TriangleAt& triangleAt) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), std::max<std::size_t>(vertices.size(), 1)));
    auto* indices = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(unsigned), std::max<std::size_t>(triangles, 1)));
    const bool allocated = positions != nullptr && indices != nullptr;
    if (allocated) {
        std::fill_n(positions, 3, 0.0F);
        std::fill_n(indices, 3, 0U);
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const glm::vec3 p = finite(vertices[i]) ? vertices[i] : glm::vec3(0.0F);
            std::memcpy(positions + 3 * i, &p, sizeof(p));
        }
        for (std::size_t i = 0; i < triangles; ++i) {
            const glm::uvec3 t = triangleAt(i);
            const bool sound = t.x < vertices.size() && t.y < vertices.size() &&
                               t.z < vertices.size() && finite(vertices[t.x]) &&
                               finite(vertices[t.y]) && finite(vertices[t.z]);
            const glm::uvec3 kept = sound ? t : glm::uvec3(0U);
            std::memcpy(indices + 3 * i, &kept, sizeof(kept));
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene, geometry, id);
    }
    rtcReleaseGeometry(geometry);
    return allocated;
}

bool continueBuild(void* job, double fraction) {
    static_cast<const JobContext*>(job)->progress(fraction);
    return !static_cast<const JobContext*>(job)->cancelled();
}

Error buildError(RTCError code) {
    if (code == RTC_ERROR_CANCELLED) {
        return JobContext::cancelledError();
    }
    if (code == RTC_ERROR_OUT_OF_MEMORY) {
        return {ErrorCode::ResourceLimit,
                "There is not enough memory for the ray tracing structure of the city",
                {},
                "Import a smaller area or fewer levels of detail.",
                {}};
    }
    return {
        ErrorCode::Internal,
        "Embree refused to build the ray tracing structure (error " + std::to_string(code) + ")",
        {},
        {},
        {}};
}

SceneHit sceneHit(unsigned geometry, unsigned primitive, float distance, float u, float v) {
    SceneHit hit;
    hit.distance = kInfinity;
    if (geometry == RTC_INVALID_GEOMETRY_ID) {
        return hit;
    }
    hit.distance = distance;
    hit.barycentric = {u, v};
    if (geometry == kCityGeometry) {
        hit.triangle = primitive;
    } else {
        hit.occluder = geometry - 1;
        hit.occluderTriangle = primitive;
    }
    return hit;
}

/// Fills the rays [first, first + count) of a packet; the rest are inactive.
template <class Packet>
void fillPacket(Packet& ray, std::array<int, kPacket>& active, std::span<const glm::vec3> origins,
                std::span<const glm::vec3> directions, std::size_t first, std::size_t count) {
    for (std::size_t i = 0; i < kPacket; ++i) {
        const std::size_t k = first + std::min(i, count - 1);
        active[i] = i < count ? -1 : 0;
        ray.org_x[i] = origins[k].x;
        ray.org_y[i] = origins[k].y;
        ray.org_z[i] = origins[k].z;
        ray.dir_x[i] = directions[k].x;
        ray.dir_y[i] = directions[k].y;
        ray.dir_z[i] = directions[k].z;
        ray.tnear[i] = 0.0F;
        ray.time[i] = 0.0F;
        ray.mask[i] = 0xffffffffU;
        ray.id[i] = unsigned(i);
        ray.flags[i] = 0;
    }
}

RTCRay singleRay(const glm::vec3& origin, const glm::vec3& direction, float distance) {
    RTCRay ray{};
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tfar = distance;
    ray.mask = 0xffffffffU;
    return ray;
}

/// Sets all of a packet of `n` rays but their directions and their ends.
template <std::size_t n, class Packet>
void beginBundle(Packet& query, std::array<int, n>& active, const glm::vec3& origin) {
    std::memset(&query, 0, sizeof(query));
    active.fill(-1);
    std::fill_n(query.ray.org_x, n, origin.x);
    std::fill_n(query.ray.org_y, n, origin.y);
    std::fill_n(query.ray.org_z, n, origin.z);
    std::fill_n(query.ray.mask, n, 0xffffffffU);
    std::fill_n(query.hit.instID[0], n, RTC_INVALID_GEOMETRY_ID);
}

/// Traces the rays of a bundle, `n` at a time.
template <std::size_t n, class Packet, class Intersect>
void intersectBundle(const RayBundle& rays, std::span<float> t, const Intersect& intersect) {
    Packet query;
    alignas(64) std::array<int, n> active{};
    beginBundle<n>(query, active, rays.origin);
    for (std::size_t first = 0; first < rays.x.size(); first += n) {
        const std::size_t count = std::min(n, rays.x.size() - first);
        if (count < n)
            std::fill(active.begin() + std::ptrdiff_t(count), active.end(), 0);
        std::copy_n(rays.x.begin() + std::ptrdiff_t(first), count, query.ray.dir_x);
        std::copy_n(rays.y.begin() + std::ptrdiff_t(first), count, query.ray.dir_y);
        std::copy_n(rays.z.begin() + std::ptrdiff_t(first), count, query.ray.dir_z);
        std::fill_n(query.ray.tfar, n, kInfinity);
        std::fill_n(query.hit.geomID, n, RTC_INVALID_GEOMETRY_ID);
        intersect(active.data(), query);
        std::copy_n(query.ray.tfar, count, t.begin() + std::ptrdiff_t(first));
    }
}

/// Tells each hit of a ray to a visitor and lets the ray go on.
struct CrossingContext {
    RTCIntersectContext context;  // must come first: Embree hands back a pointer to it
    const std::function<void(std::uint32_t, float)>* visit;
};

void reportCrossing(const RTCFilterFunctionNArguments* arguments) {
    assert(arguments->N == 1);
    arguments->valid[0] = 0;
    if (RTCHitN_geomID(arguments->hit, 1, 0) == kCityGeometry) {
        const auto* crossing = reinterpret_cast<const CrossingContext*>(arguments->context);
        (*crossing->visit)(RTCHitN_primID(arguments->hit, 1, 0),
                           RTCRayN_tfar(arguments->ray, 1, 0));
    }
}

}  // namespace

RayScene::RayScene(std::unique_ptr<Handles> handles) : m_handles(std::move(handles)) {}
RayScene::~RayScene() = default;

void RayScene::Handles::openScene() {
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene,
                     RTCSceneFlags(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
}

Result<void> RayScene::Handles::commit(const JobContext& job) const {
    JobContext shared = job;
    rtcSetSceneProgressMonitorFunction(scene, continueBuild, &shared);
    rtcCommitScene(scene);
    rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
    if (const RTCError code = rtcGetDeviceError(device); code != RTC_ERROR_NONE) {
        return tl::unexpected(buildError(code));
    }
    if (job.cancelled()) {
        return tl::unexpected(JobContext::cancelledError());
    }
    return {};
}

Result<std::unique_ptr<RayScene>> RayScene::build(const CityModel& city,
                                                  std::span<const Occluder> occluders,
                                                  const JobContext& job) {
    auto handles = std::make_unique<Handles>();
    handles->device = rtcNewDevice(nullptr);
    if (handles->device == nullptr) {
        return tl::unexpected(buildError(rtcGetDeviceError(nullptr)));
    }
    handles->openScene();
    const bool allocated = attachMesh(handles->device, handles->scene, kCityGeometry, city.vertices,
                                      city.triangles.size(), [&](std::size_t i) {
                                          const auto& v = city.triangles[i].vertex;
                                          return glm::uvec3(v[0], v[1], v[2]);
                                      });
    if (!allocated) {
        return tl::unexpected(buildError(RTC_ERROR_OUT_OF_MEMORY));
    }
    if (auto committed = handles->commit(job); !committed) {
        return tl::unexpected(committed.error());
    }
    std::unique_ptr<RayScene> scene(new RayScene(std::move(handles)));
    return occluders.empty() ? std::move(scene) : withOccluders(std::move(scene), occluders, job);
}

Result<std::unique_ptr<RayScene>> RayScene::withOccluders(std::shared_ptr<const RayScene> city,
                                                          std::span<const Occluder> occluders,
                                                          const JobContext& job) {
    if (city->m_handles->city != nullptr) {
        city = city->m_handles->city;
    }
    // An instance of its own device: Embree shares scenes within a device only. Hits in the
    // instance report the city's geometry number, those of occluders follow it.
    auto handles = std::make_unique<Handles>();
    handles->device = city->m_handles->device;
    rtcRetainDevice(handles->device);
    handles->openScene();
    RTCGeometry instance = rtcNewGeometry(handles->device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, city->m_handles->scene);
    rtcCommitGeometry(instance);
    rtcAttachGeometryByID(handles->scene, instance, kCityGeometry);
    rtcReleaseGeometry(instance);
    handles->city = std::move(city);
    bool allocated = true;
    for (std::size_t i = 0; allocated && i < occluders.size(); ++i) {
        const Occluder& occluder = occluders[i];
        allocated = attachMesh(handles->device, handles->scene, unsigned(i + 1), occluder.vertices,
                               occluder.triangles.size(),
                               [&](std::size_t k) { return occluder.triangles[k]; });
    }
    if (!allocated) {
        return tl::unexpected(buildError(RTC_ERROR_OUT_OF_MEMORY));
    }
    if (auto committed = handles->commit(job); !committed) {
        return tl::unexpected(committed.error());
    }
    return std::unique_ptr<RayScene>(new RayScene(std::move(handles)));
}

SceneHit RayScene::intersect(const glm::vec3& origin, const glm::vec3& direction,
                             float distance) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{};
    query.ray = singleRay(origin, direction, distance);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(m_handles->scene, &context, &query);
    return sceneHit(query.hit.geomID, query.hit.primID, query.ray.tfar, query.hit.u, query.hit.v);
}

void RayScene::intersect(std::span<const glm::vec3> origins, std::span<const glm::vec3> directions,
                         float distance, std::span<SceneHit> hits) const {
    assert(origins.size() == directions.size() && origins.size() == hits.size());
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = m_handles->packetFlags();
    RTCRayHit16 query;
    alignas(64) std::array<int, kPacket> active;
    for (std::size_t first = 0; first < origins.size(); first += kPacket) {
        const std::size_t count = std::min(kPacket, origins.size() - first);
        fillPacket(query.ray, active, origins, directions, first, count);
        std::fill_n(query.ray.tfar, kPacket, distance);
        std::fill_n(query.hit.geomID, kPacket, RTC_INVALID_GEOMETRY_ID);
        std::fill_n(query.hit.instID[0], kPacket, RTC_INVALID_GEOMETRY_ID);
        rtcIntersect16(active.data(), m_handles->scene, &context, &query);
        for (std::size_t i = 0; i < count; ++i) {
            hits[first + i] = sceneHit(query.hit.geomID[i], query.hit.primID[i], query.ray.tfar[i],
                                       query.hit.u[i], query.hit.v[i]);
        }
    }
}

void RayScene::intersect(const RayBundle& rays, const RayPackets& packets,
                         std::span<float> t) const {
    assert(rays.x.size() == rays.y.size() && rays.x.size() == rays.z.size());
    assert(t.size() == rays.x.size());
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    if (packets.coherent)
        context.flags = m_handles->packetFlags();
    const RTCScene scene = m_handles->scene;
    if (packets.size == 16) {
        intersectBundle<16, RTCRayHit16>(rays, t, [&](const int* active, RTCRayHit16& query) {
            rtcIntersect16(active, scene, &context, &query);
        });
    } else if (packets.size == 8) {
        intersectBundle<8, RTCRayHit8>(rays, t, [&](const int* active, RTCRayHit8& query) {
            rtcIntersect8(active, scene, &context, &query);
        });
    } else {
        for (std::size_t k = 0; k < t.size(); ++k) {
            RTCRayHit query{};
            query.ray = singleRay(rays.origin, {rays.x[k], rays.y[k], rays.z[k]}, kInfinity);
            query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
            query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
            rtcIntersect1(scene, &context, &query);
            t[k] = query.ray.tfar;
        }
    }
}

bool RayScene::occluded(const glm::vec3& origin, const glm::vec3& direction, float distance) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray = singleRay(origin, direction, distance);
    rtcOccluded1(m_handles->scene, &context, &ray);
    return ray.tfar < 0.0F;
}

void RayScene::occluded(std::span<const glm::vec3> origins, std::span<const glm::vec3> directions,
                        std::span<const float> distances, std::span<unsigned char> occluded) const {
    assert(origins.size() == directions.size() && origins.size() == distances.size() &&
           origins.size() == occluded.size());
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = m_handles->packetFlags();
    RTCRay16 ray;
    alignas(64) std::array<int, kPacket> active;
    for (std::size_t first = 0; first < origins.size(); first += kPacket) {
        const std::size_t count = std::min(kPacket, origins.size() - first);
        fillPacket(ray, active, origins, directions, first, count);
        for (std::size_t i = 0; i < kPacket; ++i) {
            ray.tfar[i] = distances[first + std::min(i, count - 1)];
        }
        rtcOccluded16(active.data(), m_handles->scene, &context, &ray);
        for (std::size_t i = 0; i < count; ++i) {
            occluded[first + i] = ray.tfar[i] < 0.0F ? 1 : 0;
        }
    }
}

void RayScene::crossings(const glm::vec3& origin, const glm::vec3& direction,
                         const std::function<void(std::uint32_t, float)>& visit) const {
    CrossingContext crossing{};
    rtcInitIntersectContext(&crossing.context);
    crossing.context.filter = reportCrossing;
    crossing.visit = &visit;
    RTCRayHit query{};
    query.ray = singleRay(origin, direction, kInfinity);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(m_handles->scene, &crossing.context, &query);
}

}  // namespace reflet
