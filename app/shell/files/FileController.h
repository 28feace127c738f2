// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/document/ProjectDocument.h"
#include "app/pipeline/Import.h"
#include "app/shell/Workbench.h"

#include <QObject>
#include <QStringList>
#include <functional>

namespace reflet {

/// Everything between the window and files: opening projects and cities (by menu, by drop, from the
/// command line), saving, and the question about unsaved changes. Nothing fails silently, and
/// nothing is lost by opening something else.
class FileController : public QObject {
    Q_OBJECT
public:
    FileController(Workbench& bench, QObject* parent);

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

    /// The sample as it came, without a change by the user.
    [[nodiscard]] bool showsDemo() const { return m_demo; }
    /// Where the built-in sample lies.
    [[nodiscard]] static QString sampleFolder();

Q_SIGNALS:
    void opened();      ///< another project is shown
    void cityOpened();  ///< one of the user's own
    void saved();
    void vehicleDropped(const QString& path);
    void demoOpened();

private:
    void newProject();
    void chooseFile();
    void chooseCityToAdd();
    void openCities(const QStringList& paths);
    void importCities(const QStringList& paths);
    void addCities(const QStringList& paths);
    void adoptImported(ImportReport report);
    void adoptSample(const std::filesystem::path& project);
    void noteRecent(const QString& path);
    bool writeTo(const QString& path);

    Workbench& m_bench;
    bool m_demo = false;
};

}  // namespace reflet
