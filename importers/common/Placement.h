// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "core/geo/Crs.h"
#include "core/geo/ProjectFrame.h"
#include "importers/ImportTypes.h"
#include "importers/common/Extent.h"
#include "importers/common/SourceCity.h"
#include "importers/common/SourceCrs.h"

#include <optional>
#include <string>
#include <vector>

namespace reflet::importers {

/// Brings the coordinates of a file into the project frame.
///
/// In the frame's own CRS there is no transformation, only number * scale + (translate - origin) in
/// double. Otherwise PROJ transforms east and north and the height travels beside them. Coordinates
/// are rounded to 1 mm, or, where the file has an integer grid of its own, to 1 µm: that leaves the
/// grid alone and takes away the rounding of the sum, so that a scene has the same bits wherever on
/// the Earth it lies.
class Placement {
public:
    /// `extent` tells where the used points lie (east, north, up in the CRS); Refused with a remedy
    /// when there is no way into the frame.
    [[nodiscard]] static Result<Placement> create(SourceCrs crs, const Extent& extent,
                                                  const ImportOptions& options,
                                                  const std::string& subject,
                                                  std::vector<Diagnostic>& diagnostics);

    [[nodiscard]] const ProjectFrame& frame() const { return m_frame; }
    /// PROJ's operation into the frame's CRS; empty when there is none.
    [[nodiscard]] const std::string& operation() const { return m_operation; }
    /// Metres; nullopt = unknown.
    [[nodiscard]] std::optional<double> accuracy() const { return m_accuracy; }
    /// All vertices of the file in the frame; NaN where there is no image. `source` are the same in
    /// the file's CRS and order; with `swapAxes`, both have north first.
    [[nodiscard]] Result<std::vector<glm::dvec3>> vertices(const SourceCity& file,
                                                           const std::vector<glm::dvec3>& source,
                                                           bool swapAxes,
                                                           const JobContext& job) const;
    /// Where the points `anchor + offset` come to lie. Offsets are in the units of the source CRS;
    /// in a geographic one they are metres along the frame's axes.
    [[nodiscard]] Result<void> placeAround(const glm::dvec3& sourceAnchor,
                                           const glm::dvec3& localAnchor,
                                           std::vector<glm::dvec3>& offsets) const;

private:
    Placement() = default;
    [[nodiscard]] Result<void> chooseFrame(const ImportOptions& options, const glm::dvec3& centre,
                                           const std::string& subject,
                                           std::vector<Diagnostic>& diagnostics);
    [[nodiscard]] Result<void> into(const std::string& crs, const std::string& subject);
    [[nodiscard]] Result<std::string> metricCrs(const glm::dvec3& centre) const;
    void nameOperation(const glm::dvec3& centre);
    [[nodiscard]] Result<void> transform(std::vector<glm::dvec3>& points) const;

    std::optional<Crs> m_source;
    std::optional<Crs> m_target;  ///< only if the points must be transformed
    ProjectFrame m_frame;
    double m_heightUnit = 1.0;  ///< metres
    std::string m_operation;
    std::optional<double> m_accuracy;
};

}  // namespace reflet::importers
