// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/SceneRenderer.h"

#include "core/base/Stopwatch.h"
#include "core/gpu/FrameTargets.h"
#include "core/gpu/StageTimer.h"
#include "core/gpu/base/GlState.h"
#include "core/gpu/base/GlVersion.h"
#include "core/gpu/city/CityBaker.h"
#include "core/gpu/city/CityBuffers.h"
#include "core/gpu/city/CityPass.h"
#include "core/gpu/overlay/OverlayPass.h"
#include "core/gpu/reflection/SceneReflections.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr double kMilliseconds = 1e3;
/// While something moves, parts of the city below so many pixels of the shown picture are left out.
constexpr float kSmallestMovingPart = 2.0F;
/// And those below so many pixels of the picture as it is drawn.
constexpr float kSmallestDrawnPart = 1.25F;
/// While something moves, leaves below so many pixels are drawn fewer and larger.
constexpr float kThinnedMovingLeaf = 2.5F;
/// Metres around the camera in which vehicles throw shadows.
constexpr double kShadowRange = 300.0;
/// Metres by which bodies count as longer when it is decided whose maps are needed: their maps fade
/// into those of their neighbours over half a metre.
constexpr double kFade = 1.0;

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

}  // namespace

struct SceneRenderer::Impl {
    std::unique_ptr<CityPass> city;
    std::unique_ptr<LocalMapPass> localMaps;
    std::unique_ptr<BodyPass> bodyPass;
    std::unique_ptr<MapBodiesPass> mapBodies;
    std::unique_ptr<OverlayPass> overlays;
    std::unique_ptr<FrameTargets> targets;
    SceneReflections reflections;
    CityBaker baker;
    VehicleMeshes vehicles;
    std::shared_ptr<const DrawnCity> drawnCity;
    Lighting lighting;
    RemSet rems;
    StageTimer cityTime, mapTime, copyTime, bodyTime, overlayTime, displayTime;

    /// The bodies in the view, of all reflectors; and the shadows of all that are near.
    [[nodiscard]] std::vector<SceneBody> findBodies(const FrameRequest& request,
                                                    const CityView& view,
                                                    std::vector<ShadowCaster>& casters);
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
    m_impl->reflections.setCity(city);
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
                     reflector.middle(),
                     *columns,
                     pixelsOf(body.bounds, pose, view),
                     reflector.interest});
            }
        }
    }
    return found;
}

FrameStatistics SceneRenderer::draw(const FrameRequest& request, unsigned framebuffer) {
    Impl& impl = *m_impl;
    FrameStatistics statistics;
    const Stopwatch watch;
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
    std::vector<SceneBody> bodies = impl.findBodies(request, view, casters);
    impl.reflections.smear(request, bodies);
    const float split = request.right ? std::clamp(request.wipe, 0.0F, 1.0F) : 1.0F;
    // Another thread traces the maps while the city is drawn; those that show the city as OpenGL
    // draws it come first. Maps hold no vehicles, so their shadows are left out of these too.
    impl.reflections.begin(request, bodies, split, *impl.localMaps, statistics);
    std::vector<GpuLocalMap> maps;
    const auto finishMaps = [&] {
        impl.mapTime.begin();
        maps = impl.reflections.finish(*impl.localMaps, impl.city.get(), statistics);
        statistics.maps = std::max(0.0, impl.mapTime.end() - statistics.tracing);
    };
    const bool mapsFirst = request.method == Method::Rerender || request.right == Method::Rerender;
    if (mapsFirst) {
        static_cast<void>(impl.city->prepareShadows(request.camera.position, {}, request.moving));
        finishMaps();
    }
    impl.cityTime.begin();
    static_cast<void>(impl.city->prepareShadows(request.camera.position, casters, request.moving));
    statistics.triangles =
        impl.city->draw(view, {targets.radiance().id(), targets.depth().id(), 0}).triangles;
    glFlush();
    statistics.city = impl.cityTime.end();
    if (!mapsFirst)
        finishMaps();

    impl.copyTime.begin();
    impl.city->bindLight();
    const std::vector<GpuLocalMap> cityMaps = maps;
    impl.reflections.drawIntoMaps(request, impl.vehicles, *impl.mapBodies, *impl.bodyPass, maps);
    statistics.inMaps = impl.copyTime.end();
    impl.bodyTime.begin();
    std::vector<DrawnBody> drawn;
    for (const SceneBody& body : bodies)
        drawn.push_back(body.drawn);
    const BodyTargets bodyTargets{&targets.radiance(), &targets.depth()};
    impl.bodyPass->drawContact(view, bodyTargets, drawn);
    impl.city->bindLight();
    const int middle = int(std::lround(split * float(view.width)));
    const std::span<const GpuLocalMap> all(maps);
    const std::span<const GpuLocalMap> allOfCity(cityMaps);
    const auto pixelsOf = [&](std::optional<Method> method) {
        return method == Method::PerPixel && impl.bodyPass->drawsPixels() &&
                       impl.localMaps->tracesPixels()
                   ? std::function([&](const Program& program, std::size_t i) {
                         impl.localMaps->bindPixels(program, bodies[i].vehicleMiddle,
                                                    request.tuning);
                         program.set("sightCenter", glm::vec3(bodies[i].vehicleMiddle - view.eye));
                     })
                   : std::function<void(const Program&, std::size_t)>();
    };
    const BodyPass::Part parts[] = {{all.first(bodies.size()), 0, middle, pixelsOf(request.method),
                                     allOfCity.first(bodies.size())},
                                    {all.last(bodies.size()), middle, view.width,
                                     pixelsOf(request.right), allOfCity.last(bodies.size())}};
    impl.bodyPass->draw(view, bodyTargets, drawn, parts);
    statistics.bodies = impl.bodyTime.end();

    impl.displayTime.begin();
    targets.resolve(request.exposure);
    const double display = impl.displayTime.end();
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
    const double stages = statistics.tracing + statistics.maps + statistics.city +
                          statistics.inMaps + statistics.bodies + display + statistics.overlays;
    statistics.milliseconds = std::max(kMilliseconds * watch.seconds(), stages);
    impl.reflections.took(statistics);
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

double SceneRenderer::timeLocalMap(Method method, const glm::dvec3& position,
                                   const MemSettings& settings, bool everyPart) {
    const LocalMapRequest request{method, position, settings, nullptr, everyPart};
    if (method == Method::Rerender)
        static_cast<void>(m_impl->city->prepareShadows(position, {}));
    glFinish();
    const Stopwatch watch;
    static_cast<void>(m_impl->localMaps->draw({&request, 1}, m_impl->city.get()));
    glFinish();
    const double taken = kMilliseconds * watch.seconds();
    restoreGlDefaults();
    return taken;
}

Result<ReferenceEnvironmentMap> SceneRenderer::bake(const std::string& id,
                                                    const glm::dvec3& position,
                                                    const BakeSettings& settings) {
    auto map = m_impl->baker.bake(*m_impl->city, id, position, settings);
    restoreGlDefaults();
    return map;
}

}  // namespace reflet
