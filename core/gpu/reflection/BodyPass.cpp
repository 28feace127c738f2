// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/reflection/BodyPass.h"

#include "core/gpu/base/GlState.h"
#include "core/gpu/base/ShaderLibrary.h"
#include "core/rendering/BodyShading.h"
#include "core/traffic/BodyCoupling.h"

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <string>

namespace reflet {

namespace {

constexpr double kContactMargin = 1.0;  // metres around a body in which it darkens the ground
constexpr double kContactHeight = 0.6;  // metres above and below its running surface
constexpr double kContactFloor = 0.45;  // metres: what begins higher darkens nothing

/// The picture, and faces of local maps of some sizes.
constexpr std::size_t kPaneSizes = 4;

constexpr unsigned kCityMapUnit = 9;
constexpr GLint kUnitsForPixels = 20;

enum Layer { kOpaque = 0, kPanesAway = 1, kPanesTowards = 2 };

glm::mat4 eyeFromBody(const CityView& view, const RigidTransform& pose) {
    glm::mat4 matrix(glm::mat3(pose.rotation));
    matrix[3] = glm::vec4(glm::vec3(pose.translation - view.eye), 1.0F);
    return matrix;
}

bool coupled(const DrawnBody& a, const DrawnBody& b) {
    return a.vehicle == b.vehicle && a.body + 1 == b.body &&
           rigidlyCoupled(*a.vehicle, a.body, a.project_from_body, b.project_from_body);
}

/// Reversed depth: the nearer is the greater.
void beginDepthTest(bool write) {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(write ? GL_TRUE : GL_FALSE);
}

int countOf(const DrawnBody& body, bool glass) {
    return glass ? body.level.glassCount : body.level.opaqueCount;
}

/// In place of a map that there is none of. Drivers that draw in software compile a shader anew
/// (over half a second for that of bodies, while something moves) for a texture without levels, or
/// with edges that are no powers of two: this one has what maps have.
Texture blackMap() {
    constexpr int kEdge = 2;
    Texture black = Texture::makeCube(GL_RGBA16F, kEdge, mipLevels(kEdge));
    black.filter(GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR);
    for (int level = 0; level < black.levels(); ++level)
        glClearTexImage(black.id(), level, GL_RGBA, GL_FLOAT, nullptr);
    return black;
}

/// At least so many texels, and no power of two, for the same reason: windows are none either.
int paneEdge(int pixels) {
    return std::has_single_bit(unsigned(pixels)) ? std::max(pixels + 1, 3) : pixels;
}

void drawTriangles(const DrawnBody& body, bool glass) {
    body.mesh->array.bind();
    const int first = body.level.first + (glass ? body.level.opaqueCount : 0);
    glDrawElements(GL_TRIANGLES, countOf(body, glass), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(sizeof(std::uint32_t) * std::size_t(first)));
}

}  // namespace

Result<std::unique_ptr<BodyPass>> BodyPass::create() {
    std::unique_ptr<BodyPass> pass(new BodyPass);
    const auto load = [](Program& program, const char* name, std::vector<std::string> defines) {
        auto made = makeProgram(name, defines);
        if (made)
            program = std::move(*made);
        return made ? Result<void>() : tl::unexpected(made.error());
    };
    for (const Result<void>& loaded :
         {load(pass->m_surface[kOpaque], "body_surface", {"LAYER 0"}),
          load(pass->m_surface[kPanesAway], "body_surface", {"LAYER 1"}),
          load(pass->m_surface[kPanesTowards], "body_surface", {"LAYER 2"}),
          load(pass->m_depth, "body_depth", {}), load(pass->m_contact, "body_contact", {})}) {
        if (!loaded)
            return tl::unexpected(loaded.error());
    }
    GLint units = 0;
    glGetIntegerv(GL_MAX_TEXTURE_IMAGE_UNITS, &units);
    for (const Layer layer : {kOpaque, kPanesAway, kPanesTowards}) {
        if (units < kUnitsForPixels)
            break;
        if (auto loaded = load(pass->m_pixels[layer], "body_surface",
                               {fmt::format("LAYER {}", int(layer)), "PER_PIXEL"});
            !loaded)
            return tl::unexpected(loaded.error());
    }
    pass->m_framebuffer = Framebuffer::make();
    pass->m_glassFramebuffer = Framebuffer::make();
    pass->m_contactFramebuffer = Framebuffer::make();
    pass->m_noAttributes = VertexArray::make();
    pass->m_black = blackMap();
    pass->setLighting({});
    return pass;
}

void BodyPass::setLighting(const Lighting& lighting) {
    m_sky.emplace(lighting);
}

void BodyPass::resize(int width, int height) {
    width = paneEdge(width);
    height = paneEdge(height);
    const auto known = std::find_if(m_panes.begin(), m_panes.end(), [&](const Panes& panes) {
        return panes.front.width() == width && panes.front.height() == height;
    });
    if (known != m_panes.end()) {
        std::rotate(m_panes.begin(), known, known + 1);
        return;
    }
    if (m_panes.size() == kPaneSizes)
        m_panes.pop_back();
    m_panes.insert(m_panes.begin(), {Texture::make2D(GL_DEPTH_COMPONENT32F, width, height),
                                     Texture::make2D(GL_DEPTH_COMPONENT32F, width, height)});
    m_glassFramebuffer.drawTo(0);
}

void BodyPass::setBody(const Program& program, const CityView& view, const DrawnBody& body) const {
    program.set("eye_from_body", eyeFromBody(view, body.project_from_body));
}

void BodyPass::drawContact(const CityView& view, const BodyTargets& targets,
                           std::span<const DrawnBody> bodies) {
    if (bodies.empty())
        return;
    resetGlState();
    m_contactFramebuffer.attach(GL_COLOR_ATTACHMENT0, *targets.radiance);
    m_contactFramebuffer.bind();
    glViewport(0, 0, view.width, view.height);
    targets.depth->bind(0);
    m_noAttributes.bind();
    m_contact.use();
    m_contact.set("clip_from_eye", view.clip_from_eye());
    m_contact.set("forward", view.forward);
    m_contact.set("near", view.near);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ZERO, GL_SRC_COLOR);
    glEnable(GL_CULL_FACE);  // far sides only: the eye may be inside
    glCullFace(GL_FRONT);
    for (const DrawnBody& body : bodies) {
        const Box& box = body.mesh->bounds;
        if (box.empty() || box.min.z > kContactFloor)
            continue;
        const double width = std::min(box.size().x, box.size().y);
        m_contact.set("reach", float(std::clamp(0.5 * width, 0.1, 0.9)));
        setBody(m_contact, view, body);
        m_contact.set("lower", glm::vec3(box.min.x - kContactMargin, box.min.y - kContactMargin,
                                         -kContactHeight));
        m_contact.set("upper", glm::vec3(box.max.x + kContactMargin, box.max.y + kContactMargin,
                                         kContactHeight));
        m_contact.set("halfSize", glm::vec2(0.5 * box.size()));
        m_contact.set("middle", glm::vec2(box.center()));
        glDrawArrays(GL_TRIANGLES, 0, 36);
    }
    resetGlState();
}

