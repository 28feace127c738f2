// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/ImageFile.h"

#include "core/base/Files.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace reflet {

namespace {

namespace oiio = OIIO;

tl::unexpected<Error> unreadable(const std::filesystem::path& path, const std::string& why) {
    return fail(ErrorCode::Unreadable, "the image cannot be read: " + why, path.string(),
                "Open it in an image editor and save it anew as PNG or JPEG.");
}

/// The library's last message on this thread, one line.
std::string libraryError(const std::string& fallback) {
    std::string text = oiio::geterror();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text.empty() ? fallback : text;
}

/// Any 8-bit image of 1..n channels as RGBA.
std::vector<std::uint8_t> toRgba(const std::vector<std::uint8_t>& pixels, std::size_t count,
                                 int channels) {
    std::vector<std::uint8_t> rgba(count * 4);
    const bool grey = channels < 3;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint8_t* in = &pixels[i * static_cast<std::size_t>(channels)];
        std::uint8_t* out = &rgba[i * 4];
        out[0] = in[0];
        out[1] = grey ? in[0] : in[1];
        out[2] = grey ? in[0] : in[2];
        out[3] = channels == 2 ? in[1] : channels >= 4 ? in[3] : 255;
    }
    return rgba;
}

/// Halves an image by averaging 2 × 2 blocks (an odd last row or column is averaged with itself).
TextureImage halved(const TextureImage& image) {
    TextureImage out{std::max(1, image.width / 2), std::max(1, image.height / 2), {}};
    out.rgba.resize(std::size_t(out.width) * std::size_t(out.height) * 4);
    const auto at = [&](int x, int y, int c) {
        x = std::min(x, image.width - 1);
        y = std::min(y, image.height - 1);
        return int(image.rgba[(std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * 4 +
                              std::size_t(c)]);
    };
    for (int y = 0; y < out.height; ++y) {
        for (int x = 0; x < out.width; ++x) {
            for (int c = 0; c < 4; ++c) {
                const int sum = at(2 * x, 2 * y, c) + at(2 * x + 1, 2 * y, c) +
                                at(2 * x, 2 * y + 1, c) + at(2 * x + 1, 2 * y + 1, c);
                out.rgba[(std::size_t(y) * std::size_t(out.width) + std::size_t(x)) * 4 +
                         std::size_t(c)] = static_cast<std::uint8_t>((sum + 2) / 4);
            }
        }
    }
    return out;
}

std::string centerText(const glm::dvec3& center) {
    return fmt::format("{} {} {}", center.x, center.y, center.z);
}

}  // namespace

Result<TextureImage> readTexture(const std::filesystem::path& path, std::size_t maxPixels,
                                 int maxEdge) {
    try {
        auto input = oiio::ImageInput::open(path.string());
        if (!input)
            return unreadable(path, libraryError("unknown format"));
        const oiio::ImageSpec& spec = input->spec();
        const int channels = spec.nchannels;
        if (spec.width <= 0 || spec.height <= 0 || channels <= 0 || spec.depth > 1) {
            return unreadable(path, "it is empty or not a flat picture");
        }
        const std::size_t count = std::size_t(spec.width) * std::size_t(spec.height);
        if (count > maxPixels || channels > 16) {
            return fail(
                ErrorCode::ResourceLimit,
                fmt::format("the image claims {} x {} pixels of {} channels", spec.width,
                            spec.height, channels),
                path.string(),
                fmt::format("Scale it to at most {} million pixels.", maxPixels / 1'000'000));
        }
        TextureImage image{spec.width, spec.height, {}};
        std::vector<std::uint8_t> pixels(count * static_cast<std::size_t>(channels));
        if (!input->read_image(0, 0, 0, channels, oiio::TypeDesc::UINT8, pixels.data())) {
            return unreadable(path, input->geterror());
        }
        image.rgba = toRgba(pixels, count, channels);
        while (std::max(image.width, image.height) > maxEdge)
            image = halved(image);
        return image;
    } catch (const std::exception& e) {
        return unreadable(path, e.what());
    }
}

