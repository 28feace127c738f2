// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/project/Migrations.h"

#include "core/project/Project.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <vector>

namespace reflet {

namespace {

/// steps[v - 1] turns version v into v + 1. Version 1 is the first one.
const std::vector<std::function<void(nlohmann::json&)>>& steps() {
    static const std::vector<std::function<void(nlohmann::json&)>> table{};
    return table;
}

}  // namespace

void migrateProject(nlohmann::json& root, int version) {
    for (int v = version; v < kProjectSchemaVersion; ++v)
        steps()[static_cast<std::size_t>(v - 1)](root);
    root["version"] = kProjectSchemaVersion;
}

}  // namespace reflet
