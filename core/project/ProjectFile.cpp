// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/project/ProjectFile.h"

#include "core/base/Files.h"

namespace reflet {

namespace {
/// A project holds decisions, not data: a thousand routes of a thousand points are 40 MB.
constexpr std::size_t kLargestProject = std::size_t(256) << 20;
}  // namespace

Result<Project> loadProject(const std::filesystem::path& path) {
    const auto text = readFile(path, kLargestProject);
    if (!text)
        return tl::unexpected(text.error());
    return projectFromJson(*text, path.string());
}

Result<void> saveProject(const Project& project, const std::filesystem::path& path) {
    return writeFileAtomically(path, projectToJson(project));
}

}  // namespace reflet