void BodyPass::drawDepths(const CityView& view, std::span<const DrawnBody> bodies, bool glass) {
    m_depth.use();
    for (const DrawnBody& body : bodies) {
        if (countOf(body, glass) == 0)
            continue;
        setBody(m_depth, view, body);
        drawTriangles(body, glass);
    }
}

void BodyPass::drawGlassDepths(const CityView& view, std::span<const DrawnBody> bodies) {
    glViewport(0, 0, view.width, view.height);
    beginDepthTest(true);
    glEnable(GL_CULL_FACE);
    for (const bool towards : {true, false}) {
        m_glassFramebuffer.attach(GL_DEPTH_ATTACHMENT,
                                  towards ? m_panes[0].front : m_panes[0].back);
        m_glassFramebuffer.bind();
        const float farthest = 0.0F;
        glClearNamedFramebufferfv(m_glassFramebuffer.id(), GL_DEPTH, 0, &farthest);
        glCullFace(towards ? GL_BACK : GL_FRONT);
        drawDepths(view, bodies, true);
    }
    glDisable(GL_CULL_FACE);
}

void BodyPass::draw(const CityView& view, const BodyTargets& targets,
                    std::span<const DrawnBody> bodies, std::span<const Part> parts) {
    if (bodies.empty())
        return;
    resetGlState();
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    resize(view.width, view.height);
    // Faces of cube maps are pictures in a mirror.
    if (glm::dot(glm::cross(view.right, view.up), view.forward) > 0.0F)
        glFrontFace(GL_CW);
    m_depth.set("clip_from_eye", view.clip_from_eye());
    drawGlassDepths(view, bodies);

    std::vector<std::size_t> order(bodies.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    const auto distance = [&](std::size_t i) {
        return glm::distance(bodies[i].project_from_body.translation, view.eye);
    };
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return distance(a) > distance(b); });

    m_framebuffer.attach(GL_COLOR_ATTACHMENT0, *targets.radiance);
    m_framebuffer.attach(GL_DEPTH_STENCIL_ATTACHMENT, *targets.depth);
    m_framebuffer.bind();
    glViewport(0, 0, view.width, view.height);
    for (const auto& programs : {std::span(m_surface), std::span(m_pixels)}) {
        for (const Program& program : programs) {
            if (!program)
                continue;
            program.set("clip_from_eye", view.clip_from_eye());
            program.set("eye", glm::vec3(view.eye));
            program.set("interiorLight", m_sky->ambient({0.0F, 0.0F, 1.0F}) * kCabinLight);
        }
    }
    // Depth first: what is hidden is never shaded.
    beginDepthTest(true);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    drawDepths(view, bodies, false);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    m_panes[0].front.bind(4);
    m_panes[0].back.bind(5);
    glEnable(GL_SCISSOR_TEST);
    for (const Layer layer : {kOpaque, kPanesAway, kPanesTowards}) {
        for (const Part& part : parts) {
            if (part.to <= part.from)
                continue;
            glScissor(part.from, 0, part.to - part.from, view.height);
            drawLayer(view, bodies, part, order, layer);
        }
    }
    resetGlState();
}

