// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/io/VectorFile.h"
#include "importers/extrusion/Building.h"
#include "importers/footprints/FieldChoice.h"

#include <string>
#include <string_view>
#include <vector>

namespace reflet::footprints {

/// How many buildings told their height.
struct HeightTally {
    std::size_t buildings = 0;
    std::size_t assumed = 0;     ///< took the default
    std::size_t unreadable = 0;  ///< values that are no height
    std::string example;         ///< one of those

    void add(const HeightTally& more);
};

/// Reads the levels of the buildings of one layer.
class HeightReader {
public:
    HeightReader(FieldChoice choice, const ImportOptions& options);

    /// The fields to be read, in the order in which `read` expects their values.
    [[nodiscard]] const std::vector<std::size_t>& fields() const { return m_fields; }
    [[nodiscard]] std::string_view id(const AreaFeature& feature) const;
    /// Sets levels, roof and aboveGround.
    void read(const AreaFeature& feature, const extrusion::MetricScale& metres,
              extrusion::Building& building);

    [[nodiscard]] const HeightTally& tally() const { return m_tally; }
    [[nodiscard]] const std::string& described() const { return m_choice.described; }
    /// Metres.
    [[nodiscard]] static double defaultHeight(const ImportOptions& options);

private:
    [[nodiscard]] std::string_view value(const AreaFeature& feature,
                                         std::optional<std::size_t> field) const;
    [[nodiscard]] std::optional<double> length(const AreaFeature& feature,
                                               std::optional<std::size_t> field, double unit);
    [[nodiscard]] std::optional<double> height(const AreaFeature& feature, double unit);
    void readRoof(const AreaFeature& feature, double unit, extrusion::Building& building);

    FieldChoice m_choice;
    double m_default;
    std::vector<std::size_t> m_fields;
    HeightTally m_tally;
};

/// North and east exchanged.
[[nodiscard]] PlanPolygon turned(PlanPolygon polygon);

}  // namespace reflet::footprints
