// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/GltfDocument.h"

#include "core/base/Files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <set>

namespace reflet::gltf {

using nlohmann::json;

namespace {

constexpr std::uint32_t kMagic = 0x46546C67;  // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;
constexpr std::size_t kHeader = 12;
constexpr std::size_t kChunkHeader = 8;

/// Extensions that a file may require: read, or without bearing on what Reflet shows.
const std::set<std::string, std::less<>> kKnownExtensions{
    "KHR_draco_mesh_compression",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
};

std::uint32_t word(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof(value));
    return value;
}

tl::unexpected<Error> unreadable(const std::string& what, const std::filesystem::path& path) {
    return fail(ErrorCode::Unreadable, what, path.string(),
                "Export the vehicle again as glTF 2.0 (.glb), e.g. from Blender.");
}

struct Container {
    std::string_view json;
    std::string_view binary;
};

/// The chunks of a .glb (glTF 2.0 specification, section 4.4); plain text is its own JSON.
Result<Container> openContainer(std::string_view bytes, const std::filesystem::path& path) {
    const bool binary = bytes.size() >= 4 && word(bytes, 0) == kMagic;
    if (!binary) {
        std::string suffix = path.extension().string();
        std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                       [](unsigned char c) { return char(std::tolower(c)); });
        if (suffix == ".glb")
            return unreadable("is no binary glTF: it does not begin with \"glTF\"", path);
        return Container{bytes, {}};
    }
    if (bytes.size() < kHeader)
        return unreadable("is cut off within its header", path);
    if (word(bytes, 4) != 2)
        return unreadable(fmt::format("is of glTF version {}, not 2", word(bytes, 4)), path);
    const std::size_t length = word(bytes, 8);
    if (length > bytes.size()) {
        return unreadable(fmt::format("is cut off: {} of {} bytes are there", bytes.size(), length),
                          path);
    }
    Container out;
    for (std::size_t at = kHeader; at + kChunkHeader <= length;) {
        const std::size_t size = word(bytes, at);
        const std::uint32_t type = word(bytes, at + 4);
        if (size > length - at - kChunkHeader)
            return unreadable("is cut off within a chunk", path);
        const std::string_view chunk = bytes.substr(at + kChunkHeader, size);
        if (type == kJsonChunk && out.json.empty()) {
            out.json = chunk;
        } else if (type == kBinaryChunk && out.binary.empty()) {
            out.binary = chunk;
        }
        at += kChunkHeader + size;
    }
    if (out.json.empty())
        return unreadable("has no JSON in it", path);
    return out;
}

int base64Digit(char c) {
    if (c >= 'A' && c <= 'Z')
        return c - 'A';
    if (c >= 'a' && c <= 'z')
        return c - 'a' + 26;
    if (c >= '0' && c <= '9')
        return c - '0' + 52;
    return c == '+' || c == '-' ? 62 : c == '/' || c == '_' ? 63 : -1;
}

std::optional<std::string> fromBase64(std::string_view digits) {
    std::string out;
    out.reserve(digits.size() / 4 * 3);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : digits) {
        if (c == '=')
            break;
        const int digit = base64Digit(c);
        if (digit < 0)
            return std::nullopt;
        bits = (bits << 6U) | std::uint32_t(digit);
        count += 6;
        if (count >= 8) {
            count -= 8;
            out.push_back(char((bits >> unsigned(count)) & 0xffU));
        }
    }
    return out;
}

/// "%20" and the like.
std::string percentDecoded(const std::string& uri) {
    std::string out;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && i + 2 < uri.size() &&
            std::isxdigit(static_cast<unsigned char>(uri[i + 1])) != 0 &&
            std::isxdigit(static_cast<unsigned char>(uri[i + 2])) != 0) {
            out.push_back(char(std::stoi(uri.substr(i + 1, 2), nullptr, 16)));
            i += 2;
        } else {
            out.push_back(uri[i]);
        }
    }
    return out;
}

}  // namespace

std::optional<std::size_t> wholeNumber(const json& object, const char* key) {
    const json& value = member(object, key);
    if (value.is_number_unsigned())
        return value.get<std::size_t>();
    // Some writers put 3.0 where 3 is meant.
    if (value.is_number_float()) {
        const double d = value.get<double>();
        if (d >= 0.0 && d < 9e15 && d == std::floor(d))
            return std::size_t(d);
    }
    return std::nullopt;
}

double number(const json& object, const char* key, double fallback) {
    const json& value = member(object, key);
    if (!value.is_number())
        return fallback;
    const double d = value.get<double>();
    return std::isfinite(d) ? d : fallback;
}

std::string text(const json& object, const char* key) {
    const json& value = member(object, key);
    return value.is_string() ? value.get<std::string>() : std::string();
}

const json& member(const json& object, const char* key) {
    static const json none;
    if (!object.is_object())
        return none;
    const auto found = object.find(key);
    return found == object.end() ? none : *found;
}

