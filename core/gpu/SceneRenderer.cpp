// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/SceneRenderer.h"

#include "core/gpu/FrameTargets.h"
#include "core/gpu/StageTimer.h"
#include "core/gpu/base/GlState.h"
#include "core/gpu/base/GlVersion.h"
#include "core/gpu/city/CityBuffers.h"
#include "core/gpu/city/CityPass.h"
#include "core/gpu/overlay/OverlayPass.h"
#include "core/gpu/reflection/BodyPass.h"
#include "core/gpu/reflection/MapBodiesPass.h"
#include "core/gpu/reflection/ReflectionMaps.h"
#include "core/gpu/reflection/VisibleBodies.h"
#include "core/rendering/MapBodies.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace reflet {

namespace {

/// Metres from the camera beyond which a body's map is not worth more than the nearest REM.
constexpr double kReflectorRange = 400.0;
/// While something moves, parts of the city below so many pixels of the shown picture are left out.
constexpr float kSmallestMovingPart = 2.0F;
/// And those below so many pixels of the picture as it is drawn.
constexpr float kSmallestDrawnPart = 1.25F;
/// While something moves, leaves below so many pixels are drawn fewer and larger.
constexpr float kThinnedMovingLeaf = 2.5F;
/// While something moves, bodies below so many pixels show the blend of two REMs.
constexpr float kBlendPixels = 24.0F;
/// In pictures of a movement smaller than this share of the shown one, quads of local maps are not
/// divided below so many texels: some four pixels of the picture as it is drawn.
constexpr float kCoarseQuadsBelow = 0.75F;
constexpr double kCoarseQuad = 2.0;
/// Texels along the edge of the smallest map while something moves.
constexpr int kSmallestMovingMap = 32;
/// Texels of local maps that a picture of a movement may draw anew: two maps of 128² a face.
constexpr std::size_t kMovingTexels = std::size_t(2) * 6 * 128 * 128;
/// Samples along the edge of a texel that vehicles are drawn with into local maps of stills.
constexpr int kMapSamples = 2;
/// Metres around the camera in which vehicles throw shadows.
constexpr double kShadowRange = 300.0;
/// Metres by which bodies count as longer when it is decided whose maps are needed: their maps fade
/// into those of their neighbours over half a metre.
constexpr double kFade = 1.0;

/// A body in the picture, with where it may be seen.
struct SceneBody {
    DrawnBody drawn;
    std::string reflector;
    glm::dvec3 mapCenter{0.0};
    ViewColumns columns;
    float pixels = 0.0F;  ///< of the picture that it may take along its longest edge
};

/// Pixels that a body's longest edge takes at most, seen from its nearest point.
float pixelsOf(const Box& bounds, const RigidTransform& pose, const CityView& view) {
    const glm::dvec3 size = bounds.size();
    const double longest = std::max({size.x, size.y, size.z});
    const double away = distanceTo(placedBounds(bounds, pose), view.eye);
    return float(view.pixelsPerRadian() * longest / std::max(away, double(view.near)));
}

/// Metres that a pixel spans at the body's nearest point.
float pixelSize(const VehicleMesh::Body& body, const RigidTransform& pose, const CityView& view) {
    return float(distanceTo(placedBounds(body.bounds, pose), view.eye)) / view.pixelsPerRadian();
}

/// A power of two that gives two pixels of the body a texel, enough while it passes: a face holds a
/// quarter of what the whole body may reflect. Never more than was tuned.
int usefulResolution(float pixels, int tuned) {
    int resolution = kSmallestMovingMap;
    while (resolution < tuned && 2.0F * float(resolution) < pixels)
        resolution *= 2;
    return std::min(resolution, tuned);
}

}  // namespace

struct SceneRenderer::Impl {
    std::unique_ptr<CityPass> city;
    std::unique_ptr<LocalMapPass> localMaps;
    std::unique_ptr<BodyPass> bodyPass;
    std::unique_ptr<MapBodiesPass> mapBodies;
    std::unique_ptr<OverlayPass> overlays;
    std::unique_ptr<FrameTargets> targets;
    ReflectionMaps reflections;
    VehicleMeshes vehicles;
    std::shared_ptr<const DrawnCity> drawnCity;
    Lighting lighting;
    RemSet rems;
    StageTimer cityTime, mapTime, bodyTime, overlayTime, displayTime;
    std::vector<std::size_t> mapPlaces;  ///< of the maps begun, among those of finishMaps()
    std::vector<Method> mapMethods;      ///< of the same
    std::vector<bool> mapIsNew;          ///< of those that finishMaps() gives
    std::size_t leftMaps = 0;            ///< how many of them are left of the split

