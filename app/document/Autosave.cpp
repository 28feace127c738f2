// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/document/Autosave.h"

#include "app/document/ProjectDocument.h"
#include "app/document/Recovery.h"
#include "app/document/files/DerivedFiles.h"
#include "app/document/files/ModelPaths.h"
#include "core/base/Files.h"

#include <QUuid>
#include <exception>

namespace reflet {

namespace fs = std::filesystem;

namespace {

/// A save that was due during a drag follows this soon after it.
constexpr int kAfterDragMilliseconds = 1'000;

struct Snapshot {
    RecoveryRecord record;
    fs::path folder;  ///< where relative paths of models start
    fs::path file;
};

Snapshot snapshotOf(const ProjectDocument& document, const fs::path& file) {
    return {
        {document.project(), document.file(), document.origin(), QDateTime::currentDateTimeUtc()},
        document.folder(),
        file};
}

Result<void> write(Snapshot snapshot) {
    try {
        rebasePaths(snapshot.record.project, snapshot.folder, {});
        return writeFileAtomically(snapshot.file, recoveryToJson(snapshot.record));
    } catch (const std::exception& exception) {
        return fail(ErrorCode::WriteFailed,
                    std::string("the project cannot be written as text: ") + exception.what(),
                    snapshot.file.string(), "Save the project yourself.");
    }
}

}  // namespace

Autosave::Autosave(ProjectDocument& document, const fs::path& folder, QObject* parent)
    : QObject(parent), m_document(document) {
    const QString name = QUuid::createUuid().toString(QUuid::WithoutBraces);
    m_file = (folder.empty() ? recoveryFolder() : folder) / (name.toStdString() + kRecoveryEnding);
    m_thread.setMaxThreadCount(1);
    connect(&document, &ProjectDocument::projectChanged, this, [this] { m_changed = true; });
    connect(document.undoStack(), &QUndoStack::cleanChanged, this, [this](bool clean) {
        m_changed = true;
        if (clean && !m_writing)
            forget();
    });
    connect(&m_timer, &QTimer::timeout, this, &Autosave::saveIfDue);
    setInterval(kDefaultMilliseconds);
    m_changed = document.isDirty();
}

Autosave::~Autosave() {
    m_thread.waitForDone();
    forget();
}

void Autosave::setInterval(int milliseconds) {
    m_timer.start(milliseconds);
}

Result<void> Autosave::prepareFolder() {
    if (m_lock)
        return {};
    if (auto made = makeFolder(m_file.parent_path()); !made)
        return made;
    auto lock = std::make_unique<QLockFile>(QString::fromStdString(m_file.string() + ".lock"));
    lock->setStaleLockTime(0);
    if (!lock->tryLock(0)) {
        return fail(ErrorCode::WriteFailed, "the folder for recovery cannot be written",
                    m_file.parent_path().string(),
                    "Check its permissions and the free space; until then save yourself.");
    }
    m_lock = std::move(lock);
    return {};
}

void Autosave::saveIfDue() {
    if (!m_document.isDirty() || !m_changed || m_writing)
        return;
    if (m_document.isDragging()) {
        QTimer::singleShot(kAfterDragMilliseconds, this, &Autosave::saveIfDue);
        return;
    }
    if (const auto prepared = prepareFolder(); !prepared)
        return report(prepared);
    m_changed = false;
    m_writing = true;
    m_thread.start([this, snapshot = snapshotOf(m_document, m_file)]() mutable {
        auto written = write(std::move(snapshot));
        // This object is alive: its destructor waits for this thread.
        QMetaObject::invokeMethod(
            this,
            [this, written = std::move(written)] {
                m_writing = false;
                report(written);
            },
            Qt::QueuedConnection);
    });
}

Result<void> Autosave::saveNow() {
    m_thread.waitForDone();
    if (!m_document.isDirty())
        return {};
    auto written = prepareFolder();
    if (written)
        written = write(snapshotOf(m_document, m_file));
    m_changed = false;
    report(written);
    return written;
}

void Autosave::report(const Result<void>& written) {
    if (!m_document.isDirty())
        forget();
    if (written) {
        m_failed = false;
        return;
    }
    m_changed = true;  // to be tried again
    if (!m_failed) {
        m_failed = true;
        Q_EMIT failed(written.error());
    }
}

void Autosave::forget() {
    std::error_code ignored;
    if (m_lock)
        fs::remove(m_file, ignored);
    m_lock.reset();
}

}  // namespace reflet
