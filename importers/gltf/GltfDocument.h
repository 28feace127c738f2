// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"
#include "core/base/Error.h"
#include "importers/gltf/TinyGltf.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace reflet::gltf {

/// Where an image is, which is not opened.
struct ImagePlace {
    std::string uri;             ///< decoded, relative to the document's folder; empty: embedded
    std::filesystem::path file;  ///< that it is embedded in; empty: the document itself
    std::uint64_t offset = 0, length = 0;  ///< in that file; in the document from its first byte on
    std::shared_ptr<const std::string> bytes = nullptr;  ///< not null: instead of the range
    bool broken = false;  ///< it is neither named nor PNG or JPEG where it should be
};

/// How an image goes on beyond its edges.
enum class Wrap : std::uint8_t { Repeat, Clamp, Mirror };
struct Sampler {
    Wrap u = Wrap::Repeat, v = Wrap::Repeat;
};

/// The file as tinygltf parses it, with its buffers. tinygltf checks no index, count or range:
/// everything is asked for through functions that do. Internal to importers/gltf.
class Document {
public:
    /// Attribute of a primitive that names its index accessor; Primitive::indices is not used.
    static constexpr const char* kIndices = "_INDICES";

    /// See importVehicle for the errors. `bytes` must outlive the document; what is read beside
    /// them, or unpacked from them, has at most `maxBytes`.
    static Result<Document> read(std::string_view bytes, const std::filesystem::path& path,
                                 std::size_t maxBytes);

    /// The same of its JSON alone: there are no buffers, so that nothing can be asked for that lies
    /// in them.
    static Result<Document> readDescription(std::string_view text,
                                            const std::filesystem::path& path);

    /// Without buffers and images, which are Reflet's to read.
    [[nodiscard]] const tinygltf::Model& model() const { return m_model; }
    [[nodiscard]] const std::filesystem::path& path() const { return m_path; }
    /// What could not be read of it and is left out.
    [[nodiscard]] const std::vector<Diagnostic>& remarks() const { return m_remarks; }
    /// The bytes of a bufferView; nullopt when it does not lie within its buffer.
    [[nodiscard]] std::optional<std::string_view> view(int index) const;
    [[nodiscard]] std::size_t imageCount() const { return m_images.size(); }
    /// The bytes of an image, not decoded.
    [[nodiscard]] Result<std::string> image(std::size_t index) const;
    [[nodiscard]] std::string imageName(std::size_t index) const;
    [[nodiscard]] ImagePlace imagePlace(std::size_t index) const;
    /// Of a texture: that of the specification where it names none that exists.
    [[nodiscard]] Sampler sampler(int texture) const;

private:
    struct Buffer {
        std::string bytes;
        bool binary = false;              ///< the chunk of a .glb instead
        std::filesystem::path file = {};  ///< where the bytes come from; empty: a data URI
    };
    struct Source {
        std::string uri;  ///< empty: in the view
        int view = -1;
    };

    [[nodiscard]] Result<std::string> resource(const std::string& uri, std::size_t limit) const;
    [[nodiscard]] std::optional<std::filesystem::path> fileOf(const std::string& uri) const;
    [[nodiscard]] std::optional<std::string_view> range(int buffer, std::size_t offset,
                                                        std::size_t length) const;
    Result<void> readBuffers(const nlohmann::json& buffers, std::size_t maxBytes);
    void listImages(const nlohmann::json& images);
    void listSamplers(const nlohmann::json& samplers);
    Result<void> parse(nlohmann::json& root);
    void unpackViews(std::size_t maxBytes);
    std::optional<std::string> unpackView(const tinygltf::Value& extension,
                                          std::size_t maxBytes) const;

    tinygltf::Model m_model;
    std::filesystem::path m_path;
    std::string_view m_whole;   // lives as long as the caller's bytes
    std::string_view m_binary;  // of a .glb: a part of them
    std::vector<Buffer> m_buffers;
    std::vector<Source> m_images;
    std::vector<Sampler> m_samplers;
    std::vector<Diagnostic> m_remarks;
};

/// The element, or null where there is none.
template <class T>
const T* elementAt(const std::vector<T>& list, int index) {
    return index >= 0 && std::size_t(index) < list.size() ? &list[std::size_t(index)] : nullptr;
}

/// Appends a diagnostic, up to a hundred.
void remark(std::vector<Diagnostic>& list, Severity severity, const char* code, std::string object,
            std::string text, std::string remedy = {});

/// An extension as it is in the file; null where there is none.
[[nodiscard]] const tinygltf::Value& extensionOf(const tinygltf::ExtensionMap& extensions,
                                                 const char* name);
