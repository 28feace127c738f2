// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/base/Program.h"
#include "core/gpu/city/CityBuffers.h"
#include "core/gpu/city/CityPass.h"

#include <array>

namespace reflet {

/// Shadow maps of the sun: four squares around the place of interest, each four times as wide as
/// the one before, the last over the whole city; and one around the vehicles. The city's are kept
/// and drawn anew only when the city or the sun changes, or the place leaves the middle of a
/// square: their centres move in steps of whole texels, so that shadows stand still.
class SunShadow {
public:
    static constexpr int kCascades = 4;

    [[nodiscard]] static Result<SunShadow> create();

    /// Everything must be drawn anew: the city is another, or the sun stands elsewhere.
    void setSun(const glm::dvec3& direction, const Box& city);
    /// Returns the number of triangles drawn. buffers: null for no city.
    std::size_t update(const glm::dvec3& focus, CityBuffers* buffers,
                       std::span<const ShadowCaster> casters);
    void bind(unsigned cityUnit, unsigned vehicleUnit) const;

    /// Texture coordinates and depth, 0..1, from the project frame; the last: vehicles.
    [[nodiscard]] const std::array<glm::mat4, kCascades + 1>& matrices() const {
        return m_matrices;
    }
    /// Metres per texel of each cascade.
    [[nodiscard]] const std::array<float, kCascades>& texels() const { return m_texels; }
    [[nodiscard]] float vehicleTexel() const { return m_vehicleTexel; }  ///< 0: no casters

private:
    struct Square {
        glm::dvec2 center{0.0};
        double half = 0.0;  ///< metres; 0 = not drawn yet
    };
    [[nodiscard]] glm::mat4 matrixOf(const Square& square, double low, double high) const;
    [[nodiscard]] Square squareOf(int cascade, const glm::dvec3& focus) const;
    std::size_t drawCascade(int cascade, CityBuffers& buffers);
    void drawVehicles(const glm::dvec3& focus, std::span<const ShadowCaster> casters);

    Program m_program;
    Texture m_maps, m_vehicleMap;
    Framebuffer m_framebuffer, m_vehicleFramebuffer;
    std::array<Square, kCascades> m_squares;
    std::array<glm::mat4, kCascades + 1> m_matrices{};
    std::array<float, kCascades> m_texels{};
    float m_vehicleTexel = 0.0F;
    glm::dvec3 m_sun{0.0, 0.0, 1.0};
    glm::dvec3 m_right{1.0, 0.0, 0.0}, m_up{0.0, 1.0, 0.0};  ///< axes of the maps
    glm::dvec2 m_cityCenter{0.0};                            ///< in them
    double m_cityHalf = 1.0;
    double m_low = 0.0, m_high = 1.0;  ///< of the city along the sun's direction
};

}  // namespace reflet
