// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/city/SunShadow.h"

#include "core/gpu/base/GlVersion.h"
#include "core/gpu/base/ShaderLibrary.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace reflet {

namespace {

constexpr int kEdge = 2048;             ///< texels of a cascade
constexpr int kVehicleEdge = 1024;      ///< and of the map of vehicles
constexpr double kNearest = 40.0;       ///< metres from the middle of the first square to its sides
constexpr double kGrowth = 4.0;         ///< of each square against the one before
constexpr double kStep = 0.5;           ///< squares move by this share of their half
constexpr double kVehicleReach = 80.0;  ///< metres from the focus; further ones throw no shadow
constexpr double kVehicleBelow = 30.0;  ///< metres that their shadow may fall below them
constexpr double kMargin = 2.0;         ///< metres around the city's depths
/// Of its half: how far a square may be from where it should be, and serve while that is drawn.
constexpr double kServes = 0.8;
constexpr std::size_t kTrianglesAtOnce = 40'000;  ///< of a square that is drawn in parts, about

Texture depthMap(int edge, int layers) {
    Texture map = layers == 1 ? Texture::make2D(GL_DEPTH_COMPONENT32F, edge, edge)
                              : Texture::makeArray(GL_DEPTH_COMPONENT32F, edge, edge, layers);
    map.filter(GL_LINEAR, GL_LINEAR);
    glTextureParameteri(map.id(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTextureParameteri(map.id(), GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    const float far = 1.0F;
    glClearTexImage(map.id(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, &far);
    return map;
}

/// The state in which depth alone is drawn; the caller's is not kept.
void beginDepth(int edge) {
    glViewport(0, 0, edge, edge);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_SCISSOR_TEST);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_DEPTH_CLAMP);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
}

/// The coarsest level that a map of such texels does not tell from the body: the lookup itself is
/// shifted by more than a texel, and filtered.
const ShadowCaster::Level& levelFor(const ShadowCaster& caster, double texel) {
    const auto finer =
        std::find_if(caster.levels.begin() + 1, caster.levels.end(),
                     [&](const ShadowCaster::Level& level) { return level.error > texel; });
    return *(finer - 1);
}

void endDepth() {
    glDisable(GL_DEPTH_CLAMP);
    glDisable(GL_DEPTH_TEST);
}

}  // namespace

Result<SunShadow> SunShadow::create() {
    auto program = makeProgram("city_depth");
    if (!program) {
        return tl::unexpected(program.error());
    }
    SunShadow shadow;
    shadow.m_program = std::move(*program);
    shadow.m_maps = depthMap(kEdge, kCascades + 1);
    shadow.m_slow = contextDrawsInSoftware();
    shadow.m_vehicleMap = depthMap(kVehicleEdge, 1);
    shadow.m_framebuffer = Framebuffer::make();
    shadow.m_framebuffer.attach(GL_DEPTH_ATTACHMENT, shadow.m_maps, 0, 0).drawTo(0);
    shadow.m_vehicleFramebuffer = Framebuffer::make();
    shadow.m_vehicleFramebuffer.attach(GL_DEPTH_ATTACHMENT, shadow.m_vehicleMap).drawTo(0);
    for (const Framebuffer* framebuffer : {&shadow.m_framebuffer, &shadow.m_vehicleFramebuffer}) {
        if (auto sound = framebuffer->check("shadow map"); !sound) {
            return tl::unexpected(sound.error());
        }
    }
    return shadow;
}

void SunShadow::setSun(const glm::dvec3& direction, const Box& city) {
    m_sun = glm::normalize(direction);
    const glm::dvec3 axis =
        std::abs(m_sun.z) < 0.99 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(0.0, 1.0, 0.0);
    m_right = glm::normalize(glm::cross(axis, m_sun));
    m_up = glm::cross(m_sun, m_right);
    m_squares = {};
    m_work = {};
    m_bodyShadows = {};
    ++m_version;
    const glm::dvec3 center = city.empty() ? glm::dvec3(0.0) : city.center();
    const glm::dvec3 half = 0.5 * city.size();
    const auto reach = [&](const glm::dvec3& a) { return glm::dot(glm::abs(a), half); };
    m_cityCenter = {glm::dot(center, m_right), glm::dot(center, m_up)};
    m_cityHalf = std::max({reach(m_right), reach(m_up), 1.0}) + kMargin;
    const double middle = glm::dot(center, m_sun);
    m_range = {middle - reach(m_sun) - kMargin, middle + reach(m_sun) + kMargin};
}

glm::mat4 SunShadow::clip_from_project(const Square& square, const Range& range) const {
    const double scale = 1.0 / square.half;
    const double depth = 1.0 / (range.high - range.low);
    // Rows: right, up, away from the sun (0 to 1).
    const glm::dvec4 x(m_right * scale, -square.center.x * scale);
    const glm::dvec4 y(m_up * scale, -square.center.y * scale);
    const glm::dvec4 z(-m_sun * depth, range.high * depth);
    return glm::mat4(glm::transpose(glm::dmat4(x, y, z, glm::dvec4(0.0, 0.0, 0.0, 1.0))));
}

SunShadow::Lookup SunShadow::lookup(bool bodies) const {
    Lookup result;
    result.axes = {glm::vec4(m_right, 0.0), glm::vec4(m_up, 0.0), glm::vec4(-m_sun, m_range.high)};
    result.depth = {1.0 / (m_range.high - m_range.low),
                    1.0 / (m_vehicleRange.high - m_vehicleRange.low), m_vehicleRange.high, 0.0};
    const auto place = [](const Square& s, int edge) {
        const double scale = 0.5 / std::max(s.half, 1e-3);
        return glm::vec4(scale, 0.5 - s.center.x * scale, 0.5 - s.center.y * scale,
                         2.0 * s.half / edge);
    };
    for (std::size_t i = 0; i < kCascades; ++i) {
        result.squares[i] = place(m_squares[i], kEdge);
    }
    for (int i = 0; i < kCascades; ++i)
        result.layers[i] = float(m_layers[std::size_t(i)]);
    result.squares[kCascades] = place(bodies ? m_vehicleSquare : Square{}, kVehicleEdge);
    return result;
}

SunShadow::Square SunShadow::squareOf(int cascade, const glm::dvec3& focus) const {
    const double half = kNearest * std::pow(kGrowth, cascade);
    if (cascade == kCascades - 1 || half >= m_cityHalf) {
        return {m_cityCenter, m_cityHalf};
    }
    const double step = kStep * half;
    const glm::dvec2 at(glm::dot(focus, m_right), glm::dot(focus, m_up));
    return {glm::round(at / step) * step, half};
}

std::size_t SunShadow::update(const glm::dvec3& focus, CityBuffers* buffers,
                              std::span<const ShadowCaster> casters, bool inParts) {
    inParts = inParts && m_slow && buffers != nullptr;
    std::size_t triangles = 0;
    for (int i = 0; i < kCascades; ++i) {
        Square& kept = m_squares[std::size_t(i)];
        const Square wanted = squareOf(i, focus);
        const double away = glm::distance(kept.center, wanted.center);
        const bool alike = kept.half == wanted.half;
        const bool working = m_work.cascade == i;
        if (alike && away <= 0.6 * kStep * kept.half) {
            if (working)  // the focus has come back
                m_work = {};
            continue;
        }
        if (inParts && alike && away <= kServes * kept.half) {
            const bool isOther = working && m_work.square.center != wanted.center;
            if (m_work.cascade < 0 || isOther)
                m_work = {i, wanted, buffers->nearestFirst(m_sun * 1e5), 0};
            continue;
        }
        if (working)
            m_work = {};
        kept = wanted;
        ++m_version;
        if (buffers != nullptr) {
            triangles += drawChunks(kept, m_layers[std::size_t(i)],
                                    buffers->nearestFirst(m_sun * 1e5), true, *buffers);
        }
    }
    if (m_work.cascade >= 0 && buffers != nullptr)
        triangles += drawPart(*buffers);
    drawVehicles(focus, casters);
    return triangles;
}

/// The next part of the square that is being drawn; once it is whole, it takes the place of the
/// old one.
std::size_t SunShadow::drawPart(CityBuffers& buffers) {
    const CityMesh& mesh = *buffers.mesh();
    const auto choice = choiceOf(m_work.square);
    const std::size_t first = m_work.done;
    std::size_t triangles = 0;
    while (m_work.done < m_work.chunks.size() && triangles < kTrianglesAtOnce) {
        const CityChunk& chunk = mesh.chunks[m_work.chunks[m_work.done++]];
        const SizeRange sizes = choice(chunk);
        if (sizes.least < sizes.limit)
            triangles += trianglesOfSize(mesh, chunk, sizes.least);
    }
    const auto at = [&](std::size_t n) { return m_work.chunks.begin() + std::ptrdiff_t(n); };
    triangles =
        drawChunks(m_work.square, m_spare, {at(first), at(m_work.done)}, first == 0, buffers);
    if (m_work.done == m_work.chunks.size()) {
        const auto cascade = std::size_t(m_work.cascade);
        std::swap(m_layers[cascade], m_spare);
        m_squares[cascade] = m_work.square;
        m_work = {};
        ++m_version;
    }
    return triangles;
}

CityBuffers::Choice SunShadow::choiceOf(const Square& square) const {
    const auto texel = float(2.0 * square.half / kEdge);
    return [this, square, texel](const CityChunk& chunk) {
        const glm::dvec3 half = 0.5 * chunk.bounds.size();
        const glm::dvec3 center = chunk.bounds.center();
        const glm::dvec2 at(glm::dot(center, m_right), glm::dot(center, m_up));
        const glm::dvec2 reach(glm::dot(glm::abs(m_right), half), glm::dot(glm::abs(m_up), half));
        const glm::dvec2 gap = glm::abs(at - square.center) - reach;
        const bool outside = std::max(gap.x, gap.y) > square.half;
        return outside || chunk.thinned > 0 ? kNoSizes : SizeRange{0.5F * texel};
    };
}

/// Into a layer; the first ones of a square clear it.
std::size_t SunShadow::drawChunks(const Square& square, int layer,
                                  const std::vector<std::uint32_t>& chunks, bool first,
                                  CityBuffers& buffers) {
    m_framebuffer.attach(GL_DEPTH_ATTACHMENT, m_maps, 0, layer);
    m_framebuffer.bind();
    beginDepth(kEdge);
    const float far = 1.0F;
    if (first)
        glClearNamedFramebufferfv(m_framebuffer.id(), GL_DEPTH, 0, &far);
    m_program.use();
    m_program.set("clip_from_model", clip_from_project(square, m_range));
    buffers.bindGeometry();
    const auto choice = choiceOf(square);
    std::size_t triangles = 0;
    for (int kind = 1; kind < kShadeKinds; ++kind)
        triangles += buffers.draw(chunks, ShadeKind(kind), choice);
    endDepth();
    return triangles;
}

void SunShadow::drawVehicles(const glm::dvec3& focus, std::span<const ShadowCaster> casters) {
    Box bounds;
    std::vector<const ShadowCaster*> near;
    for (const ShadowCaster& caster : casters) {
        if (!caster.levels.empty() && !caster.bounds.empty() &&
            distanceTo(caster.bounds, focus) < kVehicleReach) {
            near.push_back(&caster);
            bounds.add(caster.bounds);
        }
    }
    m_vehicleSquare = {};
    m_bodyShadows = {};
    if (near.empty()) {
        return;
    }
    // A square about their boxes; depth from the highest of them down to where shadows fall.
    const glm::dvec3 half = 0.5 * bounds.size() + 0.2;
    const auto along = [&](const glm::dvec3& a) { return glm::dot(glm::abs(a), half); };
    m_vehicleSquare = {{glm::dot(bounds.center(), m_right), glm::dot(bounds.center(), m_up)},
                       std::max(along(m_right), along(m_up))};
    const double middle = glm::dot(bounds.center(), m_sun);
    m_vehicleRange = {middle - along(m_sun) - kVehicleBelow, middle + along(m_sun)};
    m_bodyShadows.lowest = m_vehicleRange.low;
    m_bodyShadows.texel = 2.0 * m_vehicleSquare.half / kVehicleEdge;
    const glm::mat4 matrix = clip_from_project(m_vehicleSquare, m_vehicleRange);
    m_vehicleFramebuffer.bind();
    beginDepth(kVehicleEdge);
    const float far = 1.0F;
    glClearNamedFramebufferfv(m_vehicleFramebuffer.id(), GL_DEPTH, 0, &far);
    m_program.use();
    for (const ShadowCaster* caster : near) {
        m_bodyShadows.casters.push_back(*caster);
        m_program.set("clip_from_model", matrix * caster->project_from_body);
        glBindVertexArray(caster->vertexArray);
        const ShadowCaster::Level& level = levelFor(*caster, m_bodyShadows.texel);
        const std::size_t offset = std::size_t(level.firstIndex) * sizeof(std::uint32_t);
        glDrawElements(GL_TRIANGLES, level.indexCount, GL_UNSIGNED_INT,
                       reinterpret_cast<const void*>(offset));
    }
    endDepth();
}

void SunShadow::bind(unsigned cityUnit, unsigned vehicleUnit) const {
    m_maps.bind(cityUnit);
    m_vehicleMap.bind(vehicleUnit);
}

}  // namespace reflet
