// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/Geometry.h"

#include <nlohmann/json_fwd.hpp>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace reflet::tiles {

/// A feature or batch table: JSON and the binary part that it points into (3D Tiles 1.0).
class TileTable {
public:
    /// An empty table for text that is empty or no JSON object.
    TileTable(std::string_view text, std::string_view binary);
    ~TileTable();
    TileTable(TileTable&&) noexcept;
    TileTable(const TileTable&) = delete;
    TileTable& operator=(const TileTable&) = delete;
    TileTable& operator=(TileTable&&) = delete;

    [[nodiscard]] bool has(const char* key) const;
    /// A whole number, or 0.
    [[nodiscard]] std::size_t count(const char* key) const;
    /// Three finite numbers, written out or in the binary part as floats.
    [[nodiscard]] std::optional<glm::dvec3> triple(const char* key) const;
    /// `count` tuples of `width` floats, or unsigned 16-bit integers, in the binary part; empty
    /// when they are not all there.
    [[nodiscard]] std::vector<double> floats(const char* key, std::size_t count, int width) const;
    [[nodiscard]] std::vector<double> shorts(const char* key, std::size_t count, int width) const;
    /// The column that names its rows, as far as it is written out; empty where there is none.
    [[nodiscard]] std::vector<std::string> names() const;

private:
    [[nodiscard]] std::string_view bytes(const char* key, std::size_t count) const;
    std::unique_ptr<nlohmann::json> m_json;
    std::string_view m_binary;
};

}  // namespace reflet::tiles
