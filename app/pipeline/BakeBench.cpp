// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/BakeBench.h"

#include "app/pipeline/Bake.h"
#include "core/baking/EnvironmentBaker.h"
#include "core/baking/SceneParts.h"
#include "core/base/Median.h"
#include "core/base/ParallelFor.h"
#include "core/base/Stopwatch.h"

#include <algorithm>
#include <optional>

namespace reflet {

namespace {

constexpr double kMilli = 1000.0;

struct Seen {
    SeenSpace space;
    std::uint64_t content = 0;
};

/// A map that was baked, or nothing where the place is refused.
struct Baked {
    std::optional<Seen> seen;
    double seconds = 0.0, noting = 0.0;
};

class Bench {
public:
    Bench(const PreparedCity& city, const BakeBenchOptions& options, const JobContext& job)
        : m_city(city), m_options(options), m_job(job) {}

    [[nodiscard]] Result<BakeBenchSize> size(int resolution) const {
        const auto scene = m_city.sceneWith({}, m_job);
        if (!scene)
            return tl::unexpected(scene.error());
        const auto& probes = m_city.project().probes;
        BakeBenchSize out;
        out.resolution = resolution;
        std::vector<double> times, noting;
        double sum = 0.0;
        const std::size_t count = std::min(m_options.probes, probes.size());
        for (std::size_t k = 0; k < count; ++k) {
            auto baked = bake(**scene, probes[k * probes.size() / count], resolution);
            if (!baked)
                return tl::unexpected(baked.error());
            if (!baked->seen)
                continue;
            times.push_back(kMilli * baked->seconds);
            noting.push_back(kMilli * baked->noting);
            sum += baked->seconds;
        }
        out.probes = times.size();
        if (times.empty())
            return out;
        out.first = times.front();
        out.milliseconds = median(times);
        out.noting = median(noting);
        out.raysPerSecond = double(times.size()) * raysOf(resolution) / sum;
        return out;
    }

    [[nodiscard]] Result<void> project(BakeBenchReport& report) const {
        const auto scene = m_city.sceneWith({}, m_job);
        if (!scene)
            return tl::unexpected(scene.error());
        std::vector<std::optional<Seen>> seen;
        const Stopwatch watch;
        for (const Probe& probe : m_city.project().probes) {
            auto baked = bake(**scene, probe, resolutionOf(probe));
            if (!baked)
                return tl::unexpected(baked.error());
            report.probes += baked->seen ? 1 : 0;
            seen.push_back(std::move(baked->seen));
        }
        report.seconds = watch.seconds();
        report.resolution = m_city.project().bake.resolution;
        for (const std::uint32_t object : buildings()) {
            auto change = without(object, seen);
            if (!change)
                return tl::unexpected(change.error());
            report.changes.push_back(std::move(*change));
        }
        return {};
    }

private:
    [[nodiscard]] int resolutionOf(const Probe& probe) const {
        return bakeSettingsOf(m_city.project(), probe).resolution;
    }
    [[nodiscard]] double raysOf(int resolution) const {
        const int samples = m_city.project().bake.samplesPerEdge;
        return 6.0 * resolution * resolution * (samples * samples + 1);
    }

    [[nodiscard]] Result<Baked> bake(const RadianceScene& scene, const Probe& probe,
                                     int resolution) const {
        const auto contents = m_city.contents(cellsOver(m_city.city().bounds()), m_job);
        if (!contents)
            return tl::unexpected(contents.error());
        BakeSettings settings = bakeSettingsOf(m_city.project(), probe);
        settings.resolution = resolution;
        const glm::dvec3 position = m_city.inFrame(probe.position);
        const Stopwatch watch;
        SightRecorder sight(**contents, position, m_city.lighting());
        const auto map = bakeEnvironmentMap(scene, &m_city.heightfield(), probe.id, position,
                                            settings, m_job, &sight);
        if (!map && map.error().code == ErrorCode::Refused)
            return Baked{};
        if (!map)
            return tl::unexpected(map.error());
        const Stopwatch noting;
        Seen seen{sight.seen(), 0};
        seen.content = contentOf(seen.space, **contents);
        return Baked{std::move(seen), watch.seconds(), noting.seconds()};
    }

