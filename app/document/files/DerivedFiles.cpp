// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/document/files/DerivedFiles.h"

#include "app/pipeline/PreparedCity.h"

#include <QDir>
#include <QStandardPaths>
#include <chrono>
#include <string>
#include <system_error>
#include <vector>

namespace reflet {

namespace fs = std::filesystem;

namespace {

fs::path withEnding(const fs::path& path, const char* ending) {
    fs::path out = path;
    out += ending;
    return out;
}

/// A second name for a file, or a copy of it where the file system has no such names.
bool linkOrCopy(const fs::path& from, const fs::path& to) {
    std::error_code error;
    fs::create_hard_link(from, to, error);
    if (!error)
        return true;
    fs::copy_file(from, to, fs::copy_options::overwrite_existing, error);
    return !error;
}

}  // namespace

void removeUnfinishedSaves(const fs::path& projectFile) {
    constexpr auto kSurelyDead = std::chrono::minutes(1);
    std::error_code error;
    std::vector<fs::path> dead;
    for (fs::directory_iterator entry(projectFile.parent_path(), error), end;
         !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        std::error_code ignored;
        const bool staging = name.starts_with(".reflet-") && entry->is_directory(ignored) &&
                             fs::exists(entry->path() / projectFile.filename(), ignored);
        const auto written = fs::last_write_time(entry->path(), ignored);
        if (staging && !ignored && fs::file_time_type::clock::now() - written > kSurelyDead)
            dead.push_back(entry->path());
    }
    for (const fs::path& folder : dead)
        fs::remove_all(folder, error);
}

fs::path untitledDataFile() {
    const QString cache = QStandardPaths::writableLocation(QStandardPaths::GenericCacheLocation);
    return fs::path(cache.toStdString()) / "reflet" / "untitled.reflet";
}

fs::path recoveryFolder() {
    // Qt 6.4 does not know the XDG state folder yet.
    const QByteArray state = qgetenv("XDG_STATE_HOME");
    const fs::path base = fs::path(state.constData()).is_absolute()
                              ? fs::path(state.constData())
                              : fs::path(QDir::homePath().toStdString()) / ".local" / "state";
    return base / "reflet" / "recovery";
}

void keepBackup(const fs::path& projectFile) {
    std::error_code error;
    if (!fs::is_regular_file(projectFile, error) || fs::file_size(projectFile, error) == 0)
        return;
    const fs::path newest = withEnding(projectFile, ".bak");
    const fs::path fresh = withEnding(projectFile, ".bak~");
    fs::remove(fresh, error);
    if (!linkOrCopy(projectFile, fresh)) {
        fs::remove(fresh, error);
        return;
    }
    if (fs::exists(newest, error))
        fs::rename(newest, withEnding(projectFile, ".bak2"), error);
    fs::rename(fresh, newest, error);
}

void shareDerivedFiles(const fs::path& oldProjectFile, const fs::path& newProjectFile) {
    const fs::path from = cacheFolder(oldProjectFile);
    const fs::path to = cacheFolder(newProjectFile);
    std::error_code error;
    if (from == to || !fs::is_directory(from, error))
        return;
    fs::create_directories(to, error);
    fs::recursive_directory_iterator entries(from, fs::directory_options::skip_permission_denied,
                                             error);
    for (; !error && entries != fs::recursive_directory_iterator(); entries.increment(error)) {
        std::error_code ignored;
        const fs::path target = to / entries->path().lexically_relative(from);
        if (entries->is_directory(ignored)) {
            fs::create_directories(target, ignored);
        } else if (entries->is_regular_file(ignored) && !fs::exists(target, ignored)) {
            fs::create_hard_link(entries->path(), target, ignored);
            if (ignored == std::errc::cross_device_link)
                return;
        }
    }
}

}  // namespace reflet
