// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/environment/DistanceBlocks.h"

#include "core/base/ParallelFor.h"
#include "core/environment/CubeDirection.h"
#include "core/environment/DistanceBudget.h"
#include "core/math/Geometry.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace reflet {

using namespace distance_forms;

namespace {

/// What the words say of a texel.
class WordReader {
public:
    explicit WordReader(const DistanceBlocks& blocks)
        : m_words(blocks.words), m_edge(DistanceBlocks::blocksAlong(blocks.resolution)) {}

    /// 1/z of a texel of a face; 0 for sky.
    [[nodiscard]] float inverseDepth(int face, int column, int row) const {
        const auto index = std::size_t((face * m_edge + row / 4) * m_edge + column / 4);
        const std::uint64_t block = m_words[index / 2] >> (index % 2 == 0 ? 0U : 32U);
        const int x = column % 4;
        const int y = row % 4;
        const unsigned texel = unsigned(4 * y + x);
        switch (formOf(block)) {
            case Form::Plane:
                return at(referenceOf(block, 2), x, y);
            case Form::Shared: {
                const unsigned first = entryOf(block);
                switch (bitsOf(entry(first), 2U * texel, 2)) {
                    case 0:
                        return at(referenceOf(entry(first), 32), x, y);
                    case 1:
                        return at(referenceOf(entry(first + 1U), 0), x, y);
                    case 2:
                        return at(referenceOf(entry(first + 1U), 32), x, y);
                    default:
                        return 0.0f;
                }
            }
            case Form::Listed:
                return fromSmallFloat(
                    bitsOf(entry(entryOf(block) + unsigned(y)), 16U * unsigned(x), 16),
                    kListedMantissa);
            case Form::Rough:
                break;
        }
        return roughPlaneOf(block).at(float(x) - 1.5f, float(y) - 1.5f);
    }

private:
    [[nodiscard]] std::uint64_t entry(unsigned index) const {
        return m_words[std::min(m_words.size() / 2 + index, m_words.size() - 1)];
    }
    [[nodiscard]] float at(const Reference& reference, int x, int y) const {
        return planeOf(entry(reference.entry))
            .at(float(x - 4 * reference.columns) - 1.5f, float(y - 4 * reference.rows) - 1.5f);
    }

    const std::vector<std::uint64_t>& m_words;
    int m_edge;
};

/// Gives out entries and writes the words.
class WordWriter {
public:
    WordWriter(const std::vector<DistanceFacePlan>& faces, DistanceBlocks& out)
        : m_faces(faces),
          m_budget(faces, std::min(out.words.size() / 2, std::size_t(1) << kEntryBits)),
          m_out(out) {}

    void write() {
        for (std::size_t face = 0; face < m_faces.size(); ++face) {
            writePlanes(face);
            for (std::size_t i = 0; i < m_faces[face].blocks().size(); ++i) {
                const std::size_t place = face * m_faces[face].blocks().size() + i;
                m_out.words[place / 2] |= blockOf(face, i) << (place % 2 == 0 ? 0U : 32U);
            }
        }
    }

private:
    unsigned addEntry(std::uint64_t bits) {
        m_out.words[m_out.words.size() / 2 + m_entries] = bits;
        return unsigned(m_entries++);
    }

    void writePlanes(std::size_t face) {
        const auto& planes = m_faces[face].planes();
        m_planeEntries.assign(planes.size(), 0);
        for (std::size_t i = 0; i < planes.size(); ++i) {
            if (m_budget.hasPlane[face][i] != 0)
                m_planeEntries[i] = addEntry(planeEntry(planes[i].plane));
        }
    }

    [[nodiscard]] std::uint64_t reference(std::size_t face, std::size_t block,
                                          std::size_t plane) const {
        const auto& target = m_faces[face].planes()[plane];
        const int edge = m_faces[face].edge();
        return referenceBits({target.column - int(block) % edge, target.row - int(block) / edge,
                              m_planeEntries[plane]});
    }

    std::uint64_t blockOf(std::size_t face, std::size_t index) {
        const DistanceFacePlan::Block& block = m_faces[face].blocks()[index];
        const Form form = m_budget.form[face][index];
        switch (form) {
            case Form::Plane:
                return std::uint64_t(form) | (reference(face, index, *block.plane) << 2U);
            case Form::Shared: {
                std::array<std::uint64_t, 3> references{};
                for (std::size_t k = 0; k < block.mixture->planes.size(); ++k)
                    references[k] = reference(face, index, block.mixture->planes[k]);
                const unsigned first =
                    addEntry(std::uint64_t(block.mixture->indices) | (references[0] << 32U));
                addEntry(references[1] | (references[2] << 32U));
                return blockBits(form, first);
            }
            case Form::Listed: {
                const int edge = m_faces[face].edge();
                const DistanceTexels texels =
                    m_faces[face].texels(int(index) % edge, int(index) / edge);
                const unsigned first = addEntry(texels.listedRow(0));
                for (std::size_t row = 1; row < 4; ++row)
                    addEntry(texels.listedRow(row));
                return blockBits(form, first);
            }
            case Form::Rough:
                break;
        }
        return block.rough;
    }

    const std::vector<DistanceFacePlan>& m_faces;
    DistanceBudget m_budget;
    DistanceBlocks& m_out;
    std::vector<unsigned> m_planeEntries;  ///< of the face that is being written
    std::size_t m_entries = 0;
};

}  // namespace

DistanceBlocks encodeDistances(const CubeMap<float>& distances) {
    const auto edge = std::size_t(DistanceBlocks::blocksAlong(distances.resolution()));
    DistanceBlocks out{distances.resolution(), std::vector<std::uint64_t>(6 * edge * edge)};
    std::array<std::optional<DistanceFacePlan>, 6> plans;
    parallelFor(0, plans.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t face = first; face < last; ++face)
            plans[face].emplace(distances, int(face));
    });
    std::vector<DistanceFacePlan> faces;
    for (auto& plan : plans)
        faces.push_back(std::move(*plan));
    WordWriter(faces, out).write();
    return out;
}

CubeMap<float> decodeDistances(const DistanceBlocks& blocks) {
    const int n = blocks.resolution;
    const WordReader reader(blocks);
    CubeMap<float> out(n);
    parallelFor(0, 6 * std::size_t(n), 8, [&](std::size_t first, std::size_t last) {
        for (std::size_t line = first; line < last; ++line) {
            const int face = int(line) / n;
            const int row = int(line) % n;
            for (int column = 0; column < n; ++column) {
                const float inverse = reader.inverseDepth(face, column, row);
                const double length = glm::length(texelDirection(n, face, column, row));
                out.at(face, column, row) = inverse > 0.0f ? float(length) / inverse : kInfinity;
            }
        }
    });
    return out;
}

}  // namespace reflet
