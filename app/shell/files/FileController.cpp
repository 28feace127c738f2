// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/files/FileController.h"

#include "app/document/JobRunner.h"
#include "app/document/LiveCity.h"
#include "app/document/RecentProjects.h"
#include "app/pipeline/GroundModels.h"
#include "app/pipeline/VehicleFile.h"
#include "app/pipeline/WriteSample.h"
#include "app/shell/Commands.h"
#include "app/shell/Notices.h"
#include "app/shell/StartOptions.h"
#include "app/shell/files/DroppedFiles.h"
#include "core/project/ProjectFile.h"
#include "importers/FormatRegistry.h"

#include <QDir>
#include <QFileDialog>
#include <QLocale>
#include <QMainWindow>
#include <QMenu>
#include <QMessageBox>
#include <algorithm>

namespace reflet {
namespace {

constexpr std::uint64_t kSampleSeed = 1;
const char* const kImportLane = "import";
constexpr double kFewMetres = 10.0;  // whose decimetres are of interest

std::filesystem::path pathOf(const QString& path) {
    return std::filesystem::path(path.toStdString());
}

std::vector<std::filesystem::path> pathsOf(const QStringList& paths) {
    std::vector<std::filesystem::path> result;
    for (const QString& path : paths)
        result.push_back(pathOf(path));
    return result;
}

}  // namespace

FileController::FileController(Workbench& bench, QMenu* recentMenu, QObject* parent)
    : QObject(parent), m_bench(bench), m_recent(m_settings, this), m_recentMenu(recentMenu) {
    const Commands& commands = *bench.commands;
    auto on = [&](Command command, auto slot) {
        connect(commands.action(command), &QAction::triggered, this, slot);
    };
    on(Command::New, [this] { guardUnsaved([this] { newProject(); }); });
    on(Command::Open, [this] { chooseFile(); });
    on(Command::AddCity, [this] { chooseCityToAdd(); });
    on(Command::OpenSample,
       [this] { guardUnsaved([this] { openSample(QStringLiteral("square")); }); });
    on(Command::Save, [this] { save(); });
    on(Command::SaveAs, [this] { saveAs(); });
    connect(bench.document, &ProjectDocument::projectChanged, this, [this] {
        if (m_bench.document->isDirty())
            m_demo = false;
    });
    connect(&m_recent, &RecentProjects::changed, this, &FileController::showRecent);
    showRecent();
}

void FileController::showRecent() {
    m_recentMenu->clear();
    for (const RecentProjects::Entry& entry : m_recent.entries()) {
        const QString path = QString::fromStdString(entry.file.string());
        const QString name = QFileInfo(path).completeBaseName();
        QAction* action =
            m_recentMenu->addAction(entry.missing ? tr("%1 (not there)").arg(name) : name);
        action->setStatusTip(path);
        action->setToolTip(path);
        action->setEnabled(!entry.missing);
        connect(action, &QAction::triggered, this,
                [this, path] { guardUnsaved([this, path] { openProject(path); }); });
    }
    m_recentMenu->setEnabled(!m_recentMenu->isEmpty());
    if (!m_recentMenu->isEmpty()) {
        m_recentMenu->addSeparator();
        connect(m_recentMenu->addAction(tr("&Forget these")), &QAction::triggered, &m_recent,
                &RecentProjects::clear);
    }
}

void FileController::noteRecent(const QString& path) {
    m_recent.add(pathOf(path));
}

QString FileController::sampleFolder() const {
    StartOptions options;
    options.samples = m_sampleFolder;
    return reflet::sampleFolder(options);
}

void FileController::openPaths(const QStringList& paths) {
    const DroppedFiles files = sortDropped(paths);
    if (!files.projects.isEmpty()) {
        guardUnsaved([this, path = files.projects.front()] { openProject(path); });
    } else if (!files.cities.isEmpty()) {
        openCities(files.cities);
    }
    for (const Diagnostic& remark : files.remarks)
        m_bench.notices->tell(remark.severity, QString::fromStdString(remark.text), {},
                              QString::fromStdString(remark.remedy));
    const bool cityThere = m_demo || !m_bench.document->project().models.empty() ||
                           !files.projects.isEmpty() || !files.cities.isEmpty();
    for (const QString& vehicle : files.vehicles)
        cityThere ? Q_EMIT vehicleDropped(vehicle) : askWhatItIs(vehicle);
    for (const QString& file : files.unclear)
        askWhatItIs(file);
    if (files.unknown.size() == 1 && QFileInfo(files.unknown.front()).isFile()) {
        m_bench.notices->tell(cityFormatOf(pathOf(files.unknown.front())).error());
    } else if (!files.unknown.isEmpty()) {
        m_bench.notices->tell(Error{ErrorCode::Unreadable,
                                    tr("Reflet does not know files of this kind").toStdString(),
                                    files.unknown.join(QStringLiteral(", ")).toStdString(),
                                    tr("Drop a project (.reflet), a city model (%1) or a vehicle "
                                       "(.glb, .gltf).")
                                        .arg(cityFormatNames())
                                        .toStdString()});
    }
}

void FileController::askWhatItIs(const QString& path) {
    const double length = guessGltf(pathOf(path)).length;
    const QLocale locale;
    m_bench.notices->tell(Severity::Info,
                          tr("%1 is %2 m long as it counts: is it a city or a vehicle?")
                              .arg(QFileInfo(path).fileName(),
                                   locale.toString(length, 'f', length < kFewMetres ? 1 : 0)),
                          {{tr("Open it as a city"), [this, path] { openCities({path}); }},
                           {tr("It is a vehicle"), [this, path] { Q_EMIT vehicleDropped(path); }}});
}

bool FileController::openProject(const QString& path) {
    const auto opened = m_bench.document->open(pathOf(path));
    if (!opened) {
        const bool locked = opened.error().code == ErrorCode::Refused;
        std::vector<Notices::Action> actions;
        if (locked && loadProject(pathOf(path))) {
            // Readable, but refused: another window has it.
            actions.emplace_back(tr("Open to look at"), [this, path] {
                const auto readOnly =
                    m_bench.document->open(pathOf(path), ProjectDocument::Access::ReadOnly);
                if (!readOnly) {
                    m_bench.notices->tell(readOnly.error());
                    return;
                }
                noteOpened();
            });
        }
        m_bench.notices->tell(opened.error(), std::move(actions));
        return false;
    }
    noteRecent(path);
    noteOpened();
    return true;
}

void FileController::newProject() {
    m_bench.document->close();
    m_demo = false;
    Q_EMIT opened();
}

void FileController::chooseFile() {
    auto* dialog = new QFileDialog(m_bench.window, tr("Open your city"));
    dialog->setObjectName(QStringLiteral("openDialog"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::ExistingFiles);
    dialog->setNameFilters({tr("Cities and projects (*.reflet %1)").arg(cityPatterns()),
                            tr("Vehicles (*.glb *.gltf)"), tr("All files (*)")});
    connect(dialog, &QFileDialog::filesSelected, this, &FileController::openPaths);
    dialog->open();
}

void FileController::chooseCityToAdd() {
    auto* dialog = new QFileDialog(m_bench.window, tr("Add a city file to this project"));
    dialog->setObjectName(QStringLiteral("addCityDialog"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::ExistingFiles);
    dialog->setNameFilters({tr("City models (%1)").arg(cityPatterns()), tr("All files (*)")});
    connect(dialog, &QFileDialog::filesSelected, this, &FileController::addCities);
    dialog->open();
}

void FileController::openCities(const QStringList& paths) {
    const bool hasCity = !m_demo && !m_bench.document->project().models.empty();
    const bool belongsUnderIt = std::all_of(paths.begin(), paths.end(), [](const QString& path) {
        return useOf(pathOf(path)) != ModelUse::City;
    });
    if (hasCity && belongsUnderIt) {
        addCities(paths);
        return;
    }
    if (m_demo || m_bench.document->project().models.empty()) {
        guardUnsaved([this, paths] { importCities(paths); });
        return;
    }
    m_bench.notices->tell(
        Severity::Info, tr("What shall become of the dropped city?"),
        {{tr("Open it in place of this one"),
          [this, paths] { guardUnsaved([this, paths] { importCities(paths); }); }},
         {tr("Add it to this project"), [this, paths] { addCities(paths); }}});
}

void FileController::importCities(const QStringList& paths) {
    ImportRequest request;
    request.files = pathsOf(paths);
    m_bench.jobs->run<ImportReport>(
        {.title = tr("Reading %1").arg(QFileInfo(paths.front()).fileName()),
         .lane = QLatin1String(kImportLane)},
        [request](const JobContext& job) { return importProject(request, job); }, this,
        [this](Result<ImportReport> report) {
            if (!report) {
                m_bench.notices->tell(report.error());
                return;
            }
            adoptImported(std::move(*report));
        });
}

void FileController::adoptImported(ImportReport report) {
    m_bench.live->setReadCity(report.project, std::move(report.city));
    m_bench.document->adopt(std::move(report.project), {}, ProjectDocument::Condition::Dirty);
    for (const Diagnostic& remark : report.remarks) {
        if (remark.code == "ground-fit")
            continue;  // told with a button when the city is there
        m_bench.notices->tell(remark.severity, QString::fromStdString(remark.text), {},
                              QString::fromStdString(remark.remedy));
    }
    Q_EMIT imported();
    noteOpened();
}

void FileController::addCities(const QStringList& paths) {
    const Project before = m_bench.document->project();
    m_bench.jobs->run<Project>(
        {.title = tr("Reading %1").arg(QFileInfo(paths.front()).fileName()),
         .lane = QLatin1String(kImportLane)},
        [before, files = pathsOf(paths), folder = m_bench.document->folder()](
            const JobContext& job) { return addModels(before, folder, files, job); },
        this,
        [this](Result<Project> after) {
            if (!after) {
                m_bench.notices->tell(after.error());
                return;
            }
            // Only the models: the user may have worked on while the file was read.
            Project project = m_bench.document->project();
            project.models = std::move(after->models);
            m_bench.document->replaceProject(std::move(project), tr("Add a city file"));
            Q_EMIT imported();
        });
}

void FileController::openSample(const QString& name) {
    const std::filesystem::path folder = pathOf(sampleFolder());
    const std::filesystem::path project = folder / (name.toStdString() + ".reflet");
    std::error_code error;
    if (std::filesystem::is_regular_file(project, error)) {
        adoptSample(project);
        return;
    }
    m_bench.jobs->run<std::filesystem::path>(
        {.title = tr("Building the sample town"), .lane = QLatin1String(kImportLane)},
        [name = name.toStdString(), folder](const JobContext&) {
            return writeSample(name, kSampleSeed, folder);
        },
        this,
        [this](Result<std::filesystem::path> written) {
            if (!written) {
                m_bench.notices->tell(written.error());
                return;
            }
            adoptSample(*written);
        });
}

void FileController::adoptSample(const std::filesystem::path& file) {
    auto project = loadProject(file);
    if (!project) {
        m_bench.notices->tell(project.error());
        return;
    }
    m_bench.document->adopt(std::move(*project), {}, ProjectDocument::Condition::Clean, file);
    m_demo = true;
    Q_EMIT opened();
    Q_EMIT demoOpened();
}

void FileController::noteOpened() {
    m_demo = false;
    Q_EMIT opened();
    Q_EMIT cityOpened();
}

void FileController::guardUnsaved(const std::function<void()>& then) {
    if (!m_bench.document->isDirty()) {
        then();
        return;
    }
    auto* question = new QMessageBox(
        QMessageBox::Question, tr("Unsaved changes"),
        tr("Shall the changes to “%1” be saved?")
            .arg(QString::fromStdString(m_bench.document->project().name)),
        QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, m_bench.window);
    question->setObjectName(QStringLiteral("unsavedQuestion"));
    question->setAttribute(Qt::WA_DeleteOnClose);
    question->setDefaultButton(QMessageBox::Save);
    connect(question, &QMessageBox::finished, this, [this, then](int answer) {
        if (answer == QMessageBox::Save) {
            save(then);
        } else if (answer == QMessageBox::Discard) {
            then();
        }
    });
    question->open();
}

void FileController::save(const std::function<void()>& then) {
    ProjectDocument& document = *m_bench.document;
    if (document.file().empty() || document.isReadOnly()) {
        saveAs(then);
        return;
    }
    auto written = [this, then, file = QString::fromStdString(document.file().string())](
                       const Result<void>& result) {
        if (!result) {
            m_bench.notices->tell(result.error(),
                                  {{tr("Save as…"), [this, then] { saveAs(then); }}});
            return;
        }
        noteRecent(file);
        Q_EMIT saved();
        if (then)
            then();
    };
    if (then) {
        written(document.save());  // what follows may close the project
    } else {
        document.saveInBackground(*m_bench.jobs, written);
    }
}

void FileController::saveAs(const std::function<void()>& then) {
    auto* dialog = new QFileDialog(m_bench.window, tr("Save the project"));
    dialog->setObjectName(QStringLiteral("saveDialog"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setDefaultSuffix(QStringLiteral("reflet"));
    dialog->setNameFilter(tr("Reflet projects (*.reflet)"));
    const auto& document = *m_bench.document;
    dialog->selectFile(document.file().empty() ? QString::fromStdString(document.project().name)
                                               : QString::fromStdString(document.file().string()));
    connect(dialog, &QFileDialog::fileSelected, this, [this, then](const QString& path) {
        if (writeTo(path) && then)
            then();
    });
    dialog->open();
}

bool FileController::writeTo(const QString& path) {
    if (const auto saved = m_bench.document->saveAs(pathOf(path)); !saved) {
        m_bench.notices->tell(saved.error());
        return false;
    }
    m_demo = false;
    noteRecent(path);
    Q_EMIT saved();
    return true;
}

}  // namespace reflet
