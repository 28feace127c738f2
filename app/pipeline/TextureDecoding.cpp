// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/TextureDecoding.h"

#include "core/baking/Pattern.h"
#include "core/base/ParallelFor.h"
#include "core/environment/ImageMetrics.h"
#include "core/io/ImageFile.h"
#include "core/io/RasterFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr int kSmallestEdge = 64, kLargestEdge = 2048;

ImageSource sourceOf(const CityTexture& texture) {
    if (!texture.embedded)
        return {texture.path};
    return {texture.path, texture.embedded->offset, texture.embedded->length,
            texture.embedded->bytes};
}

/// A part of an orthophoto, no longer than `edge`.
Result<TextureImage> readWindow(const CityTexture& texture, int edge) {
    const PictureWindow& window = *texture.window;
    const auto file = RasterFile::open(texture.path);
    if (!file)
        return tl::unexpected(file.error());
    const double share = std::min(1.0, double(edge) / std::max(window.width, window.height));
    const auto pixels = [&](int count) { return std::max(1, int(share * count)); };
    return file->readPicture(window.crs, window.min, window.max, pixels(window.width),
                             pixels(window.height));
}

/// Pixels of each, zero where that cannot be told.
std::vector<glm::ivec2> sizesOf(const std::vector<CityTexture>& references, const JobContext& job) {
    std::vector<glm::ivec2> sizes(references.size(), glm::ivec2(0));
    parallelFor(0, references.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const CityTexture& texture = references[i];
            if (texture.path.empty() || job.cancelled())
                continue;
            if (texture.window)
                sizes[i] = {texture.window->width, texture.window->height};
            else if (const auto size = textureSize(sourceOf(texture)))
                sizes[i] = *size;
        }
    });
    return sizes;
}

}  // namespace

TextureCap textureCap(const std::vector<glm::ivec2>& sizes, double budget) {
    TextureCap cap{kLargestEdge, 0};
    const auto bytes = [&](const glm::ivec2& size) {
        glm::ivec2 left = size;
        while (std::max(left.x, left.y) > cap.edge)
            left = {std::max(1, left.x / 2), std::max(1, left.y / 2)};
        return 4.0 * double(left.x) * double(left.y);
    };
    for (; cap.edge > kSmallestEdge; cap.edge /= 2) {
        double total = 0.0;
        for (const glm::ivec2& size : sizes)
            total += bytes(size);
        if (total <= budget)
            break;
    }
    cap.reduced = std::size_t(std::count_if(sizes.begin(), sizes.end(), [&](const glm::ivec2& s) {
        return std::max(s.x, s.y) > cap.edge;
    }));
    return cap;
}

void settleAlpha(TextureImage& image, TextureAlpha alpha) {
    if (alpha == TextureAlpha::Shown)
        return;
    glm::dvec3 sum(0.0);
    double weight = 0.0;
    const auto& linear = linearFromSrgbTable();
    for (std::size_t i = 0; alpha == TextureAlpha::Closed && i < image.rgba.size(); i += 4) {
        const double a = image.rgba[i + 3];
        weight += a;
        for (std::size_t c = 0; c < 3; ++c)
            sum[int(c)] += a * double(linear[image.rgba[i + c]]);
    }
    const glm::vec3 mean = weight > 0.0 ? glm::vec3(sum / weight) : glm::vec3(0.5F);
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        const float a = float(image.rgba[i + 3]) / 255.0F;
        for (std::size_t c = 0; alpha == TextureAlpha::Closed && a < 1.0F && c < 3; ++c) {
            const float shown = a * linear[image.rgba[i + c]] + (1.0F - a) * mean[int(c)];
            image.rgba[i + c] = std::uint8_t(std::lround(255.0F * srgbFromLinear(shown)));
        }
        image.rgba[i + 3] = 255;
    }
}

std::vector<TextureImage> decodeTextures(const std::vector<CityTexture>& references,
                                         std::vector<Diagnostic>& remarks, const JobContext& job) {
    std::vector<TextureImage> images(references.size());
    const TextureCap cap = textureCap(sizesOf(references, job));
    std::vector<Diagnostic> problems(references.size());
    parallelFor(0, references.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const CityTexture& texture = references[i];
            if (texture.path.empty() || job.cancelled())
                continue;
            auto image = texture.window ? readWindow(texture, cap.edge)
                                        : readTexture(sourceOf(texture), kLargestTexture, cap.edge);
            if (!image) {
                problems[i] = {Severity::Warning, "texture-unreadable", texture.reference,
                               image.error().message(), image.error().remedy};
                continue;
            }
            settleAlpha(*image, texture.alpha);
            images[i] = std::move(*image);
        }
    });
    constexpr std::size_t kNamed = 20;
    std::size_t bad = 0;
    for (auto& problem : problems) {
        if (!problem.code.empty() && bad++ < kNamed)
            remarks.push_back(std::move(problem));
    }
    if (bad > kNamed)
        remarks.push_back({Severity::Warning, "texture-unreadable", "",
                           fmt::format("{} textures in all cannot be read", bad),
                           "Export the model again with images as PNG or JPEG."});
    if (cap.reduced > 0 && cap.edge < kLargestEdge)
        remarks.push_back(
            {Severity::Info, "textures-reduced", "",
             fmt::format(
                 "{} of {} textures were reduced to at most {} pixels along an edge, so that "
                 "all of them take no more than {} MB",
                 cap.reduced, references.size(), cap.edge, int(kTextureBudget / (1024 * 1024))),
             "Import a part of the city to see it finer."});
    return images;
}

}  // namespace reflet
