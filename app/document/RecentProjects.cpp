// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/document/RecentProjects.h"

#include <QSettings>
#include <QStringList>
#include <system_error>

namespace reflet {

namespace fs = std::filesystem;

namespace {

const QString kKey = QStringLiteral("recentProjects");

QString nameOf(const fs::path& file) {
    std::error_code error;
    const fs::path absolute = fs::absolute(file, error);
    return QString::fromStdString((error ? file : absolute.lexically_normal()).string());
}

}  // namespace

RecentProjects::RecentProjects(QSettings& settings, QObject* parent)
    : QObject(parent), m_settings(settings) {}

std::vector<RecentProjects::Entry> RecentProjects::entries() const {
    std::vector<Entry> out;
    for (const QString& name : m_settings.value(kKey).toStringList()) {
        const fs::path file(name.toStdString());
        std::error_code error;
        out.push_back({file, !fs::is_regular_file(file, error)});
    }
    return out;
}

void RecentProjects::add(const fs::path& file) {
    if (file.empty())
        return;
    QStringList files = m_settings.value(kKey).toStringList();
    const QString name = nameOf(file);
    files.removeAll(name);
    files.prepend(name);
    store(files.mid(0, kMost));
}

void RecentProjects::remove(const fs::path& file) {
    QStringList files = m_settings.value(kKey).toStringList();
    if (files.removeAll(nameOf(file)) > 0)
        store(files);
}

void RecentProjects::clear() {
    store({});
}

void RecentProjects::store(const QStringList& files) {
    m_settings.setValue(kKey, files);
    Q_EMIT changed();
}

}  // namespace reflet
