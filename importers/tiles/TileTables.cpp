// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/tiles/TileTables.h"

#include "importers/common/Identifiers.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>

namespace reflet::tiles {

using nlohmann::json;

namespace {

constexpr int kDeepest = 32;
constexpr std::size_t kLongestName = 200;

json parsed(std::string_view text) {
    bool tooDeep = false;
    const auto look = [&](int depth, json::parse_event_t, json&) {
        tooDeep = tooDeep || depth > kDeepest;
        return !tooDeep;
    };
    json table = json::parse(text.begin(), text.end(), look, false);
    return tooDeep || !table.is_object() ? json::object() : table;
}

template <class Number>
std::vector<double> numbersIn(std::string_view bytes) {
    std::vector<double> out(bytes.size() / sizeof(Number));
    for (std::size_t i = 0; i < out.size(); ++i) {
        Number value{};
        std::memcpy(&value, bytes.data() + i * sizeof(Number), sizeof(Number));
        out[i] = double(value);
    }
    return out;
}

}  // namespace

TileTable::TileTable(std::string_view text, std::string_view binary)
    : m_json(std::make_unique<json>(parsed(text))), m_binary(binary) {}
TileTable::~TileTable() = default;
TileTable::TileTable(TileTable&&) noexcept = default;

bool TileTable::has(const char* key) const {
    return m_json->contains(key);
}

std::size_t TileTable::count(const char* key) const {
    const auto found = m_json->find(key);
    return found != m_json->end() && found->is_number_unsigned() ? found->get<std::size_t>() : 0;
}

/// `count` bytes at the offset that the key tells; empty when they are not all there.
std::string_view TileTable::bytes(const char* key, std::size_t count) const {
    const auto found = m_json->find(key);
    if (found == m_json->end() || !found->is_object() || !found->contains("byteOffset") ||
        !(*found)["byteOffset"].is_number_unsigned())
        return {};
    const auto offset = (*found)["byteOffset"].get<std::size_t>();
    if (offset > m_binary.size() || count > m_binary.size() - offset)
        return {};
    return m_binary.substr(offset, count);
}

std::vector<double> TileTable::floats(const char* key, std::size_t count, int width) const {
    return numbersIn<float>(bytes(key, count * std::size_t(width) * sizeof(float)));
}

std::vector<double> TileTable::shorts(const char* key, std::size_t count, int width) const {
    return numbersIn<std::uint16_t>(bytes(key, count * std::size_t(width) * sizeof(std::uint16_t)));
}

std::optional<glm::dvec3> TileTable::triple(const char* key) const {
    const auto found = m_json->find(key);
    if (found == m_json->end())
        return std::nullopt;
    std::vector<double> values;
    if (found->is_array()) {
        for (const json& value : *found)
            values.push_back(value.is_number() ? value.get<double>() : std::nan(""));
    } else {
        values = floats(key, 1, 3);
    }
    if (values.size() != 3 || !std::isfinite(values[0] + values[1] + values[2]))
        return std::nullopt;
    return glm::dvec3(values[0], values[1], values[2]);
}

std::vector<std::string> TileTable::names() const {
    std::vector<std::string> columns;
    for (const auto& [key, value] : m_json->items()) {
        if (value.is_array())
            columns.push_back(key);
    }
    std::string column = importers::bestIdentifier(columns);
    for (std::size_t i = 0; column.empty() && i < columns.size(); ++i) {
        const json& values = (*m_json)[columns[i]];
        if (!values.empty() && values.front().is_string())
            column = columns[i];
    }
    std::vector<std::string> names;
    if (column.empty())
        return names;
    for (const json& value : (*m_json)[column])
        names.push_back(value.is_string()   ? value.get<std::string>().substr(0, kLongestName)
                        : value.is_number() ? value.dump()
                                            : std::string());
    return names;
}

}  // namespace reflet::tiles