    /// The bodies in the view, of all reflectors; and the shadows of all that are near.
    [[nodiscard]] std::vector<SceneBody> findBodies(const FrameRequest& request,
                                                    const CityView& view,
                                                    std::vector<ShadowCaster>& casters);
    void beginMaps(const FrameRequest& request, const std::vector<SceneBody>& bodies, float split,
                   FrameStatistics& statistics);
    [[nodiscard]] std::vector<GpuLocalMap> finishMaps(std::size_t bodies,
                                                      FrameStatistics& statistics);
    /// Draws all other vehicles into the maps of both sides, where a map shows the city only.
    void drawIntoMaps(const FrameRequest& request, const std::vector<SceneBody>& bodies,
                      std::vector<GpuLocalMap>& maps);
};

SceneRenderer::SceneRenderer() : m_impl(std::make_unique<Impl>()) {}
SceneRenderer::~SceneRenderer() = default;

Result<std::unique_ptr<SceneRenderer>> SceneRenderer::create() {
    if (auto sound = requireOpenGl45(); !sound)
        return tl::unexpected(sound.error());
    std::unique_ptr<SceneRenderer> renderer(new SceneRenderer);
    Impl& impl = *renderer->m_impl;
    const auto make = [](auto& part) -> Result<void> {
        auto made = std::remove_reference_t<decltype(*part)>::create();
        if (!made)
            return tl::unexpected(made.error());
        part = std::move(*made);
        return {};
    };
    for (const Result<void>& made :
         {make(impl.city), make(impl.localMaps), make(impl.bodyPass), make(impl.mapBodies),
          make(impl.overlays), make(impl.targets)}) {
        if (!made)
            return tl::unexpected(made.error());
    }
    renderer->setLighting({});
    return renderer;
}

void SceneRenderer::setCity(std::shared_ptr<const DrawnCity> city) {
    m_impl->city->setCity(city);
    m_impl->localMaps->setCity(city);
    m_impl->overlays->setHeightfield(city ? city->heightfield : nullptr);
    m_impl->reflections.invalidate();
    m_impl->mapBodies->invalidate();
    m_impl->drawnCity = std::move(city);
}

void SceneRenderer::setLighting(const Lighting& lighting) {
    m_impl->lighting = lighting;
    m_impl->city->setLighting(lighting);
    m_impl->localMaps->setLighting(lighting);
    m_impl->bodyPass->setLighting(lighting);
    m_impl->reflections.invalidate();
    m_impl->mapBodies->invalidate();
}

void SceneRenderer::setAmbient(std::shared_ptr<const AmbientVolume> ambient) {
    m_impl->city->setAmbient(ambient);
    m_impl->reflections.invalidate();
    m_impl->mapBodies->invalidate();
}

void SceneRenderer::setRems(const RemSet& rems) {
    if (rems == m_impl->rems)
        return;
    m_impl->rems = rems;
    m_impl->localMaps->setRems(rems);
    m_impl->reflections.invalidate();
    m_impl->mapBodies->invalidate();
}

