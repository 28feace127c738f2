// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/pictures/PictureController.h"

#include "app/document/LiveCity.h"
#include "app/document/ProjectDocument.h"
#include "app/pipeline/Film.h"
#include "app/pipeline/GlRender.h"
#include "app/pipeline/Render.h"
#include "app/shell/Commands.h"
#include "app/shell/Notices.h"
#include "app/shell/pictures/Snapshot.h"
#include "app/shell/scene/CompareController.h"
#include "core/io/ImageFile.h"
#include "core/io/VideoWriter.h"
#include "widgets/inspector/Inspector.h"
#include "widgets/viewport/Viewport.h"

#include <QDesktopServices>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QInputDialog>
#include <QMainWindow>
#include <QMenu>
#include <QStandardPaths>
#include <QUrl>

namespace reflet {
namespace {

const char* const kLane = "pictures";

/// The point given in the plan's axes, turned about the vertical so that east becomes `heading`.
glm::dvec3 turnedTo(const glm::dvec2& heading, const glm::dvec3& point) {
    return {heading.x * point.x - heading.y * point.y, heading.y * point.x + heading.x * point.y,
            point.z};
}

/// A camera that goes along with a vehicle as it does at `start`.
std::function<Camera(double)> companion(std::shared_ptr<const Traffic> traffic, std::size_t vehicle,
                                        double start, const Camera& camera) {
    const PlacedReflector then = traffic->at(vehicle, start);
    const glm::dvec2 back(then.heading().x, -then.heading().y);
    const Camera beside{turnedTo(back, camera.position - then.middle()),
                        turnedTo(back, camera.target - then.middle()), camera.verticalFov};
    return [traffic = std::move(traffic), vehicle, beside](double seconds) {
        const PlacedReflector now = traffic->at(vehicle, seconds);
        const glm::dvec2 heading(now.heading());
        return Camera{now.middle() + turnedTo(heading, beside.position),
                      now.middle() + turnedTo(heading, beside.target), beside.verticalFov};
    };
}

}  // namespace

PictureController::PictureController(Workbench& bench, const CompareController& compare,
                                     QMenu* viewsMenu, QObject* parent)
    : QObject(parent), m_bench(bench), m_compare(compare), m_views(viewsMenu) {
    auto on = [this](Command command, auto slot) {
        connect(m_bench.commands->action(command), &QAction::triggered, this, slot);
    };
    on(Command::SavePicture, [this] { askForPicture(); });
    on(Command::SaveFilm, [this] { askForFilm(); });
    on(Command::SaveView, [this] { keepView(); });
    connect(bench.document, &ProjectDocument::projectChanged, this, [this](ProjectChanges what) {
        if (what & ProjectChange::Views)
            showViews();
    });
    connect(bench.inspector, &Inspector::viewShown, this, &PictureController::goToView);
    connect(bench.inspector, &Inspector::viewFromCameraRequested, this,
            &PictureController::storeCamera);
    showViews();
}

// ---- pictures ----

void PictureController::askForPicture() {
    auto* dialog = new PictureDialog(PictureDialog::For::Picture, m_bench.viewport->size(), {},
                                     m_bench.window);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QDialog::accepted, this, [this, dialog] {
        const PictureChoice choice = dialog->choice();
        askForPath(tr("Save picture"), tr("Pictures (*.png)"), QStringLiteral("png"),
                   [this, choice](const QString& path) { savePicture(choice, path); });
    });
    dialog->open();
}

