// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"

#include <QLockFile>
#include <filesystem>
#include <memory>

namespace reflet {

/// The mark beside a project file ("name.reflet.lock") that a window has it open; taken away when
/// this goes. A mark whose process is dead, on this computer, counts for nothing: that tells a
/// crash from a second window.
class ProjectLock {
public:
    /// Refused, with who has it, while another window has the file open. `takeOver` breaks the
    /// lock of an owner that cannot be asked, but not that of a process that lives here. Where the
    /// folder lets nobody write, there is nothing to protect: a lock that holds nothing.
    [[nodiscard]] static Result<std::unique_ptr<ProjectLock>> acquire(
        const std::filesystem::path& projectFile, bool takeOver);

    /// The file that is locked.
    [[nodiscard]] const std::filesystem::path& projectFile() const { return m_projectFile; }

private:
    ProjectLock(std::filesystem::path projectFile, const QString& lockFile);

    std::filesystem::path m_projectFile;
    QLockFile m_lock;
};

}  // namespace reflet
