// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/ReadBackTarget.h"

#include "core/gpu/base/GlObjects.h"

#include <epoxy/gl.h>

namespace reflet {

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

bool ReadBackTarget::read(std::vector<std::uint8_t>& rgba) const {
    rgba.resize(std::size_t(m_width) * std::size_t(m_height) * 4);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glGetTextureImage(m_objects->texture.id(), 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(rgba.size()),
                      rgba.data());
    return glGetError() != GL_CONTEXT_LOST;
}

}  // namespace reflet
