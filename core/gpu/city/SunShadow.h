// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/base/Program.h"
#include "core/gpu/city/CityBuffers.h"
#include "core/gpu/city/CityPass.h"

#include <array>
#include <vector>

namespace reflet {

/// Shadow maps of the sun: four squares around the place of interest, each four times as wide as
/// the one before, the last over the whole city; and one around the vehicles. The city's are kept
/// and drawn anew only when the city or the sun changes, or the place leaves the middle of a
/// square: their centres move in steps of whole texels, so that shadows stand still. Where OpenGL
/// is software, a square that the place leaves may be drawn in parts over several updates, so that
/// no picture waits for it; until it is whole, the old one serves.
class SunShadow {
public:
    static constexpr int kCascades = 4;

    [[nodiscard]] static Result<SunShadow> create();

    /// Everything must be drawn anew: the city is another, or the sun stands elsewhere.
    void setSun(const glm::dvec3& direction, const Box& city);
    /// Returns the number of triangles drawn. buffers: null for no city. inParts: squares may be
    /// drawn in parts, for a picture of a movement.
    std::size_t update(const glm::dvec3& focus, CityBuffers* buffers,
                       std::span<const ShadowCaster> casters, bool inParts = false);
    void bind(unsigned cityUnit, unsigned vehicleUnit) const;

    /// What shaders need to find a point in the maps: part of the block CityLight.
    struct Lookup {
        std::array<glm::vec4, 3> axes{};
        glm::vec4 depth{0.0F};
        std::array<glm::vec4, kCascades + 1> squares{};
        glm::vec4 layers{0.0F};  ///< of the texture, a cascade each
    };
    /// bodies: false leaves the shadows of moving bodies out.
    [[nodiscard]] Lookup lookup(bool bodies = true) const;

    /// Where shadows of moving bodies may fall since the last update().
    struct BodyShadows {
        std::vector<ShadowCaster> casters;  ///< those that are near enough
        double lowest = 0.0;                ///< along sun(): none falls below
        double texel = 0.0;                 ///< metres
    };
    [[nodiscard]] const BodyShadows& bodyShadows() const { return m_bodyShadows; }
    /// Unit axes of the maps: right × up = sun, which points to the sun.
    [[nodiscard]] const glm::dvec3& right() const { return m_right; }
    [[nodiscard]] const glm::dvec3& up() const { return m_up; }
    [[nodiscard]] const glm::dvec3& sun() const { return m_sun; }
    /// Another number whenever the city's shadows are others.
    [[nodiscard]] unsigned version() const { return m_version; }

private:
    struct Square {
        glm::dvec2 center{0.0};
        double half = 0.0;  ///< metres; 0 = not drawn yet
    };
    /// Depths along the sun's direction.
    struct Range {
        double low = 0.0;
        double high = 1.0;
    };
    [[nodiscard]] glm::mat4 clip_from_project(const Square& square, const Range& range) const;
    /// A square that is being drawn in parts, into the spare layer.
    struct Work {
        int cascade = -1;  ///< -1: none
        Square square;
        std::vector<std::uint32_t> chunks;
        std::size_t done = 0;  ///< of them
    };
    [[nodiscard]] Square squareOf(int cascade, const glm::dvec3& focus) const;
    [[nodiscard]] CityBuffers::Choice choiceOf(const Square& square) const;
    std::size_t drawChunks(const Square& square, int layer,
                           const std::vector<std::uint32_t>& chunks, bool first,
                           CityBuffers& buffers);
    std::size_t drawPart(CityBuffers& buffers);
    void drawVehicles(const glm::dvec3& focus, std::span<const ShadowCaster> casters);

    Program m_program;
    Texture m_maps, m_vehicleMap;
    Framebuffer m_framebuffer, m_vehicleFramebuffer;
    std::array<Square, kCascades> m_squares;
    std::array<int, kCascades> m_layers{0, 1, 2, 3};  ///< of m_maps
    int m_spare = kCascades;                          ///< the layer that nobody reads
    Work m_work;
    bool m_slow = false;     ///< OpenGL is software
    Square m_vehicleSquare;  ///< half 0: no vehicles
    Range m_range, m_vehicleRange;
    glm::dvec3 m_sun{0.0, 0.0, 1.0};
    glm::dvec3 m_right{1.0, 0.0, 0.0}, m_up{0.0, 1.0, 0.0};  ///< axes of the maps
    glm::dvec2 m_cityCenter{0.0};                            ///< in them
    double m_cityHalf = 1.0;
    BodyShadows m_bodyShadows;
    unsigned m_version = 0;
};

}  // namespace reflet
