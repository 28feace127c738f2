// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/reflection/MapBodiesPass.h"

#include "core/base/ParallelFor.h"
#include "core/gpu/base/GlState.h"
#include "core/gpu/base/ShaderLibrary.h"
#include "core/gpu/reflection/ReflectionMaps.h"
#include "core/gpu/reflection/VisibleBodies.h"
#include "core/rendering/MapBodies.h"

#include <epoxy/gl.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace reflet {

namespace {

constexpr float kNear = 0.05F;  // metres: a body may almost touch the centre of another's map
constexpr double kAll = std::numeric_limits<double>::infinity();
/// While something moves, reflections in bodies that look smaller than so many texels of a map are
/// looked up without parallax.
constexpr double kParallaxTexels = 32.0;
constexpr double kArm = 4.0;  // metres from a body's middle to where its turning counts

double movedBy(const RigidTransform& a, const RigidTransform& b) {
    double most = glm::distance(a.translation, b.translation);
    for (int axis = 0; axis < 3; ++axis)
        most = std::max(most, kArm * glm::distance(a.rotation[axis], b.rotation[axis]));
    return most;
}

/// Pixels of a face, the last ones excluded.
struct FacePart {
    int left = 0, bottom = 0, right = 0, top = 0;
};

FacePart pixelsOf(const ViewColumns& shares, int edge, int step) {
    const auto down = [&](float share) { return int(share * float(edge)) / step * step; };
    const auto up = [&](float share) {
        return std::min(edge, (int(std::ceil(share * float(edge))) + step) / step * step);
    };
    return {down(shares.from), down(shares.bottom), up(shares.to), up(shares.top)};
}

void enclose(std::optional<FacePart>& all, const FacePart& part) {
    if (!all) {
        all = part;
        return;
    }
    *all = {std::min(all->left, part.left), std::min(all->bottom, part.bottom),
            std::max(all->right, part.right), std::max(all->top, part.top)};
}

std::shared_ptr<Texture> makeCopy(int edge) {
    auto texture = std::make_shared<Texture>(Texture::makeCube(GL_RGBA16F, edge, mipLevels(edge)));
    texture->filter(GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR);
    return texture;
}

}  // namespace

Result<std::unique_ptr<MapBodiesPass>> MapBodiesPass::create() {
    std::unique_ptr<MapBodiesPass> pass(new MapBodiesPass);
    for (const auto& [program, name] :
         {std::pair{&pass->m_city, "localmap_city"}, {&pass->m_bodies, "localmap_bodies"}}) {
        auto made = makeProgram(name);
        if (!made)
            return tl::unexpected(made.error());
        *program = std::move(*made);
    }
    pass->m_faceFramebuffer = Framebuffer::make();
    pass->m_mapFramebuffer = Framebuffer::make();
    pass->m_noAttributes = VertexArray::make();
    pass->m_unfiltered = Sampler::make(GL_NEAREST, GL_NEAREST);
    return pass;
}

void MapBodiesPass::nextFrame() {
    std::erase_if(m_kept, [](const auto& entry) { return !entry.second.used; });
    for (auto& [key, kept] : m_kept)
        kept.used = false;
    m_drawn = 0;
    m_drawnUnits = 0.0;
}

double MapBodiesPass::errorOf(const Kept& kept, const Kept& wanted, double tolerance) {
    constexpr double kOther = 8.0;  // it shows others than it should
    double error = 0.0;
    const auto moved = [&](double way, double away) {
        const double allowed = std::max(ReflectionMaps::kReuseDistance, tolerance * away);
        error = std::max(error, way / allowed);
    };
    if (kept.places.size() != wanted.places.size() || kept.samplesPerEdge != wanted.samplesPerEdge)
        return std::max(error, kOther);
    for (std::size_t i = 0; i < kept.places.size(); ++i) {
        const Place &a = kept.places[i], &b = wanted.places[i];
        if (a.reflector != b.reflector || a.body != b.body)
            return std::max(error, kOther);
        if (a.mirrors != b.mirrors && tolerance == 0.0)
            error = std::max(error, 1.0);
        // Where both have moved alike, as in a column, nothing has.
        RigidTransform before = a.pose;
        before.translation += wanted.center - kept.center;
        moved(movedBy(before, b.pose), glm::distance(b.pose.translation, wanted.center));
    }
    return error;
}

