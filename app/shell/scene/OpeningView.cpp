// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/scene/OpeningView.h"

#include "app/document/JobRunner.h"
#include "app/document/LiveCity.h"
#include "app/document/ProjectDocument.h"
#include "app/pipeline/Render.h"
#include "core/base/ContentHash.h"
#include "core/heightfield/BuiltBounds.h"
#include "core/heightfield/Heightfield.h"
#include "widgets/viewport/Viewport.h"

#include <QLocale>
#include <QMainWindow>
#include <QStatusBar>
#include <QStringList>
#include <algorithm>
#include <cmath>

namespace reflet {
namespace {

constexpr int kKeptCameras = 50;
constexpr double kMoved = 0.01;        // metres: less comes from rounding and from the ground
constexpr double kNarrowest = 0.02;    // radians
constexpr double kWidest = 3.0;        // radians
constexpr double kScattered = 2500.0;  // metres: of a wider city one would see no house
constexpr double kBusiest = 800.0;     // metres: what is shown of it
constexpr int kTold = 20'000;          // milliseconds
constexpr int kNumbers = 8;            // of a camera in the settings
const auto kOrder = QStringLiteral("cameras/order");

QString keyOf(const QString& file) {
    return QString::fromStdString(ContentHash().add(file.toStdString()).hex());
}

QString toText(const View& view) {
    QStringList numbers;
    for (const double number : {view.position.x, view.position.y, view.position.z, view.target.x,
                                view.target.y, view.target.z, view.verticalFov, view.time}) {
        numbers << QString::number(number, 'g', QLocale::FloatingPointShortest);
    }
    return numbers.join(QLatin1Char(' '));
}

/// nullopt for what no camera can be: the settings' file may have been edited.
std::optional<View> fromText(const QString& text) {
    const QStringList words = text.split(QLatin1Char(' '));
    if (words.size() != kNumbers) {
        return std::nullopt;
    }
    double numbers[kNumbers];
    for (int i = 0; i < kNumbers; ++i) {
        bool sound = false;
        numbers[i] = words[i].toDouble(&sound);
        if (!sound || !std::isfinite(numbers[i])) {
            return std::nullopt;
        }
    }
    View view;
    view.position = {numbers[0], numbers[1], numbers[2]};
    view.target = {numbers[3], numbers[4], numbers[5]};
    view.verticalFov = numbers[6];
    view.time = numbers[7];
    const bool sound = view.position != view.target && view.verticalFov > kNarrowest &&
                       view.verticalFov < kWidest && view.time >= 0.0;
    return sound ? std::optional(view) : std::nullopt;
}

}  // namespace

OpeningView::OpeningView(Workbench& bench, QObject* parent) : QObject(parent), m_bench(bench) {
    connect(bench.live, &LiveCity::cityChanged, this, &OpeningView::cityCame);
    connect(bench.document, &ProjectDocument::projectChanged, this, [this] {
        // Of a project that comes in its place, the origin counts from projectOpened() on.
        if (m_file == QString::fromStdString(m_bench.document->file().string())) {
            m_origin = m_bench.document->project().frame.origin;
        }
    });
    connect(bench.live, &LiveCity::trafficChanged, this, [this] {
        if (m_waiting == Waiting::ForVehicles) {
            lookFromThePavement();
        }
    });
}

void OpeningView::projectOpened() {
    remember();
    const auto file = m_bench.document->file();
    m_file = QString::fromStdString(file.string());
    m_origin = m_bench.document->project().frame.origin;
    m_shown.reset();
    m_waiting = Waiting::ForCity;
    if (const auto view = known()) {
        show(*view, false);
    }
    if (m_bench.live->city() && !m_bench.live->loading()) {
        cityCame();
    }
}

std::optional<View> OpeningView::known() const {
    if (const auto last = remembered()) {
        return last;
    }
    const Project& project = m_bench.document->project();
    return project.views.empty() ? std::nullopt : std::optional(project.views.front());
}

std::optional<View> OpeningView::remembered() const {
    if (m_file.isEmpty()) {
        return std::nullopt;
    }
    return fromText(m_settings.value(QStringLiteral("cameras/") + keyOf(m_file)).toString());
}

void OpeningView::remember() {
    if (m_file.isEmpty() || !m_shown) {
        return;
    }
    const Camera camera = m_bench.viewport->camera();
    View view;
    view.position = camera.position + m_origin;
    view.target = camera.target + m_origin;
    view.verticalFov = camera.verticalFov;
    view.time = m_bench.viewport->time();
    if (glm::distance(view.position, m_shown->position) < kMoved &&
        glm::distance(view.target, m_shown->target) < kMoved) {
        return;
    }
    const QString key = keyOf(m_file);
    QStringList order = m_settings.value(kOrder).toStringList();
    order.removeAll(key);
    order.prepend(key);
    while (order.size() > kKeptCameras) {
        m_settings.remove(QStringLiteral("cameras/") + order.takeLast());
    }
    m_settings.setValue(kOrder, order);
    m_settings.setValue(QStringLiteral("cameras/") + key, toText(view));
}

void OpeningView::cityCame() {
    if (m_waiting != Waiting::ForCity || !m_bench.live->city()) {
        return;
    }
    m_waiting = Waiting::No;
    if (const auto view = known()) {
        // Again: without a city there was no ground to stand on.
        show(*view, false);
        return;
    }
    // At once: the first picture shows the city, not the way there.
    m_bench.viewport->frameAll(false);
    frameBusiest();
    if (!m_bench.document->project().reflectors.empty()) {
        m_waiting = Waiting::ForVehicles;
        if (m_bench.live->traffic()->size() > 0) {
            lookFromThePavement();
        }
    }
}

void OpeningView::frameBusiest() {
    const auto field = m_bench.live->city()->heightfield;
    const glm::dvec3 size = field ? builtBounds(*field).size() : glm::dvec3(0.0);
    if (std::max(size.x, size.y) < kScattered) {
        return;
    }
    m_bench.viewport->frameBox(busiestBounds(*field, kBusiest), false);
    m_bench.window->statusBar()->showMessage(
        tr("The city is %1 km wide: this is its most built-up part. Home shows all of it.")
            .arg(std::max(size.x, size.y) / 1000.0, 0, 'f', 1),
        kTold);
}

void OpeningView::lookFromThePavement() {
    const auto city = m_bench.live->prepared();
    if (!city || m_bench.live->traffic()->size() == 0) {
        return;
    }
    m_waiting = Waiting::No;
    m_bench.jobs->run<std::vector<View>>(
        {{}, QStringLiteral("opening view"), true, false},
        [city, traffic = m_bench.live->traffic()](const JobContext&) -> Result<std::vector<View>> {
            return viewsOf(*city, *traffic);
        },
        this,
        [this, file = m_file](Result<std::vector<View>> views) {
            if (views && !views->empty() && file == m_file) {
                show(views->front(), true);
            }
        });
}

void OpeningView::show(const View& view, bool animate) {
    const glm::dvec3 origin = m_bench.document->project().frame.origin;
    m_bench.viewport->setCamera(cameraOf(view, m_bench.document->project().frame), animate);
    m_bench.viewport->setTime(view.time);
    m_shown = view;
    if (!animate) {
        // The ground may have raised it.
        m_shown->position = m_bench.viewport->camera().position + origin;
        m_shown->target = m_bench.viewport->camera().target + origin;
    }
}

}  // namespace reflet
