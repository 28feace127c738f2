// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/tiles/TileTree.h"

#include "core/base/Files.h"
#include "importers/common/PercentDecoding.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <system_error>

namespace reflet::tiles {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr std::size_t kLargestJson = std::size_t(512) << 20;
constexpr int kDeepestJson = 512;
constexpr int kMostLevels = 10;  // of an implicit quadtree: a million tiles

const json& memberOf(const json& object, const char* key) {
    static const json none;
    const auto found = object.find(key);
    return found == object.end() ? none : *found;
}

std::string textOf(const json& object, const char* key) {
    const json& value = memberOf(object, key);
    return value.is_string() ? value.get<std::string>() : std::string();
}

Result<json> readJson(const fs::path& path) {
    const auto text = readFile(path, kLargestJson);
    if (!text)
        return tl::unexpected(text.error());
    bool tooDeep = false;
    const auto look = [&](int depth, json::parse_event_t, json&) {
        tooDeep = tooDeep || depth > kDeepestJson;
        return !tooDeep;
    };
    json root = json::parse(text->begin(), text->end(), look, false);
    if (tooDeep || root.is_discarded() || !root.is_object() || !memberOf(root, "root").is_object())
        return fail(ErrorCode::Unreadable,
                    tooDeep ? "is nested too deep" : "is no tileset, or is cut off", path.string(),
                    "Choose the tileset.json of 3D Tiles 1.0 or 1.1.");
    return root;
}

/// The path of a URI; what follows a "?" is for servers.
std::string plainUri(const std::string& uri) {
    return importers::percentDecoded(uri.substr(0, uri.find_first_of("?#")));
}

/// The same text for each way to write the path of one file.
std::string identityOf(const fs::path& path) {
    std::error_code failed;
    const fs::path canonical = fs::weakly_canonical(path, failed);
    return (failed ? path.lexically_normal() : canonical).string();
}

bool isRemote(const std::string& uri) {
    return uri.find("://") != std::string::npos || uri.starts_with("//");
}

/// Column by column; the identity for what is no such matrix.
glm::dmat4 transformOf(const json& tile) {
    const json& list = memberOf(tile, "transform");
    glm::dmat4 out(1.0);
    if (!list.is_array() || list.size() != 16)
        return out;
    for (std::size_t i = 0; i < 16; ++i) {
        if (!list[i].is_number() || !std::isfinite(list[i].get<double>()))
            return glm::dmat4(1.0);
        out[int(i / 4)][int(i % 4)] = list[i].get<double>();
    }
    return out;
}

bool replaces(const json& tile, bool inherited) {
    std::string refine = textOf(tile, "refine");
    std::transform(refine.begin(), refine.end(), refine.begin(),
                   [](unsigned char c) { return char(std::toupper(c)); });
    return refine.empty() ? inherited : refine != "ADD";
}

/// The URIs of a tile's contents: 1.0 also wrote "url", 1.1 may have several.
std::vector<std::string> contentsOf(const json& tile) {
    std::vector<std::string> uris;
    const auto add = [&](const json& content) {
        if (!content.is_object())
            return;
        const std::string uri = textOf(content, "uri");
        const std::string url = textOf(content, "url");
        if (!uri.empty() || !url.empty())
            uris.push_back(uri.empty() ? url : uri);
    };
    add(memberOf(tile, "content"));
    for (const json& content : memberOf(tile, "contents"))
        add(content);
    return uris;
}

/// Names for one remark, of which a tileset may have thousands.
struct Named {
    std::size_t count = 0;
    std::string names;
    void add(const std::string& name) {
        constexpr std::size_t kShown = 3;
        if (count++ < kShown)
            names += fmt::format("{}{:.100}", names.empty() ? "" : ", ", name);
    }
};

class Walker {
public:
    Walker(const fs::path& path, const TreeLimits& limits, const JobContext& job)
        : m_folder(path.has_parent_path() ? path.parent_path() : fs::path(".")),
          m_limits(limits),
          m_job(job) {}

    Result<TileTree> run(const fs::path& path) {
        const auto root = readJson(path);
        if (!root)
            return tl::unexpected(root.error());
        m_tree.version = textOf(memberOf(*root, "asset"), "version");
        m_tree.geocentric =
            memberOf(memberOf(memberOf(*root, "root"), "boundingVolume"), "region").is_array();
        m_chain = {identityOf(path)};
        auto tiles = walkTileset(*root, path, {glm::dmat4(1.0), true, false, 0});
        if (!tiles)
            return tl::unexpected(tiles.error());
        m_tree.tiles = *std::move(tiles);
        m_tree.errors.assign(m_errors.begin(), m_errors.end());
        tell();
        return std::move(m_tree);
    }

private:
    using Tiles = std::vector<TileUse>;
    /// What a tile has of those above it.
    struct Above {
        glm::dmat4 world_from_parent{1.0};
        bool replaces = true;
        bool zUp = false;
        int depth = 0;
    };

