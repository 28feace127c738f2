// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"

#include <cstddef>
#include <optional>
#include <span>
#include <utility>

// Owners of OpenGL 4.5 objects, with direct state access. All move and never copy; a default one
// owns nothing (id 0). Make, use and destroy them with the same context current. GL's own types and
// constants are unsigned and int here, so that users of a header need no OpenGL header.

namespace reflet {

/// What the owners have in common: a name that Delete gives back.
template <void (*Delete)(unsigned)>
class GlName {
public:
    GlName() = default;
    explicit GlName(unsigned id) : m_id(id) {}
    ~GlName() { reset(); }
    GlName(GlName&& other) noexcept : m_id(std::exchange(other.m_id, 0U)) {}
    GlName& operator=(GlName&& other) noexcept {
        if (this != &other) {
            reset();
            m_id = std::exchange(other.m_id, 0U);
        }
        return *this;
    }
    GlName(const GlName&) = delete;
    GlName& operator=(const GlName&) = delete;

    [[nodiscard]] unsigned id() const { return m_id; }
    explicit operator bool() const { return m_id != 0; }

private:
    void reset() {
        if (m_id != 0)
            Delete(m_id);
        m_id = 0;
    }
    unsigned m_id = 0;
};

void deleteBuffer(unsigned id);
void deleteTexture(unsigned id);
void deleteVertexArray(unsigned id);
void deleteFramebuffer(unsigned id);
void deleteQuery(unsigned id);
void deleteSampler(unsigned id);

/// A buffer of fixed size.
class Buffer : public GlName<deleteBuffer> {
public:
    Buffer() = default;
    /// data: null leaves the contents undefined. An empty buffer gets one byte of storage.
    explicit Buffer(std::size_t bytes, const void* data = nullptr);
    template <class T>
    explicit Buffer(std::span<const T> values) : Buffer(values.size_bytes(), values.data()) {}

    [[nodiscard]] std::size_t bytes() const { return m_bytes; }
    /// offset + bytes must lie within the buffer.
    void write(std::size_t offset, std::size_t bytes, const void* data);
    /// As write() from the start, but makes a larger buffer (another id) when this is too small.
    void writeGrowing(std::size_t bytes, const void* data);
    /// target: GL_UNIFORM_BUFFER, GL_SHADER_STORAGE_BUFFER.
    void bindBase(unsigned target, unsigned binding) const;

private:
    std::size_t m_bytes = 0;
};

/// A texture of immutable storage. format: sized internal format (GL_RGBA16F ...).
class Texture : public GlName<deleteTexture> {
public:
    Texture() = default;
    [[nodiscard]] static Texture make2D(unsigned format, int width, int height, int levels = 1);
    [[nodiscard]] static Texture makeArray(unsigned format, int width, int height, int layers,
                                           int levels = 1);
    [[nodiscard]] static Texture make3D(unsigned format, int width, int height, int depth);
    [[nodiscard]] static Texture makeCube(unsigned format, int edge, int levels = 1);
    [[nodiscard]] static Texture makeCubeArray(unsigned format, int edge, int cubes,
                                               int levels = 1);
    /// A buffer's contents as texels, for samplerBuffer; the buffer must outlive it.
    [[nodiscard]] static Texture viewOf(unsigned format, const Buffer& buffer);

    /// GL_LINEAR, GL_LINEAR_MIPMAP_LINEAR, ...; initially GL_LINEAR without levels.
    Texture& filter(unsigned minify, unsigned magnify);
    /// GL_CLAMP_TO_EDGE (initially), GL_REPEAT, GL_CLAMP_TO_BORDER.
    Texture& wrap(unsigned mode);
    void generateMipmaps() const;
    void bind(unsigned unit) const;

    [[nodiscard]] int width() const { return m_width; }
    [[nodiscard]] int height() const { return m_height; }
    [[nodiscard]] int layers() const { return m_layers; }  ///< or cubes, or depth
    [[nodiscard]] int levels() const { return m_levels; }

private:
    Texture(unsigned target, int width, int height, int layers, int levels);
    int m_width = 0, m_height = 0, m_layers = 0, m_levels = 0;
};

/// Levels of a full mip chain down to one texel.
[[nodiscard]] int mipLevels(int edge);

/// How a texture is read, in place of the texture's own settings; clamps to edges.
class Sampler : public GlName<deleteSampler> {
public:
    Sampler() = default;
    [[nodiscard]] static Sampler make(unsigned minify, unsigned magnify);
    /// For the texture unit, until unbind().
    void bind(unsigned unit) const;
    static void unbind(unsigned unit);
};

class VertexArray : public GlName<deleteVertexArray> {
public:
    VertexArray() = default;
    [[nodiscard]] static VertexArray make();

    /// Takes `components` floats per vertex for a shader's input `location` from a buffer.
    /// divisor: 0 = per vertex, 1 = per instance. The buffer must outlive the drawing.
    void floats(unsigned location, int components, const Buffer& buffer, std::size_t stride,
                std::size_t offset, unsigned divisor = 0);
    /// The same for unsigned bytes that reach the shader as 0..1, and for integers.
    void bytes(unsigned location, int components, const Buffer& buffer, std::size_t stride,
               std::size_t offset);
    void integers(unsigned location, int components, const Buffer& buffer, std::size_t stride,
                  std::size_t offset, unsigned divisor = 0);
    void indices(const Buffer& buffer);
    void bind() const;

private:
    void source(unsigned location, const Buffer& buffer, std::size_t stride, unsigned divisor);
};

class Framebuffer : public GlName<deleteFramebuffer> {
public:
    Framebuffer() = default;
    [[nodiscard]] static Framebuffer make();

    /// attachment: GL_COLOR_ATTACHMENT0 + i, GL_DEPTH_ATTACHMENT. layer < 0: all of it.
    Framebuffer& attach(unsigned attachment, const Texture& texture, int level = 0, int layer = -1);
    /// Draws to the first `count` colour attachments; 0 = to none.
    Framebuffer& drawTo(int count);
    /// Internal when the driver refuses the combination, naming `subject` and the reason.
    [[nodiscard]] Result<void> check(const char* subject) const;
    void bind() const;
};

/// Measures the GPU's time between begin() and end(), and never waits: the answer is that of some
/// frames ago. One at a time may be running.
class TimerQuery : public GlName<deleteQuery> {
public:
    TimerQuery() = default;
    [[nodiscard]] static TimerQuery make();
    /// Whether it measures now: not while the last answer is still waited for.
    bool begin();
    void end();
    /// The answer, in milliseconds, once it is there; nullopt before and after that.
    [[nodiscard]] std::optional<double> take();

private:
    bool m_running = false;
    bool m_pending = false;
};

}  // namespace reflet