MapBodiesPass::Plan MapBodiesPass::planOf(const CityMap& map, std::span<const Other> others,
                                          int samplesPerEdge, const Hiding* hiding) const {
    Plan plan;
    if (!map.map.texture)
        return plan;
    const int edge = map.map.texture->width();
    plan.wanted = {{}, map.map.texture->id(), map.map.center, samplesPerEdge, nullptr, true};
    for (std::size_t i = 0; i < others.size(); ++i) {
        const DrawnBody& body = others[i].drawn;
        if (others[i].reflector == map.reflector ||
            !fillsTexel(body.mesh->bounds, body.project_from_body, map.map.center,
                        std::max(1, edge / map.smallest)) ||
            (hiding != nullptr &&
             hiding->hides(map.map.center,
                           placedBounds(body.mesh->bounds, body.project_from_body))))
            continue;
        plan.seen.push_back(i);
        plan.wanted.places.push_back(
            {others[i].reflector, body.body, body.project_from_body,
             others[i].mirrors.texture ? others[i].mirrors.texture->id() : 0U});
    }
    if (plan.seen.empty())
        return plan;
    Detail detail;
    detail.resolution = edge;
    plan.update = {0.0, map.weight, unitsOfOthers(detail, plan.seen.size()), true};
    const auto kept = m_kept.find({map.reflector, map.body, map.side});
    if (kept != m_kept.end() && kept->second.texture && !map.isNew &&
        kept->second.city == plan.wanted.city) {
        plan.update.missing = false;
        plan.update.error = errorOf(kept->second, plan.wanted, map.tolerance);
    }
    return plan;
}

std::vector<GpuLocalMap> MapBodiesPass::draw(std::span<const CityMap> maps,
                                             std::span<const Other> others, BodyPass& bodies,
                                             int samplesPerEdge, const Hiding* hiding,
                                             double units) {
    std::vector<Plan> plans(maps.size());
    parallelFor(0, maps.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            plans[i] = planOf(maps[i], others, samplesPerEdge, hiding);
    });
    std::vector<MapUpdate> updates;
    for (const Plan& plan : plans)
        updates.push_back(plan.update);
    std::vector<bool> due(maps.size(), false);
    // Those without a copy of this map are promised; the rest is for what has moved.
    for (const MapUpdate& update : updates)
        units -= update.missing ? update.units : 0.0;
    for (const std::size_t i : chooseUpdates(updates, kAll)) {
        due[i] = updates[i].missing || updates[i].units <= units;
        units -= due[i] && !updates[i].missing ? updates[i].units : 0.0;
    }
    std::vector<GpuLocalMap> out;
    for (std::size_t i = 0; i < maps.size(); ++i) {
        const CityMap& map = maps[i];
        Plan& plan = plans[i];
        out.push_back(map.map);
        const Key key{map.reflector, map.body, map.side};
        if (plan.seen.empty()) {
            m_kept.erase(key);
            continue;
        }
        Kept& kept = m_kept[key];
        kept.used = true;
        if (due[i] || plan.update.missing) {
            const int edge = map.map.texture->width();
            plan.wanted.texture =
                kept.texture && kept.texture->width() == edge ? kept.texture : makeCopy(edge);
            kept = std::move(plan.wanted);
            drawMap(map, others, plan.seen, bodies, kept);
            ++m_drawn;
            m_drawnUnits += plan.update.units;
        }
        out.back().texture = kept.texture;
        out.back().owned.reset();
    }
    return out;
}

void MapBodiesPass::resize(int edge) {
    if (m_radiance.width() == edge)
        return;
    m_radiance = Texture::make2D(GL_RGBA16F, edge, edge);
    m_depth = Texture::make2D(GL_DEPTH32F_STENCIL8, edge, edge);
}

