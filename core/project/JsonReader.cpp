// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/project/JsonReader.h"

#include <fmt/format.h>

#include <cmath>

namespace reflet {

namespace {

using nlohmann::json;

const json& emptyObject() {
    static const json value = json::object();
    return value;
}

const json& nullValue() {
    static const json value;
    return value;
}

std::optional<double> finite(const json& value) {
    if (!value.is_number())
        return std::nullopt;
    const double number = value.get<double>();
    return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

}  // namespace

std::optional<glm::dvec3> tripleFromJson(const json& value) {
    if (!value.is_array() || value.size() != 3)
        return std::nullopt;
    glm::dvec3 out;
    for (int i = 0; i < 3; ++i) {
        const auto number = finite(value[static_cast<std::size_t>(i)]);
        if (!number || std::abs(*number) > 1e9)
            return std::nullopt;
        out[i] = *number;
    }
    return out;
}

bool JsonReader::has(const char* key) const {
    return m_value.contains(key);
}

const json& JsonReader::raw(const char* key) const {
    const auto found = m_value.find(key);
    return found == m_value.end() ? nullValue() : *found;
}

void JsonReader::fail(const std::string& key, std::string expected) const {
    if (!m_failure)
        m_failure = Failure{m_pointer + "/" + key, std::move(expected)};
}

void JsonReader::require(const char* key) const {
    if (!has(key))
        fail(key, "a value: it is missing");
}

void JsonReader::read(const char* key, std::string& out) const {
    if (!has(key))
        return;
    if (!raw(key).is_string())
        return fail(key, "a text");
    out = raw(key).get<std::string>();
}

void JsonReader::read(const char* key, bool& out) const {
    if (!has(key))
        return;
    if (!raw(key).is_boolean())
        return fail(key, "true or false");
    out = raw(key).get<bool>();
}

void JsonReader::read(const char* key, double& out, double min, double max) const {
    if (!has(key))
        return;
    const auto number = finite(raw(key));
    if (!number || *number < min || *number > max) {
        return fail(key, fmt::format("a number from {} to {}", min, max));
    }
    out = *number;
}

void JsonReader::read(const char* key, float& out, double min, double max) const {
    double number = out;
    read(key, number, min, max);
    out = static_cast<float>(number);
}

void JsonReader::read(const char* key, int& out, int min, int max) const {
    if (!has(key))
        return;
    const json& value = raw(key);
    const auto number = finite(value);
    if (!value.is_number_integer() || *number < min || *number > max) {
        return fail(key, fmt::format("a whole number from {} to {}", min, max));
    }
    out = value.get<int>();
}

void JsonReader::read(const char* key, std::size_t& out, std::size_t min, std::size_t max) const {
    if (!has(key))
        return;
    const json& value = raw(key);
    if (!value.is_number_unsigned() || value.get<std::size_t>() < min ||
        value.get<std::size_t>() > max) {
        return fail(key, fmt::format("a whole number from {} to {}", min, max));
    }
    out = value.get<std::size_t>();
}

void JsonReader::read(const char* key, glm::dvec3& out) const {
    if (!has(key))
        return;
    const auto triple = tripleFromJson(raw(key));
    if (!triple)
        return fail(key, "three finite numbers: east, north, up in metres");
    out = *triple;
}

void JsonReader::read(const char* key, std::vector<std::string>& out) const {
    if (!has(key))
        return;
    const json& value = raw(key);
    if (!value.is_array())
        return fail(key, "a list of texts");
    out.clear();
    for (const auto& item : value) {
        if (!item.is_string())
            return fail(key, "a list of texts");
        out.push_back(item.get<std::string>());
    }
}

JsonReader JsonReader::object(const char* key) const {
    if (has(key) && !raw(key).is_object()) {
        fail(key, "an object");
        return {emptyObject(), m_pointer + "/" + key, m_failure};
    }
    return {has(key) ? raw(key) : emptyObject(), m_pointer + "/" + key, m_failure};
}

std::vector<JsonReader> JsonReader::objects(const char* key) const {
    std::vector<JsonReader> out;
    if (!has(key))
        return out;
    const json& value = raw(key);
    if (!value.is_array()) {
        fail(key, "a list of objects");
        return out;
    }
    for (std::size_t i = 0; i < value.size(); ++i) {
        if (!value[i].is_object()) {
            fail(fmt::format("{}/{}", key, i), "an object");
            return out;
        }
        out.emplace_back(value[i], fmt::format("{}/{}/{}", m_pointer, key, i), m_failure);
    }
    return out;
}

}  // namespace reflet
