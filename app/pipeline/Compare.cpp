// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Compare.h"

#include "app/pipeline/TrafficMaps.h"
#include "core/io/ImageFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

/// Where a reflector is compared, and the reference of each of its bodies.
struct Pose {
    std::size_t reflector = 0;
    double time = 0.0;
    PlacedReflector placed;
    std::vector<LocalEnvironmentMap> truth;

    /// The reflector first, then the other vehicles as they stand when it is there.
    [[nodiscard]] std::vector<PlacedReflector> withOthers(const Traffic& traffic) const {
        std::vector<PlacedReflector> all{placed};
        for (std::size_t i = 0; i < traffic.size(); ++i) {
            if (i != reflector)
                all.push_back(traffic.at(i, time));
        }
        return all;
    }
};

/// Poses at equal steps along each route, never nearer to its ends than half the vehicle.
std::vector<Pose> spreadPoses(const Traffic& traffic, int count) {
    std::vector<Pose> poses;
    for (int k = 0; k < count; ++k) {
        const auto reflector = std::size_t(k) % traffic.size();
        const int turn = k / int(traffic.size());
        const int turns = (count - 1 - int(reflector)) / int(traffic.size()) + 1;
        Pose pose;
        pose.reflector = reflector;
        pose.placed = traffic.atStation(reflector, 0.0);
        const double length = traffic.route(reflector).length();
        const double margin = std::min(0.5 * pose.placed.vehicle->length(), 0.4 * length);
        const double station = margin + (length - 2.0 * margin) * (turn + 0.5) / double(turns);
        const Drive& drive = traffic.drive(reflector);
        pose.placed = traffic.atStation(reflector, station);
        pose.time = drive.speed > 0.0 ? std::max(0.0, (station - drive.start) / drive.speed) : 0.0;
        poses.push_back(std::move(pose));
    }
    return poses;
}

/// Traces the reference of each body; poses where that is refused (inside a wall) are left out.
Result<void> traceReferences(const PreparedCity& city, const Traffic& traffic,
                             std::vector<Pose>& poses, std::vector<Diagnostic>& remarks,
                             const JobContext& job) {
    std::vector<Pose> kept;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        job.progress(double(i) / double(poses.size()));
        Pose& pose = poses[i];
        auto maps = TrafficMaps::create(city, {}, pose.withOthers(traffic), job);
        if (!maps)
            return tl::unexpected(maps.error());
        bool refused = false;
        for (std::size_t body = 0; body < pose.placed.poses.size() && !refused; ++body) {
            auto truth = maps->map(body, Method::RayTrace, job);
            if (truth) {
                pose.truth.push_back(std::move(*truth));
            } else if (truth.error().code == ErrorCode::Refused) {
                remarks.push_back({Severity::Warning, "pose-refused", pose.placed.id,
                                   fmt::format("A pose {:.0f} m along the route was left out: {}",
                                               pose.placed.station, truth.error().what),
                                   "Move the route away from the wall."});
                refused = true;
            } else {
                return tl::unexpected(truth.error());
            }
        }
        if (!refused)
            kept.push_back(std::move(pose));
    }
    poses = std::move(kept);
    return {};
}

/// Draws the vehicle by each method and by ray tracing, and compares the reflector's pixels.
class VehicleComparison {
public:
    VehicleComparison(const PreparedCity& city, const Traffic& traffic, const RemSet& rems,
                      const CompareOptions& options)
        : m_city(city), m_traffic(traffic), m_rems(rems), m_options(options) {}

    Result<void> begin(const Pose& pose, std::size_t number, const JobContext& job) {
        m_number = number;
        auto maps = TrafficMaps::create(m_city, m_rems, pose.withOthers(m_traffic), job);
        if (!maps)
            return tl::unexpected(maps.error());
        m_maps = std::make_unique<TrafficMaps>(std::move(*maps));
        m_camera = streetCamera(m_city, pose.placed);
        auto truth = draw({}, job);
        if (!truth)
            return tl::unexpected(truth.error());
        m_mask = std::move(truth->reflector);
        m_truth = toDisplayImage(*truth, m_city.project().exposure);
        return write(m_truth, "raytrace");
    }

    /// The vehicles as they stand at the pose, the compared one first.
    [[nodiscard]] TrafficMaps& maps() { return *m_maps; }

    /// maps: of all bodies.
    Result<void> add(const std::string& method, const std::vector<LocalEnvironmentMap>& maps,
                     FigureTally& tally, const JobContext& job) {
        auto view = draw(maps, job);
        if (!view)
            return tl::unexpected(view.error());
        const DisplayImage image = toDisplayImage(*view, m_city.project().exposure);
        tally.vehicle.add(image, m_truth, m_mask);
        return write(image, method);
    }

