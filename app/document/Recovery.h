// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"
#include "core/project/Project.h"

#include <QDateTime>
#include <filesystem>
#include <string>
#include <vector>

namespace reflet {

class ProjectDocument;

/// What the autosave of a window that crashed has left.
struct RecoverableProject {
    std::filesystem::path file;      ///< in the state folder
    std::filesystem::path original;  ///< the project's own file; empty: it was never saved
    std::string name;                ///< of the project
    QDateTime time;                  ///< when it was written
};

/// Finds what crashed windows left in the state folder, and brings it back.
class Recovery {
public:
    /// `folder` empty: the user's state folder.
    explicit Recovery(std::filesystem::path folder = {});

    /// The newest first. Files of living windows, and files that cannot be read, are not listed.
    [[nodiscard]] std::vector<RecoverableProject> list() const;
    /// Opens the project with unsaved changes, under its old path; read-only when another window
    /// has that open. The file is kept: discard() it once the document is saved or autosaved.
    /// Unreadable, and the document as it was, when the file is not whole.
    Result<void> recover(const RecoverableProject& found, ProjectDocument& document) const;
    void discard(const RecoverableProject& found) const;

private:
    std::filesystem::path m_folder;
};

/// The file format that Autosave writes and Recovery reads: JSON, with the paths of the project's
/// models made absolute.
struct RecoveryRecord {
    Project project;
    std::filesystem::path original;  ///< the project's own file; empty: it was never saved
    std::filesystem::path origin;    ///< of an untitled project, see ProjectDocument::origin()
    QDateTime time;
};
[[nodiscard]] std::string recoveryToJson(const RecoveryRecord& record);
[[nodiscard]] Result<RecoveryRecord> recoveryFromJson(const std::string& text,
                                                      const std::string& subject);
inline constexpr const char* kRecoveryEnding = ".recovery.json";

}  // namespace reflet