std::optional<std::vector<double>> numbers(const json& object, const char* key, std::size_t n) {
    const json& list = member(object, key);
    if (!list.is_array() || list.size() != n)
        return std::nullopt;
    std::vector<double> out;
    for (const json& value : list) {
        if (!value.is_number() || !std::isfinite(value.get<double>()))
            return std::nullopt;
        out.push_back(value.get<double>());
    }
    return out;
}

glm::vec3 color(const json& object, const char* key, glm::vec3 fallback) {
    auto values = numbers(object, key, 3);
    if (!values)
        values = numbers(object, key, 4);
    if (!values)
        return fallback;
    glm::vec3 out(0.0F);
    for (int i = 0; i < 3; ++i)
        out[i] = float(std::clamp((*values)[std::size_t(i)], 0.0, 1e4));
    return out;
}

const json& Document::element(const char* list, std::size_t index) const {
    static const json none;
    const json& all = member(m_root, list);
    return all.is_array() && index < all.size() ? all[index] : none;
}

std::size_t Document::count(const char* list) const {
    const json& all = member(m_root, list);
    return all.is_array() ? all.size() : 0;
}

std::optional<std::string_view> Document::view(std::size_t index) const {
    const json& view = element("bufferViews", index);
    const auto buffer = wholeNumber(view, "buffer");
    const auto length = wholeNumber(view, "byteLength");
    const std::size_t offset = wholeNumber(view, "byteOffset").value_or(0);
    if (!buffer || !length || *buffer >= m_buffers.size())
        return std::nullopt;
    const bool embedded = *buffer == 0 && m_buffers[0].empty();
    const std::string_view bytes = embedded ? m_binary : std::string_view(m_buffers[*buffer]);
    if (offset > bytes.size() || *length > bytes.size() - offset)
        return std::nullopt;
    return bytes.substr(offset, *length);
}

Result<std::string> Document::resource(const std::string& uri, std::size_t limit) const {
    if (uri.rfind("data:", 0) == 0) {
        const std::size_t comma = uri.find(";base64,");
        auto bytes = comma == std::string::npos
                         ? std::nullopt
                         : fromBase64(std::string_view(uri).substr(comma + 8));
        if (!bytes)
            return unreadable("holds data that are not base64", m_path);
        return std::move(*bytes);
    }
    std::filesystem::path folder = m_path.parent_path();
    if (folder.empty())
        folder = ".";
    const auto file = confinedPath(folder, percentDecoded(uri));
    if (!file) {
        return fail(ErrorCode::Refused, "names a file outside its folder: " + uri, m_path.string(),
                    "Put all its files into one folder, or export it as .glb.");
    }
    auto bytes = readFile(*file, limit);
    if (!bytes)
        return tl::unexpected(bytes.error().in("reading " + m_path.string()));
    return bytes;
}

Result<void> Document::readBuffers(std::size_t maxBytes) {
    std::size_t left = maxBytes;
    for (std::size_t i = 0; i < count("buffers"); ++i) {
        const json& buffer = element("buffers", i);
        const auto length = wholeNumber(buffer, "byteLength");
        if (!length || *length == 0)
            return unreadable(fmt::format("buffer {} has no length", i), m_path);
        const std::string uri = text(buffer, "uri");
        if (uri.empty()) {
            if (i != 0 || m_binary.size() < *length)
                return unreadable(fmt::format("buffer {} is not in the file", i), m_path);
            m_buffers.emplace_back();
            continue;
        }
        auto bytes = resource(uri, left);
        if (!bytes)
            return tl::unexpected(bytes.error());
        if (bytes->size() < *length) {
            return unreadable(
                fmt::format("buffer {} has {} bytes instead of {}", i, bytes->size(), *length),
                m_path);
        }
        left -= bytes->size();
        m_buffers.push_back(std::move(*bytes));
    }
    return {};
}

Result<Document> Document::read(std::string_view bytes, const std::filesystem::path& path,
                                std::size_t maxBytes) {
    if (bytes.empty())
        return unreadable("is empty", path);
    const auto container = openContainer(bytes, path);
    if (!container)
        return tl::unexpected(container.error());
    Document out;
    out.m_path = path;
    out.m_binary = container->binary;
    out.m_root = json::parse(container->json.begin(), container->json.end(), nullptr, false);
    if (out.m_root.is_discarded())
        return unreadable("is no valid JSON, or is cut off", path);
    const std::string version = text(member(out.m_root, "asset"), "version");
    if (version.empty())
        return unreadable("is no glTF: it has no \"asset\" with a version", path);
    if (version.rfind("2.", 0) != 0)
        return unreadable("is of glTF version " + version + ", not 2", path);
    for (const json& extension : member(out.m_root, "extensionsRequired")) {
        const std::string name = extension.is_string() ? extension.get<std::string>() : "?";
        if (kKnownExtensions.count(name) == 0) {
            return fail(ErrorCode::Refused,
                        "needs the glTF extension " + name + ", which Reflet does not know",
                        path.string(), "Export the vehicle without it.");
        }
    }
    if (auto read = out.readBuffers(maxBytes); !read)
        return tl::unexpected(read.error());
    return out;
}

}  // namespace reflet::gltf
