// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

namespace reflet {

/// A place to draw to whose pixels are read back. Belongs to one OpenGL 4.5 context, which must be
/// current at every call and when it is destroyed.
class ReadBackTarget {
public:
    ReadBackTarget(int width, int height);
    ~ReadBackTarget();
    ReadBackTarget(const ReadBackTarget&) = delete;
    ReadBackTarget& operator=(const ReadBackTarget&) = delete;

    [[nodiscard]] int width() const { return m_width; }
    [[nodiscard]] int height() const { return m_height; }
    [[nodiscard]] unsigned framebuffer() const;
    /// Waits for what was drawn; 0xFFRRGGBB a pixel whatever was left in alpha, rows from the top.
    /// False: the context is lost.
    [[nodiscard]] bool read(std::vector<std::uint32_t>& pixels) const;

private:
    struct Objects;
    int m_width, m_height;
    std::unique_ptr<Objects> m_objects;
};

}  // namespace reflet
