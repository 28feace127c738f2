// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"
#include "core/base/Error.h"

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace reflet::gltf {

/// The parsed file with its buffers. Indices and counts of the JSON are never trusted: everything
/// is asked for through functions that check. Internal to importers/gltf.
class Document {
public:
    /// See importVehicle for the errors.
    static Result<Document> read(std::string_view bytes, const std::filesystem::path& path,
                                 std::size_t maxBytes);

    [[nodiscard]] const nlohmann::json& root() const { return m_root; }
    [[nodiscard]] const std::filesystem::path& path() const { return m_path; }
    /// Element `index` of a list at the root ("nodes"); null when there is none.
    [[nodiscard]] const nlohmann::json& element(const char* list, std::size_t index) const;
    [[nodiscard]] std::size_t count(const char* list) const;
    /// The bytes of a bufferView; nullopt when it does not lie within its buffer.
    [[nodiscard]] std::optional<std::string_view> view(std::size_t index) const;
    /// The bytes that a URI names: a data URI, or a file in the document's folder.
    [[nodiscard]] Result<std::string> resource(const std::string& uri, std::size_t limit) const;

private:
    Result<void> readBuffers(std::size_t maxBytes);

    nlohmann::json m_root;
    std::filesystem::path m_path;
    std::string_view m_binary;  // of a .glb; lives as long as the caller's bytes
    std::vector<std::string> m_buffers;
};

/// A whole number >= 0 under `key`, or nullopt.
[[nodiscard]] std::optional<std::size_t> wholeNumber(const nlohmann::json& object, const char* key);
/// A finite number under `key`, or the fallback.
[[nodiscard]] double number(const nlohmann::json& object, const char* key, double fallback);
[[nodiscard]] std::string text(const nlohmann::json& object, const char* key);
/// The member `key`, or null.
[[nodiscard]] const nlohmann::json& member(const nlohmann::json& object, const char* key);
/// Exactly `n` finite numbers under `key`, or nullopt.
[[nodiscard]] std::optional<std::vector<double>> numbers(const nlohmann::json& object,
                                                         const char* key, std::size_t n);
[[nodiscard]] glm::vec3 color(const nlohmann::json& object, const char* key, glm::vec3 fallback);

/// The values of an accessor as floats, element by element; strides, sparse parts and normalised
/// integers resolved. nullopt with a reason when it does not fit its buffers or is not of that
/// type.
[[nodiscard]] std::optional<std::vector<float>> readFloats(const Document& document,
                                                           std::size_t accessor, int components,
                                                           std::string& problem);
[[nodiscard]] std::optional<std::vector<std::uint32_t>> readIndices(const Document& document,
                                                                    std::size_t accessor,
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
    [[nodiscard]] const Image* ofTexture(std::size_t texture);
    [[nodiscard]] std::size_t readCount() const { return m_read; }

private:
    const Document& m_document;
    std::vector<Diagnostic>& m_diagnostics;
    std::map<std::size_t, std::optional<Image>> m_images;
    std::size_t m_read = 0;
};

/// A mesh primitive as triangles.
struct Primitive {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  ///< empty: to be computed
    std::vector<float> uv;           ///< two per vertex and set; empty: none
    std::vector<float> uv1;
    std::vector<glm::vec3> colors;  ///< linear, of the vertices; empty: none
    std::vector<glm::uvec3> triangles;
    std::optional<std::size_t> material;
    std::size_t outOfRange = 0;  ///< triangles left out because a vertex does not exist
};
/// nullopt with a reason when nothing of it can be shown.
[[nodiscard]] std::optional<Primitive> readPrimitive(const Document& document,
                                                     const nlohmann::json& primitive,
                                                     std::string& problem);
/// Triangles of a primitive by the file's own counts, without reading it; 0 for lines and points.
[[nodiscard]] std::size_t countTriangles(const Document& document, const nlohmann::json& primitive);
/// KHR_draco_mesh_compression.
[[nodiscard]] std::optional<Primitive> readDraco(const Document& document,
                                                 const nlohmann::json& primitive,
                                                 std::string& problem);

}  // namespace reflet::gltf
