// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/document/files/ProjectLock.h"

#include <QDateTime>
#include <QFile>
#include <QFileInfo>
#include <QString>
#include <QSysInfo>

namespace reflet {

namespace {

/// A window that has been open for days still has its file: only a dead owner loses the lock.
constexpr int kNeverStale = 0;

/// A mark that names nobody was left by a process that died while it wrote it.
bool isOld(const QString& lockFile) {
    constexpr qint64 kWritingSeconds = 10;
    const QDateTime written = QFileInfo(lockFile).lastModified();
    return written.secsTo(QDateTime::currentDateTime()) > kWritingSeconds;
}

tl::unexpected<Error> heldBy(const QLockFile& lock, const std::filesystem::path& projectFile,
                             bool here, const QString& host) {
    qint64 process = 0;
    QString ignored;
    QString program;
    static_cast<void>(lock.getLockInfo(&process, &ignored, &program));
    const std::string who = here ? " (process " + std::to_string(process) + ")"
                                 : " on the computer " + host.toStdString();
    return fail(ErrorCode::Refused, "the project is open in another window" + who,
                projectFile.string(),
                here ? "Go on in that window, or open the project here for reading only."
                     : "Open it for reading only; if that window is gone for good, take it over.");
}

}  // namespace

ProjectLock::ProjectLock(std::filesystem::path projectFile, const QString& lockFile)
    : m_projectFile(std::move(projectFile)), m_lock(lockFile) {
    m_lock.setStaleLockTime(kNeverStale);
}

Result<std::unique_ptr<ProjectLock>> ProjectLock::acquire(const std::filesystem::path& projectFile,
                                                          bool takeOver) {
    const QString name = QString::fromStdString(projectFile.string() + ".lock");
    std::unique_ptr<ProjectLock> out(new ProjectLock(projectFile, name));
    if (out->m_lock.tryLock(0))
        return out;
    if (out->m_lock.error() != QLockFile::LockFailedError)
        return out;  // nobody can write here, so nobody can save over anybody
    qint64 process = 0;
    QString host;
    QString program;
    const bool told = out->m_lock.getLockInfo(&process, &host, &program);
    const bool here = told && (host.isEmpty() || host == QSysInfo::machineHostName());
    const bool mayBreak = told ? takeOver && !here : takeOver || isOld(name);
    if (mayBreak && QFile::remove(name) && out->m_lock.tryLock(0))
        return out;
    return heldBy(out->m_lock, projectFile, here, told ? host : QStringLiteral("?"));
}

}  // namespace reflet
