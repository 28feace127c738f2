// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"

#include <QLockFile>
#include <QObject>
#include <QThreadPool>
#include <QTimer>
#include <filesystem>
#include <memory>

namespace reflet {

class ProjectDocument;

/// Writes the unsaved project to the state folder now and then, on a thread of its own and never
/// during a drag, so that a crash costs seconds of work. The file goes when the project is saved or
/// given up; it stays when the process dies, and Recovery finds it then. GUI thread.
class Autosave : public QObject {
    Q_OBJECT
public:
    static constexpr int kDefaultMilliseconds = 30'000;

    /// `folder` empty: the user's state folder.
    explicit Autosave(ProjectDocument& document, const std::filesystem::path& folder = {},
                      QObject* parent = nullptr);
    /// Removes the file: a window that closes has asked what to do with changes before.
    ~Autosave() override;

    void setInterval(int milliseconds);
    [[nodiscard]] int interval() const { return m_timer.interval(); }
    /// Writes now, and waits for it. Nothing to do for a project without changes.
    Result<void> saveNow();
    /// The file that this writes to; whether it is there depends on the project.
    [[nodiscard]] const std::filesystem::path& file() const { return m_file; }

Q_SIGNALS:
    /// The disk is full or the folder cannot be written. Told once until it goes well again.
    void failed(const reflet::Error& error);

private:
    void saveIfDue();
    Result<void> prepareFolder();
    void forget();
    void report(const Result<void>& written);

    ProjectDocument& m_document;
    std::filesystem::path m_file;
    std::unique_ptr<QLockFile> m_lock;
    QTimer m_timer;
    QThreadPool m_thread;
    bool m_changed = false;  ///< since a write was started
    bool m_writing = false;
    bool m_failed = false;
};

}  // namespace reflet
