// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/city/CityPass.h"

#include "core/gpu/base/ShaderLibrary.h"
#include "core/gpu/city/CityBuffers.h"
#include "core/gpu/city/CityLight.h"
#include "core/gpu/city/ShadowMarks.h"
#include "core/gpu/city/SunShadow.h"

#include <epoxy/gl.h>

#include <array>
#include <optional>
#include <string>

namespace reflet {

namespace {

/// Copies all of a texture of the view's size to another of the same format.
void copyPicture(unsigned from, unsigned to, const CityView& view) {
    glCopyImageSubData(from, GL_TEXTURE_2D, 0, 0, 0, 0, to, GL_TEXTURE_2D, 0, 0, 0, 0, view.width,
                       view.height, 1);
}

}  // namespace

struct CityPass::Impl {
    Program ids;
    std::array<Program, kShadeKinds> kinds;
    SunShadow shadow;
    CityLight light;
    std::optional<CityBuffers> city;
    Lighting lighting;
    Texture numbers;  ///< the triangle of each pixel, of the view's size
    Framebuffer idTarget, radianceTarget;
    VertexArray empty = VertexArray::make();

    /// What the last view showed: a view that comes again is not drawn anew.
    struct Kept {
        CityView view;
        std::size_t triangles = 0;
        bool hasDepth = false;     ///< `depth` holds what was drawn
        bool hasRadiance = false;  ///< `radiance` holds it without the shadows of moving bodies
        unsigned shadows = 0;      ///< SunShadow::version() of `radiance`
    };
    std::optional<Kept> kept;
    Texture depth;     ///< with the stencil, as drawNumbers() left them
    Texture radiance;  ///< of the targets' format
    unsigned radianceFormat = 0;
    ShadowMarks marks;

    void fit(const CityView& view);
    std::size_t showNumbers(const CityView& view, const CityTargets& targets);
    std::size_t drawNumbers(const CityView& view, const CityTargets& targets);
    void shade(const CityView& view, const CityTargets& targets);
    void showRadiance(const CityView& view, const CityTargets& targets);
    void shadeKinds(const CityView& view, bool marked);
    void sunChanged();
    void forgetRadiance() {
        if (kept)
            kept->hasRadiance = false;
    }
};

CityPass::CityPass() : m_impl(std::make_unique<Impl>()) {}
CityPass::~CityPass() = default;

Result<std::unique_ptr<CityPass>> CityPass::create() {
    std::unique_ptr<CityPass> pass(new CityPass);
    Impl& impl = *pass->m_impl;
    auto ids = makeProgram("city_ids");
    if (!ids) {
        return tl::unexpected(ids.error());
    }
    impl.ids = std::move(*ids);
    for (int kind = 0; kind < kShadeKinds; ++kind) {
        auto program = makeProgram("city_shade", {"KIND " + std::to_string(kind)});
        if (!program) {
            return tl::unexpected(program.error());
        }
        impl.kinds[std::size_t(kind)] = std::move(*program);
    }
    auto shadow = SunShadow::create();
    if (!shadow) {
        return tl::unexpected(shadow.error());
    }
    impl.shadow = std::move(*shadow);
    auto marks = ShadowMarks::create();
    if (!marks) {
        return tl::unexpected(marks.error());
    }
    impl.marks = std::move(*marks);
    impl.idTarget = Framebuffer::make();
    impl.radianceTarget = Framebuffer::make();
    impl.sunChanged();
    return pass;
}

void CityPass::Impl::sunChanged() {
    shadow.setSun(glm::dvec3(Sky(lighting).sunDirection()), city ? city->mesh()->bounds : Box{});
}

void CityPass::setCity(const std::shared_ptr<const DrawnCity>& city) {
    m_impl->city.reset();
    m_impl->kept.reset();
    if (city != nullptr) {
        m_impl->city.emplace(city->mesh != nullptr ? city->mesh : buildCityMesh(city));
    }
    m_impl->sunChanged();
}

void CityPass::setLighting(const Lighting& lighting) {
    m_impl->lighting = lighting;
    m_impl->light.setSky(Sky(lighting));
    m_impl->sunChanged();
    m_impl->forgetRadiance();
}

void CityPass::setAmbient(const std::shared_ptr<const AmbientVolume>& ambient) {
    m_impl->light.setAmbient(ambient.get());
    m_impl->forgetRadiance();
}

CityStatistics CityPass::prepareShadows(const glm::dvec3& focus,
                                        std::span<const ShadowCaster> casters, bool moving) {
    CityStatistics statistics;
    statistics.shadowTriangles =
        m_impl->shadow.update(focus, m_impl->city ? &*m_impl->city : nullptr, casters, moving);
    return statistics;
}

void CityPass::Impl::fit(const CityView& view) {
    if (numbers.width() != view.width || numbers.height() != view.height) {
        numbers = Texture::make2D(GL_R32UI, view.width, view.height);
        numbers.filter(GL_NEAREST, GL_NEAREST);
        idTarget.attach(GL_COLOR_ATTACHMENT0, numbers).drawTo(1);
        kept.reset();
    }
}

/// drawNumbers(), or what it left when it drew the same view before. Depths are kept from the
/// second time on: while the camera moves, that would be in vain.
std::size_t CityPass::Impl::showNumbers(const CityView& view, const CityTargets& targets) {
    const bool again = kept && kept->view == view;
    if (again && kept->hasDepth) {
        copyPicture(depth.id(), targets.depth, view);
        return kept->triangles;
    }
    const std::size_t triangles = drawNumbers(view, targets);
    if (again) {
        if (depth.width() != view.width || depth.height() != view.height) {
            depth = Texture::make2D(GL_DEPTH32F_STENCIL8, view.width, view.height);
        }
        copyPicture(targets.depth, depth.id(), view);
    }
    kept = {view, triangles, again};
    return triangles;
}

/// Which triangle each pixel shows, its depth, and in the stencil the kind of its look.
std::size_t CityPass::Impl::drawNumbers(const CityView& view, const CityTargets& targets) {
    glNamedFramebufferTexture(idTarget.id(), GL_DEPTH_STENCIL_ATTACHMENT, targets.depth, 0);
    idTarget.bind();
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_GREATER);
    glStencilMask(0xffU);
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    glClearNamedFramebufferfi(idTarget.id(), GL_DEPTH_STENCIL, 0, 0.0F, 0);
    if (!city) {
        return 0;
    }
    ids.use();
    ids.set("clip_from_eye", view.clip_from_eye());
    ids.set("eye", glm::vec3(view.eye));
    city->bindGeometry();
    const auto order = city->nearestFirst(view.eye);
    const auto choice = [&](const CityChunk& chunk) { return sizesInView(view, chunk); };
    std::size_t triangles = 0;
    // Walls and ground first: much of what is plain (leaves, furniture) is hidden behind them.
    for (int kind = kShadeKinds - 1; kind > 0; --kind) {
        glStencilFunc(GL_ALWAYS, kind, 0xffU);
        triangles += city->draw(order, ShadeKind(kind), choice);
    }
    return triangles;
}

