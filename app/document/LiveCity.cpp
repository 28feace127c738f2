// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/document/LiveCity.h"

#include "app/pipeline/Bake.h"
#include "app/pipeline/Render.h"
#include "app/pipeline/Traffic.h"
#include "core/baking/EnvironmentBaker.h"
#include "core/io/ImageFile.h"

namespace reflet {
namespace {

const char* const kLoadLane = "live-load";
const char* const kBakeLane = "live-bake";

}  // namespace

LiveCity::LiveCity(ProjectDocument& document, JobRunner& jobs, QObject* parent)
    : QObject(parent), m_document(document), m_jobs(jobs) {
    connect(&document, &ProjectDocument::projectChanged, this, &LiveCity::projectChanged);
}

void LiveCity::projectChanged(ProjectChanges what) {
    if (what & (ProjectChange::Models | ProjectChange::Heightfield | ProjectChange::Light)) {
        load();
    }
    if (what & (ProjectChange::Routes | ProjectChange::Reflectors | ProjectChange::Vehicles)) {
        updateTraffic();
    }
    if (what & (ProjectChange::Probes | ProjectChange::Bake)) {
        Q_EMIT remsChanged();
        Q_EMIT probeStatesChanged();
        if (m_autoBake && !m_baking) {
            bakeNext();
        }
    }
}

void LiveCity::load() {
    if (m_document.project().models.empty()) {
        m_city.reset();
        m_prepared.reset();
        Q_EMIT cityChanged();
        return;
    }
    m_loading = true;
    m_jobs.run<Prepared>(
        {.title = tr("Preparing the city"), .lane = QLatin1String(kLoadLane)},
        [project = m_document.project(),
         file = m_document.dataFile()](const JobContext& job) -> Result<Prepared> {
            auto made = PreparedCity::prepare(project, file, job);
            if (!made) {
                return tl::unexpected(made.error());
            }
            Prepared result;
            result.city = std::make_shared<PreparedCity>(std::move(*made));
            const auto& owner = result.city;
            auto drawn = std::make_shared<DrawnCity>();
            drawn->model = {owner, &owner->city()};
            drawn->looks = std::make_shared<SurfaceLooks>(owner->city());
            auto images = std::make_shared<std::vector<TextureImage>>();
            for (const auto& texture : owner->city().textures) {
                auto image = texture.path.empty() ? Result<TextureImage>(TextureImage{})
                                                  : readTexture(texture.path);
                images->push_back(image ? std::move(*image) : TextureImage{});
            }
            drawn->textures = images;
            drawn->heightfield = {owner, &owner->heightfield()};
            drawn->tracer = {owner, &owner->tracer()};
            drawn->diameter = owner->diameter();
            result.drawn = drawn;
            return result;
        },
        this,
        [this](Result<Prepared> prepared) {
            m_loading = false;
            if (!prepared) {
                Q_EMIT problem(prepared.error());
                return;
            }
            m_prepared = prepared->city;
            m_city = prepared->drawn;
            m_lighting = m_prepared->lighting();
            Q_EMIT lightingChanged();
            Q_EMIT cityChanged();
            if (m_autoBake && !m_baking) {
                bakeNext();
            }
            Q_EMIT remsChanged();
            Q_EMIT probeStatesChanged();
        });
}

void LiveCity::updateTraffic() {
    m_jobs.run<Traffic>(
        {.title = tr("Building the vehicles"),
         .lane = QStringLiteral("live-traffic"),
         .visible = false},
        [project = m_document.project(), folder = m_document.folder()](const JobContext&) {
            return trafficOf(project, folder);
        },
        this,
        [this](Result<Traffic> traffic) {
            if (!traffic) {
                Q_EMIT problem(traffic.error());
                return;
            }
            m_traffic = std::make_shared<const Traffic>(std::move(*traffic));
            Q_EMIT trafficChanged();
        });
}

std::string LiveCity::keyOf(const Probe& probe) const {
    if (!m_prepared) {
        return {};
    }
    BakeSettings settings = m_document.project().bake;
    settings.resolution = probe.resolution.value_or(settings.resolution);
    return m_prepared->mapKey(m_prepared->inFrame(probe.position), settings);
}

void LiveCity::bakeNow() {
    bakeNext();
}

void LiveCity::cancelBaking() {
    m_jobs.cancelLane(QLatin1String(kBakeLane));
    m_baking = false;
}

void LiveCity::bakeNext() {
    m_baking = false;
    if (!m_prepared) {
        return;
    }
    for (const Probe& probe : m_document.project().probes) {
        const std::string key = keyOf(probe);
        if (m_maps.contains(key) || m_refused.contains(key)) {
            continue;
        }
        m_baking = true;
        BakeSettings settings = m_document.project().bake;
        settings.resolution = probe.resolution.value_or(settings.resolution);
        m_jobs.run<RemSet::Pointer>(
            {.title = tr("Taking the picture of %1").arg(QString::fromStdString(probe.id)),
             .lane = QLatin1String(kBakeLane)},
            [city = m_prepared, probe, settings,
             key](const JobContext& job) -> Result<RemSet::Pointer> {
                if (auto found = city->cache().find(key)) {
                    return std::make_shared<const ReferenceEnvironmentMap>(std::move(*found));
                }
                const auto scene = city->scene(job);
                if (!scene) {
                    return tl::unexpected(scene.error());
                }
                auto map = bakeEnvironmentMap(**scene, &city->heightfield(), probe.id,
                                              city->inFrame(probe.position), settings, job);
                if (!map) {
                    return tl::unexpected(map.error());
                }
                if (auto stored = city->cache().store(key, *map); !stored) {
                    return tl::unexpected(stored.error());
                }
                return std::make_shared<const ReferenceEnvironmentMap>(std::move(*map));
            },
            this,
            [this, key](Result<RemSet::Pointer> map) {
                if (map) {
                    m_maps[key] = *map;
                } else if (map.error().code == ErrorCode::Cancelled) {
                    m_baking = false;
                    return;
                } else {
                    m_refused[key] = map.error().what;
                }
                Q_EMIT remsChanged();
                Q_EMIT probeStatesChanged();
                bakeNext();
            });
        return;
    }
}

RemSet LiveCity::rems() const {
    RemSet set;
    for (const Probe& probe : m_document.project().probes) {
        const auto found = m_maps.find(keyOf(probe));
        if (found != m_maps.end()) {
            set.add(found->second);
        }
    }
    return set;
}

ProbeState LiveCity::probeState(const std::string& id) const {
    for (const Probe& probe : m_document.project().probes) {
        if (probe.id == id) {
            const std::string key = keyOf(probe);
            if (m_refused.contains(key)) {
                return ProbeState::Refused;
            }
            return m_maps.contains(key) ? ProbeState::Fresh : ProbeState::Missing;
        }
    }
    return ProbeState::Missing;
}

QString LiveCity::probeProblem(const std::string& id) const {
    for (const Probe& probe : m_document.project().probes) {
        const auto found = m_refused.find(keyOf(probe));
        if (probe.id == id && found != m_refused.end()) {
            return QString::fromStdString(found->second);
        }
    }
    return {};
}

std::shared_ptr<const ReferenceEnvironmentMap> LiveCity::rem(const std::string& id) const {
    for (const Probe& probe : m_document.project().probes) {
        const auto found = m_maps.find(keyOf(probe));
        if (probe.id == id && found != m_maps.end()) {
            return found->second;
        }
    }
    return {};
}

std::optional<double> LiveCity::groundHeight(double x, double y) const {
    return m_prepared ? std::optional(m_prepared->groundHeight(x, y)) : std::nullopt;
}

Camera LiveCity::streetCamera(std::size_t reflector, double seconds) const {
    if (!m_prepared || !m_traffic || reflector >= m_traffic->size()) {
        return {};
    }
    return reflet::streetCamera(*m_prepared, m_traffic->at(reflector, seconds));
}

std::vector<FileReport> LiveCity::reports() const {
    return m_prepared ? m_prepared->loaded().files : std::vector<FileReport>{};
}

}  // namespace reflet
