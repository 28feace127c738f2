// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/TraceCheck.h"

#include "core/base/ParallelFor.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <random>
#include <vector>

namespace reflet {

namespace {

constexpr std::size_t kRaysAtOnce = 4096;
constexpr int kKinds = 8;

class RandomRays {
public:
    RandomRays(const Heightfield& field, const Box& box, std::uint64_t seed)
        : m_field(field), m_box(box), m_random(seed) {}

    [[nodiscard]] Ray next(std::size_t kind) {
        const GridSpec& grid = m_field.grid;
        const int i = int(between(0.0, grid.columns));
        const int j = int(between(0.0, grid.rows));
        Ray ray{{between(m_box.min.x, m_box.max.x), between(m_box.min.y, m_box.max.y),
                 between(m_box.min.z, m_box.max.z)},
                {between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0)}};
        switch (kind % kKinds) {
            case 0:  // from outside
                ray.origin += 2.0 * (ray.origin - m_box.center());
                break;
            case 1:  // along an axis
                ray.direction[i % 2] = j % 2 == 0 ? 0.0 : -0.0;
                break;
            case 2:  // along a border
                ray.origin.x = grid.xMin(i);
                ray.direction.x = 0.0;
                break;
            case 3:  // through corners
                ray.origin.x = grid.xMin(i);
                ray.origin.y = grid.yMin(j);
                ray.direction.x = i % 2 == 0 ? 1.0 : -1.0;
                ray.direction.y = j % 2 == 0 ? 1.0 : -1.0;
                break;
            case 4: {  // level, at the height of a column
                const float height = m_field.topCenter[grid.index(i, j)];
                ray.origin.z = isMissing(height) ? ray.origin.z : double(height);
                ray.direction.z = 0.0;
                break;
            }
            case 5:  // as from a street
                ray.direction.z *= 0.05;
                break;
            case 6:  // nearly without a component
                ray.direction[i % 3] *= 1e-300;
                break;
            default:
                break;
        }
        return ray;
    }

private:
    double between(double from, double to) {
        return from + (to - from) * double(m_random() >> 11U) * 0x1p-53;
    }

    const Heightfield& m_field;
    const Box& m_box;
    std::mt19937_64 m_random;
};

HeightfieldHit oracle(const Heightfield& field, const Ray& ray) {
    return traceReference(field.grid, field.topCenter, field.centerSpans, ray);
}

bool sameBits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

Box boxOf(const Heightfield& field) {
    Box box;
    for (const float height : field.topCenter) {
        if (std::isfinite(height))
            box.add({field.grid.x0, field.grid.y0, double(height)});
    }
    if (box.empty())
        box.add({field.grid.x0, field.grid.y0, 0.0});
    box.add({field.grid.xMax(), field.grid.yMax(), box.max.z + 0.1 * box.size().z});
    return box;
}

}  // namespace

bool isOracles(const Heightfield& field, const Ray& ray, double t) {
    const HeightfieldHit expected = oracle(field, ray);
    return expected.hit ? sameBits(t, expected.t) : t == std::numeric_limits<double>::infinity();
}

std::size_t randomMismatches(const HeightfieldTracer& tracer, const Heightfield& field,
                             std::size_t rays, const JobContext& job) {
    const Box box = boxOf(field);
    std::atomic<std::size_t> mismatches = 0;
    std::atomic<std::size_t> done = 0;
    const std::size_t parts = (rays + kRaysAtOnce - 1) / kRaysAtOnce;
    parallelFor(0, parts, 1, [&](std::size_t first, std::size_t last) {
        for (; first < last && !job.cancelled(); ++first) {
            RandomRays random(field, box, first);
            std::vector<Ray> some(std::min(kRaysAtOnce, rays - first * kRaysAtOnce));
            for (std::size_t k = 0; k < some.size(); ++k)
                some[k] = random.next(k);
            std::vector<HeightfieldHit> hits(some.size());
            tracer.trace(some, hits);
            for (std::size_t k = 0; k < some.size(); ++k) {
                const HeightfieldHit expected = oracle(field, some[k]);
                mismatches += hits[k] == expected && sameBits(hits[k].t, expected.t) ? 0 : 1;
            }
            job.progress(double(++done) / double(parts));
        }
    });
    return mismatches;
}

}  // namespace reflet
