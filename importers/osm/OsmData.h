// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace reflet::osm {

/// The tags of a thing: a handful, as they are written.
class Tags {
public:
    void add(std::string key, std::string value) {
        m_tags.emplace_back(std::move(key), std::move(value));
    }
    /// Empty when there is no such tag.
    [[nodiscard]] std::string_view operator[](std::string_view key) const {
        for (const auto& [name, value] : m_tags) {
            if (name == key)
                return value;
        }
        return {};
    }
    /// The value of the first of the keys that is there.
    [[nodiscard]] std::string_view first(std::initializer_list<std::string_view> keys) const {
        for (const std::string_view key : keys) {
            if (const std::string_view value = (*this)[key]; !value.empty())
                return value;
        }
        return {};
    }
    [[nodiscard]] bool empty() const { return m_tags.empty(); }

private:
    std::vector<std::pair<std::string, std::string>> m_tags;
};

/// A node with tags of its own.
struct Node {
    std::int64_t id = 0;
    Tags tags;
    std::optional<glm::dvec2> place;  ///< longitude and latitude in degrees, if it is a sound one
};

struct Way {
    std::int64_t id = 0;
    Tags tags;
    std::vector<std::int64_t> nodes;
};

struct Member {
    std::int64_t way = 0;
    bool isRelation = false;  ///< `way` is the id of a relation then
    std::string role;
};

struct Relation {
    std::int64_t id = 0;
    Tags tags;
    std::vector<Member> members;  ///< ways and relations
};

/// What was asked for of a file, in the file's order.
struct OsmData {
    std::vector<Node> nodes;
    std::vector<Relation> relations;
    std::vector<Way> ways;  ///< those asked for, and the members of the relations

    [[nodiscard]] const Way* way(std::int64_t id) const {
        const auto found = wayIndex.find(id);
        return found == wayIndex.end() ? nullptr : &ways[found->second];
    }
    /// Longitude and latitude in degrees; nullopt when the file has not the node, or no sound place
    /// for it.
    [[nodiscard]] std::optional<glm::dvec2> place(std::int64_t node) const;

    std::unordered_map<std::int64_t, std::size_t> wayIndex;
    std::vector<std::int64_t> nodeIds;  ///< ascending; those of the ways
    /// In units of 1e-7 degrees, as the formats hold them; kNowhere for nodes that are not there.
    std::vector<std::pair<std::int32_t, std::int32_t>> nodePlaces;
    static constexpr std::int32_t kNowhere = 2147483647;
};

}  // namespace reflet::osm
