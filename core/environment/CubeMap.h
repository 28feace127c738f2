// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace reflet {

/// Six square images in the order +X −X +Y −Y +Z −Z, rows from the top, stored one after another
/// (a 1 × 6 vertical strip). Directions belong to texels only through CubeDirection.h.
template <class T>
class CubeMap {
public:
    CubeMap() = default;
    explicit CubeMap(int resolution, const T& value = T{})
        : m_resolution(resolution),
          m_texels(std::size_t(6) * std::size_t(resolution) * std::size_t(resolution), value) {}

    /// Texels along an edge of a face; 0 for an empty map.
    [[nodiscard]] int resolution() const { return m_resolution; }
    [[nodiscard]] bool empty() const { return m_texels.empty(); }
    [[nodiscard]] T& at(int face, int column, int row) {
        return m_texels[index(face, column, row)];
    }
    [[nodiscard]] const T& at(int face, int column, int row) const {
        return m_texels[index(face, column, row)];
    }
    [[nodiscard]] std::vector<T>& texels() { return m_texels; }
    [[nodiscard]] const std::vector<T>& texels() const { return m_texels; }

private:
    [[nodiscard]] std::size_t index(int face, int column, int row) const {
        const auto n = std::size_t(m_resolution);
        return (std::size_t(face) * n + std::size_t(row)) * n + std::size_t(column);
    }

    int m_resolution = 0;
    std::vector<T> m_texels;
};

}  // namespace reflet
