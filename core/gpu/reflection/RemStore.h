// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"
#include "core/environment/RemSet.h"
#include "core/gpu/base/GlObjects.h"
#include "core/gpu/reflection/RemCompressor.h"

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

namespace reflet {

/// How reference environment maps are kept on the GPU.
enum class RemMemory {
    /// What usualRemMemory() says.
    Automatic,
    /// RGBA16F: radiance rounded to 11 significant bits (a relative error of at most 2^-11; above
    /// 65504 clipped) and the distance in the same way, +infinity for sky. 8 bytes a texel.
    Plain,
    /// core/environment/CompressedMap: 1.5 bytes a texel; radiance at some 40 dB, distances right
    /// to 2 cm and 2 · 10^-4.
    Compressed,
};

/// What the environment variable REFLET_PROBE_MEMORY says ("plain" or "compressed"); where it is
/// unset or empty, Compressed, but Plain where the current context draws in software: that takes
/// blocks apart at each look. Usage for any other value, with those that it may have.
[[nodiscard]] Result<RemMemory> usualRemMemory();

/// Reference environment maps on the GPU, in one cube-map array for each resolution. A map is
/// uploaded when it is first asked for, and stays while its RemSet holds it and the budget lasts;
/// the one that was longest unused gives way. Maps are compressed on another thread once a set
/// holds them.
class RemStore {
public:
    static constexpr std::size_t kUsualBudget = std::size_t(1) << 30U;  ///< bytes

    /// With a current context. memory: not Automatic. budget: bytes.
    explicit RemStore(RemMemory memory, std::size_t budget = kUsualBudget);
    [[nodiscard]] bool compresses() const { return m_compressor != nullptr; }

    /// Forgets maps that the set does not hold; those in common stay where they are.
    void setRems(const RemSet& rems);

    struct Place {
        unsigned texture = 0;  ///< a cube-map array; 0 when no map was asked for
        int cube = 0;          ///< its element
        /// Where the distances are: words of DistanceBlocks in an array of GL_RG32UI with a layer
        /// for each cube, as wide as a face has blocks; 0: in the alpha of the texture.
        unsigned distances = 0;
    };
    /// Where two maps are, until the next call; either may be null.
    struct Pair {
        Place a, b;
    };
    [[nodiscard]] Pair places(const RemSet::Pointer& a, const RemSet::Pointer& b);
    /// The same for any number of maps, none of them null. Where the budget does not hold all of
    /// them at once, the first ones give way: their texture is 0.
    [[nodiscard]] std::vector<Place> places(std::span<const RemSet::Pointer> maps);

    [[nodiscard]] std::size_t bytes() const;                         ///< of all arrays
    [[nodiscard]] std::size_t uploads() const { return m_uploads; }  ///< ever made

private:
    struct Slot {
        RemSet::Pointer map;  ///< null: free
        std::uint64_t lastUse = 0;
    };
    struct Array {
        Texture texture;
        Texture distances;  ///< only where compressed
        std::vector<Slot> slots;
    };

    [[nodiscard]] std::size_t slotOf(const RemSet::Pointer& map);
    [[nodiscard]] std::size_t freeSlot(Array& array, int resolution);
    void grow(Array& array, int resolution, std::size_t cubes);
    void upload(const Array& array, std::size_t slot, const RemSet::Pointer& map);
    [[nodiscard]] std::size_t cubeBytes(int resolution) const;

    std::unique_ptr<RemCompressor> m_compressor;  ///< null: maps are kept as they are
    std::size_t m_budget;
    std::map<int, Array> m_arrays;  ///< by resolution
    std::uint64_t m_clock = 0;
    std::size_t m_uploads = 0;
};

}  // namespace reflet