Result<void> writePng(const DisplayImage& image, const std::filesystem::path& path) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(image.pixels.size() * 3);
    for (const glm::vec3& pixel : image.pixels) {
        for (int c = 0; c < 3; ++c) {
            bytes.push_back(
                static_cast<std::uint8_t>(std::lround(std::clamp(pixel[c], 0.0F, 1.0F) * 255.0F)));
        }
    }
    return writeAtomically(path, [&](const std::filesystem::path& temporary) -> Result<void> {
        auto output = oiio::ImageOutput::create("png");
        if (!output)
            return fail(ErrorCode::Internal, libraryError("no PNG writer"), path.string());
        const oiio::ImageSpec spec(image.width, image.height, 3, oiio::TypeDesc::UINT8);
        const bool written = output->open(temporary.string(), spec) &&
                             output->write_image(oiio::TypeDesc::UINT8, bytes.data()) &&
                             output->close();
        if (!written) {
            return fail(ErrorCode::WriteFailed,
                        "the picture cannot be written: " + output->geterror(), path.string(),
                        "Check that the folder exists, is writable and has space.");
        }
        return {};
    });
}

Result<void> writeEnvironmentMap(const std::string& id, const glm::dvec3& center,
                                 const CubeMap<glm::vec3>& radiance, const CubeMap<float>& distance,
                                 const std::filesystem::path& path) {
    const int n = radiance.resolution();
    std::vector<float> pixels;
    pixels.reserve(radiance.texels().size() * 4);
    for (std::size_t i = 0; i < radiance.texels().size(); ++i) {
        for (int c = 0; c < 3; ++c)
            pixels.push_back(std::clamp(radiance.texels()[i][c], 0.0F, 65504.0F));
        pixels.push_back(distance.texels()[i]);
    }
    return writeAtomically(path, [&](const std::filesystem::path& temporary) -> Result<void> {
        oiio::ImageSpec spec(n, 6 * n, 4, oiio::TypeDesc::FLOAT);
        spec.channelnames = {"R", "G", "B", "Z"};
        spec.channelformats = {oiio::TypeDesc::HALF, oiio::TypeDesc::HALF, oiio::TypeDesc::HALF,
                               oiio::TypeDesc::FLOAT};
        spec.attribute("compression", "zip");
        spec.attribute("reflet:id", id);
        spec.attribute("reflet:center", centerText(center));
        spec.attribute("reflet:faces", "+X -X +Y -Y +Z -Z");
        auto output = oiio::ImageOutput::create("exr");
        if (!output)
            return fail(ErrorCode::Internal, libraryError("no OpenEXR writer"), path.string());
        const bool written = output->open(temporary.string(), spec) &&
                             output->write_image(oiio::TypeDesc::FLOAT, pixels.data()) &&
                             output->close();
        if (!written) {
            return fail(ErrorCode::WriteFailed, "the map cannot be written: " + output->geterror(),
                        path.string(), "Check that the folder exists, is writable and has space.");
        }
        return {};
    });
}

Result<ReferenceEnvironmentMap> readEnvironmentMap(const std::filesystem::path& path) {
    try {
        auto input = oiio::ImageInput::open(path.string());
        if (!input)
            return unreadable(path, libraryError("not an OpenEXR file"));
        const oiio::ImageSpec& spec = input->spec();
        const int n = spec.width;
        const bool shape = n >= 1 && n <= 4096 && spec.height == 6 * n && spec.nchannels == 4;
        ReferenceEnvironmentMap map;
        const std::string center = spec.get_string_attribute("reflet:center");
        if (!shape || std::sscanf(center.c_str(), "%lf %lf %lf", &map.center.x, &map.center.y,
                                  &map.center.z) != 3) {
            return unreadable(path,
                              "it is no environment map of Reflet (1 x 6 faces, channels R G B Z)");
        }
        map.id = spec.get_string_attribute("reflet:id");
        std::vector<float> pixels(std::size_t(n) * std::size_t(n) * 6 * 4);
        if (!input->read_image(0, 0, 0, 4, oiio::TypeDesc::FLOAT, pixels.data())) {
            return unreadable(path, input->geterror());
        }
        map.radiance = CubeMap<glm::vec3>(n);
        map.distance = CubeMap<float>(n);
        for (std::size_t i = 0; i < map.distance.texels().size(); ++i) {
            const float* p = &pixels[i * 4];
            const bool sound = p[0] >= 0.0F && p[1] >= 0.0F && p[2] >= 0.0F && p[3] >= 0.0F &&
                               std::isfinite(p[0] + p[1] + p[2]);
            if (!sound)
                return unreadable(path, "it holds negative values or values that are no numbers");
            map.radiance.texels()[i] = {p[0], p[1], p[2]};
            map.distance.texels()[i] = p[3];
        }
        return map;
    } catch (const std::exception& e) {
        return unreadable(path, e.what());
    }
}

std::string openImageIoVersion() {
    return fmt::format("{}", OIIO_VERSION_STRING);
}

}  // namespace reflet
