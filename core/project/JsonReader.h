// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

/// Reads members of a JSON object with checks, and remembers the first thing that was wrong: its
/// JSON pointer and what was expected there. Absent members keep the default; wrong ones too.
/// Internal to core/project.
class JsonReader {
public:
    struct Failure {
        std::string pointer;
        std::string expected;
    };

    JsonReader(const nlohmann::json& value, std::string pointer, std::optional<Failure>& failure)
        : m_value(value), m_pointer(std::move(pointer)), m_failure(failure) {}

    [[nodiscard]] bool has(const char* key) const;
    void read(const char* key, std::string& out) const;
    void read(const char* key, bool& out) const;
    void read(const char* key, double& out, double min, double max) const;
    void read(const char* key, float& out, double min, double max) const;
    void read(const char* key, int& out, int min, int max) const;
    void read(const char* key, std::size_t& out, std::size_t min, std::size_t max) const;
    void read(const char* key, glm::dvec3& out) const;
    void read(const char* key, std::vector<std::string>& out) const;
    void require(const char* key) const;

    /// The object under `key`; an empty object when it is absent.
    [[nodiscard]] JsonReader object(const char* key) const;
    /// One reader per object of the array under `key`; none when it is absent.
    [[nodiscard]] std::vector<JsonReader> objects(const char* key) const;
    /// The raw value under `key`, or null.
    [[nodiscard]] const nlohmann::json& raw(const char* key) const;

    void fail(const std::string& key, std::string expected) const;
    [[nodiscard]] const std::string& pointer() const { return m_pointer; }

private:
    const nlohmann::json& m_value;
    std::string m_pointer;
    std::optional<Failure>& m_failure;
};

/// A triple of finite numbers, or nullopt.
[[nodiscard]] std::optional<glm::dvec3> tripleFromJson(const nlohmann::json& value);

}  // namespace reflet