std::vector<SceneBody> SceneRenderer::Impl::findBodies(const FrameRequest& request,
                                                       const CityView& view,
                                                       std::vector<ShadowCaster>& casters) {
    std::vector<SceneBody> found;
    for (const PlacedReflector& reflector : request.reflectors) {
        if (!reflector.vehicle)
            continue;
        const VehicleMesh& mesh = vehicles.of(reflector.vehicle);
        const std::size_t count = std::min(mesh.bodies.size(), reflector.poses.size());
        for (std::size_t i = 0; i < count; ++i) {
            const VehicleMesh::Body& body = mesh.bodies[i];
            const RigidTransform& pose = reflector.poses[i];
            if (glm::distance(pose.translation, view.eye) < kShadowRange) {
                glm::mat4 matrix(glm::mat3(pose.rotation));
                matrix[3] = glm::vec4(glm::vec3(pose.translation), 1.0F);
                std::vector<ShadowCaster::Level> levels;
                for (const VehicleMesh::Level& level : body.levels)
                    levels.push_back({level.error, level.first, level.count()});
                casters.push_back({body.array.id(), std::move(levels), matrix,
                                   placedBounds(body.bounds, pose), body.bounds});
            }
            Box reach = body.bounds;
            reach.min.x -= kFade;
            reach.max.x += kFade;
            if (const auto columns = columnsOf(reach, pose, view)) {
                found.push_back(
                    {{reflector.vehicle.get(), &body,
                      body.levelWithin(request.moving ? pixelSize(body, pose, view) : 0.0F),
                      &mesh.materials, i, pose},
                     reflector.id,
                     reflector.mapCenter(i),
                     *columns,
                     pixelsOf(body.bounds, pose, view)});
            }
        }
    }
    return found;
}

/// Begins the maps of all bodies left of the split, then of all right of it.
void SceneRenderer::Impl::beginMaps(const FrameRequest& request,
                                    const std::vector<SceneBody>& bodies, float split,
                                    FrameStatistics& statistics) {
    std::vector<ReflectionMaps::Wanted> wanted;
    mapPlaces.clear();
    mapMethods.clear();
    const auto want = [&](std::size_t i, Method method, std::size_t at) {
        const SceneBody& body = bodies[i];
        if (!reflectsAnything(*body.drawn.vehicle))
            return;
        LocalMapRequest map{method, body.mapCenter, request.tuning, nullptr};
        if (method == Method::RayTrace) {
            const auto given = request.given.find(body.reflector);
            if (given != request.given.end() && body.drawn.body < given->second.size())
                map.given = given->second[body.drawn.body];
            statistics.referenceMissing = statistics.referenceMissing || !map.given;
            map.method = map.given ? method : Method::Mem;
        } else if (method != Method::Sky &&
                   glm::distance(body.mapCenter, request.camera.position) > kReflectorRange) {
            map.method = Method::Nearest;
        }
        if (request.moving && map.method != Method::RayTrace) {
            map.settings.resolution = usefulResolution(body.pixels, request.tuning.resolution);
            if (request.scale < kCoarseQuadsBelow)
                map.settings.smallestQuad = std::max(map.settings.smallestQuad, kCoarseQuad);
            if ((map.method == Method::Mem || map.method == Method::Dense) &&
                body.pixels < kBlendPixels)
                map.method = Method::Blend;
        }
        wanted.push_back({body.reflector, body.drawn.body, map});
        mapPlaces.push_back(at);
        mapMethods.push_back(map.method);
    };
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (bodies[i].columns.from <= split)
            want(i, request.method, i);
    }
    leftMaps = wanted.size();
    for (std::size_t i = 0; request.right && i < bodies.size(); ++i) {
        if (bodies[i].columns.to >= split)
            want(i, *request.right, bodies.size() + i);
    }
    const std::size_t budget =
        request.moving ? std::size_t(request.scale * float(kMovingTexels)) : ReflectionMaps::kAll;
    reflections.begin(wanted, *localMaps, {request.camera.position, budget});
}

/// The maps of all bodies left of the split, then right of it; those not seen there stay empty.
std::vector<GpuLocalMap> SceneRenderer::Impl::finishMaps(std::size_t bodies,
                                                         FrameStatistics& statistics) {
    const std::vector<GpuLocalMap> maps = reflections.finish(*localMaps, city.get());
    std::vector<GpuLocalMap> placed(2 * bodies);
    for (std::size_t k = 0; k < maps.size(); ++k)
        placed[mapPlaces[k]] = maps[k];
    mapIsNew.assign(maps.size(), false);
    for (const std::size_t k : reflections.drawn())
        mapIsNew[k] = true;
    statistics.localMaps = reflections.drawn().size();
    for (const std::size_t k : reflections.drawn()) {
        const ReconstructionStatistics& drawn = maps[k].statistics;
        if (k >= leftMaps)
            continue;
        statistics.quads += drawn.quads;
        statistics.rays += drawn.rays;
        statistics.vertices += drawn.vertices;
        statistics.uncovered += drawn.uncovered;
    }
    return placed;
}

