// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/gltf/GltfImporter.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

namespace reflet::test {

using nlohmann::json;

/// A glTF file built in memory: accessors over one buffer that is written into the JSON.
class GltfText {
public:
    json root{{"asset", {{"version", "2.0"}}},
              {"scene", 0},
              {"scenes", {{{"nodes", {0}}}}},
              {"nodes", {{{"mesh", 0}, {"name", "thing"}}}},
              {"meshes", json::array()}};

    json moreBuffers = json::array();  ///< after the one that this file has

    /// Appends bytes as a view of their own; returns its index.
    int view(const std::string& bytes) {
        m_bytes.resize((m_bytes.size() + 3) / 4 * 4);
        root["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", m_bytes.size()}, {"byteLength", bytes.size()}});
        m_bytes += bytes;
        return int(root["bufferViews"].size()) - 1;
    }
    [[nodiscard]] const std::string& bytes() const { return m_bytes; }

    /// Appends an accessor; returns its index. componentType as in glTF.
    template <class T>
    std::size_t accessor(const std::vector<T>& values, int componentType, const char* type,
                         std::size_t components) {
        std::string bytes(values.size() * sizeof(T), '\0');
        std::memcpy(bytes.data(), values.data(), bytes.size());
        root["accessors"].push_back({{"bufferView", view(bytes)},
                                     {"componentType", componentType},
                                     {"count", values.size() / components},
                                     {"type", type}});
        return root["accessors"].size() - 1;
    }

    /// A mesh of one primitive; returns the primitive for changes.
    json& mesh(const std::vector<float>& positions, const std::vector<std::uint16_t>& indices) {
        const std::size_t position = accessor(positions, 5126, "VEC3", 3);
        for (std::size_t i = 0; i < positions.size(); ++i) {
            json& least = root["accessors"][position]["min"][i % 3];
            json& most = root["accessors"][position]["max"][i % 3];
            least = i < 3 ? positions[i] : std::min(least.get<float>(), positions[i]);
            most = i < 3 ? positions[i] : std::max(most.get<float>(), positions[i]);
        }
        json primitive{{"attributes", {{"POSITION", position}}}};
        if (!indices.empty())
            primitive["indices"] = accessor(indices, 5123, "SCALAR", 1);
        root["meshes"].push_back({{"primitives", json::array({primitive})}});
        return root["meshes"].back()["primitives"][0];
    }

    /// A box from lo to hi, closed, facing outwards, without normals.
    json& box(const glm::vec3& lo, const glm::vec3& hi) {
        std::vector<float> p;
        for (int i = 0; i < 8; ++i) {
            p.push_back((i & 1) != 0 ? hi.x : lo.x);
            p.push_back((i & 2) != 0 ? hi.y : lo.y);
            p.push_back((i & 4) != 0 ? hi.z : lo.z);
        }
        return mesh(p, {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                        2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5});
    }

    [[nodiscard]] std::string text() const {
        static const char* const digits =
            "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::string data = "data:application/octet-stream;base64,";
        for (std::size_t i = 0; i < m_bytes.size(); i += 3) {
            std::uint32_t bits = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                bits <<= 8U;
                bits |= i + k < m_bytes.size() ? static_cast<unsigned char>(m_bytes[i + k]) : 0U;
            }
            for (std::size_t k = 0; k < 4; ++k)
                data.push_back(i + k <= m_bytes.size() ? digits[(bits >> (18 - 6 * k)) & 63U]
                                                       : '=');
        }
        json out = root;
        if (!m_bytes.empty())
            out["buffers"] = {{{"byteLength", m_bytes.size()}, {"uri", data}}};
        for (const json& buffer : moreBuffers)
            out["buffers"].push_back(buffer);
        return out.dump();
    }

    [[nodiscard]] Result<Imported<GltfModel>> import(const GltfOptions& options = {}) const {
        return importVehicleBytes(text(), "/nonexistent/thing.gltf", options, {});
    }

private:
    std::string m_bytes;
};

}  // namespace reflet::test
