// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/city/CityBuffers.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace reflet {

namespace {

Texture uploadPages(const TexturePages& pages) {
    if (pages.layers == 0) {
        Texture none = Texture::makeArray(GL_SRGB8_ALPHA8, 1, 1, 1);
        none.filter(GL_LINEAR, GL_LINEAR);
        return none;
    }
    Texture texture = Texture::makeArray(GL_SRGB8_ALPHA8, pages.edge, pages.edge, pages.layers);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTextureSubImage3D(texture.id(), 0, 0, 0, 0, pages.edge, pages.edge, pages.layers, GL_RGBA,
                        GL_UNSIGNED_BYTE, pages.rgba.data());
    texture.filter(GL_LINEAR, GL_LINEAR);
    return texture;
}

/// Whether a box lies outside a view for sure.
bool outOfView(const CityView& view, const Box& bounds) {
    const glm::dvec3 center = bounds.center() - view.eye;
    const glm::dvec3 half = 0.5 * bounds.size();
    // Outside when the whole box lies behind one of the planes through the eye (or the near one).
    const glm::dvec3 forward(view.forward);
    const auto behind = [&](const glm::dvec3& normal, double offset) {
        return glm::dot(normal, center) + glm::dot(glm::abs(normal), half) < offset;
    };
    for (const double sign : {-1.0, 1.0}) {
        const glm::dvec3 x = double(view.tanHalf.x) * forward + sign * glm::dvec3(view.right);
        const glm::dvec3 y = double(view.tanHalf.y) * forward + sign * glm::dvec3(view.up);
        if (behind(x, 0.0) || behind(y, 0.0)) {
            return true;
        }
    }
    return behind(forward, view.near);
}

}  // namespace

TableTexture::TableTexture(const std::vector<TableTexel>& texels)
    : m_buffer(std::max<std::size_t>(texels.size(), 1) * sizeof(TableTexel)) {
    if (!texels.empty()) {
        m_buffer.write(0, texels.size() * sizeof(TableTexel), texels.data());
    }
    unsigned id = 0;
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &id);
    m_texture = GlName<deleteTexture>(id);
    glTextureBuffer(id, GL_RGBA32UI, m_buffer.id());
}

void TableTexture::bind(unsigned unit) const {
    glBindTextureUnit(unit, m_texture.id());
}

CityBuffers::CityBuffers(std::shared_ptr<const CityMesh> mesh)
    : m_mesh(std::move(mesh)),
      m_vertices(std::span<const CityVertex>(m_mesh->vertices)),
      m_indices(std::span<const std::uint32_t>(m_mesh->indices)),
      m_vertexArray(VertexArray::make()),
      m_triangles(m_mesh->triangles),
      m_surfaces(m_mesh->surfaces),
      m_facades(m_mesh->facades),
      m_walls(m_mesh->walls),
      m_mapping(m_mesh->mapping),
      m_pages(uploadPages(m_mesh->textures)) {
    m_vertexArray.floats(0, 3, m_vertices, sizeof(CityVertex), offsetof(CityVertex, position));
    m_vertexArray.integers(1, 1, m_vertices, sizeof(CityVertex), offsetof(CityVertex, triangle));
    m_vertexArray.indices(m_indices);
}

bool CityBuffers::has(ShadeKind kind) const {
    return std::any_of(m_mesh->chunks.begin(), m_mesh->chunks.end(),
                       [&](const CityChunk& chunk) { return chunk.kind == kind; });
}

void CityBuffers::bindTables() const {
    m_triangles.bind(1);
    m_facades.bind(2);
    m_surfaces.bind(3);
    m_walls.bind(4);
    m_mapping.bind(5);
    m_pages.bind(6);
}

std::size_t CityBuffers::draw(const std::vector<std::uint32_t>& chunks, ShadeKind kind,
                              const Choice& choice) {
    m_counts.clear();
    m_offsets.clear();
    std::size_t triangles = 0;
    for (const std::uint32_t i : chunks) {
        const CityChunk& chunk = m_mesh->chunks[i];
        if (chunk.kind != kind) {
            continue;
        }
        const SizeRange sizes = choice(chunk);
        if (!(sizes.least < sizes.limit)) {
            continue;
        }
        const std::uint32_t end = trianglesOfSize(*m_mesh, chunk, sizes.least);
        const std::uint32_t begin = trianglesOfSize(*m_mesh, chunk, sizes.limit);
        if (end > begin) {
            m_counts.push_back(int(3 * (end - begin)));
            const std::size_t offset =
                std::size_t(3) * (chunk.firstTriangle + begin) * sizeof(std::uint32_t);
            m_offsets.push_back(reinterpret_cast<const void*>(offset));
            triangles += end - begin;
        }
    }
    if (triangles > 0) {
        glMultiDrawElements(GL_TRIANGLES, m_counts.data(), GL_UNSIGNED_INT, m_offsets.data(),
                            GLsizei(m_counts.size()));
    }
    return triangles;
}

std::vector<std::uint32_t> CityBuffers::nearestFirst(const glm::dvec3& eye) const {
    std::vector<std::uint32_t> order(m_mesh->chunks.size());
    std::vector<double> away(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        away[i] = distanceTo(m_mesh->chunks[i].bounds, eye);
    }
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return away[a] < away[b]; });
    return order;
}

double distanceTo(const Box& box, const glm::dvec3& point) {
    return glm::length(glm::max(glm::max(box.min - point, point - box.max), glm::dvec3(0.0)));
}

SizeRange sizesInView(const CityView& view, const CityChunk& chunk) {
    if (outOfView(view, chunk.bounds)) {
        return kNoSizes;
    }
    const auto pixel =
        float(distanceTo(chunk.bounds, view.eye) / double(view.pixelsPerRadian()));  // metres
    const float factor = float(1 << chunk.thinned);
    SizeRange sizes{view.smallestPart * pixel / factor};
    if (chunk.leaves) {
        // Each halving of what a leaf looks like is one more thinning.
        const float thinned = view.thinnedLeaf * pixel;
        if (chunk.thinned > 0) {
            sizes.limit = 2.0F * thinned / factor;
        }
        if (chunk.thinned < kThinnings) {
            sizes.least = std::max(sizes.least, thinned / factor);
        }
    }
    return sizes;
}

}  // namespace reflet
