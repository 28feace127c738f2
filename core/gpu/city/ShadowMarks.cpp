// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/city/ShadowMarks.h"

#include "core/gpu/base/ShaderLibrary.h"

#include <epoxy/gl.h>

#include <cmath>

namespace reflet {

namespace {

/// Texels of the shadow map by which boxes count as larger: what the lookup is shifted off the
/// surface (two at most), the texels that it is filtered over,
/// and one by which bodies are coarser in their shadows.
constexpr double kMarginTexels = 5.0;
constexpr double kMargin = 0.05;  ///< and metres, for a map that is very fine

/// The box about a caster's shadow: axes of the maps, relative to the eye.
Box shadowVolume(const ShadowCaster& caster, const CityView& view, const SunShadow& shadow,
                 double margin) {
    Box volume;
    for (int k = 0; k < 8; ++k) {
        const Box& box = caster.box;
        const glm::dvec3 corner(k & 1 ? box.max.x : box.min.x, k & 2 ? box.max.y : box.min.y,
                                k & 4 ? box.max.z : box.min.z);
        const glm::dvec3 placed =
            glm::dvec3(glm::dmat4(caster.project_from_body) * glm::dvec4(corner, 1.0)) - view.eye;
        volume.add({glm::dot(placed, shadow.right()), glm::dot(placed, shadow.up()),
                    glm::dot(placed, shadow.sun())});
    }
    volume.min -= margin;
    volume.max += margin;
    volume.min.z = shadow.bodyShadows().lowest - glm::dot(view.eye, shadow.sun()) - margin;
    return volume;
}

}  // namespace

Result<ShadowMarks> ShadowMarks::create() {
    auto program = makeProgram("shadow_marks");
    if (!program)
        return tl::unexpected(program.error());
    ShadowMarks marks;
    marks.m_program = std::move(*program);
    marks.m_noAttributes = VertexArray::make();
    return marks;
}

void ShadowMarks::draw(const CityView& view, const Texture& depth, const SunShadow& shadow) const {
    const SunShadow::BodyShadows& fallen = shadow.bodyShadows();
    const double margin = kMarginTexels * fallen.texel + kMargin;
    glDisable(GL_DEPTH_TEST);
    glDepthMask(GL_FALSE);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glStencilMask(kMark);
    glStencilFunc(GL_ALWAYS, GLint(kMark), 0xffU);
    glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    glEnable(GL_CULL_FACE);  // far sides only: the eye may be inside
    glCullFace(GL_FRONT);
    glFrontFace(GL_CCW);
    depth.bind(0);
    m_noAttributes.bind();
    m_program.use();
    m_program.set("clip_from_eye", view.clip_from_eye());
    m_program.set("forward", view.forward);
    m_program.set("near", view.near);
    m_program.set("axes", glm::mat3(glm::dmat3(shadow.right(), shadow.up(), shadow.sun())));
    for (const ShadowCaster& caster : fallen.casters) {
        if (caster.box.empty())
            continue;
        const Box volume = shadowVolume(caster, view, shadow, margin);
        glm::dmat4 eye_from_body(caster.project_from_body);
        eye_from_body[3] -= glm::dvec4(view.eye, 0.0);
        m_program.set("lower", glm::vec3(volume.min));
        m_program.set("upper", glm::vec3(volume.max));
        m_program.set("body_from_eye", glm::mat4(glm::inverse(eye_from_body)));
        m_program.set("boxLower", glm::vec3(caster.box.min - margin));
        m_program.set("boxUpper", glm::vec3(caster.box.max + margin));
        glDrawArrays(GL_TRIANGLES, 0, 36);
    }
    glDisable(GL_CULL_FACE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

}  // namespace reflet
