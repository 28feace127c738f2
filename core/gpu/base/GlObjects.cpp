// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/base/GlObjects.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>

namespace reflet {

void deleteBuffer(unsigned id) {
    glDeleteBuffers(1, &id);
}
void deleteTexture(unsigned id) {
    glDeleteTextures(1, &id);
}
void deleteVertexArray(unsigned id) {
    glDeleteVertexArrays(1, &id);
}
void deleteFramebuffer(unsigned id) {
    glDeleteFramebuffers(1, &id);
}
void deleteQuery(unsigned id) {
    glDeleteQueries(1, &id);
}
void deleteSampler(unsigned id) {
    glDeleteSamplers(1, &id);
}

namespace {

template <class Create>
unsigned created(Create create) {
    unsigned id = 0;
    create(&id);
    return id;
}

}  // namespace

Buffer::Buffer(std::size_t bytes, const void* data)
    : GlName(created([](unsigned* id) { glCreateBuffers(1, id); })), m_bytes(bytes) {
    glNamedBufferStorage(id(), GLsizeiptr(std::max<std::size_t>(bytes, 1)),
                         bytes > 0 ? data : nullptr, GL_DYNAMIC_STORAGE_BIT);
}

void Buffer::write(std::size_t offset, std::size_t bytes, const void* data) {
    assert(offset + bytes <= m_bytes);
    if (bytes > 0)
        glNamedBufferSubData(id(), GLintptr(offset), GLsizeiptr(bytes), data);
}

void Buffer::writeGrowing(std::size_t bytes, const void* data) {
    if (id() == 0 || bytes > m_bytes)
        *this = Buffer(std::bit_ceil(std::max<std::size_t>(bytes, 256)));
    write(0, bytes, data);
}

void Buffer::bindBase(unsigned target, unsigned binding) const {
    glBindBufferBase(target, binding, id());
}

Texture::Texture(unsigned target, int width, int height, int layers, int levels)
    : GlName(created([target](unsigned* id) { glCreateTextures(target, 1, id); })),
      m_width(width),
      m_height(height),
      m_layers(layers),
      m_levels(levels) {
    filter(GL_LINEAR, GL_LINEAR);
    wrap(GL_CLAMP_TO_EDGE);
}

Texture Texture::make2D(unsigned format, int width, int height, int levels) {
    Texture texture(GL_TEXTURE_2D, width, height, 1, levels);
    glTextureStorage2D(texture.id(), levels, format, width, height);
    return texture;
}

Texture Texture::makeArray(unsigned format, int width, int height, int layers, int levels) {
    Texture texture(GL_TEXTURE_2D_ARRAY, width, height, layers, levels);
    glTextureStorage3D(texture.id(), levels, format, width, height, layers);
    return texture;
}

Texture Texture::make3D(unsigned format, int width, int height, int depth) {
    Texture texture(GL_TEXTURE_3D, width, height, depth, 1);
    glTextureStorage3D(texture.id(), 1, format, width, height, depth);
    return texture;
}

Texture Texture::makeCube(unsigned format, int edge, int levels) {
    Texture texture(GL_TEXTURE_CUBE_MAP, edge, edge, 1, levels);
    glTextureStorage2D(texture.id(), levels, format, edge, edge);
    return texture;
}

Texture Texture::makeCubeArray(unsigned format, int edge, int cubes, int levels) {
    Texture texture(GL_TEXTURE_CUBE_MAP_ARRAY, edge, edge, cubes, levels);
    glTextureStorage3D(texture.id(), levels, format, edge, edge, 6 * cubes);
    return texture;
}

Texture Texture::viewOf(unsigned format, const Buffer& buffer) {
    Texture texture;
    static_cast<GlName&>(texture) =
        GlName(created([](unsigned* id) { glCreateTextures(GL_TEXTURE_BUFFER, 1, id); }));
    glTextureBuffer(texture.id(), format, buffer.id());
    return texture;
}

Texture& Texture::filter(unsigned minify, unsigned magnify) {
    glTextureParameteri(id(), GL_TEXTURE_MIN_FILTER, GLint(minify));
    glTextureParameteri(id(), GL_TEXTURE_MAG_FILTER, GLint(magnify));
    return *this;
}

Texture& Texture::wrap(unsigned mode) {
    for (const unsigned axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glTextureParameteri(id(), axis, GLint(mode));
    return *this;
}

void Texture::generateMipmaps() const {
    glGenerateTextureMipmap(id());
}

void Texture::bind(unsigned unit) const {
    glBindTextureUnit(unit, id());
}

Sampler Sampler::make(unsigned minify, unsigned magnify) {
    Sampler sampler;
    static_cast<GlName&>(sampler) = GlName(created([](unsigned* id) { glCreateSamplers(1, id); }));
    glSamplerParameteri(sampler.id(), GL_TEXTURE_MIN_FILTER, GLint(minify));
    glSamplerParameteri(sampler.id(), GL_TEXTURE_MAG_FILTER, GLint(magnify));
    for (const unsigned axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glSamplerParameteri(sampler.id(), axis, GL_CLAMP_TO_EDGE);
    return sampler;
}

void Sampler::bind(unsigned unit) const {
    glBindSampler(unit, id());
}

void Sampler::unbind(unsigned unit) {
    glBindSampler(unit, 0);
}

int mipLevels(int edge) {
    return int(std::bit_width(unsigned(std::max(edge, 1))));
}

VertexArray VertexArray::make() {
    VertexArray array;
    static_cast<GlName&>(array) =
        GlName(created([](unsigned* id) { glCreateVertexArrays(1, id); }));
    return array;
}

void VertexArray::source(unsigned location, const Buffer& buffer, std::size_t stride,
                         unsigned divisor) {
    glEnableVertexArrayAttrib(id(), location);
    glVertexArrayVertexBuffer(id(), location, buffer.id(), 0, GLsizei(stride));
    glVertexArrayAttribBinding(id(), location, location);
    glVertexArrayBindingDivisor(id(), location, divisor);
}

void VertexArray::floats(unsigned location, int components, const Buffer& buffer,
                         std::size_t stride, std::size_t offset, unsigned divisor) {
    source(location, buffer, stride, divisor);
    glVertexArrayAttribFormat(id(), location, components, GL_FLOAT, GL_FALSE, GLuint(offset));
}

void VertexArray::bytes(unsigned location, int components, const Buffer& buffer, std::size_t stride,
                        std::size_t offset) {
    source(location, buffer, stride, 0);
    glVertexArrayAttribFormat(id(), location, components, GL_UNSIGNED_BYTE, GL_TRUE,
                              GLuint(offset));
}

void VertexArray::integers(unsigned location, int components, const Buffer& buffer,
                           std::size_t stride, std::size_t offset, unsigned divisor) {
    source(location, buffer, stride, divisor);
    glVertexArrayAttribIFormat(id(), location, components, GL_UNSIGNED_INT, GLuint(offset));
}

void VertexArray::indices(const Buffer& buffer) {
    glVertexArrayElementBuffer(id(), buffer.id());
}

void VertexArray::bind() const {
    glBindVertexArray(id());
}

Framebuffer Framebuffer::make() {
    Framebuffer framebuffer;
    static_cast<GlName&>(framebuffer) =
        GlName(created([](unsigned* id) { glCreateFramebuffers(1, id); }));
    return framebuffer;
}

Framebuffer& Framebuffer::attach(unsigned attachment, const Texture& texture, int level,
                                 int layer) {
    if (layer < 0) {
        glNamedFramebufferTexture(id(), attachment, texture.id(), level);
    } else {
        glNamedFramebufferTextureLayer(id(), attachment, texture.id(), level, layer);
    }
    return *this;
}

Framebuffer& Framebuffer::drawTo(int count) {
    GLenum targets[8] = {GL_NONE};
    for (int i = 0; i < count; ++i)
        targets[i] = GLenum(GL_COLOR_ATTACHMENT0 + i);
    glNamedFramebufferDrawBuffers(id(), std::max(count, 1), targets);
    return *this;
}

Result<void> Framebuffer::check(const char* subject) const {
    const GLenum status = glCheckNamedFramebufferStatus(id(), GL_FRAMEBUFFER);
    if (status == GL_FRAMEBUFFER_COMPLETE)
        return {};
    return fail(ErrorCode::Internal,
                fmt::format("the graphics driver refuses a framebuffer (0x{:04x})", status),
                subject, "Update the driver, or start with LIBGL_ALWAYS_SOFTWARE=1.");
}

void Framebuffer::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, id());
}

TimerQuery TimerQuery::make() {
    TimerQuery query;
    static_cast<GlName&>(query) =
        GlName(created([](unsigned* id) { glCreateQueries(GL_TIME_ELAPSED, 1, id); }));
    return query;
}

bool TimerQuery::begin() {
    m_running = !m_pending;
    if (m_running)
        glBeginQuery(GL_TIME_ELAPSED, id());
    return m_running;
}

void TimerQuery::end() {
    if (!m_running)
        return;
    glEndQuery(GL_TIME_ELAPSED);
    m_running = false;
    m_pending = true;
}

std::optional<double> TimerQuery::take() {
    GLint available = 0;
    if (m_pending)
        glGetQueryObjectiv(id(), GL_QUERY_RESULT_AVAILABLE, &available);
    if (available == 0)
        return std::nullopt;
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(id(), GL_QUERY_RESULT, &nanoseconds);
    m_pending = false;
    return double(nanoseconds) * 1e-6;
}

}  // namespace reflet
