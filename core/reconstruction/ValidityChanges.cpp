// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reconstruction/ValidityChanges.h"

#include "core/base/ParallelFor.h"
#include "core/environment/CubeDirection.h"
#include "core/reconstruction/MemVertexTracer.h"

#include <bit>
#include <cassert>
#include <mutex>

namespace reflet {

namespace {
constexpr std::size_t kRowsPerTask = 4;
}

ValidityChanges& ValidityChanges::operator+=(const ValidityChanges& other) {
    texels += other.texels;
    changedTexels += other.changedTexels;
    decisions += other.decisions;
    changedDecisions += other.changedDecisions;
    return *this;
}

ValidityChanges validityChanges(const ReconstructionInput& input, const RemSet& other,
                                const glm::dvec3& position, const MemSettings& settings) {
    assert(input.tracer && input.rems.size() == other.size());
    const RemCandidates candidates = input.candidates(position, settings);
    const ReconstructionInput otherInput{input.tracer, other, input.sceneDiameter, nullptr};
    const MemVertexTracer tracer(input, candidates, position, false);
    const MemVertexTracer otherTracer(otherInput, candidates, position, false);
    const int n = settings.resolution;
    std::mutex mutex;
    ValidityChanges sum;
    parallelFor(0, 6 * std::size_t(n), kRowsPerTask, [&](std::size_t first, std::size_t last) {
        ValidityChanges part;
        for (std::size_t line = first; line < last; ++line) {
            for (int column = 0; column < n; ++column) {
                const glm::dvec3 direction = texelDirection(n, int(line / std::size_t(n)), column,
                                                            int(line % std::size_t(n)));
                const MemVertex mine = tracer.trace(direction);
                const MemVertex theirs = otherTracer.trace(direction);
                const unsigned both = mine.tested & theirs.tested;
                const auto changed =
                    std::size_t(std::popcount((mine.seenBy ^ theirs.seenBy) & both));
                part += {1, changed > 0 ? std::size_t(1) : 0, std::size_t(std::popcount(both)),
                         changed};
            }
        }
        const std::lock_guard lock(mutex);
        sum += part;
    });
    return sum;
}

}  // namespace reflet