void SceneRenderer::Impl::drawIntoMaps(const FrameRequest& request,
                                       const std::vector<SceneBody>& bodies,
                                       std::vector<GpuLocalMap>& maps) {
    if (request.reflectors.size() < 2)
        return;
    std::vector<MapBodiesPass::Other> others;
    for (const PlacedReflector& reflector : request.reflectors) {
        if (!reflector.vehicle)
            continue;
        const VehicleMesh& mesh = vehicles.of(reflector.vehicle);
        for (std::size_t i = 0; i < std::min(mesh.bodies.size(), reflector.poses.size()); ++i) {
            others.push_back({reflector.id,
                              {reflector.vehicle.get(),
                               &mesh.bodies[i],
                               {},
                               &mesh.materials,
                               i,
                               reflector.poses[i]},
                              {}});
        }
    }
    std::vector<std::size_t> shown;  // bodies in the view, among the others
    for (const SceneBody& body : bodies) {
        const auto same = [&](const MapBodiesPass::Other& other) {
            return other.reflector == body.reflector && other.drawn.body == body.drawn.body;
        };
        shown.push_back(
            std::size_t(std::find_if(others.begin(), others.end(), same) - others.begin()));
    }
    const int samples = request.moving ? 1 : kMapSamples;
    for (int side = 0; side < 2; ++side) {
        const std::size_t first = side == 0 ? 0 : bodies.size();
        for (std::size_t i = 0; i < bodies.size(); ++i)
            others[shown[i]].mirrors = maps[first + i];
        std::vector<MapBodiesPass::CityMap> wanted;
        std::vector<std::size_t> places;
        for (std::size_t k = 0; k < mapPlaces.size(); ++k) {
            const bool here = mapPlaces[k] >= first && mapPlaces[k] < first + bodies.size();
            if (!here || mapMethods[k] == Method::Sky || mapMethods[k] == Method::RayTrace)
                continue;
            const SceneBody& body = bodies[mapPlaces[k] - first];
            wanted.push_back(
                {body.reflector, body.drawn.body, side, maps[mapPlaces[k]], mapIsNew[k]});
            places.push_back(mapPlaces[k]);
        }
        const auto drawn = mapBodies->draw(wanted, others, *bodyPass, samples);
        for (std::size_t k = 0; k < drawn.size(); ++k)
            maps[places[k]] = drawn[k];
    }
}

