// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/reflection/SightTable.h"

#include "core/reconstruction/MemVertexTracer.h"

#include <epoxy/gl.h>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>

namespace reflet {

namespace {

constexpr unsigned kRems = 14;
constexpr unsigned kDistances = 17;
constexpr unsigned kCandidatesBinding = 3;

/// std140, as in the shader.
struct Table {
    std::array<glm::vec4, kMostCandidates> center{};  ///< C − P; presence
    std::array<glm::ivec4, kMostCandidates>
        place{};  ///< which array, its element, resolution, blocks
};

}  // namespace

void SightTable::bind(const Program& program, const HeightfieldTable& field, RemStore& store,
                      const RemSet& rems, const RemCandidates& candidates,
                      const glm::dvec3& position, bool refineHits) {
    std::vector<RemSet::Pointer> maps;
    for (const RemCandidate& candidate : candidates.rems)
        maps.push_back(rems.pointers()[candidate.rem]);
    const std::vector<RemStore::Place> places = store.places(maps);
    std::vector<unsigned> arrays, distances;
    Table table;
    int count = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (places[i].texture == 0)
            continue;
        auto array = std::find(arrays.begin(), arrays.end(), places[i].texture);
        if (array == arrays.end()) {
            array = arrays.insert(array, places[i].texture);
            distances.push_back(places[i].distances);
        }
        const auto k = std::size_t(count++);
        table.center[k] =
            glm::vec4(glm::vec3(maps[i]->center - position), float(candidates.rems[i].presence));
        table.place[k] = {int(array - arrays.begin()), places[i].cube,
                          maps[i]->radiance.resolution(), places[i].distances != 0 ? 1 : 0};
    }
    m_candidates.writeGrowing(sizeof table, &table);
    m_candidates.bindBase(GL_UNIFORM_BUFFER, kCandidatesBinding);
    for (std::size_t k = 0; k < kArrays && !arrays.empty(); ++k) {
        const std::size_t array = std::min(k, arrays.size() - 1);
        glBindTextureUnit(kRems + unsigned(k), arrays[array]);
        glBindTextureUnit(kDistances + unsigned(k), distances[array]);
    }
    field.bind(program, position);
    program.set("candidates", count);
    program.set("weighAsInPaper", int(candidates.weighting == Weighting::AsInPaper));
    program.set("tolerance", float(validityTolerance(field.grid())));
    program.set("reach", refineHits ? float(refinementReach(field.grid())) : 0.0F);
}

}  // namespace reflet
