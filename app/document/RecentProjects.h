// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QObject>
#include <filesystem>
#include <vector>

class QSettings;

namespace reflet {

/// The projects that were opened or saved last, kept in the user's settings.
class RecentProjects : public QObject {
    Q_OBJECT
public:
    static constexpr int kMost = 12;

    struct Entry {
        std::filesystem::path file;
        bool missing = false;  ///< not there just now: a disk that is not plugged in comes back

        friend bool operator==(const Entry&, const Entry&) = default;
    };

    /// `settings` outlives this.
    explicit RecentProjects(QSettings& settings, QObject* parent = nullptr);

    /// The newest first.
    [[nodiscard]] std::vector<Entry> entries() const;
    /// Puts a file first.
    void add(const std::filesystem::path& file);
    void remove(const std::filesystem::path& file);
    void clear();

Q_SIGNALS:
    void changed();

private:
    void store(const QStringList& files);

    QSettings& m_settings;
};

}  // namespace reflet