    /// Objects with walls or roofs, spread over the file.
    [[nodiscard]] std::vector<std::uint32_t> buildings() const {
        const CityModel& model = m_city.city();
        std::vector<unsigned char> shown(model.objects.size(), 0);
        for (const CityTriangle& triangle : model.triangles)
            shown[model.surfaces[triangle.surface].object] = 1;
        std::vector<std::uint32_t> all, some;
        for (std::uint32_t i = 0; i < model.objects.size(); ++i) {
            const CityObjectType type = model.objects[i].type;
            if (shown[i] != 0 &&
                (type == CityObjectType::Building || type == CityObjectType::BuildingPart))
                all.push_back(i);
        }
        const std::size_t count = std::min(m_options.changes, all.size());
        for (std::size_t k = 0; k < count; ++k)
            some.push_back(all[(2 * k + 1) * all.size() / (2 * count)]);
        return some;
    }

    /// The city without one of its objects: finds the probes that depend on it and bakes them.
    [[nodiscard]] Result<BakeBenchChange> without(
        std::uint32_t object, const std::vector<std::optional<Seen>>& seen) const {
        auto model = std::make_shared<CityModel>(m_city.city());
        const auto isPart = [&](std::size_t triangle) {
            return model->surfaces[model->triangles[triangle].surface].object == object;
        };
        std::size_t left = 0;
        for (std::size_t i = 0; i < model->triangles.size(); ++i) {
            if (isPart(i))
                continue;
            if (!model->uv.empty())
                model->uv[left] = model->uv[i];
            model->triangles[left++] = model->triangles[i];
        }
        model->triangles.resize(left);
        if (!model->uv.empty())
            model->uv.resize(left);
        const auto looks = std::make_shared<const SurfaceLooks>(*model, m_job);
        const auto drawn = m_city.drawn(m_job);
        if (!drawn || m_job.cancelled())
            return tl::unexpected(JobContext::cancelledError());

        BakeBenchChange change;
        change.object = model->objects[object].id;
        const Stopwatch watch;
        const auto images = contentOf(*(*drawn)->textures, *model);
        const CellContents contents =
            CityContents(*model, *looks, images).in(cellsOver(m_city.city().bounds()));
        const auto parts = makeSceneParts(model, looks, (*drawn)->textures, m_job);
        if (!parts)
            return tl::unexpected(parts.error());
        const auto scene = RadianceScene::create(*parts, m_city.lighting(), {}, m_job);
        if (!scene)
            return tl::unexpected(scene.error());
        for (std::size_t i = 0; i < seen.size(); ++i) {
            if (!seen[i] || contentOf(seen[i]->space, contents) == seen[i]->content)
                continue;
            const Probe& probe = m_city.project().probes[i];
            if (auto baked = bake(**scene, probe, resolutionOf(probe)); !baked)
                return tl::unexpected(baked.error());
            ++change.baked;
        }
        change.seconds = watch.seconds();
        return change;
    }

    const PreparedCity& m_city;
    const BakeBenchOptions& m_options;
    const JobContext& m_job;
};

}  // namespace

Result<BakeBenchReport> benchBake(const PreparedCity& city, const BakeBenchOptions& options,
                                  const JobContext& job) {
    if (city.project().probes.empty()) {
        return fail(ErrorCode::Usage, "the project has no reflection probes", city.project().name,
                    "Place some: `reflet-cli edit P.reflet --probes-every 15`.");
    }
    const Bench bench(city, options, job);
    BakeBenchReport report;
    report.threads = threadLimit();
    report.triangles = city.city().triangles.size();
    for (const int resolution : options.resolutions) {
        auto size = bench.size(resolution);
        if (!size)
            return tl::unexpected(size.error());
        if (size->probes == 0)
            return fail(ErrorCode::Refused,
                        "all probes that were tried stand in walls or the ground",
                        city.project().name, "Move them onto the streets.");
        report.sizes.push_back(*size);
    }
    if (auto whole = bench.project(report); !whole)
        return tl::unexpected(whole.error());
    return report;
}

}  // namespace reflet