    tl::unexpected<Error> tooLarge(std::string what) const {
        return fail(ErrorCode::ResourceLimit, std::move(what), m_folder.string(),
                    "Import a part of it: one of the tilesets that it refers to.");
    }

    Result<Tiles> walkTileset(const json& root, const fs::path& file, Above above) {
        std::string up = textOf(memberOf(root, "asset"), "gltfUpAxis");
        above.zUp = up == "Z" || up == "z";
        return walk(memberOf(root, "root"), file.parent_path(), above);
    }

    Result<Tiles> walk(const json& tile, const fs::path& folder, Above above) {
        if (m_job.cancelled())
            return tl::unexpected(JobContext::cancelledError());
        if (++m_met > m_limits.maxTiles)
            return tooLarge(fmt::format("has more than {} tiles", m_limits.maxTiles));
        if (!tile.is_object())
            return Tiles();
        if (above.depth > m_limits.deepest) {
            m_deep.add(folder.string());
            return Tiles();
        }
        above.world_from_parent = above.world_from_parent * transformOf(tile);
        above.replaces = replaces(tile, above.replaces);
        ++above.depth;
        if (memberOf(tile, "implicitTiling").is_object())
            return implicitTiles(tile, folder, above);
        const double error = errorOf(tile);
        Tiles below;
        if (!memberOf(tile, "children").empty()) {
            m_errors.insert(error);
            if (error <= m_limits.goodEnough) {
                auto here = contents(contentsOf(tile), folder, above);
                if (!here || !here->empty())
                    return here;
            }
        }
        for (const json& child : memberOf(tile, "children")) {
            auto tiles = walk(child, folder, above);
            if (!tiles)
                return tiles;
            std::move(tiles->begin(), tiles->end(), std::back_inserter(below));
        }
        for (const std::string& uri : contentsOf(tile)) {
            auto tiles = content(uri, folder, above, !below.empty());
            if (!tiles)
                return tiles;
            std::move(tiles->begin(), tiles->end(), std::back_inserter(below));
        }
        return below;
    }

    /// All contents of a tile that stands for those below it.
    Result<Tiles> contents(const std::vector<std::string>& uris, const fs::path& folder,
                           const Above& above) {
        Tiles all;
        const Named missing = m_missing;  // then those below are taken, which is no loss
        for (const std::string& uri : uris) {
            auto tiles = content(uri, folder, above, false);
            if (!tiles)
                return tiles;
            std::move(tiles->begin(), tiles->end(), std::back_inserter(all));
        }
        m_missing = missing;
        return all;
    }

    /// Metres by which a tile without those below it is off; infinite where it does not say.
    static double errorOf(const json& tile) {
        const json& error = memberOf(tile, "geometricError");
        const double metres = error.is_number() ? error.get<double>() : -1.0;
        return metres >= 0.0 ? metres : std::numeric_limits<double>::infinity();
    }

    /// What stands behind a URI; `refined`: there are finer tiles.
    Result<Tiles> content(const std::string& uri, const fs::path& folder, const Above& above,
                          bool refined) {
        if (isRemote(uri)) {
            m_remote.add(uri);
            return Tiles();
        }
        const std::string plain = plainUri(uri);
        const fs::path relative = (folder.lexically_relative(m_folder) / plain).lexically_normal();
        const auto file = confinedPath(m_folder, relative.generic_string());
        if (plain.empty() || plain.front() == '/' || !file) {
            m_outside.add(uri);
            return Tiles();
        }
        std::error_code error;
        if (!fs::is_regular_file(*file, error)) {
            m_missing.add(relative.generic_string());
            return Tiles();
        }
        std::string suffix = file->extension().string();
        std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                       [](unsigned char c) { return char(std::tolower(c)); });
        if (suffix == ".json")
            return external(*file, above);
        if (refined && above.replaces)
            return Tiles();
        return Tiles{{*file, relative.generic_string(), above.world_from_parent, above.zUp}};
    }

    Result<Tiles> external(const fs::path& file, const Above& above) {
        const std::string whole = identityOf(file);
        if (std::find(m_chain.begin(), m_chain.end(), whole) != m_chain.end()) {
            m_cycles.add(file.lexically_relative(m_folder).string());
            return Tiles();
        }
        if (++m_tilesets > m_limits.maxTilesets)
            return tooLarge(fmt::format("refers to more than {} tilesets", m_limits.maxTilesets));
        const auto root = readJson(file);
        if (!root) {
            m_tree.remarks.push_back(
                {Severity::Error, "tileset-unreadable", file.lexically_relative(m_folder).string(),
                 root.error().what + "; it was left out", root.error().remedy});
            return Tiles();
        }
        m_chain.push_back(whole);
        auto tiles = walkTileset(*root, file, above);
        m_chain.pop_back();
        return tiles;
    }

