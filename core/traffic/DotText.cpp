// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/traffic/MeshPrimitives.h"

#include <glm/geometric.hpp>

#include <array>
#include <cstdint>

namespace reflet {
namespace {

/// Seven rows from the top, the five low bits of each are the dots, left = high bit.
using Glyph = std::array<std::uint8_t, 7>;

struct Letter {
    char character;
    Glyph rows;
};

constexpr Letter kLetters[] = {
    {'A', {14, 17, 17, 31, 17, 17, 17}}, {'B', {30, 17, 17, 30, 17, 17, 30}},
    {'C', {14, 17, 16, 16, 16, 17, 14}}, {'D', {30, 17, 17, 17, 17, 17, 30}},
    {'E', {31, 16, 16, 30, 16, 16, 31}}, {'F', {31, 16, 16, 30, 16, 16, 16}},
    {'G', {14, 17, 16, 23, 17, 17, 15}}, {'H', {17, 17, 17, 31, 17, 17, 17}},
    {'I', {14, 4, 4, 4, 4, 4, 14}},      {'J', {7, 2, 2, 2, 2, 18, 12}},
    {'K', {17, 18, 20, 24, 20, 18, 17}}, {'L', {16, 16, 16, 16, 16, 16, 31}},
    {'M', {17, 27, 21, 21, 17, 17, 17}}, {'N', {17, 25, 21, 19, 17, 17, 17}},
    {'O', {14, 17, 17, 17, 17, 17, 14}}, {'P', {30, 17, 17, 30, 16, 16, 16}},
    {'Q', {14, 17, 17, 17, 21, 18, 13}}, {'R', {30, 17, 17, 30, 20, 18, 17}},
    {'S', {15, 16, 16, 14, 1, 1, 30}},   {'T', {31, 4, 4, 4, 4, 4, 4}},
    {'U', {17, 17, 17, 17, 17, 17, 14}}, {'V', {17, 17, 17, 17, 17, 10, 4}},
    {'W', {17, 17, 17, 21, 21, 27, 17}}, {'X', {17, 17, 10, 4, 10, 17, 17}},
    {'Y', {17, 17, 10, 4, 4, 4, 4}},     {'Z', {31, 1, 2, 4, 8, 16, 31}},
    {'0', {14, 17, 19, 21, 25, 17, 14}}, {'1', {4, 12, 4, 4, 4, 4, 14}},
    {'2', {14, 17, 1, 6, 8, 16, 31}},    {'3', {30, 1, 1, 14, 1, 1, 30}},
    {'4', {2, 6, 10, 18, 31, 2, 2}},     {'5', {31, 16, 30, 1, 1, 17, 14}},
    {'6', {6, 8, 16, 30, 17, 17, 14}},   {'7', {31, 1, 2, 4, 8, 8, 8}},
    {'8', {14, 17, 17, 14, 17, 17, 14}}, {'9', {14, 17, 17, 15, 1, 2, 12}},
    {'-', {0, 0, 0, 14, 0, 0, 0}},
};
constexpr int kAdvance = 6;  // dots from letter to letter

const Glyph* glyphOf(char c) {
    for (const Letter& letter : kLetters) {
        if (letter.character == c) {
            return &letter.rows;
        }
    }
    return nullptr;
}

}  // namespace

int dotTextWidth(std::string_view text) {
    return text.empty() ? 0 : int(text.size()) * kAdvance - 1;
}

PartMesh dotText(std::string_view text, const glm::vec3& origin, const glm::vec3& right,
                 const glm::vec3& up, float pitch, std::uint16_t material) {
    PartMesh mesh;
    const glm::vec3 normal = glm::normalize(glm::cross(right, up));
    const float edge = 0.86F * pitch;
    for (std::size_t k = 0; k < text.size(); ++k) {
        const Glyph* glyph = glyphOf(text[k]);
        for (int row = 0; glyph != nullptr && row < 7; ++row) {
            for (int column = 0; column < 5; ++column) {
                if ((((*glyph)[std::size_t(row)] >> (4 - column)) & 1) == 0) {
                    continue;
                }
                const glm::vec3 p = origin + right * (float(int(k) * kAdvance + column) * pitch) +
                                    up * (float(6 - row) * pitch);
                const auto base = std::uint32_t(mesh.positions.size());
                for (const glm::vec3& q :
                     {p, p + right * edge, p + right * edge + up * edge, p + up * edge}) {
                    mesh.positions.push_back(q);
                    mesh.normals.push_back(normal);
                    mesh.surface.emplace_back(0.0F);
                }
                mesh.triangles.emplace_back(base, base + 1, base + 2);
                mesh.triangles.emplace_back(base, base + 2, base + 3);
                mesh.material.insert(mesh.material.end(), 2, material);
            }
        }
    }
    return mesh;
}

}  // namespace reflet
