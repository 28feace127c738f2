// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/TraceBench.h"

#include "app/pipeline/TraceBenchCities.h"
#include "app/pipeline/TraceCheck.h"
#include "core/baking/RayScene.h"
#include "core/base/ParallelFor.h"
#include "core/base/Stopwatch.h"
#include "core/environment/FaceDirections.h"
#include "core/reconstruction/Reconstruction.h"
#include "core/reconstruction/RemSelection.h"

#include <atomic>
#include <functional>

namespace reflet {

namespace {

constexpr int kFaceResolution = 128;
constexpr double kMeasured = 0.1;  ///< seconds that a figure is measured for, at least
constexpr int kPasses = 3;         ///< of which the fastest counts, at least

/// Rays from one position, as everybody likes them best.
struct PoseRays {
    glm::dvec3 position{0.0};
    std::vector<glm::dvec3> directions;
    std::vector<float> x, y, z;

    void add(const glm::dvec3& direction) {
        directions.push_back(direction);
        x.push_back(float(direction.x));
        y.push_back(float(direction.y));
        z.push_back(float(direction.z));
    }
    [[nodiscard]] RayBundle bundle() const { return {glm::vec3(position), x, y, z}; }
};

std::vector<double> texelCoordinates() {
    std::vector<double> coordinates;
    for (int k = 0; k < kFaceResolution; ++k)
        coordinates.push_back(texelCoordinate(kFaceResolution, k));
    return coordinates;
}

/// The vertices of the meshes of all faces, face by face, as the meshes have them.
PoseRays vertexRays(const TraceBenchCity& city, const glm::dvec3& position) {
    PoseRays rays;
    rays.position = position;
    const ReconstructionInput input{city.tracer.get(), {}, city.diameter};
    const RemCandidates candidates = candidateRems(input.rems, position, city.tuning);
    for (int face = 0; face < 6; ++face) {
        for (const MemVertex& vertex :
             buildMemFace(input, candidates, position, face, city.tuning).vertices)
            rays.add(vertex.direction);
    }
    return rays;
}

/// All texels of the six faces, face by face and row by row.
PoseRays texelRays(const glm::dvec3& position) {
    PoseRays rays;
    rays.position = position;
    for (int face = 0; face < 6; ++face) {
        for (int row = 0; row < kFaceResolution; ++row) {
            for (int column = 0; column < kFaceResolution; ++column)
                rays.add(texelDirection(kFaceResolution, face, column, row));
        }
    }
    return rays;
}

/// Million rays a second of a way to trace all the rays of a pose.
class Race {
public:
    Race(const std::vector<PoseRays>& poses, const JobContext& job) : m_poses(poses), m_job(job) {
        for (const PoseRays& pose : poses)
            m_rays += pose.directions.size();
    }

