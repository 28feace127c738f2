// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/Lighting.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

/// Scene radiance per kcd/m²: a white horizontal surface under a clear sky (turbidity 2.5) with the
/// sun 65° high has about 39 kcd/m² (123 klx, with the sky's gain), which is to be 1.
constexpr float kRadiancePerKilocandela = 1.0F / 39.0F;
/// The sky against the sun, more than measured, as film and eye lift the shadows of a sunny street.
constexpr float kSkyGain = 1.35F;
/// How far the chromaticity x of a high sun's sky is moved to the blue, as a share: the model's
/// haze is grey, which no picture of a fine day is.
constexpr float kSkyBlue = 0.035F;
/// The same for the blue hour, when the sun lights the sky no more from below.
constexpr float kDuskBlue = 0.16F;
/// Illuminance of the sun above the atmosphere, klx.
constexpr float kSolarIlluminance = 133.8F;
/// The extraterrestrial sun (5778 K) relative to the white point D65.
constexpr glm::vec3 kSolarColour{1.06F, 0.99F, 0.92F};
/// What is left of the light in the depth of the night: dark blue, brighter at the horizon.
constexpr glm::vec3 kNightZenith{0.0080F, 0.0115F, 0.0230F};
constexpr glm::vec3 kNightHorizon{0.0210F, 0.0225F, 0.0320F};

/// The table of ambient light: normals every 11.25°, poles included.
constexpr int kAmbientRows = 17;
constexpr int kAmbientColumns = 32;

float degrees(float radians) {
    return radians * float(180.0 / kPi);
}

float smoothStep(float edge0, float edge1, float x) {
    const float t = std::clamp((x - edge0) / (edge1 - edge0), 0.0F, 1.0F);
    return t * t * (3.0F - 2.0F * t);
}

/// The fall of daylight: 1 above 8° of sun elevation, 0.37 at sunset, 0.05 at -8°, then nothing.
/// Gentler than nature, which loses three decades by -6°: pictures here have one exposure.
float daylight(float elevation) {
    const float below = std::max(0.0F, 8.0F - degrees(elevation)) / 8.0F;
    return std::exp(-std::pow(below, 1.6F));
}

/// For the same reason a low sun is stronger than the air would leave it: up to five times.
float lowSunGain(float elevation) {
    return 1.0F + 4.0F * (1.0F - smoothStep(0.0F, 12.0F, degrees(elevation)));
}

/// Transmittance of the atmosphere for the three primaries (wavelengths that stand for them: 610,
/// 550 and 465 nm): Rayleigh, aerosol and ozone as in appendix A.1 of Preetham et al. 1999, with
/// the relative air mass of Kasten (the same appendix). elevation in radians, at least -1°.
glm::vec3 sunTransmittance(float elevation, float turbidity) {
    const float elevationDegrees = std::max(degrees(elevation), -1.0F);
    const float mass = 1.0F / (std::max(std::sin(elevation), 0.0F) +
                               0.15F * std::pow(elevationDegrees + 3.885F, -1.253F));
    const float beta = 0.04608F * turbidity - 0.04586F;
    constexpr glm::vec3 wavelength{0.610F, 0.550F, 0.465F};  // micrometres
    constexpr glm::vec3 ozone{0.120F, 0.085F, 0.012F};       // 1/cm
    glm::vec3 result;
    for (int i = 0; i < 3; ++i) {
        const float rayleigh = 0.008735F * std::pow(wavelength[i], -4.08F);
        const float aerosol = beta * std::pow(wavelength[i], -1.3F);
        result[i] = std::exp(-mass * (rayleigh + aerosol + 0.35F * ozone[i]));
    }
    return result;
}

/// F(theta, gamma) of Perez et al. 1993, as in equation 3 of Preetham et al. 1999.
float perez(const float (&c)[5], float cosTheta, float gamma) {
    const float cosGamma = std::cos(gamma);
    return (1.0F + c[0] * std::exp(c[1] / cosTheta)) *
           (1.0F + c[2] * std::exp(c[3] * gamma) + c[4] * cosGamma * cosGamma);
}

float cubic(const float (&a)[4], float x) {
    return ((a[0] * x + a[1]) * x + a[2]) * x + a[3];
}

/// Zenith luminance (kcd/m²) and chromaticity: appendix A.2 of Preetham et al. 1999.
glm::vec3 zenithYxy(float theta, float t) {
    const float chi = (4.0F / 9.0F - t / 120.0F) * (float(kPi) - 2.0F * theta);
    const float luminance = (4.0453F * t - 4.9710F) * std::tan(chi) - 0.2155F * t + 2.4192F;
    constexpr float x[3][4] = {{0.00166F, -0.00375F, 0.00209F, 0.0F},
                               {-0.02903F, 0.06377F, -0.03202F, 0.00394F},
                               {0.11693F, -0.21196F, 0.06052F, 0.25886F}};
    constexpr float y[3][4] = {{0.00275F, -0.00610F, 0.00317F, 0.0F},
                               {-0.04214F, 0.08970F, -0.04153F, 0.00516F},
                               {0.15346F, -0.26756F, 0.06670F, 0.26688F}};
    const auto chromaticity = [&](const float(&m)[3][4]) {
        return (cubic(m[0], theta) * t + cubic(m[1], theta)) * t + cubic(m[2], theta);
    };
    return {std::max(luminance, 0.05F), chromaticity(x), chromaticity(y)};
}