    /// The tiles of a quadtree or octree (3D Tiles 1.1) whose files are there; subtrees, which tell
    /// the same to those who read over a network, are not needed.
    Result<Tiles> implicitTiles(const json& tile, const fs::path& folder, const Above& above) {
        const json& tiling = memberOf(tile, "implicitTiling");
        const bool octree = textOf(tiling, "subdivisionScheme") == "OCTREE";
        const json& said = memberOf(tiling, "availableLevels");
        const int levels =
            said.is_number_unsigned() ? int(std::min<std::size_t>(said.get<std::size_t>(), 64)) : 0;
        const int most = octree ? 2 * kMostLevels / 3 : kMostLevels;
        if (levels > most) {
            m_tree.remarks.push_back(
                {Severity::Error, "implicit-levels", "",
                 fmt::format("an implicit tiling of {} levels was left out: at most {} are read",
                             levels, most),
                 "Write the tileset with explicit tiles."});
            return Tiles();
        }
        const std::vector<std::string> patterns = contentsOf(tile);
        const Implicit what{levels, octree, errorOf(tile), patterns};
        auto tiles = implicitBelow({0, 0, 0, 0}, what, folder, above);
        if (tiles && tiles->empty() && !patterns.empty())
            m_missing.add(patterns.front());
        return tiles;
    }

    struct Cell {
        int level = 0, x = 0, y = 0, z = 0;
    };

    struct Implicit {
        int levels = 0;
        bool octree = false;
        double error = 0.0;  ///< of level 0, halved from level to level
        const std::vector<std::string>& patterns;
    };

    Result<Tiles> implicitBelow(const Cell& cell, const Implicit& what, const fs::path& folder,
                                const Above& above) {
        if (m_job.cancelled())
            return tl::unexpected(JobContext::cancelledError());
        Tiles below;
        if (cell.level >= what.levels)
            return below;
        const double error = std::ldexp(what.error, -cell.level);
        if (cell.level + 1 < what.levels) {
            m_errors.insert(error);
            if (error <= m_limits.goodEnough) {
                auto here = contents(filledAll(what.patterns, cell), folder, above);
                if (!here || !here->empty())
                    return here;
            }
        }
        for (int child = 0; child < (what.octree ? 8 : 4); ++child) {
            auto tiles = implicitBelow({cell.level + 1, 2 * cell.x + (child & 1),
                                        2 * cell.y + ((child >> 1) & 1), 2 * cell.z + (child >> 2)},
                                       what, folder, above);
            if (!tiles)
                return tiles;
            std::move(tiles->begin(), tiles->end(), std::back_inserter(below));
        }
        const bool refined = !below.empty();
        for (const std::string& uri : filledAll(what.patterns, cell)) {
            const Named missing = m_missing;  // those of other cells are no loss
            auto tiles = content(uri, folder, above, refined);
            m_missing = missing;
            if (!tiles)
                return tiles;
            std::move(tiles->begin(), tiles->end(), std::back_inserter(below));
        }
        return below;
    }

    static std::vector<std::string> filledAll(const std::vector<std::string>& patterns,
                                              const Cell& cell) {
        std::vector<std::string> uris;
        for (const std::string& pattern : patterns)
            uris.push_back(filled(pattern, cell));
        return uris;
    }

    static std::string filled(std::string pattern, const Cell& cell) {
        for (const auto& [name, number] : {std::pair("{level}", cell.level),
                                           {"{x}", cell.x},
                                           {"{y}", cell.y},
                                           {"{z}", cell.z}}) {
            if (const std::size_t at = pattern.find(name); at != std::string::npos)
                pattern.replace(at, std::string_view(name).size(), std::to_string(number));
        }
        return pattern;
    }

    void tell() {
        m_tree.missing = m_missing.count;
        const auto say = [&](const Named& named, const char* code, const char* what,
                             const char* remedy) {
            if (named.count > 0)
                m_tree.remarks.push_back({Severity::Warning, code, "",
                                          fmt::format("{} {}: {}{}", named.count, what, named.names,
                                                      named.count > 3 ? ", ..." : ""),
                                          remedy});
        };
        say(m_missing, "tile-missing", "tiles are named and not there",
            "Download the whole tileset.");
        say(m_remote, "tile-remote", "tiles lie in the network, and nothing is fetched from there",
            "Download the whole tileset and import its tileset.json.");
        say(m_outside, "tile-outside", "tiles lie outside the tileset's folder and were left out",
            "Put the tileset into one folder.");
        say(m_cycles, "tileset-cycle", "tilesets hold themselves and were left out there",
            "Make the tileset anew.");
        say(m_deep, "tileset-deep", "tiles lie too deep below others and were left out",
            "Make the tileset anew.");
    }

    fs::path m_folder;
    const TreeLimits& m_limits;
    const JobContext& m_job;
    TileTree m_tree;
    std::vector<std::string> m_chain;  ///< tilesets from the outermost to the one that is walked
    std::set<double> m_errors;
    std::size_t m_met = 0, m_tilesets = 0;
    Named m_missing, m_remote, m_outside, m_cycles, m_deep;
};

}  // namespace

Result<TileTree> readTileTree(const fs::path& path, const TreeLimits& limits,
                              const JobContext& job) {
    return Walker(path, limits, job).run(path);
}

}  // namespace reflet::tiles
