// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/GltfCityTextures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace reflet::gltf {

namespace {

/// The image of a texture, in the plain way or by an extension that names another format.
int imageOf(const tinygltf::Texture& texture) {
    if (texture.source >= 0)
        return texture.source;
    for (const char* name : {"EXT_texture_webp", "KHR_texture_basisu", "MSFT_texture_dds"}) {
        const int source = indexIn(extensionOf(texture.extensions, name), "source");
        if (source >= 0)
            return source;
    }
    return -1;
}

}  // namespace

bool unwrap(const Sampler& sampler, std::array<glm::vec2, 3>& uv) {
    constexpr float kTolerance = 1e-4F;  // of an atlas whose coordinates were rounded
    bool exact = true;
    for (int axis = 0; axis < 2; ++axis) {
        const Wrap mode = axis == 0 ? sampler.u : sampler.v;
        const auto [low, high] = std::minmax({uv[0][axis], uv[1][axis], uv[2][axis]});
        const float turn = std::floor(low + kTolerance);
        const bool within = high <= turn + 1.0F + kTolerance;
        if (mode == Wrap::Clamp) {
            exact = exact && low >= -kTolerance && high <= 1.0F + kTolerance;
            continue;
        }
        if (mode == Wrap::Mirror && !within) {
            exact = false;
            continue;
        }
        const bool odd = mode == Wrap::Mirror && std::fmod(std::abs(turn), 2.0F) > 0.5F;
        for (glm::vec2& corner : uv)
            corner[axis] = odd ? 1.0F - (corner[axis] - turn) : corner[axis] - turn;
    }
    return exact;
}

std::uint32_t CityTextures::of(int material, const Look& look) {
    const auto [seen, isNewMaterial] = m_ofMaterial.try_emplace(material, kNone);
    if (!isNewMaterial)
        return seen->second;
    const auto& model = m_document.model();
    const tinygltf::Texture* texture = elementAt(model.textures, look.base.texture);
    const int image = texture != nullptr ? imageOf(*texture) : -1;
    if (image < 0)
        return kNone;
    const tinygltf::Material* source = elementAt(model.materials, material);
    const bool opaque =
        source == nullptr || source->alphaMode.empty() || source->alphaMode == "OPAQUE";
    m_closed += opaque ? 0 : 1;
    const Sampler sampler = m_document.sampler(look.base.texture);
    CityMesh::Texture out;
    out.number = std::size_t(image);
    out.repeat = sampler.u != Wrap::Clamp || sampler.v != Wrap::Clamp;
    out.alpha = opaque ? TextureAlpha::Ignored : TextureAlpha::Closed;
    const auto next = std::uint32_t(m_out.textures.size());
    const auto [known, isNew] = m_numbers.try_emplace({out.number, out.repeat, out.alpha}, next);
    if (isNew) {
        const auto [place, isNewImage] = m_places.try_emplace(out.number);
        if (isNewImage)
            place->second = m_document.imagePlace(out.number);
        out.image = place->second;
        m_out.textures.push_back(std::move(out));
    }
    return seen->second = known->second;
}

std::optional<std::array<glm::vec2, 3>> CityTextures::corners(const Primitive& primitive,
                                                              const glm::uvec3& triangle,
                                                              const TextureUse& use) {
    constexpr float kFarthest = 1e5F;  // turns, beyond which a float tells no place on an image
    const std::vector<float>& values = use.set == 1 ? primitive.uv1 : primitive.uv;
    std::array<glm::vec2, 3> out{};
    bool sound = use.set <= 1 && values.size() == 2 * primitive.positions.size();
    for (int k = 0; sound && k < 3; ++k) {
        const std::size_t at = 2 * std::size_t(triangle[k]);
        const glm::vec2 place = use.at({values[at], values[at + 1]});
        out[std::size_t(k)] = {place.x, place.y};
        sound = std::abs(place.x) < kFarthest && std::abs(place.y) < kFarthest;
    }
    if (!sound) {
        ++m_withoutUv;
        return std::nullopt;
    }
    const Sampler sampler = m_document.sampler(use.texture);
    if (sampler.u != Wrap::Clamp || sampler.v != Wrap::Clamp)
        m_approximated += unwrap(sampler, out) ? 0 : 1;
    for (glm::vec2& corner : out)
        corner.y = 1.0F - corner.y;
    return out;
}

void CityTextures::tell() const {
    auto& remarks = m_out.remarks;
    const std::string object = m_document.path().filename().string();
    if (m_withoutUv > 0)
        remark(remarks, Severity::Warning, "texture-coordinates", object,
               fmt::format("{} triangles have a texture and no coordinates that fit it; they are "
                           "shown in their plain colour",
                           m_withoutUv),
               "Export the file again with its texture coordinates.");
    if (m_approximated > 0)
        remark(remarks, Severity::Info, "texture-wrap", object,
               fmt::format("on {} triangles the image goes on by repeating, where the file would "
                           "mirror it or draw its edge out",
                           m_approximated));
    if (m_closed > 0)
        remark(remarks, Severity::Info, "texture-holes", object,
               fmt::format("{} materials are cut out or see-through by their texture; they are "
                           "shown closed, in the mean colour of the rest of it",
                           m_closed));
}

}  // namespace reflet::gltf
