// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reconstruction/LeafLookup.h"

namespace reflet {

LeafLookup::LeafLookup(const CubeSampler& sampler, const std::array<glm::vec3, 4>& corners,
                       bool manyTexels)
    : m_sampler(sampler), m_oneFace(manyTexels && shareFace(corners)) {
    if (m_oneFace)
        return;
    for (std::size_t k = 0; k < 4; ++k) {
        m_x.corner[k] = corners[k].x;
        m_y.corner[k] = corners[k].y;
        m_z.corner[k] = corners[k].z;
    }
}

bool LeafLookup::shareFace(const std::array<glm::vec3, 4>& corners) {
    if (!(m_sampler.last() > 0.0f))
        return false;
    for (std::size_t k = 0; k < 4; ++k) {
        if (corners[k] == glm::vec3(0.0f))
            return false;
        const FacePoint point = facePoint(corners[k]);
        if (k == 0)
            m_face = point.face;
        const float x = float(point.st.x) * m_sampler.scale() + m_sampler.shift();
        const float y = float(point.st.y) * m_sampler.scale() + m_sampler.shift();
        const bool inside =
            x >= 0.0f && y >= 0.0f && x <= m_sampler.last() && y <= m_sampler.last();
        if (point.face != m_face || !inside)
            return false;
        const float major = std::abs(corners[k][m_face / 2]);
        m_x.corner[k] = float(point.st.x) * major;
        m_y.corner[k] = float(point.st.y) * major;
        m_z.corner[k] = major;
    }
    return true;
}

void LeafLookup::read(const TexelRun& run, std::array<Float4, TexelRun::kMost>& radiance) const {
    m_oneFace ? readOneFace(run, radiance) : readAnyFace(run, radiance);
}

void LeafLookup::readOneFace(const TexelRun& run,
                             std::array<Float4, TexelRun::kMost>& radiance) const {
    const LeafScalar::Line s = m_x.along(run.v);
    const LeafScalar::Line t = m_y.along(run.v);
    const LeafScalar::Line m = m_z.along(run.v);
    const float scale = m_sampler.scale();
    const float shift = m_sampler.shift();
    const float last = m_sampler.last();
    // Rounding may carry a position past the corners, by less than the clamp gives way.
    const auto clamped = [last](float x) { return x > 0.0f ? (x < last ? x : last) : 0.0f; };
    std::array<float, TexelRun::kMost> x, y;
    for (std::size_t i = 0; i < std::size_t(run.count); ++i) {
        const float factor = scale / m.at(run.u[i]);
        x[i] = clamped(s.at(run.u[i]) * factor + shift);
        y[i] = clamped(t.at(run.u[i]) * factor + shift);
    }
    for (std::size_t i = 0; i < std::size_t(run.count); ++i)
        radiance[i] = m_sampler.interior(m_face, x[i], y[i]);
}

void LeafLookup::readAnyFace(const TexelRun& run,
                             std::array<Float4, TexelRun::kMost>& radiance) const {
    const LeafScalar::Line x = m_x.along(run.v);
    const LeafScalar::Line y = m_y.along(run.v);
    const LeafScalar::Line z = m_z.along(run.v);
    for (std::size_t i = 0; i < std::size_t(run.count); ++i) {
        radiance[i] = m_sampler.sample({x.at(run.u[i]), y.at(run.u[i]), z.at(run.u[i])});
    }
}

}  // namespace reflet