void MapBodiesPass::drawMap(const CityMap& map, std::span<const Other> others,
                            std::span<const std::size_t> seen, BodyPass& bodies,
                            const Kept& target) {
    const int edge = target.texture->width();
    glCopyImageSubData(map.map.texture->id(), GL_TEXTURE_CUBE_MAP, 0, 0, 0, 0, target.texture->id(),
                       GL_TEXTURE_CUBE_MAP, 0, 0, 0, 0, edge, edge, 6);
    resize(edge * target.samplesPerEdge);
    std::vector<DrawnBody> drawn;
    std::vector<GpuLocalMap> mirrored;
    const double texel = 0.5 * kPi / edge;
    for (const std::size_t i : seen) {
        DrawnBody body = others[i].drawn;
        const Box placed = placedBounds(body.mesh->bounds, body.project_from_body);
        const glm::dvec3 nearest = glm::clamp(map.map.center, placed.min, placed.max);
        const double away = glm::distance(nearest, map.map.center);
        body.level = body.mesh->levelWithin(float(texel * away / target.samplesPerEdge));
        drawn.push_back(body);
        mirrored.push_back(others[i].mirrors.texture ? others[i].mirrors : map.map);
        const glm::dvec3 size = body.mesh->bounds.size();
        const bool small = std::max({size.x, size.y, size.z}) < kParallaxTexels * texel * away;
        mirrored.back().atInfinity |= small && target.samplesPerEdge == 1;
    }
    for (int face = 0; face < 6; ++face)
        drawFace(map.map, face, drawn, mirrored, bodies, target);
    target.texture->generateMipmaps();
    resetGlState();
}

void MapBodiesPass::drawFace(const GpuLocalMap& map, int face, std::span<const DrawnBody> drawn,
                             std::span<const GpuLocalMap> mirrored, BodyPass& bodies,
                             const Kept& target) {
    const int samples = target.samplesPerEdge;
    const int edge = target.texture->width();
    CityView view = cityFaceView(map.center, face, edge * samples);
    view.near = kNear;
    std::vector<DrawnBody> here;
    std::vector<GpuLocalMap> maps;
    std::optional<FacePart> part;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        const auto shares = columnsOf(drawn[i].mesh->bounds, drawn[i].project_from_body, view);
        if (!shares)
            continue;
        enclose(part, pixelsOf(*shares, view.width, samples));
        here.push_back(drawn[i]);
        maps.push_back(mirrored[i]);
    }
    if (!part)
        return;
    const auto begin = [&](const Program& program, int resolution, int divisor) {
        resetGlState();
        glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
        map.texture->bind(0);
        m_unfiltered.bind(0);
        m_noAttributes.bind();
        program.set("face", face);
        program.set("resolution", resolution);
        program.set("samplesPerEdge", samples);
        program.set("near", kNear);
        program.use();
        glViewport(0, 0, resolution, resolution);
        glEnable(GL_SCISSOR_TEST);
        glScissor(part->left / divisor, part->bottom / divisor,
                  (part->right - part->left) / divisor, (part->top - part->bottom) / divisor);
    };
    m_faceFramebuffer.attach(GL_COLOR_ATTACHMENT0, m_radiance);
    m_faceFramebuffer.attach(GL_DEPTH_STENCIL_ATTACHMENT, m_depth);
    m_faceFramebuffer.bind();
    begin(m_city, view.width, 1);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    Sampler::unbind(0);

    const BodyPass::Part columns{maps, part->left, part->right, {}, {}};
    bodies.draw(view, {&m_radiance, &m_depth}, here, {&columns, 1});

    m_mapFramebuffer.attach(GL_COLOR_ATTACHMENT0, *target.texture, 0, face);
    m_mapFramebuffer.bind();
    begin(m_bodies, edge, samples);
    m_radiance.bind(1);
    m_depth.bind(2);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    Sampler::unbind(0);
}

}  // namespace reflet
