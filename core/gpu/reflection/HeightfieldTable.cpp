// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/reflection/HeightfieldTable.h"

#include <epoxy/gl.h>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace reflet {

namespace {

constexpr unsigned kHeights = 6, kHollows = 7, kStretches = 8;
constexpr int kLevels = 7;  // of the pyramid: blocks of 64 x 64 cells are the largest
constexpr float kNothing = -std::numeric_limits<float>::infinity();
constexpr float kEnd = std::numeric_limits<float>::infinity();

/// A texture's levels halve exactly when its edges are multiples of the largest block.
int paddedEdge(int cells) {
    constexpr int kBlock = 1 << (kLevels - 1);
    return (cells + kBlock - 1) / kBlock * kBlock;
}

void uploadLevel(const Texture& texture, int level, const MaxPyramid::Level& values) {
    const int width = texture.width() >> level;
    const int height = texture.height() >> level;
    std::vector<float> texels(std::size_t(width) * std::size_t(height), kNothing);
    for (int row = 0; row < std::min(height, values.rows); ++row) {
        const float* from = values.maximum.data() + std::ptrdiff_t(row) * values.columns;
        std::transform(from, from + std::min(width, values.columns),
                       texels.begin() + std::ptrdiff_t(row) * width,
                       [](float h) { return isMissing(h) ? kNothing : h; });
    }
    glTextureSubImage2D(texture.id(), level, 0, 0, width, height, GL_RED, GL_FLOAT, texels.data());
}

}  // namespace

bool HeightfieldTable::fits(const GridSpec& grid) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
    return std::max(paddedEdge(grid.columns), paddedEdge(grid.rows)) <= most;
}

HeightfieldTable::HeightfieldTable(const HeightfieldTracer& tracer) : m_grid(tracer.grid()) {
    const GridSpec& grid = m_grid;
    const MaxPyramid pyramid = buildMaxPyramid(grid, tracer.layer());
    m_heights = Texture::make2D(GL_R32F, paddedEdge(grid.columns), paddedEdge(grid.rows), kLevels);
    m_heights.filter(GL_NEAREST_MIPMAP_NEAREST, GL_NEAREST);
    m_top = kNothing;
    for (int level = 0; level < kLevels; ++level) {
        const auto at = std::min(std::size_t(level), pyramid.levels.size() - 1);
        uploadLevel(m_heights, level, pyramid.levels[at]);
    }
    for (const float h : pyramid.levels.back().maximum)
        m_top = isMissing(h) ? m_top : std::max(m_top, double(h));

    const CellSpans& spans = tracer.spans();
    m_hasHollows = !spans.empty();
    std::vector<glm::vec2> stretches;
    m_hollows =
        Texture::make2D(GL_R32UI, m_hasHollows ? grid.columns : 1, m_hasHollows ? grid.rows : 1);
    m_hollows.filter(GL_NEAREST, GL_NEAREST);
    if (m_hasHollows) {
        std::vector<std::uint32_t> first(grid.cellCount(), 0);
        for (const std::uint32_t cell : spans.cells()) {
            first[cell] = std::uint32_t(stretches.size()) + 1;
            for (const HeightSpan& span : spans.at(cell))
                stretches.emplace_back(span.low, span.high);
            stretches.emplace_back(kEnd, kEnd);
        }
        glTextureSubImage2D(m_hollows.id(), 0, 0, 0, grid.columns, grid.rows, GL_RED_INTEGER,
                            GL_UNSIGNED_INT, first.data());
    } else {
        stretches.emplace_back(kEnd, kEnd);
    }
    m_stretches = Buffer(std::span<const glm::vec2>(stretches));
    m_stretchView = Texture::viewOf(GL_RG32F, m_stretches);
}

void HeightfieldTable::bind(const Program& program, const glm::dvec3& position) const {
    m_heights.bind(kHeights);
    m_hollows.bind(kHollows);
    m_stretchView.bind(kStretches);
    program.set("fieldFrom", glm::vec2(glm::dvec2(m_grid.x0, m_grid.y0) - glm::dvec2(position)));
    program.set("fieldBase", float(position.z));
    program.set("fieldTop", float(m_top - position.z));
    program.set("cellSize", float(m_grid.cellSize));
    program.set("fieldCells", glm::ivec2(m_grid.columns, m_grid.rows));
    program.set("fieldHasHollows", int(m_hasHollows));
}

}  // namespace reflet
