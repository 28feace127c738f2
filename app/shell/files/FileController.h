// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/document/ProjectDocument.h"
#include "app/document/RecentProjects.h"
#include "app/pipeline/Import.h"
#include "app/shell/Workbench.h"

#include <QObject>
#include <QSettings>
#include <QStringList>
#include <functional>

class QMenu;

namespace reflet {

/// Everything between the window and files: opening projects and cities (by menu, by drop, from the
/// command line), saving, and the question about unsaved changes. Nothing fails silently, and
/// nothing is lost by opening something else.
class FileController : public QObject {
    Q_OBJECT
public:
    /// recentMenu: filled with the projects that were opened last.
    FileController(Workbench& bench, QMenu* recentMenu, QObject* parent);

    /// Projects, city models, vehicles and folders, as dropped or named on the command line.
    void openPaths(const QStringList& paths);
    /// Opens a project file at once; false when it could not be (which has been told).
    bool openProject(const QString& path);
    /// The built-in sample, as a project without a name: what is changed in it asks for *Save as*.
    void openSample(const QString& name);
    /// Calls `then` when nothing would be lost: at once, or after the user has saved or let go.
    void guardUnsaved(const std::function<void()>& then);
    /// Saves; asks for a name where there is none. `then` is called only after it was saved.
    void save(const std::function<void()>& then = {});
    void saveAs(const std::function<void()>& then = {});

    /// Another project came into the document by other ways (a recovery).
    void noteOpened();

    /// The sample as it came, without a change by the user.
    [[nodiscard]] bool showsDemo() const { return m_demo; }
    /// Where the built-in samples lie; the user's data folder unless set.
    [[nodiscard]] QString sampleFolder() const;
    void setSampleFolder(const QString& folder) { m_sampleFolder = folder; }

Q_SIGNALS:
    void opened();      ///< another project is shown
    void cityOpened();  ///< one of the user's own
    void imported();    ///< city files were read, and are in the document
    void saved();
    void vehicleDropped(const QString& path);
    void demoOpened();

private:
    void newProject();
    void chooseFile();
    void chooseCityToAdd();
    void openCities(const QStringList& paths);
    void askWhatItIs(const QString& path);
    void importCities(const QStringList& paths);
    void addCities(const QStringList& paths);
    void adoptImported(ImportReport report);
    void adoptSample(const std::filesystem::path& project);
    void showRecent();
    void noteRecent(const QString& path);
    bool writeTo(const QString& path);

    Workbench& m_bench;
    QSettings m_settings;
    RecentProjects m_recent;
    QMenu* m_recentMenu;
    QString m_sampleFolder;
    bool m_demo = false;
};

}  // namespace reflet
