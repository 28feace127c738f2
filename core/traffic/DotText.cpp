// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/DotFont.h"
#include "core/traffic/MeshPrimitives.h"

#include <glm/geometric.hpp>

namespace reflet {

int dotTextWidth(std::string_view text) {
    return text.empty() ? 0 : int(text.size()) * kDotAdvance - 1;
}

PartMesh dotText(std::string_view text, const glm::vec3& origin, const glm::vec3& right,
                 const glm::vec3& up, float pitch, std::uint16_t material) {
    PartMesh mesh;
    const glm::vec3 normal = glm::normalize(glm::cross(right, up));
    const float edge = 0.86F * pitch;
    for (std::size_t k = 0; k < text.size(); ++k) {
        const DotGlyph* glyph = dotGlyph(text[k]);
        for (int row = 0; glyph != nullptr && row < kDotRows; ++row) {
            for (int column = 0; column < kDotColumns; ++column) {
                if ((((*glyph)[std::size_t(row)] >> (kDotColumns - 1 - column)) & 1) == 0) {
                    continue;
                }
                const glm::vec3 p = origin +
                                    right * (float(int(k) * kDotAdvance + column) * pitch) +
                                    up * (float(kDotRows - 1 - row) * pitch);
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