/// xyY → linear Rec. 709; colours outside the gamut are moved towards grey of equal luminance, so
/// that no component is negative.
/// The model strays from daylight at both ends: purple near the horizon away from the sun, mustard
/// around a setting one. Chromaticities are kept near the daylight locus (CIE 015:2004, equation
/// 3.3), on the red side of it when they are warm.
glm::vec3 rec709FromYxy(const glm::vec3& yxy) {
    const float luminance = std::max(yxy.x, 0.0F);
    const float x = std::clamp(yxy.y, 0.2F, 0.44F);
    const float locus = -3.0F * x * x + 2.87F * x - 0.275F;
    const float warm = smoothStep(0.325F, 0.37F, x);
    const float y = std::clamp(yxy.z, glm::mix(locus, 0.02F, warm), locus + 0.02F - 0.035F * warm);
    const float bigX = luminance * x / y;
    const float bigZ = luminance * (1.0F - x - y) / y;
    const glm::vec3 rgb{3.2404542F * bigX - 1.5371385F * luminance - 0.4985314F * bigZ,
                        -0.9692660F * bigX + 1.8760108F * luminance + 0.0415560F * bigZ,
                        0.0556434F * bigX - 0.2040259F * luminance + 1.0572252F * bigZ};
    const float least = std::min({rgb.r, rgb.g, rgb.b});
    if (least >= 0.0F) {
        return rgb;
    }
    const glm::vec3 grey{luminance};
    return glm::max(grey + (rgb - grey) * (luminance / (luminance - least)), glm::vec3(0.0F));
}

/// Calls visit(direction, solid angle) for a product rule: midpoints in cos(theta) and azimuth.
template <class Visit>
void overSphere(float zFrom, float zTo, int rings, int sectors, const Visit& visit) {
    for (int i = 0; i < rings; ++i) {
        const float z = zFrom + (zTo - zFrom) * (float(i) + 0.5F) / float(rings);
        const float r = std::sqrt(std::max(0.0F, 1.0F - z * z));
        const float solidAngle = (zTo - zFrom) / float(rings) * 2.0F * float(kPi) / float(sectors);
        for (int j = 0; j < sectors; ++j) {
            const float phi = 2.0F * float(kPi) * (float(j) + 0.5F) / float(sectors);
            visit(glm::vec3(r * std::cos(phi), r * std::sin(phi), z), solidAngle);
        }
    }
}

glm::vec3 unitOr(const glm::dvec3& direction, const glm::vec3& otherwise) {
    const double length = glm::length(direction);
    return length > 0.0 && std::isfinite(length) ? glm::vec3(direction / length) : otherwise;
}

}  // namespace

Sky::Sky(const Lighting& lighting)
    : m_sunDirection(unitOr(lighting.sunDirection, glm::vec3(0.0F, 0.0F, 1.0F))) {
    const float turbidity =
        std::isfinite(lighting.turbidity) ? std::clamp(lighting.turbidity, 2.0F, 10.0F) : 2.5F;
    const float elevation = std::asin(std::clamp(m_sunDirection.z, -1.0F, 1.0F));

    // The Perez function is defined for a sun above the horizon; below it the shape stays.
    const float lifted = std::max(m_sunDirection.z, 0.01F);
    const glm::vec3 horizontal =
        unitOr({m_sunDirection.x, m_sunDirection.y, 0.0}, glm::vec3(1.0F, 0.0F, 0.0F));
    m_shapeDirection =
        std::sqrt(1.0F - lifted * lifted) * horizontal + glm::vec3(0.0F, 0.0F, lifted);

    const float t = turbidity;
    const float coefficients[3][5] = {
        {0.1787F * t - 1.4630F, -0.3554F * t + 0.4275F, -0.0227F * t + 5.3251F,
         0.1206F * t - 2.5771F, -0.0670F * t + 0.3703F},
        {-0.0193F * t - 0.2592F, -0.0665F * t + 0.0008F, -0.0004F * t + 0.2125F,
         -0.0641F * t - 0.8989F, -0.0033F * t + 0.0452F},
        {-0.0167F * t - 0.2608F, -0.0950F * t + 0.0092F, -0.0079F * t + 0.2102F,
         -0.0441F * t - 1.6537F, -0.0109F * t + 0.0529F}};
    std::copy(&coefficients[0][0], &coefficients[0][0] + 15, &m_perez[0][0]);
    const float theta = std::acos(lifted);
    m_zenith = zenithYxy(theta, t);
    for (int i = 0; i < 3; ++i) {
        m_zenith[i] /= perez(m_perez[i], 1.0F, theta);
    }
    m_zenith.y *= 1.0F - kSkyBlue * smoothStep(5.0F, 20.0F, degrees(elevation)) -
                  kDuskBlue * (1.0F - smoothStep(-8.0F, -1.0F, degrees(elevation)));
    m_scale = kSkyGain * kRadiancePerKilocandela * daylight(elevation);
    m_night = 1.0F - smoothStep(-7.0F, 3.0F, degrees(elevation));

    // The disc is half a degree wide and refraction lifts it by as much: the last light goes at
    // -1°.
    m_sunRadiance = kSolarColour * sunTransmittance(elevation, t) *
                    (kSolarIlluminance * kRadiancePerKilocandela / float(kPi) *
                     lowSunGain(elevation) * smoothStep(-1.0F, 0.5F, degrees(elevation)));
    tabulateAmbient();
}

