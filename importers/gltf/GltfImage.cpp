// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/GltfDocument.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#define STBI_ONLY_JPEG
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 16384
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace reflet::gltf {

namespace {

constexpr std::size_t kLargestImage = std::size_t(256) << 20;  // bytes of the file
constexpr std::size_t kMostPixels = 64'000'000;

float linearOf(unsigned char value) {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> out{};
        for (std::size_t i = 0; i < out.size(); ++i) {
            const double s = double(i) / 255.0;
            out[i] = float(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
        }
        return out;
    }();
    return table[value];
}

/// Index of the texel at a coordinate that repeats.
int wrapped(float at, int size) {
    if (!(std::abs(at) < 1e6F))
        return 0;
    const float fraction = at - std::floor(at);
    return std::min(int(fraction * float(size)), size - 1);
}

}  // namespace

glm::vec3 Image::sample(float u, float v) const {
    const std::size_t at =
        4 * (std::size_t(wrapped(v, height)) * std::size_t(width) + std::size_t(wrapped(u, width)));
    return {linearOf(rgba[at]), linearOf(rgba[at + 1]), linearOf(rgba[at + 2])};
}

glm::vec3 Image::data(float u, float v) const {
    const std::size_t at =
        4 * (std::size_t(wrapped(v, height)) * std::size_t(width) + std::size_t(wrapped(u, width)));
    return glm::vec3(float(rgba[at]), float(rgba[at + 1]), float(rgba[at + 2])) / 255.0F;
}

Result<Image> decodeImage(std::string_view bytes) {
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    Image image;
    int channels = 0;
    if (bytes.size() > kLargestImage || stbi_info_from_memory(data, int(bytes.size()), &image.width,
                                                              &image.height, &channels) == 0) {
        return fail(ErrorCode::Unreadable, "is no PNG or JPEG image");
    }
    if (image.width < 1 || image.height < 1 ||
        std::size_t(image.width) * std::size_t(image.height) > kMostPixels) {
        return fail(ErrorCode::ResourceLimit, "is larger than 64 million pixels");
    }
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(data, int(bytes.size()), &image.width, &image.height, &channels, 4),
        stbi_image_free);
    if (!pixels)
        return fail(ErrorCode::Unreadable, "cannot be decoded");
    image.rgba.assign(pixels.get(),
                      pixels.get() + 4 * std::size_t(image.width) * std::size_t(image.height));
    return image;
}

const Image* Images::ofTexture(int texture) {
    const tinygltf::Texture* entry = elementAt(m_document.model().textures, texture);
    if (entry == nullptr || entry->source < 0)
        return nullptr;
    const auto index = std::size_t(entry->source);
    const auto [known, isNew] = m_images.try_emplace(index);
    if (isNew) {
        const auto bytes = m_document.image(index);
        auto decoded = bytes ? decodeImage(*bytes) : Result<Image>(tl::unexpected(bytes.error()));
        if (decoded) {
            known->second = std::move(*decoded);
            ++m_read;
        } else {
            m_diagnostics.push_back(
                {Severity::Warning, "image-unreadable", fmt::format("image {}", index),
                 fmt::format("its image {} cannot be used: {}", m_document.imageName(index),
                             decoded.error().what),
                 "Put the image beside the file; its material is shown in its plain colour."});
        }
    }
    return known->second ? &*known->second : nullptr;
}

}  // namespace reflet::gltf
