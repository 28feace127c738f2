// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/document/LiveCity.h"

#include "app/pipeline/Render.h"
#include "core/base/BackgroundWork.h"

#include <algorithm>
#include <limits>

namespace reflet {

namespace {

constexpr int kSettleMilliseconds = 250;  ///< without changes, before maps are baked
constexpr int kSettleLightMilliseconds = 400;
/// For the first picture of a city, which has all cores until then.
constexpr int kHeldAtMostMilliseconds = 2500;

const QString kCityLane = QStringLiteral("city");
const QString kTrafficLane = QStringLiteral("traffic");
const QString kAmbientLane = QStringLiteral("ambient");
const QString kFiguresLane = QStringLiteral("figures");

/// A city, and what is drawn of it, made in one job.
struct Loaded {
    std::shared_ptr<const PreparedCity> city;
    std::shared_ptr<const DrawnCity> drawn;
};

Result<Loaded> loadedOf(Result<PreparedCity> prepared, const Loaded& before,
                        const JobContext& job) {
    if (!prepared)
        return tl::unexpected(prepared.error());
    Loaded loaded;
    loaded.city = std::make_shared<const PreparedCity>(std::move(*prepared));
    loaded.drawn = before.drawn;
    if (!before.city || !before.city->sharesCityWith(*loaded.city)) {
        auto drawn = loaded.city->drawn(job);
        if (!drawn)
            return tl::unexpected(drawn.error());
        loaded.drawn = std::move(*drawn);
    }
    return loaded;
}

}  // namespace

LiveCity::LiveCity(ProjectDocument& document, JobRunner& jobs, QObject* parent)
    : QObject(parent),
      m_document(document),
      m_jobs(jobs),
      m_traffic(std::make_shared<Traffic>()),
      m_vehicles(std::make_shared<VehicleShelf>()) {
    m_settle.setSingleShot(true);
    m_settle.setInterval(kSettleMilliseconds);
    m_settleLight.setSingleShot(true);
    m_settleLight.setInterval(kSettleLightMilliseconds);
    m_held.setSingleShot(true);
    m_held.setInterval(kHeldAtMostMilliseconds);
    connect(&m_held, &QTimer::timeout, this, &LiveCity::letWorkGoOn);
    connect(&m_settle, &QTimer::timeout, this, &LiveCity::pump);
    connect(&m_settleLight, &QTimer::timeout, this, &LiveCity::gatherAmbientLight);
    connect(&document, &ProjectDocument::projectChanged, this, [this](ProjectChanges what) {
        if (what & (ProjectChange::Models | ProjectChange::Heightfield))
            forgetFigures();
        follow(what);
    });
    connect(&document, &ProjectDocument::fileChanged, this,
            [this] { follow(ProjectChange::Models); });
    follow(ProjectChange::All);
}

LiveCity::~LiveCity() = default;

std::filesystem::path LiveCity::projectFile() const {
    return m_document.dataFile();
}

// ---- the project ----

void LiveCity::follow(ProjectChanges what) {
    m_stopped = false;
    using Change = ProjectChange;
    const bool geometry = what.testFlag(Change::Models) || what.testFlag(Change::Heightfield);
    if (geometry) {
        load();
    } else {
        refreshProject();
    }
    if (what & (Change::Models | Change::Routes | Change::Reflectors | Change::Vehicles))
        refreshTraffic();
    if (what & (Change::Models | Change::Light))
        refreshLighting();
    if (!geometry && (what & (Change::Probes | Change::Bake | Change::Light)))
        matchProbes();
}

void LiveCity::reload() {
    m_jobs.cancelLane(kCityLane);
    discard(m_prepared);
    m_prepared = nullptr;
    m_loading = false;
    m_stopped = false;
    load();
}

/// What was or is being measured, in a city that is no more.
void LiveCity::forgetFigures() {
    m_jobs.cancelLane(kFiguresLane);
    if (!m_figures)
        return;
    m_figures.reset();
    Q_EMIT figuresChanged();
}

void LiveCity::forget() {
    m_jobs.cancelLane(kFiguresLane);
    m_jobs.cancelLane(kCityLane);
    m_jobs.cancelLane(kAmbientLane);
    stopBaking();
    m_records.clear();
    discard(std::exchange(m_prepared, nullptr));
    discard(std::exchange(m_drawn, nullptr));
    discard(std::exchange(m_ambient, nullptr));
    m_rems = {};
    m_figures.reset();
    m_loading = false;
    Q_EMIT cityChanged();
    Q_EMIT ambientChanged();
    Q_EMIT remsChanged();
    Q_EMIT probeStatesChanged();
    Q_EMIT figuresChanged();
    Q_EMIT loadingChanged();
}

void LiveCity::load() {
    if (m_document.project().models.empty()) {
        forget();
        return;
    }
    // Opening a file changes both the project and its file: the city is not read twice for that.
    const auto file = projectFile();
    const Project& project = m_document.project();
    if (m_loading && m_jobs.isBusy(kCityLane) && file == m_loadingFile &&
        project.heightfield == m_loadingProject.heightfield &&
        readsAlike(project, file.parent_path(), m_loadingProject, file.parent_path())) {
        return;
    }
    m_loadingFile = file;
    m_loadingProject = project;
    stopBaking();
    m_loading = true;
    Q_EMIT loadingChanged();
    const Loaded before{m_prepared, m_drawn};
    m_jobs.run<Loaded>(
        {tr("Opening the city"), kCityLane},
        [before, ahead = std::exchange(m_ahead, nullptr), read = std::exchange(m_read, {}), project,
         file](const JobContext& job) {
            const auto folder = file.parent_path();
            if (read && readsAlike(read->project, folder, project, folder)) {
                return loadedOf(PreparedCity::prepare(project, file, job, {read->city, true, true}),
                                {}, job);
            }
            Loaded known = before;
            if (!known.city && ahead) {
                const HeadStart::City first = ahead->city(job);
                known = {first.prepared, first.drawn};
            }
            return loadedOf(known.city
                                ? known.city->updated(project, file, job)
                                : PreparedCity::prepare(project, file, job, {nullptr, true, true}),
                            known, job);
        },
        this,
        [this](Result<Loaded> loaded) {
            if (!loaded && loaded.error().code == ErrorCode::Cancelled)
                return;
            m_loading = false;
            if (loaded) {
                publish(loaded->city, loaded->drawn);
            } else {
                forget();
                Q_EMIT problem(loaded.error());
            }
            Q_EMIT loadingChanged();
        });
}

void LiveCity::publish(std::shared_ptr<const PreparedCity> city,
                       std::shared_ptr<const DrawnCity> drawn) {
    discard(std::exchange(m_prepared, std::move(city)));
    const bool otherCity = m_drawn != drawn;
    discard(std::exchange(m_drawn, std::move(drawn)));
    refreshProject();  // what changed while it was loading
    if (otherCity)
        Q_EMIT cityChanged();
    refreshLighting();
    if (otherCity) {
        const auto made = m_prepared->remarks();
        for (const auto& diagnostic : made)
            Q_EMIT remark(diagnostic);
    }
    m_settleLight.start();
    matchProbes();
    pump();
}

void LiveCity::holdWork() {
    m_held.start();
}

void LiveCity::letWorkGoOn() {
    m_held.stop();
    pump();
    m_settleLight.start();
}

void LiveCity::refreshProject() {
    if (!m_prepared || m_loading)
        return;
    // Models and heightfield are the same: nothing long happens here.
    auto updated = m_prepared->updated(m_document.project(), projectFile(), {});
    if (updated)
        discard(
            std::exchange(m_prepared, std::make_shared<const PreparedCity>(std::move(*updated))));
}

void LiveCity::refreshLighting() {
    if (!m_prepared)
        return;
    if (m_prepared->lighting() == m_lighting)
        return;
    m_lighting = m_prepared->lighting();
    Q_EMIT lightingChanged();
    m_settleLight.start();
}

void LiveCity::gatherAmbientLight() {
    if (!m_prepared || m_held.isActive())
        return;  // letWorkGoOn() asks again
    m_jobs.run<std::shared_ptr<const AmbientVolume>>(
        {tr("Gathering soft light"), kAmbientLane},
        [city = m_prepared](const JobContext& job) {
            return resultInBackground([&] { return city->ambient(job); });
        },
        this,
        [this](Result<std::shared_ptr<const AmbientVolume>> volume) {
            if (!volume) {
                if (volume.error().code != ErrorCode::Cancelled)
                    Q_EMIT problem(volume.error());
                return;
            }
            discard(std::exchange(m_ambient, *volume));
            Q_EMIT ambientChanged();
        });
}

void LiveCity::refreshTraffic() {
    m_jobs.run<std::shared_ptr<const Traffic>>(
        {tr("Reading vehicles"), kTrafficLane, true, false},
        [project = m_document.project(), file = projectFile(),
         shelf = m_vehicles](const JobContext&) -> Result<std::shared_ptr<const Traffic>> {
            auto traffic = trafficOf(project, file.parent_path(), *shelf, cacheFolder(file));
            if (!traffic)
                return tl::unexpected(traffic.error());
            return std::make_shared<const Traffic>(std::move(*traffic));
        },
        this,
        [this](Result<std::shared_ptr<const Traffic>> traffic) {
            if (!traffic) {
                if (traffic.error().code != ErrorCode::Cancelled)
                    Q_EMIT problem(traffic.error());
                return;
            }
            m_traffic = *traffic;
            Q_EMIT trafficChanged();
        });
}

/// Big data are destroyed on a thread of their own.
void LiveCity::discard(std::shared_ptr<const void> data) {
    if (data == nullptr)
        return;
    const auto holder = std::make_shared<std::shared_ptr<const void>>(std::move(data));
    m_jobs.run<int>({{}, {}, false, false},
                    [holder](const JobContext&) -> Result<int> {
                        holder->reset();
                        return 0;
                    },
                    nullptr, {});
}

// ---- what is asked ----

std::optional<double> LiveCity::groundHeight(double x, double y) const {
    if (!m_prepared)
        return std::nullopt;
    return m_prepared->groundHeight(x, y);
}

Camera LiveCity::streetCamera(std::size_t reflector, double seconds) const {
    if (!m_prepared || reflector >= m_traffic->size())
        return {};
    return reflet::streetCamera(*m_prepared, m_traffic->at(reflector, seconds));
}

std::vector<FileReport> LiveCity::reports() const {
    return m_prepared ? m_prepared->loaded().files : std::vector<FileReport>{};
}

std::vector<Diagnostic> LiveCity::remarks() const {
    return m_prepared ? m_prepared->remarks() : std::vector<Diagnostic>{};
}

// ---- figures ----

void LiveCity::measure(double seconds, const std::string& reflector,
                       const std::vector<Method>& methods, int resolution) {
    const auto index = m_traffic->find(reflector);
    if (!m_prepared || !index)
        return;
    FiguresRequest request;
    request.placed = m_traffic->at(*index, seconds);
    request.methods = methods;
    request.tuning = m_document.project().tuning;
    if (resolution > 0)
        request.tuning.resolution = resolution;
    std::vector<glm::dvec3> others;
    for (std::size_t i = 0; i < m_traffic->size(); ++i) {
        if (i == *index)
            continue;
        request.others.push_back(m_traffic->at(i, seconds));
        others.push_back(request.others.back().middle());
    }
    if (m_figures && m_figures->reflector == reflector && m_figuresLight == m_lighting &&
        m_figuresOthers == others)
        request.references = m_figures->references;
    m_jobs.run<PoseFigures>(
        {tr("Measuring against the reference"), kFiguresLane},
        [city = m_prepared, rems = m_rems, request](const JobContext& job) {
            return measurePose(*city, rems, request, job);
        },
        this,
        [this, light = m_lighting, others](Result<PoseFigures> figures) {
            if (!figures) {
                if (figures.error().code != ErrorCode::Cancelled)
                    Q_EMIT problem(figures.error());
                if (!m_jobs.isBusy(kFiguresLane))
                    Q_EMIT measuringFailed();
                return;
            }
            m_figures = std::move(*figures);
            m_figuresLight = light;
            m_figuresOthers = others;
            Q_EMIT figuresChanged();
        });
}

GivenMaps LiveCity::referenceMaps() const {
    GivenMaps maps;
    if (m_figures)
        maps[m_figures->reflector] = m_figures->references;
    return maps;
}

}  // namespace reflet
