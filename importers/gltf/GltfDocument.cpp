// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/GltfDocument.h"

#include "core/base/Files.h"
#include "importers/common/PercentDecoding.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
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
constexpr std::size_t kLargestImage = std::size_t(256) << 20;  // bytes of the file
// tinygltf reads extensions and extras by recursion: brackets alone would exhaust the stack.
constexpr int kDeepest = 64;
constexpr std::size_t kMostRemarks = 100;

/// Extensions that a file may require: read, or without bearing on what Reflet shows.
const std::set<std::string, std::less<>> kKnownExtensions{
    "CESIUM_RTC",
    "CESIUM_primitive_outline",
    "EXT_georeference",
    "EXT_geospatial_crs",
    "EXT_geospatial_crs_wkid",
    "EXT_geospatial_crs_wkt2",
    "EXT_mesh_features",
    "EXT_mesh_gpu_instancing",
    "EXT_structural_metadata",
    "EXT_meshopt_compression",
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

bool isData(const std::string& uri) {
    return uri.rfind("data:", 0) == 0;
}

/// PNG or JPEG, by its first bytes.
bool isImage(std::string_view bytes) {
    return bytes.starts_with("\x89PNG") || bytes.starts_with("\xff\xd8");
}

struct Container {
    std::string_view json;
    std::string_view binary;
};

/// The chunks of a .glb (glTF 2.0 specification, section 4.4); plain text is its own JSON.
/// tinygltf 2.7 would read eight bytes beyond a last chunk that says that it fills the file.
Result<Container> openContainer(std::string_view bytes, const std::filesystem::path& path) {
    if (bytes.size() < 4 || word(bytes, 0) != kMagic) {
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

/// The member `key`; null where there is none.
const json& memberOf(const json& object, const char* key) {
    static const json none;
    const auto found = object.find(key);
    return found == object.end() ? none : *found;
}

std::string textOf(const json& object, const char* key) {
    const json& value = memberOf(object, key);
    return value.is_string() ? value.get<std::string>() : std::string();
}

Result<json> parseJson(std::string_view text, const std::filesystem::path& path) {
    bool tooDeep = false;
    const auto look = [&](int depth, json::parse_event_t, json& value) {
        tooDeep = tooDeep || depth > kDeepest;
        if (value.is_number_float()) {
            // Some writers put 3.0 where 3 is meant.
            const auto d = value.get<double>();
            if (d >= 0.0 && d < 2147483648.0 && d == std::floor(d))
                value = std::uint64_t(d);
        }
        return !tooDeep;
    };
    json root = json::parse(text.begin(), text.end(), look, false);
    if (tooDeep)
        return unreadable(fmt::format("is nested deeper than {} levels", kDeepest), path);
    if (root.is_discarded())
        return unreadable("is no valid JSON, or is cut off", path);
    return root;
}

Result<void> checkHead(const json& root, const std::filesystem::path& path) {
    const std::string version = textOf(memberOf(root, "asset"), "version");
    if (version.empty())
        return unreadable("is no glTF: it has no \"asset\" with a version", path);
    if (version.rfind("2.", 0) != 0)
        return unreadable("is of glTF version " + version + ", not 2", path);
    for (const json& extension : memberOf(root, "extensionsRequired")) {
        const std::string name = extension.is_string() ? extension.get<std::string>() : "?";
        if (kKnownExtensions.count(name) == 0) {
            return fail(ErrorCode::Refused,
                        "needs the glTF extension " + name + ", which Reflet does not know",
                        path.string(), "Export the vehicle without it.");
        }
    }
    return {};
}

/// tinygltf refuses the file when the indices of one primitive do not exist, and always with Draco:
/// it meets them as an attribute. What is no number or no object it would leave out unsaid.
void preparePrimitive(json& primitive) {
    if (!primitive.is_object())
        primitive = json::object();
    json& attributes = primitive["attributes"];
    if (!attributes.is_object())
        attributes = json::object();
    for (auto it = attributes.begin(); it != attributes.end();)
        it = it->is_number_integer() ? std::next(it) : attributes.erase(it);
    attributes.erase(Document::kIndices);
    if (const json& indices = memberOf(primitive, "indices"); indices.is_number_integer())
        attributes[Document::kIndices] = indices;
    primitive.erase("indices");
}

/// The JSON of a file that says of itself what Reflet can read.
Result<json> readRoot(std::string_view text, const std::filesystem::path& path) {
    auto root = parseJson(text, path);
    if (!root)
        return root;
    if (auto sound = checkHead(*root, path); !sound)
        return tl::unexpected(sound.error());
    return root;
}

}  // namespace

std::optional<std::filesystem::path> Document::fileOf(const std::string& uri) const {
    std::filesystem::path folder = m_path.parent_path();
    if (folder.empty())
        folder = ".";
    return confinedPath(folder, importers::percentDecoded(uri));
}

Result<std::string> Document::resource(const std::string& uri, std::size_t limit) const {
    if (isData(uri)) {
        const std::size_t comma = uri.find(";base64,");
        std::vector<unsigned char> bytes;
        std::string type;
        // Whatever it says it is; tinygltf knows seven kinds.
        if (comma == std::string::npos ||
            !tinygltf::DecodeDataURI(
                &bytes, type, "data:application/octet-stream" + uri.substr(comma), 0, false)) {
            return unreadable("holds data that are not base64", m_path);
        }
        return std::string(bytes.begin(), bytes.end());
    }
    const auto file = fileOf(uri);
    if (!file) {
        return fail(ErrorCode::Refused, "names a file outside its folder: " + uri, m_path.string(),
                    "Put all its files into one folder, or export it as .glb.");
    }
    auto bytes = readFile(*file, limit);
    if (!bytes)
        return tl::unexpected(bytes.error().in("reading " + m_path.string()));
    return bytes;
}

Result<void> Document::readBuffers(const json& buffers, std::size_t maxBytes) {
    std::size_t left = maxBytes;
    for (const json& buffer : buffers) {
        const std::size_t i = m_buffers.size();
        const json& length = memberOf(buffer, "byteLength");
        if (!length.is_number_unsigned() || length == 0)
            return unreadable(fmt::format("buffer {} has no length", i), m_path);
        const std::string uri = textOf(buffer, "uri");
        Buffer& out = m_buffers.emplace_back();
        if (uri.empty()) {
            // The place of what is unpacked from another buffer: never asked for.
            if (memberOf(memberOf(buffer, "extensions"), "EXT_meshopt_compression").is_object())
                continue;
            if (i != 0 || m_binary.size() < length.get<std::size_t>())
                return unreadable(fmt::format("buffer {} is not in the file", i), m_path);
            out.binary = true;
            continue;
        }
        auto bytes = resource(uri, left);
        if (!bytes)
            return tl::unexpected(bytes.error());
        if (bytes->size() < length.get<std::size_t>()) {
            return unreadable(fmt::format("buffer {} has {} bytes instead of {}", i, bytes->size(),
                                          length.get<std::size_t>()),
                              m_path);
        }
        left -= std::min(left, bytes->size());
        out.bytes = std::move(*bytes);
        if (!isData(uri))
            out.file = fileOf(uri).value_or("");
    }
    return {};
}

void Document::listImages(const json& images) {
    for (const json& image : images) {
        const json& view = memberOf(image, "bufferView");
        const bool exists = view.is_number_unsigned() && view < 2147483648U;
        m_images.push_back({textOf(image, "uri"), exists ? view.get<int>() : -1});
    }
}

void Document::listSamplers(const json& samplers) {
    constexpr int kClamp = 33071, kMirror = 33648;  // as OpenGL counts
    const auto wrapOf = [](const json& sampler, const char* key) {
        const json& mode = memberOf(sampler, key);
        return mode == kClamp ? Wrap::Clamp : (mode == kMirror ? Wrap::Mirror : Wrap::Repeat);
    };
    for (const json& sampler : samplers)
        m_samplers.push_back({wrapOf(sampler, "wrapS"), wrapOf(sampler, "wrapT")});
}

/// What tinygltf reads is taken out of the root: animations, skins and cameras could only fail.
Result<void> Document::parse(json& root) {
    json known = json::object();
    for (const char* key : {"asset", "scene", "scenes", "nodes", "meshes", "accessors",
                            "bufferViews", "materials", "textures"}) {
        if (root.contains(key))
            known[key] = std::move(root[key]);
    }
    // Of the whole file those alone that tell what and where things are.
    for (const char* name : {"CESIUM_RTC", "EXT_geospatial_crs", "EXT_structural_metadata"}) {
        if (const json& extension = memberOf(memberOf(root, "extensions"), name);
            extension.is_object())
            known["extensions"][name] = extension;
    }
    if (known.contains("meshes")) {
        for (json& mesh : known["meshes"]) {
            if (!mesh.is_object() || !mesh.contains("primitives"))
                continue;
            for (json& primitive : mesh["primitives"])
                preparePrimitive(primitive);
        }
    }
    const std::string text = known.dump(-1, ' ', false, json::error_handler_t::replace);
    tinygltf::TinyGLTF parser;
    std::string error;
    std::string warning;
    bool read = false;
    try {
        read = parser.LoadASCIIFromString(&m_model, &error, &warning, text.data(),
                                          unsigned(text.size()), "");
    } catch (const std::exception& thrown) {
        error += thrown.what();
    }
    error = error.substr(0, std::min(error.find('\n'), std::size_t(200)));
    if (!read)
        return unreadable("is no valid glTF: " + error, m_path);
    if (!error.empty())
        remark(m_remarks, Severity::Warning, "gltf-fault", "", error + "; left out");
    return {};
}

std::optional<std::string_view> Document::range(int buffer, std::size_t offset,
                                                std::size_t length) const {
    const Buffer* found = elementAt(m_buffers, buffer);
    if (found == nullptr)
        return std::nullopt;
    const std::string_view bytes = found->binary ? m_binary : std::string_view(found->bytes);
    if (offset > bytes.size() || length > bytes.size() - offset)
        return std::nullopt;
    return bytes.substr(offset, length);
}

std::optional<std::string_view> Document::view(int index) const {
    const tinygltf::BufferView* view = elementAt(m_model.bufferViews, index);
    if (view == nullptr)
        return std::nullopt;
    return range(view->buffer, view->byteOffset, view->byteLength);
}

Result<std::string> Document::image(std::size_t index) const {
    if (index >= m_images.size())
        return unreadable("has no such image", m_path);
    if (!m_images[index].uri.empty())
        return resource(m_images[index].uri, kLargestImage);
    const auto bytes = view(m_images[index].view);
    if (!bytes)
        return unreadable("has an image outside its buffers", m_path);
    return std::string(*bytes);
}

std::string Document::imageName(std::size_t index) const {
    const std::string uri = index < m_images.size() ? m_images[index].uri : "";
    return uri.empty() || uri.size() > 200 ? "in the file" : uri;
}

ImagePlace Document::imagePlace(std::size_t index) const {
    ImagePlace out;
    out.broken = true;
    if (index >= m_images.size())
        return out;
    const Source& source = m_images[index];
    if (!source.uri.empty() && !isData(source.uri)) {
        out.broken = false;
        out.uri = importers::percentDecoded(source.uri);
        return out;
    }
    const auto keep = [&](std::string bytes) {
        out.broken = !isImage(bytes);
        out.length = bytes.size();
        out.bytes = std::make_shared<const std::string>(std::move(bytes));
    };
    if (!source.uri.empty()) {
        keep(resource(source.uri, kLargestImage).value_or(std::string()));
        return out;
    }
    const auto bytes = view(source.view);
    const tinygltf::BufferView* view = elementAt(m_model.bufferViews, source.view);
    if (!bytes || !isImage(*bytes) || view == nullptr)
        return out;
    const Buffer& buffer = m_buffers[std::size_t(view->buffer)];
    if (!buffer.binary && buffer.file.empty()) {
        keep(std::string(*bytes));
        return out;
    }
    const char* begin = buffer.binary ? m_whole.data() : buffer.bytes.data();
    out.broken = false;
    out.file = buffer.file;
    out.offset = std::uint64_t(bytes->data() - begin);
    out.length = bytes->size();
    return out;
}

Sampler Document::sampler(int texture) const {
    const tinygltf::Texture* entry = elementAt(m_model.textures, texture);
    const Sampler* found = entry != nullptr ? elementAt(m_samplers, entry->sampler) : nullptr;
    return found != nullptr ? *found : Sampler();
}

Result<Document> Document::read(std::string_view bytes, const std::filesystem::path& path,
                                std::size_t maxBytes) {
    if (bytes.empty())
        return unreadable("is empty", path);
    const auto container = openContainer(bytes, path);
    if (!container)
        return tl::unexpected(container.error());
    auto root = readRoot(container->json, path);
    if (!root)
        return tl::unexpected(root.error());
    Document out;
    out.m_path = path;
    out.m_whole = bytes;
    out.m_binary = container->binary;
    if (auto read = out.readBuffers(memberOf(*root, "buffers"), maxBytes); !read)
        return tl::unexpected(read.error());
    out.listImages(memberOf(*root, "images"));
    out.listSamplers(memberOf(*root, "samplers"));
    if (auto parsed = out.parse(*root); !parsed)
        return tl::unexpected(parsed.error());
    out.unpackViews(maxBytes);
    return out;
}

Result<Document> Document::readDescription(std::string_view text,
                                           const std::filesystem::path& path) {
    auto root = readRoot(text, path);
    if (!root)
        return tl::unexpected(root.error());
    Document out;
    out.m_path = path;
    if (auto parsed = out.parse(*root); !parsed)
        return tl::unexpected(parsed.error());
    return out;
}

void remark(std::vector<Diagnostic>& list, Severity severity, const char* code, std::string object,
            std::string text, std::string remedy) {
    if (list.size() < kMostRemarks)
        list.push_back({severity, code, std::move(object), std::move(text), std::move(remedy)});
}

const tinygltf::Value& extensionOf(const tinygltf::ExtensionMap& extensions, const char* name) {
    static const tinygltf::Value none;
    const auto found = extensions.find(name);
    return found == extensions.end() ? none : found->second;
}

const tinygltf::Value& member(const tinygltf::Value& object, const char* key) {
    static const tinygltf::Value none;
    return object.IsObject() ? object.Get(key) : none;
}

double number(const tinygltf::Value& object, const char* key, double fallback) {
    const tinygltf::Value& value = member(object, key);
    const double d = value.IsNumber() ? value.GetNumberAsDouble() : fallback;
    return std::isfinite(d) ? d : fallback;
}

int indexIn(const tinygltf::Value& object, const char* key) {
    const tinygltf::Value& value = member(object, key);
    return value.IsInt() ? std::max(value.GetNumberAsInt(), -1) : -1;
}

std::vector<double> numbers(const tinygltf::Value& object, const char* key) {
    const tinygltf::Value& list = member(object, key);
    std::vector<double> out;
    for (int i = 0; i < int(list.ArrayLen()); ++i) {
        if (!list.Get(i).IsNumber() || !std::isfinite(list.Get(i).GetNumberAsDouble()))
            return {};
        out.push_back(list.Get(i).GetNumberAsDouble());
    }
    return out;
}

}  // namespace reflet::gltf
