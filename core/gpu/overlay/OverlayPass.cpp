// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/overlay/OverlayPass.h"

#include "core/gpu/base/GlState.h"
#include "core/gpu/base/ShaderLibrary.h"
#include "core/gpu/reflection/VisibleBodies.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace reflet {

namespace {

constexpr int kReliefCells = 240;     // along an edge of the relief, around the eye
constexpr int kVerticesPerCell = 18;  // a top and two walls
constexpr int kOutlinePixels = 3;
constexpr double kSmallestScale = 0.1;  // of a picture against the one that is shown
constexpr glm::vec3 kOutline{1.0F, 0.78F, 0.1F};

void blendOver() {
    glEnable(GL_BLEND);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
}

}  // namespace

Result<std::unique_ptr<OverlayPass>> OverlayPass::create() {
    std::unique_ptr<OverlayPass> pass(new OverlayPass);
    for (const auto& [program, name] : {std::pair{&pass->m_flat, "overlay_flat"},
                                        {&pass->m_ball, "overlay_ball"},
                                        {&pass->m_relief, "overlay_relief"},
                                        {&pass->m_mask, "overlay_mask"},
                                        {&pass->m_outline, "overlay_outline"}}) {
        auto made = makeProgram(name);
        if (!made)
            return tl::unexpected(made.error());
        *program = std::move(*made);
    }
    pass->m_noAttributes = VertexArray::make();
    pass->m_maskFramebuffer = Framebuffer::make();
    pass->m_noMap = Texture::makeCubeArray(GL_RGBA16F, 1, 1);
    return pass;
}

void OverlayPass::setHeightfield(std::shared_ptr<const Heightfield> field) {
    m_field = std::move(field);
    m_heights = {};
}

void OverlayPass::setView(const Program& program, const CityView& view,
                          const FrameTargets& targets) const {
    program.set("clip_from_eye", view.clip_from_eye());
    program.set("forward", view.forward);
    program.set("near", view.near);
    program.set("samplesPerEdge", targets.samplesPerEdge());
}

void OverlayPass::draw(const Overlays& overlays, const Scene& scene, FrameTargets& targets) {
    const CityView view = cityView(scene.camera, targets.width(), targets.height());
    resetGlState();
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    targets.display().bind();
    glViewport(0, 0, targets.width(), targets.height());
    targets.depth().bind(0);
    blendOver();
    if (overlays.heightfield && m_field)
        drawRelief(view, targets);
    // What has a size in pixels has it in the picture that people see.
    const double scale = std::clamp(double(scene.scale), kSmallestScale, 1.0);
    const CityView shown = cityView(scene.camera, int(std::lround(targets.width() / scale)),
                                    int(std::lround(targets.height() / scale)));
    const OverlayShapes shapes = overlayShapes(overlays, shown, m_field.get());
    if (!shapes.triangles.empty())
        drawTriangles(shapes, view, targets);
    if (!scene.outlined.empty())
        drawOutline(scene, view, targets);
    if (!shapes.balls.empty())
        drawBalls(shapes, scene, view, targets);
    resetGlState();
}

void OverlayPass::drawRelief(const CityView& view, const FrameTargets& targets) {
    const GridSpec& grid = m_field->grid;
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (grid.columns < 1 || grid.rows < 1 || std::max(grid.columns, grid.rows) > largest)
        return;
    if (!m_heights) {
        m_heights = Texture::make2D(GL_R32F, grid.columns, grid.rows);
        m_heights.filter(GL_NEAREST, GL_NEAREST);
        glTextureSubImage2D(m_heights.id(), 0, 0, 0, grid.columns, grid.rows, GL_RED, GL_FLOAT,
                            m_field->topCenter.data());
    }
    const int across = std::min({kReliefCells, grid.columns, grid.rows});
    const auto first = [&](int middle, int cells) {
        return std::clamp(middle - across / 2, 0, cells - across);
    };
    const glm::dvec2 place =
        glm::dvec2(view.eye) + 0.35 * across * grid.cellSize * glm::dvec2(view.forward);
    const int column = first(grid.column(place.x), grid.columns);
    const int row = first(grid.row(place.y), grid.rows);
    setView(m_relief, view, targets);
    m_heights.bind(1);
    m_relief.set("across", across);
    m_relief.set("firstColumn", column);
    m_relief.set("firstRow", row);
    m_relief.set("cellSize", float(grid.cellSize));
    m_relief.set("corner",
                 glm::vec3(glm::dvec3(grid.xMin(column), grid.yMin(row), 0.0) - view.eye));
    m_noAttributes.bind();
    m_relief.use();
    glDrawArrays(GL_TRIANGLES, 0, kVerticesPerCell * across * across);
}

