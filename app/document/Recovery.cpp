// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/document/Recovery.h"

#include "app/document/ProjectDocument.h"
#include "app/document/files/DerivedFiles.h"
#include "app/document/files/ModelPaths.h"
#include "core/base/Files.h"

#include <nlohmann/json.hpp>

#include <QLockFile>
#include <QString>
#include <algorithm>

namespace reflet {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr const char* kSchema = "reflet-recovery";
constexpr int kVersion = 1;
/// As for projects, which are most of it.
constexpr std::size_t kLargestFile = std::size_t(260) << 20;

fs::path lockOf(const fs::path& file) {
    return fs::path(file) += ".lock";
}

/// The window that wrote the file is gone: its lock can be had.
bool isLeftBehind(const fs::path& file) {
    QLockFile lock(QString::fromStdString(lockOf(file).string()));
    lock.setStaleLockTime(0);
    return lock.tryLock(0);
}

std::string text(const json& object, const char* key) {
    const json value = object.value(key, json());
    return value.is_string() ? value.get<std::string>() : std::string();
}

}  // namespace

std::string recoveryToJson(const RecoveryRecord& record) {
    return json{{"schema", kSchema},
                {"version", kVersion},
                {"original", record.original.string()},
                {"origin", record.origin.string()},
                {"time", record.time.toUTC().toString(Qt::ISODateWithMs).toStdString()},
                {"project", json::parse(projectToJson(record.project))}}
        .dump();
}

Result<RecoveryRecord> recoveryFromJson(const std::string& content, const std::string& subject) {
    const json root = json::parse(content, nullptr, false);
    if (!root.is_object() || text(root, "schema") != kSchema || !root.contains("project")) {
        return fail(ErrorCode::Unreadable, "this is no project that was saved by itself", subject,
                    "Open the project's own file, or its backup beside it (.bak).");
    }
    if (root.value("version", json()) != json(kVersion)) {
        return fail(ErrorCode::Refused, "another version of Reflet has saved this by itself",
                    subject, "Recover it with that version.");
    }
    auto project = projectFromJson(root["project"].dump(), subject);
    if (!project)
        return tl::unexpected(project.error());
    return RecoveryRecord{
        std::move(*project), text(root, "original"), text(root, "origin"),
        QDateTime::fromString(QString::fromStdString(text(root, "time")), Qt::ISODateWithMs)};
}

Recovery::Recovery(fs::path folder)
    : m_folder(folder.empty() ? recoveryFolder() : std::move(folder)) {}

std::vector<RecoverableProject> Recovery::list() const {
    std::vector<RecoverableProject> out;
    std::error_code error;
    for (fs::directory_iterator entry(m_folder, error), end; !error && entry != end;
         entry.increment(error)) {
        const fs::path file = entry->path();
        if (!file.string().ends_with(kRecoveryEnding) || !isLeftBehind(file))
            continue;
        const auto content = readFile(file, kLargestFile);
        if (!content)
            continue;
        auto record = recoveryFromJson(*content, file.string());
        if (record) {
            out.push_back({file, record->original, record->project.name, record->time});
        }
    }
    std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.time > b.time; });
    return out;
}

Result<void> Recovery::recover(const RecoverableProject& found, ProjectDocument& document) const {
    const auto content = readFile(found.file, kLargestFile);
    if (!content)
        return tl::unexpected(content.error());
    auto record = recoveryFromJson(*content, found.file.string());
    if (!record)
        return tl::unexpected(record.error());
    const fs::path base = record->original.empty() ? record->origin : record->original;
    rebasePaths(record->project, {}, base.parent_path());
    document.adopt(std::move(record->project), record->original, ProjectDocument::Condition::Dirty,
                   record->origin);
    return {};
}

void Recovery::discard(const RecoverableProject& found) const {
    std::error_code ignored;
    fs::remove(found.file, ignored);
    fs::remove(lockOf(found.file), ignored);
}

}  // namespace reflet