void BodyPass::drawLayer(const CityView& view, std::span<const DrawnBody> bodies, const Part& part,
                         std::span<const std::size_t> order, int layer) {
    const bool glass = layer != kOpaque;
    const std::span<const GpuLocalMap> maps = part.maps;
    const bool byPixel = bool(part.pixels);
    const Program& program = (byPixel ? m_pixels : m_surface)[std::size_t(layer)];
    program.use();
    beginDepthTest(false);
    glDepthFunc(glass ? GL_GREATER : GL_GEQUAL);
    if (glass) {
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_SRC1_COLOR);
        glEnable(GL_CULL_FACE);
        glCullFace(layer == kPanesTowards ? GL_BACK : GL_FRONT);
    }
    const auto drawBody = [&](std::size_t i) {
        const DrawnBody& body = bodies[i];
        if (countOf(body, glass) == 0)
            return;
        setBody(program, view, body);
        program.set("smear", body.smear);
        body.materials->bind(0);
        bindMaps(program, view, bodies, maps, i);
        if (byPixel) {
            const GpuLocalMap& city = part.cityMaps[i];
            (city.texture ? *city.texture : m_black).bind(kCityMapUnit);
            part.pixels(program, i);
        }
        if (glass || body.level.error == 0.0F) {
            drawTriangles(body, glass);
            return;
        }
        // Both sides of a thin sheet may have come to lie in one place: the one that faces us last.
        glEnable(GL_CULL_FACE);
        for (const GLenum hidden : {GL_FRONT, GL_BACK}) {
            glCullFace(hidden);
            drawTriangles(body, false);
        }
        glDisable(GL_CULL_FACE);
    };
    std::for_each(order.begin(), order.end(), drawBody);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
}

void BodyPass::bindMaps(const Program& program, const CityView& view,
                        std::span<const DrawnBody> bodies, std::span<const GpuLocalMap> maps,
                        std::size_t body) {
    const GpuLocalMap& own = maps[body];
    program.set("mapCenter", glm::vec3(own.center - view.eye));
    program.set("mapAtInfinity", int(own.atInfinity || !own.texture));
    const auto bind = [&](unsigned unit, const GpuLocalMap& map) {
        (map.texture ? *map.texture : m_black).bind(unit);
    };
    bind(1, own);
    m_black.bind(2);
    m_black.bind(3);
    int couplings = 0;
    const auto couple = [&](std::size_t other) {
        const glm::dvec3 axis = maps[other].center - own.center;
        const double length = glm::length(axis);
        if (!own.texture || !maps[other].texture || length <= 0.0)
            return;
        const glm::vec4 value(glm::vec3(axis / (length * length)),
                              float(double(kFadeHalf) / length));
        program.set(couplings == 0 ? "couplingAxis[0]" : "couplingAxis[1]", value);
        program.set(couplings == 0 ? "neighbourCenter[0]" : "neighbourCenter[1]",
                    glm::vec3(maps[other].center - view.eye));
        bind(2U + unsigned(couplings), maps[other]);
        ++couplings;
    };
    if (body > 0 && coupled(bodies[body - 1], bodies[body]))
        couple(body - 1);
    if (body + 1 < bodies.size() && coupled(bodies[body], bodies[body + 1]))
        couple(body + 1);
    program.set("couplings", couplings);
}

}  // namespace reflet