void PictureController::askForPath(const QString& title, const QString& filter,
                                   const QString& suffix,
                                   const std::function<void(const QString&)>& then) {
    auto* dialog = new QFileDialog(m_bench.window, title);
    dialog->setObjectName(QStringLiteral("pictureFileDialog"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setNameFilter(filter);
    dialog->setDefaultSuffix(suffix);
    dialog->setDirectory(QStandardPaths::writableLocation(QStandardPaths::PicturesLocation));
    dialog->selectFile(QString::fromStdString(m_bench.document->project().name));
    connect(dialog, &QFileDialog::fileSelected, this, then);
    dialog->open();
}

void PictureController::savePicture(const PictureChoice& choice, const QString& path) {
    Snapshot snapshot = takeSnapshot(m_bench, m_compare, choice.size);
    if (!snapshot.city) {
        return;
    }
    m_bench.jobs->run<bool>(
        {.title = tr("Drawing the picture"), .lane = QLatin1String(kLane), .replace = false},
        [snapshot = std::move(snapshot), best = choice.best,
         file = path.toStdString()](const JobContext& job) -> Result<bool> {
            const auto image = best ? drawBest(snapshot, job) : drawQuickly(snapshot, job);
            if (!image)
                return tl::unexpected(image.error());
            if (auto written = writePng(*image, file); !written)
                return tl::unexpected(written.error());
            return true;
        },
        this,
        [this, path](const Result<bool>& saved) {
            if (saved) {
                tellSaved(path);
            } else {
                m_bench.notices->tell(saved.error());
            }
        });
}

void PictureController::tellSaved(const QString& path) {
    const QFileInfo file(path);
    m_bench.notices->tell(
        Severity::Info, tr("Saved: %1").arg(file.fileName()),
        {{tr("Show in folder"),
          [folder = file.absolutePath()] {
              QDesktopServices::openUrl(QUrl::fromLocalFile(folder));
          }},
         {tr("Open"), [path] { QDesktopServices::openUrl(QUrl::fromLocalFile(path)); }}});
    Q_EMIT savedSomething();
}

// ---- films ----

void PictureController::askForFilm() {
    if (m_bench.document->project().reflectors.empty()) {
        m_bench.notices->tell(Severity::Info, tr("A film needs a vehicle that drives."), {},
                              tr("Draw a route and press “Make it reflect”."));
        return;
    }
    QStringList remarks;
    if (!isFfmpegThere()) {
        remarks << tr(
            "The program ffmpeg is not there: numbered pictures are written into a "
            "folder in place of a film. Install the package ffmpeg for an MP4.");
    }
    if (m_compare.left() == Method::RayTrace || m_compare.right() == Method::RayTrace) {
        remarks << tr(
            "The reference, ray traced, is of a vehicle that holds still: the film shows "
            "Reflet in its place.");
    }
    const QString remark = remarks.join(QLatin1Char('\n'));
    auto* dialog = new PictureDialog(PictureDialog::For::Film, m_bench.viewport->size(), remark,
                                     m_bench.window);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QDialog::accepted, this, [this, dialog] {
        const PictureChoice choice = dialog->choice();
        askForPath(tr("Save film"), tr("Films (*.mp4)"), QStringLiteral("mp4"),
                   [this, choice](const QString& path) { saveFilm(choice, path); });
    });
    dialog->open();
}

FilmOptions PictureController::filmOptions(const PictureChoice& choice) const {
    const FrameRequest frame = takeSnapshot(m_bench, m_compare, choice.size).frame;
    FilmOptions options;
    options.width = frame.width;
    options.height = frame.height;
    options.seconds = choice.seconds;
    // One picture cannot be ray traced as fast as the vehicle drives.
    const auto drivable = [](Method method) {
        return method == Method::RayTrace ? Method::Mem : method;
    };
    options.method = drivable(frame.method);
    if (frame.right && drivable(*frame.right) != options.method) {
        options.right = drivable(*frame.right);
    }
    options.wipe = frame.wipe;
    if (choice.pavement) {
        const auto selected = m_bench.document->selection()->ids(ProjectItem::Kind::Reflector);
        options.reflector = selected.empty() ? std::string() : selected.back();
        return options;
    }
    options.start = m_bench.viewport->time();
    options.camera = [camera = frame.camera](double) { return camera; };
    const auto traffic = m_bench.live->traffic();
    if (const auto followed = traffic->find(m_bench.viewport->followed())) {
        options.camera = companion(traffic, *followed, options.start, frame.camera);
    }
    return options;
}

void PictureController::saveFilm(const PictureChoice& choice, const QString& path) {
    const LiveCity& live = *m_bench.live;
    const auto city = live.prepared();
    const auto traffic = live.traffic();
    if (!city || !traffic) {
        return;
    }
    const FilmOptions options = filmOptions(choice);
    m_bench.jobs->run<FilmReport>(
        {.title = tr("Filming"), .lane = QLatin1String(kLane), .replace = false},
        [city, rems = live.rems(), traffic, options,
         file = path.toStdString()](const JobContext& job) {
            auto film = renderFilm(*city, rems, *traffic, options, file, job);
            releaseGlStage();
            return film;
        },
        this,
        [this](const Result<FilmReport>& saved) {
            if (saved) {
                tellSaved(QString::fromStdString(saved->file.string()));
            } else {
                m_bench.notices->tell(saved.error());
            }
        });
}

// ---- views ----

void PictureController::keepView() {
    const auto& views = m_bench.document->project().views;
    auto* dialog = new QInputDialog(m_bench.window);
    dialog->setObjectName(QStringLiteral("viewNameDialog"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setWindowTitle(tr("Keep this view"));
    dialog->setLabelText(tr("Its name"));
    dialog->setTextValue(tr("view %1").arg(views.size() + 1));
    connect(dialog, &QInputDialog::textValueSelected, this, [this](const QString& name) {
        if (!name.trimmed().isEmpty()) {
            storeCamera(name.trimmed());
        }
    });
    dialog->open();
}

void PictureController::storeCamera(const QString& name) {
    const Project& project = m_bench.document->project();
    const Camera camera = m_bench.viewport->camera();
    View view;
    for (const View& present : project.views) {
        if (present.name == name.toStdString()) {
            view = present;  // keeps its caption
        }
    }
    view.name = name.toStdString();
    view.position = camera.position + project.frame.origin;
    view.target = camera.target + project.frame.origin;
    view.verticalFov = camera.verticalFov;
    view.time = m_bench.viewport->time();
    m_bench.document->setView(view);
}

void PictureController::showViews() {
    m_views->clear();
    for (const View& view : m_bench.document->project().views) {
        const QString name = QString::fromStdString(view.name);
        QAction* action =
            m_views->addAction(view.caption.empty() ? name : QString::fromStdString(view.caption));
        connect(action, &QAction::triggered, this, [this, name] { goToView(name); });
    }
    m_views->setEnabled(!m_views->isEmpty());
}

void PictureController::goToView(const QString& name) {
    const Project& project = m_bench.document->project();
    for (const View& view : project.views) {
        if (view.name == name.toStdString()) {
            m_bench.viewport->setPlaying(false);
            m_bench.viewport->follow({});
            m_bench.viewport->setTime(view.time);
            m_bench.viewport->setCamera(cameraOf(view, project.frame), true);
        }
    }
}

}  // namespace reflet
