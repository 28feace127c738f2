// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/coverage/Demand.h"
#include "core/environment/RemSet.h"
#include "core/heightfield/HeightfieldTracer.h"

#include <vector>

namespace reflet {

/// How well a reference environment map at C shows what a vehicle at P sees at I (0..1), by what
/// the picture on the vehicle loses:
///
///   service = visible · min(1, 4/blur) · min(1, 4/shift), and 0 below kLeast or beyond kReach
///
/// - visible: 1 where the REM's distances say that it sees I, by the rule of the reconstruction
///   (isValid, isValidSky), else 0.
/// - blur: texels of a map at P that one texel of a REM at C covers on the surface:
///   |I − C| / |I − P| · √(cos at P / cos at C), angles to the surface's normal; from behind the
///   surface there is no service.
/// - shift: texels of the REM that the look-up is off by when I is known to half a cell of the
///   heightfield along the ray: δ · sin(angle at I between P and C) / (|I − C| · texel).
///
/// Four texels are free, because bodies are curved and shrink what they mirror. The sky is served
/// in full by a REM within reach that sees it in that direction.
struct ServiceRule {
    static constexpr double kFree = 4.0;    ///< texels of blur, and of shift, that cost nothing
    static constexpr double kLeast = 0.05;  ///< less is nothing
    static constexpr double kReach = 80.0;  ///< metres between P and C

    /// Of the REMs, texels along an edge; 0: that of each one's distances. Where distances are
    /// known more coarsely than radiance will be, it is that of the radiance.
    int resolution = 0;
    double tolerance = 0.0;   ///< metres, of visibility: validityTolerance() of the grid
    double depthError = 0.0;  ///< metres: half a cell

    explicit ServiceRule(const GridSpec& grid, int resolution = 0);
    /// What blur and shift leave. rem: its centre counts, and its resolution where the rule has
    /// none.
    [[nodiscard]] double likeness(const DemandSample& sample,
                                  const ReferenceEnvironmentMap& rem) const;
    /// The whole. rem: its centre and its distances count.
    [[nodiscard]] double service(const DemandSample& sample,
                                 const ReferenceEnvironmentMap& rem) const;
};

/// A REM that has no radiance: what one would see at a place, by rays through the heightfield.
/// resolution: texels along an edge; the rays go through their centres.
[[nodiscard]] ReferenceEnvironmentMap sightFrom(const HeightfieldTracer& tracer,
                                                const glm::dvec3& center, int resolution,
                                                std::string id = {});

/// The samples of a demand by where the vehicle stands, to find those within reach of a place.
class SampleIndex {
public:
    explicit SampleIndex(const Demand& demand);
    /// Numbers of the samples with |P − center| <= ServiceRule::kReach, in an order of the index's.
    [[nodiscard]] std::vector<std::uint32_t> within(const glm::dvec3& center) const;

private:
    const Demand& m_demand;
    double m_x0 = 0.0, m_y0 = 0.0;
    int m_columns = 0, m_rows = 0;
    std::vector<std::vector<std::uint32_t>> m_cells;
};

/// Which samples a place serves, and how well: a row of the table of services.
struct ServiceRow {
    struct Entry {
        std::uint32_t sample = 0;
        float service = 0.0F;  ///< above 0
    };
    std::vector<Entry> entries;  ///< each sample once, in an order that depends on nothing else
};

/// The row of a REM.
[[nodiscard]] ServiceRow serviceRow(const Demand& demand, const SampleIndex& index,
                                    const ServiceRule& rule, const ReferenceEnvironmentMap& rem);

}  // namespace reflet
