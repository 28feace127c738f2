// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/SurfacePattern.h"

namespace reflet {

namespace {

/// The sample's extent on level ground, eastwards and northwards together.
float groundExtent(const glm::vec3& normal, const Footprint& f) {
    return std::max(f.along({1.0F, 0.0F, 0.0F}, normal), f.along({0.0F, 1.0F, 0.0F}, normal));
}

float joints(const glm::vec3& p, const glm::vec3& n, const Footprint& f, float size, float joint) {
    const float x = periodicCoverage(p.x, size, 0.0F, joint, f.along({1.0F, 0.0F, 0.0F}, n));
    const float y = periodicCoverage(p.y, size, 0.0F, joint, f.along({0.0F, 1.0F, 0.0F}, n));
    return x + y - x * y;
}

/// The tone of a slab of its own, fading to the mean.
float slabTone(const glm::vec3& p, float size, float extent, std::uint32_t seed) {
    const auto i = std::int32_t(std::floor(p.x / size));
    const auto j = std::int32_t(std::floor(p.y / size));
    return resolved(size, extent) * (2.0F * patternRandom(seed, i, j) - 1.0F);
}

glm::vec3 asphalt(const glm::vec3& base, const glm::vec3& p, float extent) {
    const float tone = 0.060F * filteredNoise(p.x, p.y, 9.0F, extent, 11U) +
                       0.045F * filteredNoise(p.x, p.y, 1.3F, extent, 12U) +
                       0.040F * filteredNoise(p.x, p.y, 0.16F, extent, 13U);
    return base * (1.0F + tone);
}

glm::vec3 slabs(const glm::vec3& base, const glm::vec3& p, const glm::vec3& n, const Footprint& f,
                float extent) {
    const float tone = 0.055F * slabTone(p, 0.5F, extent, 21U) +
                       0.04F * filteredNoise(p.x, p.y, 5.0F, extent, 22U);
    return base * (1.0F + tone) * (1.0F - 0.32F * joints(p, n, f, 0.5F, 0.025F));
}

/// Stone slabs framed by darker bands every six metres, as squares are laid out.
glm::vec3 paving(const glm::vec3& base, const glm::vec3& p, const glm::vec3& n, const Footprint& f,
                 float extent) {
    const float band = joints(p, n, f, 6.0F, 0.6F);
    const float tone = 0.070F * slabTone(p, 0.6F, extent, 31U) +
                       0.035F * filteredNoise(p.x, p.y, 8.0F, extent, 32U) +
                       0.025F * filteredNoise(p.x, p.y, 0.9F, extent, 33U);
    const glm::vec3 bands = base * glm::vec3(0.60F, 0.58F, 0.57F);
    return glm::mix(base, bands, band) * (1.0F + tone) *
           (1.0F - 0.30F * joints(p, n, f, 0.6F, 0.022F));
}

glm::vec3 grass(const glm::vec3& base, const glm::vec3& p, float extent) {
    const float tone = 0.10F * filteredNoise(p.x, p.y, 6.0F, extent, 41U) +
                       0.09F * filteredNoise(p.x, p.y, 1.1F, extent, 42U) +
                       0.10F * filteredNoise(p.x, p.y, 0.21F, extent, 43U);
    const float dry = 0.5F + 0.5F * filteredNoise(p.x, p.y, 17.0F, extent, 44U);
    return glm::mix(base, base * glm::vec3(1.25F, 1.05F, 0.85F), 0.5F * dry) * (1.0F + tone);
}

glm::vec3 earth(const glm::vec3& base, const glm::vec3& p, float extent) {
    const float patch = 0.5F + 0.5F * filteredNoise(p.x, p.y, 23.0F, extent, 51U);
    const float tone = 0.06F * filteredNoise(p.x, p.y, 3.1F, extent, 52U) +
                       0.06F * filteredNoise(p.x, p.y, 0.4F, extent, 53U);
    return glm::mix(base, base * glm::vec3(0.86F, 0.98F, 0.80F), patch) * (1.0F + tone);
}

glm::vec3 water(const glm::vec3& base, const glm::vec3& p, float extent) {
    const float waves = 0.05F * filteredNoise(p.x, 2.3F * p.y, 2.4F, 2.0F * extent, 61U) +
                        0.05F * filteredNoise(p.x + p.y, p.y - p.x, 11.0F, extent, 62U);
    return base * (1.0F + waves);
}

glm::vec3 flatRoof(const glm::vec3& base, const glm::vec3& p, float extent, std::uint32_t seed) {
    const float tone = 0.06F * filteredNoise(p.x, p.y, 4.3F, extent, seed) +
                       0.05F * filteredNoise(p.x, p.y, 0.35F, extent, seed ^ 3U);
    return base * (1.0F + tone);
}

/// Courses of tiles along the slope, each tile with a tone of its own.
glm::vec3 tiledRoof(const glm::vec3& base, const glm::vec3& p, const glm::vec3& normal,
                    const Footprint& f, std::uint32_t seed) {
    const glm::vec3 n = normal.z < 0.0F ? -normal : normal;
    glm::vec3 course = glm::cross(glm::vec3(0.0F, 0.0F, 1.0F), n);
    const float length = glm::length(course);
    if (length < 1e-4F) {
        return base;
    }
    course /= length;
    const glm::vec3 upslope = glm::cross(n, course);
    const float x = glm::dot(p, course);
    const float y = glm::dot(p, upslope);
    const float wx = f.along(course, n);
    const float wy = f.along(upslope, n);
    constexpr float kRow = 0.36F;
    constexpr float kTile = 0.24F;
    const auto row = std::int32_t(std::floor(y / kRow));
    const auto column = std::int32_t(std::floor(x / kTile + 0.5F * float(row & 1)));
    const float own = resolved(kTile, wx) * resolved(kRow, wy);
    const float tone = 0.10F * own * (2.0F * patternRandom(seed, column, row) - 1.0F) +
                       0.05F * filteredNoise(x, y, 3.3F, wx + wy, seed ^ 5U);
    const float shadow = periodicCoverage(y, kRow, 0.0F, 0.06F, wy);
    const float rib = periodicCoverage(x, kTile, 0.0F, 0.05F, wx);
    return base * (1.0F + tone) * (1.0F - 0.38F * shadow) * (1.0F - 0.15F * rib);
}

/// A crown of leaves over a trunk near the axis.
glm::vec3 foliage(const glm::vec3& base, const BuildingLook& tree, const glm::vec3& p,
                  float extent) {
    const float height = std::max(tree.top - tree.base, 0.1F);
    const float level = (p.z - tree.base) / height;
    const float radius = glm::length(glm::vec2(p) - tree.center);
    if (level < 0.5F && radius < 0.1F + 0.05F * height) {
        const float bark = filteredNoise(3.0F * (p.x + p.y), p.z, 0.5F, 3.0F * extent, tree.seed);
        return glm::vec3(0.115F, 0.085F, 0.062F) * (1.0F + 0.18F * bark);
    }
    const float warm = patternRandom(tree.seed, 1);
    const glm::vec3 own = glm::mix(base, base * glm::vec3(1.28F, 1.04F, 0.75F), warm) *
                          (0.88F + 0.24F * patternRandom(tree.seed, 2));
    const float clumps = filteredNoise(p.x + 0.6F * p.z, p.y + 0.8F * p.z, 0.9F, extent, tree.seed);
    const float leaves =
        filteredNoise(p.x - 0.7F * p.z, p.y + 0.5F * p.z, 0.22F, extent, tree.seed ^ 9U);
    return own * (1.0F + 0.20F * clumps + 0.20F * leaves) *
           (0.80F + 0.28F * std::clamp(level, 0.0F, 1.0F));
}

glm::vec3 stone(const glm::vec3& base, const glm::vec3& p, float extent) {
    const float tone = 0.045F * filteredNoise(p.x + 0.3F * p.z, p.y + p.z, 2.6F, extent, 71U) +
                       0.035F * filteredNoise(p.x + p.z, p.y - 0.4F * p.z, 0.4F, extent, 72U);
    return base * (1.0F + tone);
}

}  // namespace

glm::vec3 patternColour(const SurfaceLook& look, const BuildingLook& building,
                        const glm::vec3& point, const glm::vec3& normal,
                        const Footprint& footprint) {
    const float extent = groundExtent(normal, footprint);
    switch (look.kind) {
        case LookKind::Asphalt:
            return asphalt(look.colour, point, extent);
        case LookKind::Slabs:
            return slabs(look.colour, point, normal, footprint, extent);
        case LookKind::Paving:
            return paving(look.colour, point, normal, footprint, extent);
        case LookKind::Grass:
            return grass(look.colour, point, extent);
        case LookKind::Earth:
            return earth(look.colour, point, extent);
        case LookKind::Water:
            return water(look.colour, point, extent);
        case LookKind::FlatRoof:
            return flatRoof(look.colour, point, extent, building.seed);
        case LookKind::TiledRoof:
            return tiledRoof(look.colour, point, normal, footprint, building.seed);
        case LookKind::Foliage:
            return foliage(look.colour, building, point, extent);
        case LookKind::Plaster:
        case LookKind::Stone:
            return stone(look.colour, point, extent);
        case LookKind::Solid:
        case LookKind::Facade:
            break;
    }
    return look.colour;
}

}  // namespace reflet
