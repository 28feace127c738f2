// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/document/ModelPaths.h"

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
    project.source = rebasedSource(project.source, from, to);
}

std::string rebasedSource(const std::string& source, const fs::path& from, const fs::path& to) {
    if (from == to)
        return source;
    auto root = nlohmann::json::parse(source, nullptr, false);
    if (!root.is_object())
        return source;
    const auto models = root.find("models");
    if (models == root.end() || !models->is_array())
        return source;
    for (auto& model : *models) {
        if (!model.is_object())
            continue;
        const auto path = model.find("path");
        if (path != model.end() && path->is_string())
            *path = rebasedPath(path->get<std::string>(), from, to);
    }
    return root.dump();
}

}  // namespace reflet