    std::vector<std::filesystem::path> pictures;

private:
    Result<RenderedView> draw(const std::vector<LocalEnvironmentMap>& maps, const JobContext& job) {
        std::vector<PlacedBody> bodies = m_maps->bodies();
        for (std::size_t i = 0; i < maps.size(); ++i)
            bodies[i].map = &maps[i];
        return renderView(m_maps->scene(), bodies, m_camera,
                          {m_options.width, m_options.height, m_options.samplesPerEdge}, job);
    }

    Result<void> write(const DisplayImage& image, const std::string& method) {
        if (!m_options.output)
            return {};
        const auto path = *m_options.output / fmt::format("pose-{:02}-{}.png", m_number, method);
        auto written = writePng(image, path);
        if (written)
            pictures.push_back(path);
        return written;
    }

    const PreparedCity& m_city;
    const Traffic& m_traffic;
    const RemSet& m_rems;
    const CompareOptions& m_options;
    std::size_t m_number = 0;
    std::unique_ptr<TrafficMaps> m_maps;
    Camera m_camera;
    DisplayImage m_truth;
    std::vector<unsigned char> m_mask;
};

Result<void> comparePose(const PreparedCity& city, const RemSet& rems,
                         const CompareOptions& options, const Pose& pose,
                         VehicleComparison& vehicle, std::map<Method, FigureTally>& tallies,
                         const JobContext& job) {
    for (const Method method : options.methods) {
        if (job.cancelled())
            return tl::unexpected(JobContext::cancelledError());
        std::vector<LocalEnvironmentMap> maps;
        for (std::size_t body = 0; body < vehicle.maps().bodies().size(); ++body) {
            const bool compared = body < pose.truth.size();
            if (compared && method == Method::RayTrace) {
                maps.push_back(pose.truth[body]);
            } else {
                auto map = vehicle.maps().map(body, method, job);
                if (!map)
                    return tl::unexpected(map.error());
                maps.push_back(std::move(*map));
            }
            if (!compared)
                continue;
            tallies[method].add(maps.back(), pose.truth[body], city.project().exposure);
            auto traced =
                tallies[method].addSurfaces(city, rems, method, pose.placed.mapCenter(body), job);
            if (!traced)
                return traced;
        }
        if (auto added = vehicle.add(toString(method), maps, tallies[method], job); !added)
            return added;
    }
    return {};
}

Result<void> checkComparable(const PreparedCity& city, const Traffic& traffic,
                             const CompareOptions& options) {
    if (traffic.size() == 0) {
        return fail(
            ErrorCode::Usage, "the project has no vehicle to compare", city.project().name,
            "Add one: `reflet-cli edit P.reflet --route LINE.geojson --vehicle tram1=tram,ROUTE`.");
    }
    if (city.project().probes.empty()) {
        return fail(ErrorCode::Usage, "the project has no reflection probes", city.project().name,
                    "Place some: `reflet-cli edit P.reflet --probes-every 15`.");
    }
    if (options.poses < 1 || options.poses > 10'000) {
        return fail(ErrorCode::Usage, "the number of poses is out of range", "--poses",
                    "Take 1 to 10000.");
    }
    return {};
}

}  // namespace

Result<CompareReport> compareMethods(const PreparedCity& city, const CompareOptions& options,
                                     const JobContext& job) {
    const auto traffic = trafficOf(city.project(), city.folder());
    if (!traffic)
        return tl::unexpected(traffic.error());
    if (auto sound = checkComparable(city, *traffic, options); !sound)
        return tl::unexpected(sound.error());
    auto rems = loadRems(city, job.phase("baking", 0.0, 0.4));
    if (!rems)
        return tl::unexpected(rems.error());

    CompareReport report;
    report.remarks = std::move(rems->failures);
    std::vector<Pose> poses = spreadPoses(*traffic, options.poses);
    if (auto traced = traceReferences(city, *traffic, poses, report.remarks,
                                      job.phase("tracing the reference", 0.4, 0.7));
        !traced) {
        return tl::unexpected(traced.error());
    }
    std::map<Method, FigureTally> tallies;
    VehicleComparison vehicle(city, *traffic, rems->rems, options);
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const JobContext phase =
            job.phase("comparing", 0.7 + 0.3 * double(i) / double(poses.size()), 1.0);
        phase.progress(0.0);
        if (auto begun = vehicle.begin(poses[i], i + 1, phase); !begun)
            return tl::unexpected(begun.error());
        auto done = comparePose(city, rems->rems, options, poses[i], vehicle, tallies, phase);
        if (!done)
            return tl::unexpected(done.error());
        report.maps += poses[i].truth.size();
    }
    report.poses = poses.size();
    report.pictures = std::move(vehicle.pictures);
    for (const auto& [method, tally] : tallies)
        report.methods[toString(method)] = tally.figures(report.maps);
    return report;
}

}  // namespace reflet
