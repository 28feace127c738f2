// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/coverage/CoveragePlan.h"

#include "app/pipeline/Traffic.h"
#include "core/base/ParallelFor.h"
#include "core/coverage/DrivableGround.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>

namespace reflet {

namespace {

constexpr double kGroundSpacing = 2.0;   // metres between places on the ground
constexpr double kMostPlaces = 250'000;  // of them; larger cities get fewer to the metre
constexpr std::size_t kFewest = 4096;    // samples to begin with

/// Mirrors of vehicles by name, each made once.
class Mirrors {
public:
    Mirrors(const Project& project, const std::filesystem::path& folder)
        : m_project(project), m_folder(folder) {}

    [[nodiscard]] Result<std::shared_ptr<const BodyReflections>> of(const std::string& name) {
        const auto found = m_made.find(name);
        if (found != m_made.end())
            return found->second;
        const auto vehicle = vehicleOf(m_project, name, m_folder);
        if (!vehicle)
            return tl::unexpected(vehicle.error());
        return m_made[name] = std::make_shared<const BodyReflections>(**vehicle);
    }

private:
    const Project& m_project;
    const std::filesystem::path& m_folder;
    std::map<std::string, std::shared_ptr<const BodyReflections>> m_made;
};

Result<void> addLine(CoveragePlan& plan, const RouteSpec& spec, const ProjectFrame& frame,
                     const std::string& vehicle, Mirrors& mirrors) {
    auto reflections = mirrors.of(vehicle);
    if (!reflections)
        return tl::unexpected(reflections.error());
    plan.lines.push_back(
        {spec.id, std::make_shared<const Route>(routeInFrame(spec, frame)), *reflections, 1.0});
    plan.names.push_back(spec.name.empty() ? spec.id : spec.name);
    return {};
}

/// A line for each route and each kind of vehicle on it, of those that mirror: people don't.
Result<void> addRoutes(CoveragePlan& plan, const PreparedCity& city, const std::string& vehicle) {
    const Project& project = city.project();
    Mirrors mirrors(project, city.folder());
    for (const RouteSpec& spec : project.routes) {
        std::vector<std::string> drivers;
        for (const Reflector& reflector : project.reflectors) {
            if (reflector.route != spec.id ||
                std::find(drivers.begin(), drivers.end(), reflector.vehicle) != drivers.end())
                continue;
            const auto driver = vehicleOf(project, reflector.vehicle, city.folder());
            if (!driver)
                return tl::unexpected(driver.error());
            if (!(*driver)->walks)
                drivers.push_back(reflector.vehicle);
        }
        for (const std::string& driver : drivers) {
            if (auto added = addLine(plan, spec, project.frame, driver, mirrors); !added)
                return added;
        }
    }
    if (!plan.lines.empty())
        return {};
    for (const RouteSpec& spec : project.routes) {
        if (auto added =
                addLine(plan, spec, project.frame, vehicle.empty() ? "tram" : vehicle, mirrors);
            !added)
            return added;
    }
    return {};
}

Result<void> addGround(CoveragePlan& plan, const PreparedCity& city, const std::string& vehicle) {
    Mirrors mirrors(city.project(), city.folder());
    auto reflections = mirrors.of(vehicle.empty() ? "car" : vehicle);
    if (!reflections)
        return tl::unexpected(reflections.error());
    const DrivableGround ground = drivableGround(city.heightfield(), city.city());
    const double spacing = std::max(kGroundSpacing, std::sqrt(ground.squareMetres() / kMostPlaces));
    plan.ground = DemandGround{ground.places(city.heightfield(), spacing), spacing, *reflections};
    if (plan.ground->places.empty()) {
        return fail(ErrorCode::Usage, "there is no ground that a vehicle could drive on",
                    city.project().name,
                    "Draw a route where vehicles shall go, or import roads with the city.");
    }
    return {};
}

}  // namespace

Result<CoveragePlan> coveragePlan(const PreparedCity& city, const CoverageOptions& options) {
    if (!(options.error > 0.0 && options.error < 1.0)) {
        return fail(ErrorCode::Usage, "the error must lie between 0 and 1", "--error",
                    "Take e.g. 0.005, which is half a per cent.");
    }
    const Project& project = city.project();
    CoveragePlan plan;
    for (const View& view : project.views)
        plan.onlookers.eyes.push_back(city.inFrame(view.position));
    const DemandOn on =
        options.on.value_or(project.routes.empty() ? DemandOn::Ground : DemandOn::Routes);
    if (on == DemandOn::Ground) {
        if (auto added = addGround(plan, city, options.vehicle); !added)
            return tl::unexpected(added.error());
        return plan;
    }
    if (project.routes.empty()) {
        return fail(ErrorCode::Usage, "the project has no route", project.name,
                    "Draw one, add one with edit --route, or ask for all drivable ground "
                    "(--on ground).");
    }
    if (auto added = addRoutes(plan, city, options.vehicle); !added)
        return tl::unexpected(added.error());
    return plan;
}

Result<RemSet> probeSights(const PreparedCity& city, const std::vector<Probe>& probes,
                           const JobContext& job) {
    std::vector<RemSet::Pointer> made(probes.size());
    std::atomic<std::size_t> done{0};
    parallelFor(0, probes.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last && !job.cancelled(); ++i) {
            const int resolution = probes[i].resolution.value_or(city.project().bake.resolution);
            made[i] = std::make_shared<const ReferenceEnvironmentMap>(sightFrom(
                city.tracer(), city.inFrame(probes[i].position), resolution, probes[i].id));
            job.progress(double(++done) / double(probes.size()));
        }
    });
    if (job.cancelled())
        return tl::unexpected(JobContext::cancelledError());
    RemSet rems;
    for (RemSet::Pointer& one : made)
        rems.add(std::move(one));
    return rems;
}

Demand sampleToError(const CoveragePlan& plan, const HeightfieldTracer& tracer,
                     const CoverageOptions& options,
                     const std::function<std::vector<float>(const Demand&)>& valuesOf) {
    std::size_t count = std::min(kFewest, options.mostSamples);
    while (true) {
        Demand demand = plan.sample(tracer, count, options.seed);
        const Estimate estimate = estimateOf(valuesOf(demand));
        if (count >= options.mostSamples || estimate.error <= options.error)
            return demand;
        count = std::min(2 * count, options.mostSamples);
    }
}

}  // namespace reflet
