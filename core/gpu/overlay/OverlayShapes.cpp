// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/overlay/OverlayShapes.h"

#include "core/gpu/overlay/CoverageOverlay.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet {

namespace {

constexpr float kBallMetres = 0.28F;    // of a ball near by
constexpr float kBallPixels = 7.0F;     // and never smaller than this
constexpr float kPreviewMetres = 0.7F;  // of a ball that mirrors its map
constexpr float kPreviewPixels = 26.0F;
constexpr float kSelectedScale = 1.25F;
constexpr float kStemPixels = 1.4F;    // half width
constexpr float kRibbonMetres = 0.9F;  // half width of a route
constexpr float kRibbonPixels = 2.0F;
constexpr float kHandlePixels = 7.5F;
constexpr float kLargestHandlePixels = 11.0F;
constexpr float kHandleMetres = 0.3F;
constexpr float kCursorMetres = 0.8F;
constexpr float kCursorPixels = 14.0F;
constexpr float kBandMetres = 1.7F;  // half width of a stretch of a coverage
constexpr float kBandPixels = 4.5F;
constexpr float kGhostMetres = 0.45F;
constexpr float kGhostPixels = 10.0F;
constexpr double kSpotLift = 0.12;       // metres before the façade
constexpr double kSmallSpot = 0.3;       // of a spot's edge, where it is fully covered
constexpr double kLargeSpot = 0.85;      // where it is not covered: that is to be seen first
constexpr float kSpotSlack = 1.0F;       // metres that the heightfield's façade may be off by
constexpr double kFarthestSpot = 250.0;  // metres
constexpr float kNearest = 0.3F;         // metres before the eye at which ribbons end
constexpr double kLift = 0.06;           // metres over the ground
constexpr float kOnGround = 0.35F;       // metres that the ground may be uneven by

constexpr glm::vec4 kStem{1.0F, 1.0F, 1.0F, 0.85F};
constexpr glm::vec4 kRoute{0.0F, 0.447F, 0.698F, 0.55F};
constexpr glm::vec4 kSelectedRoute{0.1F, 0.6F, 0.95F, 0.8F};
constexpr glm::vec4 kHandle{1.0F, 1.0F, 1.0F, 1.0F};
constexpr float kBandOpacity = 0.7F;
constexpr float kSpotOpacity = 0.8F;
constexpr glm::vec4 kCursor{1.0F, 1.0F, 1.0F, 0.9F};

class Builder {
public:
    Builder(const CityView& view, const Heightfield* ground, OverlayShapes& out)
        : m_view(view), m_ground(ground), m_out(out) {}

    [[nodiscard]] glm::vec3 fromEye(const glm::dvec3& p) const { return glm::vec3(p - m_view.eye); }
    [[nodiscard]] float depth(const glm::dvec3& p) const {
        return glm::dot(fromEye(p), m_view.forward);
    }
    /// Metres that so many pixels take at a depth.
    [[nodiscard]] float metres(float pixels, float atDepth) const {
        return pixels * std::max(atDepth, m_view.near) / m_view.pixelsPerRadian();
    }

    void quad(const std::array<glm::vec3, 4>& corners, const std::array<glm::vec2, 4>& uv,
              const glm::vec4& color, OverlayPattern pattern, float slack) {
        for (const std::size_t k : {0U, 1U, 2U, 2U, 1U, 3U}) {
            m_out.triangles.push_back({corners[k], color, glm::vec4(uv[k], float(pattern), slack)});
        }
    }

    /// A square with the given half edges; uv from -1 to 1.
    void patch(const glm::vec3& center, const glm::vec3& right, const glm::vec3& up,
               const glm::vec4& color, OverlayPattern pattern, float slack) {
        quad({center - right - up, center + right - up, center - right + up, center + right + up},
             {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(-1, 1), glm::vec2(1, 1)}, color,
             pattern, slack);
    }

    void onGround(const glm::dvec3& place, float radius, const glm::vec4& color,
                  OverlayPattern pattern) {
        patch(fromEye(place + glm::dvec3(0, 0, kLift)), {radius, 0.0F, 0.0F}, {0.0F, radius, 0.0F},
              color, pattern, kOnGround);
    }

    void facing(const glm::dvec3& place, float radius, const glm::vec4& color,
                OverlayPattern pattern, float slack) {
        patch(fromEye(place), m_view.right * radius, m_view.up * radius, color, pattern, slack);
    }

