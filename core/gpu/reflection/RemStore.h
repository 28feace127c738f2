// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment/RemSet.h"
#include "core/gpu/base/GlObjects.h"

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace reflet {

/// Reference environment maps on the GPU, in one cube-map array for each resolution. A map is
/// uploaded when it is first asked for, and stays while its RemSet holds it and the budget lasts;
/// the one that was longest unused gives way.
///
/// Texels are RGBA16F: radiance rounded to 11 significant bits (a relative error of at most 2^-11;
/// above 65504 clipped) and the distance in the same way, +infinity for sky.
class RemStore {
public:
    static constexpr std::size_t kUsualBudget = std::size_t(1) << 30U;  ///< bytes

    explicit RemStore(std::size_t budget = kUsualBudget) : m_budget(budget) {}

    /// Forgets maps that the set does not hold; those in common stay where they are.
    void setRems(const RemSet& rems);

    struct Place {
        unsigned texture = 0;  ///< a cube-map array; 0 when no map was asked for
        int cube = 0;          ///< its element
    };
    /// Where two maps are, until the next call; either may be null.
    struct Pair {
        Place a, b;
    };
    [[nodiscard]] Pair places(const RemSet::Pointer& a, const RemSet::Pointer& b);

    [[nodiscard]] std::size_t bytes() const;                         ///< of all arrays
    [[nodiscard]] std::size_t uploads() const { return m_uploads; }  ///< ever made

private:
    struct Slot {
        RemSet::Pointer map;  ///< null: free
        std::uint64_t lastUse = 0;
    };
    struct Array {
        Texture texture;
        std::vector<Slot> slots;
    };

    [[nodiscard]] std::size_t slotOf(const RemSet::Pointer& map);
    [[nodiscard]] std::size_t freeSlot(Array& array, int resolution);
    void grow(Array& array, int resolution, std::size_t cubes);
    void upload(const Array& array, std::size_t slot, const ReferenceEnvironmentMap& map);

    std::size_t m_budget;
    std::map<int, Array> m_arrays;  ///< by resolution
    std::uint64_t m_clock = 0;
    std::size_t m_uploads = 0;
};

/// Six faces as RGBA floats for an upload: radiance and distance. Both of one resolution.
[[nodiscard]] std::vector<float> rgbaTexels(const CubeMap<glm::vec3>& radiance,
                                            const CubeMap<float>& distance);

}  // namespace reflet