FrameStatistics SceneRenderer::draw(const FrameRequest& request, unsigned framebuffer) {
    Impl& impl = *m_impl;
    FrameStatistics statistics;
    const auto begun = std::chrono::steady_clock::now();
    FrameTargets& targets = *impl.targets;
    if (!targets.resize(request.width, request.height, request.samplesPerEdge))
        return statistics;
    const int samples = targets.samplesPerEdge();
    CityView view = cityView(request.camera, targets.width() * samples, targets.height() * samples);
    if (request.moving) {
        view.smallestPart = std::max(kSmallestDrawnPart, kSmallestMovingPart * request.scale);
        view.thinnedLeaf = kThinnedMovingLeaf;
    }
    view.smallestPart *= float(samples);
    view.thinnedLeaf *= float(samples);

    impl.vehicles.nextFrame();
    impl.mapBodies->nextFrame();
    std::vector<ShadowCaster> casters;
    const std::vector<SceneBody> bodies = impl.findBodies(request, view, casters);
    const float split = request.right ? std::clamp(request.wipe, 0.0F, 1.0F) : 1.0F;
    // Another thread traces the maps while the city is drawn; those that show the city as OpenGL
    // draws it come first. Maps hold no vehicles, so their shadows are left out of these too.
    impl.beginMaps(request, bodies, split, statistics);
    std::vector<GpuLocalMap> maps;
    const auto finishMaps = [&] {
        impl.mapTime.begin();
        maps = impl.finishMaps(bodies.size(), statistics);
        statistics.maps = impl.mapTime.end();
    };
    const bool mapsFirst = request.method == Method::Rerender || request.right == Method::Rerender;
    if (mapsFirst) {
        static_cast<void>(impl.city->prepareShadows(request.camera.position, {}));
        finishMaps();
    }
    impl.cityTime.begin();
    static_cast<void>(impl.city->prepareShadows(request.camera.position, casters));
    statistics.triangles =
        impl.city->draw(view, {targets.radiance().id(), targets.depth().id(), 0}).triangles;
    glFlush();
    statistics.city = impl.cityTime.end();
    if (!mapsFirst)
        finishMaps();

    impl.bodyTime.begin();
    std::vector<DrawnBody> drawn;
    for (const SceneBody& body : bodies)
        drawn.push_back(body.drawn);
    const BodyTargets bodyTargets{&targets.radiance(), &targets.depth()};
    impl.city->bindLight();
    impl.drawIntoMaps(request, bodies, maps);
    impl.bodyPass->drawContact(view, bodyTargets, drawn);
    impl.city->bindLight();
    const int middle = int(std::lround(split * float(view.width)));
    const std::span<const GpuLocalMap> all(maps);
    const BodyPass::Part parts[] = {{all.first(bodies.size()), 0, middle},
                                    {all.last(bodies.size()), middle, view.width}};
    impl.bodyPass->draw(view, bodyTargets, drawn, parts);
    statistics.bodies = impl.bodyTime.end();

    impl.displayTime.begin();
    targets.resolve(request.exposure);
    static_cast<void>(impl.displayTime.end());
    impl.overlayTime.begin();
    std::vector<DrawnBody> outlined;
    for (const SceneBody& body : bodies) {
        if (!request.overlays.selectedReflector.empty() &&
            body.reflector == request.overlays.selectedReflector)
            outlined.push_back(body.drawn);
    }
    impl.overlays->draw(request.overlays,
                        {request.camera, request.exposure, request.scale, &impl.rems,
                         &impl.localMaps->store(), outlined},
                        targets);
    targets.present(framebuffer);
    restoreGlDefaults();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    statistics.overlays = impl.overlayTime.end();
    double gpu = 0.0;
    for (StageTimer* stage :
         {&impl.mapTime, &impl.cityTime, &impl.bodyTime, &impl.displayTime, &impl.overlayTime})
        gpu += stage->gpu();
    const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - begun;
    statistics.milliseconds = std::max(wall.count(), gpu);
    return statistics;
}

DisplayImage SceneRenderer::drawImage(const FrameRequest& request, FrameStatistics* statistics) {
    FrameRequest sized = request;
    sized.width = std::max(request.width, 1);
    sized.height = std::max(request.height, 1);
    const Texture target = Texture::make2D(GL_RGBA8, sized.width, sized.height);
    Framebuffer framebuffer = Framebuffer::make();
    framebuffer.attach(GL_COLOR_ATTACHMENT0, target);
    const FrameStatistics drawn = draw(sized, framebuffer.id());
    if (statistics != nullptr)
        *statistics = drawn;
    const auto width = std::size_t(sized.width);
    const auto height = std::size_t(sized.height);
    std::vector<unsigned char> bytes(width * height * 4);
    glGetTextureImage(target.id(), 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(bytes.size()),
                      bytes.data());
    DisplayImage image{sized.width, sized.height, std::vector<glm::vec3>(width * height)};
    for (std::size_t row = 0; row < height; ++row) {
        for (std::size_t column = 0; column < width; ++column) {
            const unsigned char* texel = &bytes[4 * ((height - 1 - row) * width + column)];
            image.pixels[row * width + column] = glm::vec3(texel[0], texel[1], texel[2]) / 255.0F;
        }
    }
    return image;
}

LocalEnvironmentMap SceneRenderer::localMap(Method method, const glm::dvec3& position,
                                            const MemSettings& settings) {
    const LocalMapRequest request{method == Method::RayTrace ? Method::Mem : method, position,
                                  settings, nullptr};
    if (request.method == Method::Rerender)
        static_cast<void>(m_impl->city->prepareShadows(position, {}));
    const auto maps = m_impl->localMaps->draw({&request, 1}, m_impl->city.get());
    LocalEnvironmentMap map = LocalMapPass::read(maps.front());
    restoreGlDefaults();
    return map;
}

}  // namespace reflet
