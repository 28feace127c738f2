// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/ParallelFor.h"
#include "core/environment/Bc6h.h"
#include "core/environment/ImageMetrics.h"

#include <glm/common.hpp>
#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <string>

namespace reflet {
namespace {

/// The forms of one region as the specification lists them (Khronos Data Format Specification 1.3,
/// table 115 and after): fields of bits, the lowest first; [a:b] with a < b runs upwards in `a` of
/// lower places, else from b to a. The indices follow.
struct SpecifiedForm {
    unsigned mode;
    int bits, delta;
    std::vector<std::string> fields;  // name, high, low ("r0 9 0"); high < low: reversed
};
const std::vector<SpecifiedForm>& specifiedForms() {
    static const std::vector<SpecifiedForm> kForms{
        {3, 10, 0, {"r0 9 0", "g0 9 0", "b0 9 0", "r1 9 0", "g1 9 0", "b1 9 0"}},
        {7,
         11,
         9,
         {"r0 9 0", "g0 9 0", "b0 9 0", "r1 8 0", "r0 10 10", "g1 8 0", "g0 10 10", "b1 8 0",
          "b0 10 10"}},
        {11,
         12,
         8,
         {"r0 9 0", "g0 9 0", "b0 9 0", "r1 7 0", "r0 10 11", "g1 7 0", "g0 10 11", "b1 7 0",
          "b0 10 11"}},
        {15,
         16,
         4,
         {"r0 9 0", "g0 9 0", "b0 9 0", "r1 3 0", "r0 10 15", "g1 3 0", "g0 10 15", "b1 3 0",
          "b0 10 15"}}};
    return kForms;
}

/// A decoder written from the specification, to hold ours against.
std::optional<Bc6hTexels> decodeAsSpecified(const Bc6hBlock& block) {
    int place = 0;
    const auto bit = [&] {
        const int value = block[std::size_t(place / 8)] >> (place % 8) & 1;
        ++place;
        return value;
    };
    const unsigned mode = block[0] & 31U;
    const SpecifiedForm* form = nullptr;
    for (const auto& each : specifiedForms())
        form = each.mode == mode ? &each : form;
    if (form == nullptr)
        return std::nullopt;
    place = 5;
    std::map<std::string, int> value;
    for (const std::string& field : form->fields) {
        char name[3] = {field[0], field[1], 0};
        int high = 0, low = 0;
        std::sscanf(field.c_str() + 2, "%d %d", &high, &low);
        if (high >= low) {
            for (int i = low; i <= high; ++i)
                value[name] |= bit() << i;
        } else {
            for (int i = low; i >= high; --i)
                value[name] |= bit() << i;
        }
    }
    Bc6hTexels texels;
    const int weights[16] = {0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64};
    for (std::size_t i = 0; i < 16; ++i) {
        int index = 0;
        for (int k = 0; k < (i == 0 ? 3 : 4); ++k)
            index |= bit() << k;
        for (int c = 0; c < 3; ++c) {
            const std::string channel(1, "rgb"[c]);
            long ends[2] = {value[channel + "0"], value[channel + "1"]};
            if (form->delta > 0) {
                long delta = ends[1];
                if (delta >= 1L << (form->delta - 1))
                    delta -= 1L << form->delta;
                ends[1] = (ends[0] + delta) & ((1L << form->bits) - 1);
            }
            for (long& end : ends) {
                if (form->bits < 15 && end != 0)
                    end =
                        end == (1L << form->bits) - 1 ? 65535 : ((end << 16) + 32768) >> form->bits;
            }
            const long mixed =
                (ends[0] * (64 - weights[index]) + ends[1] * weights[index] + 32) >> 6;
            texels[i][c] = glm::unpackHalf1x16(std::uint16_t((mixed * 31) >> 6));
        }
    }
    return texels;
}

Bc6hTexels constant(const glm::vec3& colour) {
    Bc6hTexels texels;
    texels.fill(colour);
    return texels;
}

float nearestHalf(float value) {
    return glm::unpackHalf1x16(glm::packHalf1x16(value));
}

TEST(Bc6h, IsReadAsTheSpecificationSays) {
    std::mt19937 random(1);
    std::uniform_int_distribution<int> byte(0, 255);
    std::map<unsigned, int> seen;
    for (int i = 0; i < 20'000; ++i) {
        Bc6hBlock block;
        for (auto& each : block)
            each = std::uint8_t(byte(random));
        const auto expected = decodeAsSpecified(block);
        if (!expected)
            continue;
        ++seen[block[0] & 31U];
        const Bc6hTexels texels = decodeBc6h(block);
        for (std::size_t k = 0; k < 16; ++k)
            ASSERT_EQ(texels[k], (*expected)[k]) << "form " << (block[0] & 31U);
    }
    EXPECT_EQ(seen.size(), 4U);
}

TEST(Bc6h, BlocksOfOneColourAreTheNearestHalf) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> exponent(-23.0F, 15.99F);
    const auto draw = [&] { return std::exp2(exponent(random)); };
    for (int i = 0; i < 2'000; ++i) {
        const glm::vec3 colour(draw(), draw(), draw());
        const auto texels = decodeAsSpecified(encodeBc6h(constant(colour)));
        ASSERT_TRUE(texels);
        for (const glm::vec3& texel : *texels) {
            for (int c = 0; c < 3; ++c)
                ASSERT_LE(std::abs(texel[c] - colour[c]),
                          std::abs(nearestHalf(colour[c]) - colour[c]));
        }
    }
}

TEST(Bc6h, EveryHalfIsReached) {
    for (unsigned bits = 0; bits < 0x7C00U; ++bits) {
        const float value = glm::unpackHalf1x16(std::uint16_t(bits));
        ASSERT_EQ(decodeBc6h(encodeBc6h(constant(glm::vec3(value))))[5], glm::vec3(value)) << bits;
    }
}

TEST(Bc6h, WhatAHalfDoesNotHoldIsClipped) {
    const float infinity = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(decodeBc6h(encodeBc6h(constant({infinity, 1e9F, 70'000.0F})))[0],
              glm::vec3(65504.0F));
    EXPECT_EQ(decodeBc6h(encodeBc6h(constant({-1.0F, nan, -infinity})))[0], glm::vec3(0.0F));
    // Beside others, too, nothing comes out that is not a number.
    Bc6hTexels texels = constant(glm::vec3(0.5F));
    texels[3] = glm::vec3(infinity, nan, -3.0F);
    texels[9] = glm::vec3(0.0F, 65504.0F, 1e-9F);
    for (const glm::vec3& texel : decodeBc6h(encodeBc6h(texels))) {
        for (int c = 0; c < 3; ++c)
            EXPECT_TRUE(std::isfinite(texel[c]) && texel[c] >= 0.0F);
    }
}

TEST(Bc6h, ColoursOnALineComeOutToHalfAStepOfIt) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0.0F, 1.0F);
    for (int i = 0; i < 500; ++i) {
        // A factor of up to 16 from end to end, the same in all channels: a line of logarithms.
        const glm::vec3 first(0.02F + unit(random), 0.02F + unit(random), 0.02F + unit(random));
        const float octaves = 4.0F * unit(random);
        Bc6hTexels texels;
        for (auto& texel : texels)
            texel = first * std::exp2(octaves * unit(random));
        const Bc6hTexels out = decodeBc6h(encodeBc6h(texels));
        // Half a step of 15, and what half floats bend logarithms by: 0.09 of an octave.
        const float bound = std::exp2(octaves / 30.0F + 0.09F + 0.02F) - 1.0F;
        for (std::size_t k = 0; k < 16; ++k) {
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(out[k][c], texels[k][c], bound * texels[k][c]);
        }
    }
}

CubeMap<glm::vec3> pictured(int resolution) {
    CubeMap<glm::vec3> map(resolution);
    for (int face = 0; face < 6; ++face) {
        for (int row = 0; row < resolution; ++row) {
            for (int column = 0; column < resolution; ++column) {
                const float x = float(column) / float(resolution);
                const float y = float(row) / float(resolution);
                const bool wall = std::fmod(7.0F * x, 1.0F) > 0.4F && y > 0.3F;
                map.at(face, column, row) =
                    wall ? glm::vec3(0.3F + 0.1F * y, 0.25F, 0.2F * x)
                         : glm::vec3(0.2F + 0.3F * y, 0.4F + 0.3F * y, 0.9F + float(face));
            }
        }
    }
    return map;
}

TEST(Bc6h, MapsOfAnyResolutionComeBack) {
    for (const int resolution : {1, 2, 3, 5, 9}) {
        const CubeMap<glm::vec3> out =
            decodeBc6h(encodeBc6h(CubeMap<glm::vec3>(resolution, glm::vec3(0.25F, 1.5F, 64.0F))));
        ASSERT_EQ(out.resolution(), resolution);
        for (const glm::vec3& texel : out.texels())
            EXPECT_EQ(texel, glm::vec3(0.25F, 1.5F, 64.0F));
    }
}

TEST(Bc6h, PicturesKeepFortyDecibels) {
    for (const int resolution : {30, 64}) {
        const CubeMap<glm::vec3> map = pictured(resolution);
        const Bc6hMap small = encodeBc6h(map);
        const auto edge = std::size_t((resolution + 3) / 4);
        EXPECT_EQ(small.bytes(), 6 * edge * edge * 16);
        const CubeMap<glm::vec3> out = decodeBc6h(small);
        ASSERT_EQ(out.resolution(), resolution);
        PsnrAccumulator psnr;
        psnr.add(displayStrip(out, 1.0F), displayStrip(map, 1.0F));
        EXPECT_GT(psnr.decibels().value_or(100.0), 40.0) << resolution;
    }
}

TEST(Bc6h, IsTheSameWithAnyNumberOfThreads) {
    const CubeMap<glm::vec3> map = pictured(32);
    setThreadLimit(1);
    const Bc6hMap one = encodeBc6h(map);
    setThreadLimit(4);
    const Bc6hMap four = encodeBc6h(map);
    setThreadLimit(0);
    EXPECT_EQ(one.blocks, four.blocks);
}

}  // namespace
}  // namespace reflet
