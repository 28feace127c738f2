// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/traffic/PlaneShapes.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace reflet {
namespace {

float cross(const glm::vec2& a, const glm::vec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// Adds the arc that rounds the corner b (its ends included), or b itself.
void addCorner(std::vector<glm::vec2>& out, const glm::vec2& a, const glm::vec2& b,
               const glm::vec2& c, float radius, int steps) {
    const glm::vec2 in = glm::normalize(b - a);
    const glm::vec2 next = glm::normalize(c - b);
    const float turn = std::atan2(cross(in, next), glm::dot(in, next));
    const float tangent = std::tan(0.5F * std::abs(turn));
    const float room = 0.499F * std::min(glm::distance(a, b), glm::distance(b, c));
    if (radius <= 0.0F || tangent < 1e-4F) {
        out.push_back(b);
        return;
    }
    const float trim = std::min(radius * tangent, room);
    const float r = trim / tangent;
    const float side = turn > 0.0F ? 1.0F : -1.0F;
    const glm::vec2 start = b - in * trim;
    const glm::vec2 left(-in.y, in.x);
    const glm::vec2 center = start + left * (side * r);
    for (int i = 0; i <= steps; ++i) {
        const float angle = turn * float(i) / float(steps);
        const glm::vec2 spoke = left * (-side * r);
        out.push_back(center + glm::vec2(spoke.x * std::cos(angle) - spoke.y * std::sin(angle),
                                         spoke.x * std::sin(angle) + spoke.y * std::cos(angle)));
    }
}

}  // namespace

float roundedRectangle(const glm::vec2& p, const glm::vec2& lo, const glm::vec2& hi, float radius) {
    const glm::vec2 half = 0.5F * (hi - lo);
    const float r = std::min({radius, half.x, half.y});
    const glm::vec2 q = glm::abs(p - 0.5F * (lo + hi)) - half + r;
    return glm::length(glm::max(q, glm::vec2(0.0F))) + std::min(std::max(q.x, q.y), 0.0F) - r;
}

RoundedPolygon::RoundedPolygon(std::vector<glm::vec2> corners, float radius) {
    const std::size_t n = corners.size();
    for (std::size_t i = 0; i < n; ++i) {
        addCorner(m_outline, corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n], radius, 8);
    }
    for (std::size_t i = 0, j = m_outline.size() - 1; i < m_outline.size(); j = i++) {
        const glm::vec2 edge = m_outline[j] - m_outline[i];
        m_inverse.push_back(1.0F / std::max(glm::dot(edge, edge), 1e-12F));
    }
    m_low = m_high = m_outline.front();
    for (const glm::vec2& q : m_outline) {
        m_low = glm::min(m_low, q);
        m_high = glm::max(m_high, q);
    }
}

float RoundedPolygon::distance(const glm::vec2& p) const {
    // Far away the distance to the bounds will do: nothing is cut there.
    constexpr float kFar = 0.5F;
    const float outside = glm::length(glm::max(glm::max(m_low - p, p - m_high), glm::vec2(0.0F)));
    if (outside > kFar) {
        return outside;
    }
    float nearest = std::numeric_limits<float>::infinity();
    bool inside = false;
    for (std::size_t i = 0, j = m_outline.size() - 1; i < m_outline.size(); j = i++) {
        const glm::vec2& a = m_outline[i];
        const glm::vec2& b = m_outline[j];
        const glm::vec2 edge = b - a;
        const float t = std::clamp(glm::dot(p - a, edge) * m_inverse[i], 0.0F, 1.0F);
        const glm::vec2 away = p - a - edge * t;
        nearest = std::min(nearest, glm::dot(away, away));  // squared
        if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) {
            inside = !inside;
        }
    }
    return inside ? -std::sqrt(nearest) : std::sqrt(nearest);
}

Curve::Curve(std::initializer_list<std::pair<float, float>> knots) {
    for (const auto& [x, y] : knots) {
        m_x.push_back(x);
        m_y.push_back(y);
    }
    const std::size_t n = m_x.size();
    m_slope.assign(n, 0.0F);
    std::vector<float> secant(n, 0.0F);
    for (std::size_t i = 0; i + 1 < n; ++i) {
        secant[i] = (m_y[i + 1] - m_y[i]) / (m_x[i + 1] - m_x[i]);
    }
    for (std::size_t i = 0; i < n; ++i) {
        if (i == 0 || i + 1 == n) {
            m_slope[i] = n > 1 ? secant[i == 0 ? 0 : n - 2] : 0.0F;
        } else if (secant[i - 1] * secant[i] > 0.0F) {
            // Harmonic mean, weighted by the neighbouring spans (Fritsch & Butland 1984).
            const float left = m_x[i] - m_x[i - 1];
            const float right = m_x[i + 1] - m_x[i];
            const float w1 = 2.0F * right + left;
            const float w2 = right + 2.0F * left;
            m_slope[i] = (w1 + w2) / (w1 / secant[i - 1] + w2 / secant[i]);
        }
    }
}

float Curve::operator()(float x) const {
    if (x <= m_x.front()) {
        return m_y.front();
    }
    if (x >= m_x.back()) {
        return m_y.back();
    }
    const auto i = std::size_t(std::upper_bound(m_x.begin(), m_x.end(), x) - m_x.begin()) - 1;
    const float h = m_x[i + 1] - m_x[i];
    const float t = (x - m_x[i]) / h;
    const float t2 = t * t;
    const float t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * m_y[i] + (t3 - 2 * t2 + t) * h * m_slope[i] +
           (-2 * t3 + 3 * t2) * m_y[i + 1] + (t3 - t2) * h * m_slope[i + 1];
}

std::vector<glm::vec2> roundedPath(const std::vector<PathCorner>& corners, float step,
                                   int arcSteps) {
    std::vector<glm::vec2> sparse{corners.front().point};
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        addCorner(sparse, corners[i - 1].point, corners[i].point, corners[i + 1].point,
                  corners[i].radius, arcSteps);
    }
    sparse.push_back(corners.back().point);
    std::vector<glm::vec2> result{sparse.front()};
    for (std::size_t i = 1; i < sparse.size(); ++i) {
        const float length = glm::distance(sparse[i - 1], sparse[i]);
        if (length < 1e-5F) {
            continue;
        }
        const int pieces = std::max(1, int(std::ceil(length / step - 1e-4F)));
        for (int k = 1; k <= pieces; ++k) {
            result.push_back(glm::mix(sparse[i - 1], sparse[i], float(k) / float(pieces)));
        }
    }
    return result;
}

}  // namespace reflet