/// All pixels, or those of a view that came again on which the shadows of moving bodies fall.
void CityPass::Impl::shade(const CityView& view, const CityTargets& targets) {
    const unsigned target = radianceTarget.id();
    glNamedFramebufferTexture(target, GL_COLOR_ATTACHMENT0, targets.radiance, 0);
    glNamedFramebufferTexture(target, GL_COLOR_ATTACHMENT1, targets.distance, 0);
    glNamedFramebufferTexture(target, GL_DEPTH_STENCIL_ATTACHMENT, targets.depth, 0);
    radianceTarget.drawTo(targets.distance != 0 ? 2 : 1).bind();
    const bool keeps = kept->hasDepth && targets.distance == 0;
    if (!keeps) {
        light.bind(shadow);
        shadeKinds(view, false);
        return;
    }
    showRadiance(view, targets);
    if (shadow.bodyShadows().casters.empty())
        return;
    radianceTarget.bind();
    marks.draw(view, depth, shadow);
    light.bind(shadow);
    shadeKinds(view, true);
}

/// The picture without shadows of moving bodies, as it was kept or to be kept.
void CityPass::Impl::showRadiance(const CityView& view, const CityTargets& targets) {
    if (kept->hasRadiance && kept->shadows == shadow.version()) {
        copyPicture(radiance.id(), targets.radiance, view);
        return;
    }
    light.bind(shadow, false);
    shadeKinds(view, false);
    GLint format = 0;
    glGetTextureLevelParameteriv(targets.radiance, 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
    if (radiance.width() != view.width || radiance.height() != view.height ||
        radianceFormat != unsigned(format)) {
        radiance = Texture::make2D(unsigned(format), view.width, view.height);
        radianceFormat = unsigned(format);
    }
    copyPicture(targets.radiance, radiance.id(), view);
    kept->hasRadiance = true;
    kept->shadows = shadow.version();
}

/// marked: only pixels that have the mark, which is taken away; else all, of which none has it.
void CityPass::Impl::shadeKinds(const CityView& view, bool marked) {
    glDisable(GL_DEPTH_TEST);
    glDepthMask(GL_FALSE);
    glStencilMask(marked ? ShadowMarks::kMark : 0U);
    glStencilOp(GL_KEEP, GL_KEEP, marked ? GL_ZERO : GL_KEEP);
    glBindTextureUnit(0, numbers.id());
    if (city) {
        city->bindTables();
    }
    empty.bind();
    for (int kind = marked ? 1 : 0; kind < kShadeKinds; ++kind) {
        if (kind > 0 && (!city || !city->has(ShadeKind(kind)))) {
            continue;
        }
        const Program& program = kinds[std::size_t(kind)];
        program.use();
        program.set("eye", glm::vec3(view.eye));
        program.set("forward", view.forward);
        program.set("right", view.right * view.tanHalf.x);
        program.set("up", view.up * view.tanHalf.y);
        program.set("spread", view.spread);
        if (city) {
            program.set("firstTextured", int(city->mesh()->firstTextured));
        }
        glStencilFunc(GL_EQUAL, marked ? kind | int(ShadowMarks::kMark) : kind, 0xffU);
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
    glStencilMask(0xffU);
    glDepthMask(GL_TRUE);
}

CityStatistics CityPass::draw(const CityView& view, const CityTargets& targets) {
    CityStatistics statistics;
    m_impl->fit(view);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glViewport(0, 0, view.width, view.height);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glDisable(GL_SCISSOR_TEST);
    glEnable(GL_STENCIL_TEST);
    statistics.triangles = m_impl->showNumbers(view, targets);
    m_impl->shade(view, targets);
    glDisable(GL_STENCIL_TEST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    return statistics;
}

void CityPass::bindLight() const {
    m_impl->light.bind(m_impl->shadow);
}

}  // namespace reflet
