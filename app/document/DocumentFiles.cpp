// SPDX-License-Identifier: GPL-3.0-or-later
// How ProjectDocument opens and saves.
#include "app/document/JobRunner.h"
#include "app/document/ProjectDocument.h"
#include "app/document/files/DerivedFiles.h"
#include "app/document/files/ModelPaths.h"
#include "app/document/files/ProjectLock.h"
#include "app/document/steps/ProjectCommands.h"
#include "core/base/Files.h"
#include "core/project/ProjectFile.h"

#include <exception>
#include <mutex>

namespace reflet {

namespace fs = std::filesystem;

namespace {

/// One name for one file, whatever links lead to it; where it will be, if it is not there yet.
fs::path canonicalFile(const fs::path& path) {
    std::error_code error;
    const fs::path absolute = fs::absolute(path, error);
    if (error)
        return path;
    const fs::path canonical = fs::weakly_canonical(absolute, error);
    return error ? absolute.lexically_normal() : canonical;
}

Result<void> writeProject(const Project& project, const fs::path& path) {
    try {
        const std::string text = projectToJson(project);
        keepBackup(path);
        return writeFileAtomically(path, text);
    } catch (const std::exception& exception) {
        return fail(ErrorCode::WriteFailed,
                    std::string("the project cannot be written as text: ") + exception.what(),
                    path.string(), "Names must be readable text (UTF-8): rename what is not.");
    }
}

}  // namespace

fs::path ProjectDocument::folder() const {
    return (m_file.empty() ? m_origin : m_file).parent_path();
}

fs::path ProjectDocument::dataFile() const {
    if (!m_file.empty())
        return m_file;
    return m_origin.empty() ? untitledDataFile() : m_origin;
}

Result<void> ProjectDocument::open(const fs::path& path, Access access) {
    const fs::path file = canonicalFile(path);
    const bool ours = m_lock && m_lock->projectFile() == file;
    std::unique_ptr<ProjectLock> lock;
    if (access != Access::ReadOnly && !ours) {
        auto acquired = ProjectLock::acquire(file, access == Access::TakeOver);
        if (!acquired)
            return tl::unexpected(acquired.error());
        lock = std::move(*acquired);
    }
    auto project = loadProject(file);
    if (!project)
        return tl::unexpected(project.error());
    if (ours)
        lock = std::move(m_lock);
    if (lock)
        removeUnfinishedSaves(file);
    replaceAll(std::move(*project), file, std::move(lock), access == Access::ReadOnly && !ours);
    return {};
}

/// Lets saves of one document come one after the other, wherever they run.
struct ProjectDocument::Saves {
    quint64 started = 0;  ///< on the GUI thread

    std::mutex mutex;
    quint64 newestWritten = 0;

    Result<void> write(quint64 number, const Project& project, const fs::path& path) {
        const std::lock_guard lock(mutex);
        if (number < newestWritten)
            return {};  // a newer state is on the disk already
        auto written = writeProject(project, path);
        if (written)
            newestWritten = number;
        return written;
    }
};

ProjectDocument::ProjectDocument(QObject* parent)
    : QObject(parent), m_saves(std::make_shared<Saves>()) {}

Result<void> ProjectDocument::maySave() const {
    if (m_file.empty()) {
        return fail(ErrorCode::Usage, "the project has no file yet", m_project.name,
                    "Choose a place and a name with Save as.");
    }
    if (m_readOnly) {
        return fail(ErrorCode::Refused, "the project was opened for reading only", m_file.string(),
                    "Save it under another name.");
    }
    return {};
}

Result<void> ProjectDocument::save() {
    if (auto may = maySave(); !may)
        return may;
    if (auto written = m_saves->write(++m_saves->started, m_project, m_file); !written)
        return written;
    m_undoStack.setClean();
    return {};
}

void ProjectDocument::saveInBackground(JobRunner& jobs, std::function<void(Result<void>)> done) {
    JobRunner::Options options{
        tr("Save %1").arg(QString::fromStdString(m_file.filename().string())),
        QStringLiteral("save")};
    options.replace = false;
    const auto write = [may = maySave(), saves = m_saves, number = ++m_saves->started,
                        project = m_project, file = m_file](const JobContext&) -> Result<void> {
        return may ? saves->write(number, project, file) : may;
    };
    const auto finish = [this, revision = m_revision, file = m_file,
                         done = std::move(done)](const Result<void>& written) {
        if (written && revision == m_revision && file == m_file)
            m_undoStack.setClean();
        if (done)
            done(written);
    };
    jobs.run<void>(std::move(options), write, this, finish);
}

Result<void> ProjectDocument::saveAs(const fs::path& path) {
    const fs::path file = canonicalFile(path);
    if (file == m_file && !m_readOnly)
        return save();
    const bool ours = m_lock && m_lock->projectFile() == file;
    std::unique_ptr<ProjectLock> lock;
    if (!ours) {
        auto acquired = ProjectLock::acquire(file, false);
        if (!acquired)
            return tl::unexpected(acquired.error());
        lock = std::move(*acquired);
    }
    Project moved = m_project;
    rebasePaths(moved, folder(), file.parent_path());
    if (auto written = m_saves->write(++m_saves->started, moved, file); !written)
        return written;
    shareDerivedFiles(dataFile(), file);
    // The same files under new names: no step, and nothing that is derived from them changes.
    m_project = std::move(moved);
    m_file = file;
    m_origin.clear();
    if (!ours)
        m_lock = std::move(lock);
    m_readOnly = false;
    m_undoStack.setClean();
    Q_EMIT fileChanged();
    return {};
}

void ProjectDocument::close() {
    replaceAll(Project{}, {}, nullptr, false);
}

void ProjectDocument::adopt(Project project, const fs::path& file, Condition condition,
                            const fs::path& origin) {
    const fs::path place = file.empty() ? file : canonicalFile(file);
    std::unique_ptr<ProjectLock> lock;
    bool readOnly = false;
    if (!place.empty() && m_lock && m_lock->projectFile() == place) {
        lock = std::move(m_lock);
    } else if (!place.empty()) {
        auto acquired = ProjectLock::acquire(place, false);
        readOnly = !acquired;
        if (acquired)
            lock = std::move(*acquired);
    }
    replaceAll(std::move(project), place, std::move(lock), readOnly,
               place.empty() && !origin.empty() ? canonicalFile(origin) : fs::path());
    if (condition == Condition::Dirty)
        m_undoStack.resetClean();
}

void ProjectDocument::replaceAll(Project project, const fs::path& file,
                                 std::unique_ptr<ProjectLock> lock, bool readOnly,
                                 const fs::path& origin) {
    endDrag();
    ++m_revision;
    m_project = std::move(project);
    m_file = file;
    m_origin = origin;
    m_lock = std::move(lock);
    m_readOnly = readOnly;
    m_undoStack.clear();
    const bool reselected = m_selection.replace({});
    Q_EMIT fileChanged();
    Q_EMIT projectChanged(ProjectChange::All);
    if (reselected)
        Q_EMIT m_selection.changed();
}

}  // namespace reflet