    void addProbe(const ProbeGlyph& probe) {
        const float atDepth = depth(probe.position);
        if (atDepth < m_view.near)
            return;
        const float radius = ballRadius(probe, m_view, atDepth);
        m_out.balls.push_back({probe.position, radius, probe.state, probe.selected, probe.hovered,
                               probe.preview, probe.id});
        const double foot = groundBelow(probe.position);
        if (probe.position.z - foot <= double(radius))
            return;
        const glm::dvec3 base(probe.position.x, probe.position.y, foot);
        if (depth(base) < m_view.near)
            return;
        const glm::vec3 lower = fromEye(base);
        const glm::vec3 upper = fromEye(probe.position);
        const glm::vec3 side = m_view.right;
        const float w0 = metres(kStemPixels, depth(base));
        const float w1 = metres(kStemPixels, atDepth);
        quad({lower - side * w0, lower + side * w0, upper - side * w1, upper + side * w1},
             {glm::vec2(-1, 0), glm::vec2(1, 0), glm::vec2(-1, 0), glm::vec2(1, 0)}, kStem,
             OverlayPattern::Plain, kOnGround);
        onGround(base, 0.6F * radius, glm::vec4(stateColor(probe.state), 0.8F),
                 OverlayPattern::Disc);
    }

    void addRoute(const RouteGlyph& route) {
        addLine(route.line, {route.selected ? kSelectedRoute : kRoute, OverlayPattern::Ribbon,
                             kRibbonMetres, kRibbonPixels});
        if (!route.selected)
            return;
        for (const glm::dvec3& handle : route.handles) {
            const float atDepth = depth(handle);
            if (atDepth < m_view.near)
                continue;
            const float radius = std::clamp(kHandleMetres, metres(kHandlePixels, atDepth),
                                            metres(kLargestHandlePixels, atDepth));
            facing(handle + glm::dvec3(0, 0, kLift), radius, kHandle, OverlayPattern::Handle,
                   2.0F * radius + kOnGround);
        }
    }

    void addBand(const CoveredBand& band) {
        addLine(band.line, {glm::vec4(coverageColor(band.coverage), kBandOpacity),
                            band.coverage < kPoorlyCovered ? OverlayPattern::HatchedBand
                                                           : OverlayPattern::Band,
                            kBandMetres, kBandPixels});
    }

    void addSpot(const CoveredSpot& spot) {
        const glm::dvec3 middle = spot.middle + kSpotLift * glm::dvec3(spot.normal);
        const double away = glm::distance(middle, m_view.eye);
        if (away > kFarthestSpot || depth(middle) < m_view.near ||
            glm::dot(fromEye(middle), spot.normal) >= 0.0F)
            return;
        const glm::vec3 up =
            std::abs(spot.normal.z) < 0.9F ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
        const glm::vec3 right = glm::normalize(glm::cross(up, spot.normal));
        const auto half = float(
            spot.halfEdge * glm::mix(kLargeSpot, kSmallSpot, std::clamp(spot.coverage, 0.0, 1.0)));
        patch(fromEye(middle), half * right, half * glm::cross(spot.normal, right),
              glm::vec4(coverageColor(spot.coverage), kSpotOpacity),
              spot.coverage < kPoorlyCovered ? OverlayPattern::HollowSpot : OverlayPattern::Spot,
              kSpotSlack);
    }

    void addGhost(const GhostProbe& ghost) {
        const float atDepth = depth(ghost.position);
        if (atDepth < m_view.near)
            return;
        facing(ghost.position, std::max(kGhostMetres, metres(kGhostPixels, atDepth)),
               glm::vec4(kGhostColor, 1.0F), OverlayPattern::Ghost, kOnGround);
    }

    void addCursor(const glm::dvec3& place) {
        const float atDepth = depth(place);
        if (atDepth < m_view.near)
            return;
        onGround(place, std::max(kCursorMetres, metres(kCursorPixels, atDepth)), kCursor,
                 OverlayPattern::Ring);
    }

private:
    [[nodiscard]] double groundBelow(const glm::dvec3& p) const {
        const float height = m_ground != nullptr ? m_ground->groundAt(p.x, p.y) : kMissingHeight;
        return isMissing(height) ? p.z - 2.0 : double(height);
    }

    /// Across the line at one of its points: square to the mean of the directions that meet there.
    [[nodiscard]] static glm::dvec2 across(const std::vector<glm::dvec3>& line, std::size_t i) {
        glm::dvec2 sum(0.0);
        const auto add = [&](std::size_t from, std::size_t to) {
            const glm::dvec2 d(line[to] - line[from]);
            if (glm::length(d) > 1e-9)
                sum += glm::normalize(d);
        };
        if (i > 0)
            add(i - 1, i);
        if (i + 1 < line.size())
            add(i, i + 1);
        return glm::length(sum) > 1e-9 ? glm::dvec2(-sum.y, sum.x) / glm::length(sum)
                                       : glm::dvec2(0.0, 1.0);
    }