glm::vec3 Sky::above(const glm::vec3& direction) const {
    const float cosTheta = std::clamp(direction.z, 0.005F, 1.0F);
    const float gamma = std::acos(std::clamp(glm::dot(direction, m_shapeDirection), -1.0F, 1.0F));
    glm::vec3 yxy;
    for (int i = 0; i < 3; ++i) {
        yxy[i] = m_zenith[i] * perez(m_perez[i], cosTheta, gamma);
    }
    yxy.x *= m_scale;
    const float height = std::sqrt(std::clamp(direction.z, 0.0F, 1.0F));
    return rec709FromYxy(yxy) + m_night * glm::mix(kNightHorizon, kNightZenith, height);
}

glm::vec3 Sky::radiance(const glm::vec3& direction) const {
    if (direction.z >= 0.0F) {
        return above(direction);
    }
    const float length = std::sqrt(direction.x * direction.x + direction.y * direction.y);
    if (length < 1e-6F) {
        return m_ground;
    }
    const glm::vec3 horizon = above({direction.x / length, direction.y / length, 0.0F});
    return glm::mix(horizon, m_ground, smoothStep(0.0F, 0.4F, -direction.z));
}

void Sky::tabulateAmbient() {
    // A grey ground of albedo 0.2 under the open sky is what the haze fades to.
    glm::vec3 horizontal{0.0F};
    overSphere(0.0F, 1.0F, 32, 64, [&](const glm::vec3& d, float solidAngle) {
        horizontal += above(d) * (d.z * solidAngle / float(kPi));
    });
    m_ground = 0.2F * (horizontal + m_sunRadiance * std::max(m_sunDirection.z, 0.0F));

    std::vector<glm::vec3> directions;
    std::vector<glm::vec3> light;
    overSphere(-1.0F, 1.0F, 48, 64, [&](const glm::vec3& d, float solidAngle) {
        directions.push_back(d);
        light.push_back(radiance(d) * (solidAngle / float(kPi)));
    });
    m_irradiance.assign(std::size_t(kAmbientRows) * kAmbientColumns, glm::vec3(0.0F));
    for (int row = 0; row < kAmbientRows; ++row) {
        const float elevation = float(kPi) * (float(row) / float(kAmbientRows - 1) - 0.5F);
        for (int column = 0; column < kAmbientColumns; ++column) {
            const float azimuth = 2.0F * float(kPi) * float(column) / float(kAmbientColumns);
            const glm::vec3 normal(std::cos(elevation) * std::cos(azimuth),
                                   std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
            glm::vec3& sum = m_irradiance[std::size_t(row * kAmbientColumns + column)];
            for (std::size_t i = 0; i < light.size(); ++i) {
                sum += light[i] * std::max(glm::dot(directions[i], normal), 0.0F);
            }
        }
    }
}

glm::vec3 Sky::ambient(const glm::vec3& normal) const {
    const float elevation = std::asin(std::clamp(normal.z, -1.0F, 1.0F)) / float(kPi) + 0.5F;
    const float turn = std::atan2(normal.y, normal.x) / (2.0F * float(kPi));
    const float y = elevation * float(kAmbientRows - 1);
    const float x = (turn - std::floor(turn)) * float(kAmbientColumns);
    const int row = std::clamp(int(y), 0, kAmbientRows - 2);
    const int column = int(x) % kAmbientColumns;
    const int next = (column + 1) % kAmbientColumns;
    const auto at = [&](int j, int i) {
        return m_irradiance[std::size_t(j * kAmbientColumns + i)];
    };
    const float u = x - std::floor(x);
    return glm::mix(glm::mix(at(row, column), at(row, next), u),
                    glm::mix(at(row + 1, column), at(row + 1, next), u), y - float(row));
}

}  // namespace reflet
