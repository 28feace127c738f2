// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace reflet {

/// Brings the JSON of a project from an older schema version to kProjectSchemaVersion, one step
/// per version. Internal to core/project.
void migrateProject(nlohmann::json& root, int version);

}  // namespace reflet
