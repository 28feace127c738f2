// SPDX-License-Identifier: GPL-3.0-or-later
// What lies beside a project file. Internal to app/document.
#pragma once

#include <filesystem>

namespace reflet {

/// Keeps what is in the file now as "name.reflet.bak", and what was there as "name.reflet.bak2".
/// At every moment the file itself is whole. A backup that cannot be made holds up no saving.
void keepBackup(const std::filesystem::path& projectFile);

/// Removes what saves that were killed half-way have left beside the file: hidden folders with an
/// unfinished copy of it, that nobody has touched for a minute. For the owner of the file's lock.
void removeUnfinishedSaves(const std::filesystem::path& projectFile);

/// The file that untitled projects keep what is derived beside: it is never written itself.
[[nodiscard]] std::filesystem::path untitledDataFile();
/// Where crashed windows leave what was not saved: XDG_STATE_HOME/reflet/recovery.
[[nodiscard]] std::filesystem::path recoveryFolder();

/// Lets a project under a new name find what was derived for the old one: links of the files, which
/// are never rewritten in place, so that nothing is copied. Where links cannot be made (another
/// disk), the data are derived anew.
void shareDerivedFiles(const std::filesystem::path& oldProjectFile,
                       const std::filesystem::path& newProjectFile);

}  // namespace reflet
