// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/ImageFile.h"

#include "core/base/Files.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string_view>

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

/// The mean of blocks of 2^halvings pixels along both edges of an image that comes in strips, from
/// the top; rows and columns that fill no block are left out, unless there are no others.
class BlockMeans {
public:
    BlockMeans(int width, int height, int halvings)
        : m_from(width, height),
          m_halvings(halvings),
          m_image{std::max(1, width >> halvings), std::max(1, height >> halvings), {}} {
        m_image.rgba.resize(std::size_t(m_image.width) * std::size_t(m_image.height) * 4);
    }
    [[nodiscard]] int rows() const { return m_image.height; }
    [[nodiscard]] int firstOf(int row) const { return row << m_halvings; }
    [[nodiscard]] int endOf(int row) const { return std::min((row + 1) << m_halvings, m_from.y); }

    /// rgba: the pixels from firstOf(row) to endOf(row).
    void take(int row, const std::vector<std::uint8_t>& rgba) {
        const int lines = endOf(row) - firstOf(row);
        for (int x = 0; x < m_image.width; ++x) {
            const int first = x << m_halvings;
            const int end = std::min((x + 1) << m_halvings, m_from.x);
            const int count = lines * (end - first);
            for (int c = 0; c < 4; ++c) {
                std::int64_t sum = count / 2;
                for (int y = 0; y < lines; ++y) {
                    for (int i = first; i < end; ++i)
                        sum += rgba[(std::size_t(y) * std::size_t(m_from.x) + std::size_t(i)) * 4 +
                                    std::size_t(c)];
                }
                m_image.rgba[(std::size_t(row) * std::size_t(m_image.width) + std::size_t(x)) * 4 +
                             std::size_t(c)] = std::uint8_t(sum / count);
            }
        }
    }
    TextureImage result() && { return std::move(m_image); }

private:
    glm::ivec2 m_from;
    int m_halvings;
    TextureImage m_image;
};

constexpr std::uint64_t kLargestEncoded = std::uint64_t(256) << 20;  // bytes of an embedded image

/// What an embedded image is, by its first bytes; empty: nothing that can be read.
const char* embeddedName(std::string_view bytes) {
    if (bytes.starts_with("\x89PNG"))
        return "embedded.png";
    return bytes.starts_with("\xff\xd8") ? "embedded.jpg" : "";
}

/// An image that is open: its bytes outlive the reader.
struct OpenImage {
    std::shared_ptr<const std::string> bytes;
    std::unique_ptr<oiio::Filesystem::IOMemReader> reader;
    std::unique_ptr<oiio::ImageInput> input;
};

Result<std::shared_ptr<const std::string>> embeddedBytes(const ImageSource& source) {
    if (source.bytes)
        return source.bytes;
    if (source.length > kLargestEncoded)
        return fail(ErrorCode::ResourceLimit, "an image in it is larger than 256 MB",
                    source.path.string(), "Export it with smaller images.");
    auto bytes = std::make_shared<std::string>(std::size_t(source.length), '\0');
    std::ifstream file(source.path, std::ios::binary);
    file.seekg(std::streamoff(source.offset));
    if (!file.read(bytes->data(), std::streamsize(source.length)))
        return unreadable(source.path, "an image that was in it is not there any more");
    return bytes;
}

Result<OpenImage> openImage(const ImageSource& source, std::size_t maxPixels) {
    OpenImage image;
    oiio::ImageSpec asStored;  // colours of see-through pixels are not darkened
    asStored.attribute("oiio:UnassociatedAlpha", 1);
    if (source.bytes || source.length > 0) {
        auto bytes = embeddedBytes(source);
        if (!bytes)
            return tl::unexpected(bytes.error());
        image.bytes = *std::move(bytes);
        const std::string name = embeddedName(*image.bytes);
        if (name.empty())
            return unreadable(source.path, "an image in it is neither PNG nor JPEG");
        image.reader = std::make_unique<oiio::Filesystem::IOMemReader>(image.bytes->data(),
                                                                       image.bytes->size());
        oiio::Filesystem::IOProxy* reader = image.reader.get();
        asStored.attribute("oiio:ioproxy", oiio::TypeDesc::PTR, &reader);
        image.input = oiio::ImageInput::open(name, &asStored, reader);
    } else {
        image.input = oiio::ImageInput::open(source.path.string(), &asStored);
    }
    if (!image.input)
        return unreadable(source.path, libraryError("unknown format"));
    const oiio::ImageSpec& spec = image.input->spec();
    if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0 || spec.depth > 1)
        return unreadable(source.path, "it is empty or not a flat picture");
    if (std::size_t(spec.width) * std::size_t(spec.height) > maxPixels || spec.nchannels > 16) {
        return fail(ErrorCode::ResourceLimit,
                    fmt::format("the image claims {} x {} pixels of {} channels", spec.width,
                                spec.height, spec.nchannels),
                    source.path.string(),
                    fmt::format("Scale it to at most {} million pixels.", maxPixels / 1'000'000));
    }
    return image;
}