    [[nodiscard]] std::size_t rays() const { return m_rays; }
    [[nodiscard]] double rate(const std::function<void(std::size_t pose)>& trace) const {
        double fastest = std::numeric_limits<double>::infinity();
        double all = 0.0;
        for (int pass = 0; (pass < kPasses || all < kMeasured) && !m_job.cancelled(); ++pass) {
            const Stopwatch watch;
            parallelFor(0, m_poses.size(), 1, [&](std::size_t first, std::size_t last) {
                for (; first < last; ++first)
                    trace(first);
            });
            all += watch.seconds();
            fastest = std::min(fastest, watch.seconds());
        }
        return m_job.cancelled() ? 0.0 : 1e-6 * double(m_rays) / fastest;
    }

private:
    const std::vector<PoseRays>& m_poses;
    const JobContext& m_job;
    std::size_t m_rays = 0;
};

/// Answers of all poses, so that nothing is left out as unneeded.
template <class T>
std::vector<std::vector<T>> answersFor(const std::vector<PoseRays>& poses) {
    std::vector<std::vector<T>> answers;
    for (const PoseRays& pose : poses)
        answers.emplace_back(pose.directions.size());
    return answers;
}

/// Traces all the rays of a pose through the heightfield.
using Tracing = std::function<void(const HeightfieldTracer&, const PoseRays&, std::span<double> t)>;

void traceVertices(const HeightfieldTracer& tracer, const PoseRays& rays, std::span<double> t) {
    tracer.traceFrom(rays.position, rays.directions, {t});
}

void traceTexels(const HeightfieldTracer& tracer, const PoseRays& rays, std::span<double> t) {
    static const std::vector<double> coordinates = texelCoordinates();
    const std::size_t texels = coordinates.size() * coordinates.size();
    for (int face = 0; face < 6; ++face) {
        tracer.traceGrid(rays.position, faceDirections(face, coordinates, coordinates),
                         {t.subspan(std::size_t(face) * texels, texels)});
    }
}

TraceRates ratesOf(const TraceBenchCity& city, const RayScene& scene,
                   const std::vector<PoseRays>& poses, const Tracing& tracing,
                   const JobContext& job) {
    const Race race(poses, job);
    auto exact = answersFor<double>(poses);
    auto meshed = answersFor<float>(poses);
    const auto embree = [&](int size) {
        double fastest = 0.0;
        for (const bool coherent : {false, true}) {
            fastest = std::max(fastest, race.rate([&](std::size_t k) {
                scene.intersect(poses[k].bundle(), {size, coherent}, meshed[k]);
            }));
        }
        return fastest;
    };
    TraceRates rates;
    rates.rays = race.rays();
    rates.heightfield =
        race.rate([&](std::size_t k) { tracing(*city.tracer, poses[k], exact[k]); });
    rates.scalar = race.rate([&](std::size_t k) {
        for (std::size_t n = 0; n < exact[k].size(); ++n)
            exact[k][n] = city.tracer->trace({poses[k].position, poses[k].directions[n]}).t;
    });
    rates.single = embree(1);
    rates.packet8 = embree(8);
    rates.packet16 = embree(16);
    return rates;
}

/// Answers of a way of tracing that are not the oracle's.
std::size_t mismatchesOf(const TraceBenchCity& city, const std::vector<PoseRays>& poses,
                         const Tracing& tracing) {
    std::atomic<std::size_t> mismatches = 0;
    parallelFor(0, poses.size(), 1, [&](std::size_t first, std::size_t last) {
        for (; first < last; ++first) {
            const PoseRays& pose = poses[first];
            std::vector<double> t(pose.directions.size());
            tracing(*city.tracer, pose, t);
            for (std::size_t n = 0; n < t.size(); ++n)
                mismatches +=
                    isOracles(city.field, {pose.position, pose.directions[n]}, t[n]) ? 0 : 1;
        }
    });
    return mismatches;
}

TraceThreads measured(const TraceBenchCity& city, const RayScene& scene,
                      const std::vector<PoseRays>& poses, const Tracing& tracing,
                      const JobContext& job) {
    const int threads = threadLimit();
    TraceThreads rates;
    rates.all = ratesOf(city, scene, poses, tracing, job);
    setThreadLimit(1);
    rates.one = ratesOf(city, scene, poses, tracing, job);
    setThreadLimit(threads);
    return rates;
}

Result<TraceBenchScene> benchCity(const TraceBenchCity& city, std::size_t checkedRays,
                                  const JobContext& job) {
    const auto scene = RayScene::build(city.model, {}, job.phase("mesh", 0.0, 0.2));
    if (!scene)
        return tl::unexpected(scene.error());
    std::vector<PoseRays> vertices, texels;
    for (const glm::dvec3& position : city.positions) {
        vertices.push_back(vertexRays(city, position));
        if (texels.size() < 16)
            texels.push_back(texelRays(position));
    }
    TraceBenchScene result;
    result.name = city.name;
    result.triangles = city.model.triangles.size();
    result.vertices = measured(city, **scene, vertices, traceVertices, job);
    result.texels = measured(city, **scene, texels, traceTexels, job);
    result.compared = result.vertices.all.rays + result.texels.all.rays + checkedRays;
    result.mismatches =
        mismatchesOf(city, vertices, traceVertices) + mismatchesOf(city, texels, traceTexels) +
        randomMismatches(*city.tracer, city.field, checkedRays, job.phase("checking", 0.5, 1.0));
    if (job.cancelled())
        return tl::unexpected(JobContext::cancelledError());
    return result;
}

}  // namespace

Result<TraceBenchReport> benchTrace(const TraceBenchOptions& options, const JobContext& job) {
    const auto cities = traceBenchCities(options, job.phase("cities", 0.0, 0.3));
    if (!cities)
        return tl::unexpected(cities.error());
    TraceBenchReport report;
    report.threads = threadLimit();
    for (std::size_t k = 0; k < cities->size(); ++k) {
        const double count = double(cities->size());
        auto scene = benchCity((*cities)[k], options.checkedRays,
                               job.phase((*cities)[k].name, 0.3 + 0.7 * double(k) / count,
                                         0.3 + 0.7 * double(k + 1) / count));
        if (!scene)
            return tl::unexpected(scene.error());
        report.scenes.push_back(std::move(*scene));
    }
    return report;
}

}  // namespace reflet
