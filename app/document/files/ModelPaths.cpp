// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/document/files/ModelPaths.h"

#include <nlohmann/json.hpp>

namespace reflet {

namespace fs = std::filesystem;

std::string rebasedPath(const std::string& path, const fs::path& from, const fs::path& to) {
    const fs::path given(path);
    if (path.empty() || (from.empty() && given.is_relative()))
        return path;
    const fs::path absolute = (from / given).lexically_normal();
    const fs::path relative = to.empty() ? fs::path() : absolute.lexically_relative(to);
    return (relative.empty() ? absolute : relative).generic_string();
}

void rebasePaths(Project& project, const fs::path& from, const fs::path& to) {
    if (from == to)
        return;
    for (auto& model : project.models)
        model.path = rebasedPath(model.path, from, to);
    for (auto& vehicle : project.vehicles)
        vehicle.path = rebasedPath(vehicle.path, from, to);
    project.source = rebasedSource(project.source, from, to);
}

std::string rebasedSource(const std::string& source, const fs::path& from, const fs::path& to) {
    if (from == to)
        return source;
    auto root = nlohmann::json::parse(source, nullptr, false);
    if (!root.is_object())
        return source;
    for (const char* list : {"models", "vehicles"}) {
        const auto files = root.find(list);
        if (files == root.end() || !files->is_array())
            continue;
        for (auto& file : *files) {
            if (file.is_object() && file.contains("path") && file["path"].is_string())
                file["path"] = rebasedPath(file["path"].get<std::string>(), from, to);
        }
    }
    return root.dump();
}

}  // namespace reflet
