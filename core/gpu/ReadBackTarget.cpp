// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/ReadBackTarget.h"

#include "core/gpu/base/GlObjects.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>

namespace reflet {

namespace {
constexpr std::uint32_t kOpaque = 0xFF000000U;
}  // namespace

struct ReadBackTarget::Objects {
    Texture texture;
    Framebuffer framebuffer;
};

ReadBackTarget::ReadBackTarget(int width, int height)
    : m_width(width),
      m_height(height),
      m_objects(std::make_unique<Objects>(
          Objects{Texture::make2D(GL_RGBA8, width, height), Framebuffer::make()})) {
    m_objects->framebuffer.attach(GL_COLOR_ATTACHMENT0, m_objects->texture);
}

ReadBackTarget::~ReadBackTarget() = default;

unsigned ReadBackTarget::framebuffer() const {
    return m_objects->framebuffer.id();
}

bool ReadBackTarget::read(std::vector<std::uint32_t>& pixels) const {
    const auto width = std::size_t(m_width);
    const auto height = std::size_t(m_height);
    pixels.resize(width * height);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glGetTextureImage(m_objects->texture.id(), 0, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV,
                      GLsizei(pixels.size() * sizeof(std::uint32_t)), pixels.data());
    // OpenGL's rows run from the bottom.
    for (std::size_t row = 0; row < height / 2; ++row) {
        std::swap_ranges(pixels.begin() + std::ptrdiff_t(row * width),
                         pixels.begin() + std::ptrdiff_t((row + 1) * width),
                         pixels.begin() + std::ptrdiff_t((height - 1 - row) * width));
    }
    for (std::uint32_t& pixel : pixels)
        pixel |= kOpaque;
    return glGetError() != GL_CONTEXT_LOST;
}

}  // namespace reflet