    struct LineStyle {
        glm::vec4 color;
        OverlayPattern pattern;
        float halfMetres, leastPixels;  ///< half the width
    };
    void addLine(const std::vector<glm::dvec3>& line, const LineStyle& style) {
        double along = 0.0;
        for (std::size_t i = 1; i < line.size(); ++i) {
            const double length = glm::distance(line[i - 1], line[i]);
            if (length > 0.0)
                addRibbon(line, i, along, style);
            along += length;
        }
    }

    /// The piece of a ribbon from point i - 1 to point i, as far as it lies before the eye.
    void addRibbon(const std::vector<glm::dvec3>& line, std::size_t i, double along,
                   const LineStyle& style) {
        const glm::dvec3 a = line[i - 1];
        const glm::dvec3 b = line[i];
        const double length = glm::distance(a, b);
        const float depthA = depth(a);
        const float depthB = depth(b);
        if (std::max(depthA, depthB) < kNearest)
            return;
        const double crossing =
            depthA == depthB ? 0.0 : double((kNearest - depthA) / (depthB - depthA));
        const std::array<double, 2> shares{depthA < kNearest ? crossing : 0.0,
                                           depthB < kNearest ? crossing : 1.0};
        const std::array<glm::dvec2, 2> sides{across(line, i - 1), across(line, i)};
        std::array<glm::vec3, 4> corners;
        std::array<glm::vec2, 4> uv;
        for (std::size_t k = 0; k < 2; ++k) {
            const glm::dvec3 place = glm::mix(a, b, shares[k]) + glm::dvec3(0, 0, kLift);
            const float half = std::max(style.halfMetres, metres(style.leastPixels, depth(place)));
            const glm::dvec2 side = glm::mix(sides[0], sides[1], shares[k]) * double(half);
            const auto metresAlong = float(along + shares[k] * length);
            corners[2 * k] = fromEye(place + glm::dvec3(side, 0.0));
            corners[2 * k + 1] = fromEye(place - glm::dvec3(side, 0.0));
            uv[2 * k] = {-1.0F, metresAlong};
            uv[2 * k + 1] = {1.0F, metresAlong};
        }
        quad(corners, uv, style.color, style.pattern, kOnGround);
    }

    const CityView& m_view;
    const Heightfield* m_ground;
    OverlayShapes& m_out;
};

}  // namespace

glm::vec3 stateColor(ProbeState state) {
    switch (state) {
        case ProbeState::Fresh:
            return {0.0F, 0.62F, 0.45F};
        case ProbeState::Stale:
            return {0.9F, 0.62F, 0.0F};
        case ProbeState::Baking:
            return {0.34F, 0.71F, 0.91F};
        case ProbeState::Refused:
            return {0.84F, 0.37F, 0.0F};
        case ProbeState::Missing:
            break;
    }
    return {0.75F, 0.75F, 0.75F};
}

float ballRadius(const ProbeGlyph& probe, const CityView& view, float depth) {
    const float perPixel = std::max(depth, view.near) / view.pixelsPerRadian();
    if (probe.preview)
        return std::max(kPreviewMetres, kPreviewPixels * perPixel);
    const float radius = std::max(kBallMetres, kBallPixels * perPixel);
    return probe.selected || probe.hovered ? kSelectedScale * radius : radius;
}

OverlayShapes overlayShapes(const Overlays& overlays, const CityView& view,
                            const Heightfield* ground) {
    OverlayShapes shapes;
    Builder builder(view, ground, shapes);
    if (overlays.coverage) {
        for (const CoveredBand& band : overlays.coverage->bands)
            builder.addBand(band);
        for (const CoveredSpot& spot : overlays.coverage->spots)
            builder.addSpot(spot);
    }
    for (const RouteGlyph& route : overlays.routes)
        builder.addRoute(route);
    if (overlays.coverage)
        for (const GhostProbe& ghost : overlays.coverage->ghosts)
            builder.addGhost(ghost);
    for (const ProbeGlyph& probe : overlays.probes)
        builder.addProbe(probe);
    if (overlays.cursor)
        builder.addCursor(*overlays.cursor);
    std::sort(shapes.balls.begin(), shapes.balls.end(),
              [&](const OverlayBall& a, const OverlayBall& b) {
                  return glm::distance(a.center, view.eye) > glm::distance(b.center, view.eye);
              });
    return shapes;
}

}  // namespace reflet