/// The member `key` of an object, or null.
[[nodiscard]] const tinygltf::Value& member(const tinygltf::Value& object, const char* key);
/// A finite number under `key`, or the fallback.
[[nodiscard]] double number(const tinygltf::Value& object, const char* key, double fallback);
/// A whole number from 0 to 2^31 - 1 under `key`, or -1.
[[nodiscard]] int indexIn(const tinygltf::Value& object, const char* key);
/// The finite numbers under `key`; empty when there are others or none.
[[nodiscard]] std::vector<double> numbers(const tinygltf::Value& object, const char* key);

/// The values of an accessor as floats, element by element; strides, sparse parts and normalised
/// integers resolved. nullopt with a reason when it does not fit its buffers or is not of that
/// type.
[[nodiscard]] std::optional<std::vector<float>> readFloats(const Document& document, int accessor,
                                                           int components, std::string& problem);
[[nodiscard]] std::optional<std::vector<std::uint32_t>> readIndices(const Document& document,
                                                                    int accessor,
                                                                    std::string& problem);

/// A decoded image, 8-bit sRGB with alpha.
struct Image {
    int width = 0, height = 0;
    std::vector<unsigned char> rgba;

    /// Linear colour at texture coordinates that repeat; alpha is not used.
    [[nodiscard]] glm::vec3 sample(float u, float v) const;
    /// The stored values, linear by definition (roughness, metallic).
    [[nodiscard]] glm::vec3 data(float u, float v) const;
};
/// PNG or JPEG. Refused above 16384 pixels an edge, before anything is allocated.
[[nodiscard]] Result<Image> decodeImage(std::string_view bytes);

/// Reads images once. Problems are told once.
class Images {
public:
    Images(const Document& document, std::vector<Diagnostic>& diagnostics)
        : m_document(document), m_diagnostics(diagnostics) {}
    /// The image of a texture; null when it has none that can be read.
    [[nodiscard]] const Image* ofTexture(int texture);
    [[nodiscard]] std::size_t readCount() const { return m_read; }

private:
    const Document& m_document;
    std::vector<Diagnostic>& m_diagnostics;
    std::map<std::size_t, std::optional<Image>> m_images;
    std::size_t m_read = 0;
};

/// A node that has a mesh, where it stands.
struct Placed {
    int mesh = 0;
    glm::dmat4 file_from_mesh{1.0};
    std::string name;  ///< with those of its parents
    /// Where the mesh stands, instead of once (EXT_mesh_gpu_instancing): placed = file_from_mesh *
    /// instance.
    std::vector<glm::dmat4> instances = {};
    bool instanced = false;
    bool onEarth = false;  ///< in geocentric coordinates (EXT_georeference)
};
/// Whether nodes that are placed on the Earth are.
enum class Earth : std::uint8_t { Ignored, Used };
/// The meshes of the scene. A node that is met twice makes a loop or is shared: it stays out. A
/// node whose instances cannot be read stays out too, as do those beyond a million of a file.
[[nodiscard]] std::vector<Placed> placedMeshes(const Document& document,
                                               std::vector<Diagnostic>& diagnostics, Earth earth);

/// A mesh primitive as triangles.
struct Primitive {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  ///< empty: to be computed
    std::vector<float> uv;           ///< two per vertex and set; empty: none
    std::vector<float> uv1;
    std::vector<glm::vec3> colors;  ///< linear, of the vertices; empty: none
    /// Features that the vertices belong to (EXT_mesh_features, or the batch ids of 3D Tiles 1.0);
    /// empty: none.
    std::vector<float> features;
    std::vector<glm::uvec3> triangles;
    int material = -1;
    std::size_t outOfRange = 0;  ///< triangles left out because a vertex does not exist
};
/// nullopt with a reason when nothing of it can be shown.
[[nodiscard]] std::optional<Primitive> readPrimitive(const Document& document,
                                                     const tinygltf::Primitive& primitive,
                                                     std::string& problem);
/// Triangles of a primitive by the file's own counts, without reading it; 0 for lines and points.
[[nodiscard]] std::size_t countTriangles(const Document& document,
                                         const tinygltf::Primitive& primitive);
/// KHR_draco_mesh_compression.
[[nodiscard]] std::optional<Primitive> readDraco(const Document& document,
                                                 const tinygltf::Primitive& primitive,
                                                 std::string& problem);
/// Adds the triangle unless it is degenerate; counts it when a vertex does not exist or is not
/// finite.
void addTriangle(const glm::uvec3& triangle, Primitive& out);
/// To about that many triangles, whatever their shape; vertices that are not used any more go.
void simplify(Primitive& primitive, std::size_t triangles);
/// Leaves out the vertices that no triangle has.
void compact(Primitive& primitive);

}  // namespace reflet::gltf