void OverlayPass::drawTriangles(const OverlayShapes& shapes, const CityView& view,
                                const FrameTargets& targets) {
    const unsigned before = m_vertices.id();
    m_vertices.writeGrowing(shapes.triangles.size() * sizeof(OverlayVertex),
                            shapes.triangles.data());
    if (m_vertices.id() != before || !m_array) {
        m_array = VertexArray::make();
        const std::size_t stride = sizeof(OverlayVertex);
        m_array.floats(0, 3, m_vertices, stride, offsetof(OverlayVertex, fromEye));
        m_array.floats(1, 4, m_vertices, stride, offsetof(OverlayVertex, color));
        m_array.floats(2, 4, m_vertices, stride, offsetof(OverlayVertex, pattern));
    }
    setView(m_flat, view, targets);
    m_array.bind();
    m_flat.use();
    glDrawArrays(GL_TRIANGLES, 0, GLsizei(shapes.triangles.size()));
}

void OverlayPass::drawBalls(const OverlayShapes& shapes, const Scene& scene, const CityView& view,
                            const FrameTargets& targets) {
    setView(m_ball, view, targets);
    m_ball.set("right", view.right);
    m_ball.set("up", view.up);
    m_ball.set("exposure", scene.exposure);
    m_noAttributes.bind();
    m_ball.use();
    for (const OverlayBall& ball : shapes.balls) {
        RemSet::Pointer map;
        if (ball.preview && scene.rems != nullptr && scene.store != nullptr) {
            for (const RemSet::Pointer& rem : scene.rems->pointers())
                map = rem->id == ball.id ? rem : map;
        }
        const RemStore::Place place =
            map ? scene.store->places(map, nullptr).a : RemStore::Place{m_noMap.id(), 0};
        glBindTextureUnit(1, place.texture);
        m_ball.set("cube", map ? place.cube : -1);
        m_ball.set("center", glm::vec3(ball.center - view.eye));
        m_ball.set("radius", ball.radius);
        m_ball.set("color", stateColor(ball.state));
        m_ball.set("state", int(ball.state));
        m_ball.set("selected", int(ball.selected));
        m_ball.set("hovered", int(ball.hovered));
        glDrawArrays(GL_TRIANGLES, 0, 6);
    }
}

/// A mask of the bodies, then a line around it, within the columns that they take.
void OverlayPass::drawOutline(const Scene& scene, const CityView& view,
                              const FrameTargets& targets) {
    float from = 1.0F;
    float to = 0.0F;
    for (const DrawnBody& body : scene.outlined) {
        if (const auto columns = columnsOf(body.mesh->bounds, body.project_from_body, view)) {
            from = std::min(from, columns->from);
            to = std::max(to, columns->to);
        }
    }
    if (from >= to)
        return;
    if (m_maskTexture.width() != view.width || m_maskTexture.height() != view.height) {
        m_maskTexture = Texture::make2D(GL_R8, view.width, view.height);
        m_maskFramebuffer.attach(GL_COLOR_ATTACHMENT0, m_maskTexture);
    }
    const float empty[] = {0.0F, 0.0F, 0.0F, 0.0F};
    glClearNamedFramebufferfv(m_maskFramebuffer.id(), GL_COLOR, 0, empty);
    glDisable(GL_BLEND);
    m_maskFramebuffer.bind();
    m_mask.use();
    setView(m_mask, view, targets);
    for (const DrawnBody& body : scene.outlined) {
        glm::mat4 matrix(glm::mat3(body.project_from_body.rotation));
        matrix[3] = glm::vec4(glm::vec3(body.project_from_body.translation - view.eye), 1.0F);
        m_mask.set("eye_from_body", matrix);
        body.mesh->array.bind();
        glDrawElements(
            GL_TRIANGLES, body.level.count(), GL_UNSIGNED_INT,
            reinterpret_cast<const void*>(sizeof(std::uint32_t) * std::size_t(body.level.first)));
    }
    targets.display().bind();
    blendOver();
    const int thickness = std::max(1, int(std::lround(float(kOutlinePixels) * scene.scale)));
    const int first = int(from * float(view.width)) - thickness;
    const int last = int(std::ceil(to * float(view.width))) + thickness;
    glEnable(GL_SCISSOR_TEST);
    glScissor(std::max(first, 0), 0, std::min(last, view.width) - std::max(first, 0), view.height);
    m_maskTexture.bind(0);
    m_outline.set("color", kOutline);
    m_outline.set("width", thickness);
    m_noAttributes.bind();
    m_outline.use();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_SCISSOR_TEST);
    targets.depth().bind(0);
}

}  // namespace reflet