/// All pixels, or the rows of one strip, as RGBA.
Result<std::vector<std::uint8_t>> readRows(oiio::ImageInput& input, int first, int end,
                                           const std::filesystem::path& path) {
    const oiio::ImageSpec& spec = input.spec();
    const std::size_t count = std::size_t(spec.width) * std::size_t(end - first);
    std::vector<std::uint8_t> pixels(count * std::size_t(spec.nchannels));
    const bool whole = first == 0 && end == spec.height;
    const bool read =
        whole ? input.read_image(0, 0, 0, spec.nchannels, oiio::TypeDesc::UINT8, pixels.data())
              : input.read_scanlines(0, 0, spec.y + first, spec.y + end, 0, 0, spec.nchannels,
                                     oiio::TypeDesc::UINT8, pixels.data());
    if (!read)
        return unreadable(path, input.geterror());
    return toRgba(pixels, count, spec.nchannels);
}

/// An image that is halved while it is read, row of blocks by row; tiled files all at once.
Result<TextureImage> readReduced(oiio::ImageInput& input, int halvings,
                                 const std::filesystem::path& path) {
    const glm::ivec2 size(input.spec().width, input.spec().height);
    BlockMeans means(size.x, size.y, halvings);
    std::vector<std::uint8_t> all;
    const bool inStrips = input.spec().tile_width == 0;
    if (!inStrips) {
        auto rgba = readRows(input, 0, size.y, path);
        if (!rgba)
            return tl::unexpected(rgba.error());
        all = *std::move(rgba);
    }
    const std::ptrdiff_t stride = 4 * std::ptrdiff_t(size.x);
    for (int row = 0; row < means.rows(); ++row) {
        const int first = means.firstOf(row), end = means.endOf(row);
        if (!inStrips) {
            means.take(row, {all.begin() + first * stride, all.begin() + end * stride});
            continue;
        }
        const auto rgba = readRows(input, first, end, path);
        if (!rgba)
            return tl::unexpected(rgba.error());
        means.take(row, *rgba);
    }
    return std::move(means).result();
}

std::string centerText(const glm::dvec3& center) {
    return fmt::format("{} {} {}", center.x, center.y, center.z);
}

}  // namespace

Result<TextureImage> readTexture(const ImageSource& source, std::size_t maxPixels, int maxEdge) {
    try {
        const auto image = openImage(source, maxPixels);
        if (!image)
            return tl::unexpected(image.error());
        const oiio::ImageSpec& spec = image->input->spec();
        const glm::ivec2 size(spec.width, spec.height);
        int halvings = 0;
        while (std::max(size.x, size.y) >> halvings > std::max(maxEdge, 1))
            ++halvings;
        if (halvings == 0) {
            auto rgba = readRows(*image->input, 0, size.y, source.path);
            if (!rgba)
                return tl::unexpected(rgba.error());
            return TextureImage{size.x, size.y, *std::move(rgba)};
        }
        return readReduced(*image->input, halvings, source.path);
    } catch (const std::exception& e) {
        return unreadable(source.path, e.what());
    }
}

Result<glm::ivec2> textureSize(const ImageSource& source, std::size_t maxPixels) {
    try {
        const auto image = openImage(source, maxPixels);
        if (!image)
            return tl::unexpected(image.error());
        return glm::ivec2(image->input->spec().width, image->input->spec().height);
    } catch (const std::exception& e) {
        return unreadable(source.path, e.what());
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
