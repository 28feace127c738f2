// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"
#include "core/math/Geometry.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace reflet {

/// A coordinate reference system, its horizontal and vertical parts kept apart. Immutable; copies
/// are cheap. Axis order of everything here is always (east, north, up) or (lon, lat, up).
class Crs {
public:
    /// Reads EPSG:n, EPSG:n+m, OGC URLs and URNs, compound URNs, the German urn:adv names, old
    /// epsg.xml#n references and WKT, in any thread. Anything else (names, PROJ strings, a height
    /// system alone, engineering systems): Refused, with the spelling that would work.
    /// An ellipsoidal height is dropped (EPSG:4979 becomes 4326 without a vertical part), and WKT
    /// that says the same as an EPSG entry becomes that entry.
    [[nodiscard]] static Result<Crs> parse(std::string_view text);

    /// "EPSG:n" of the horizontal part (another authority's code where EPSG has none); the WKT2
    /// when it has no code. parse() reads it back. Equal texts mean the same horizontal CRS.
    [[nodiscard]] const std::string& horizontal() const;
    /// "EPSG:n" of the vertical part, if there is one.
    [[nodiscard]] const std::optional<std::string>& vertical() const;
    /// Name for people, e.g. "Amersfoort / RD New + NAP height".
    [[nodiscard]] const std::string& name() const;
    [[nodiscard]] bool isGeographic() const;
    [[nodiscard]] bool isGeocentric() const;
    [[nodiscard]] bool isProjected() const;
    /// Metres per unit of the horizontal axes (1 for metres); 0 for degrees.
    [[nodiscard]] double metresPerUnit() const;
    /// True when the CRS's published area of use, grown by a tenth, contains (east, north) of its
    /// own axes; true as well when no area is known.
    [[nodiscard]] bool areaContains(double east, double north) const;
    /// WKT2:2019 text of the horizontal (or compound, when a vertical part is known) CRS.
    [[nodiscard]] std::string wkt() const;

    struct Impl;
    explicit Crs(std::shared_ptr<const Impl> impl) : m_impl(std::move(impl)) {}
    [[nodiscard]] const Impl& impl() const { return *m_impl; }

private:
    std::shared_ptr<const Impl> m_impl;
};

/// A horizontal transformation between two CRSs; z is passed through. Never a ballpark operation,
/// never a grid from the network. From a geocentric CRS, z becomes the height above the target's
/// ellipsoid. One object serves one thread at a time, not always the one that made it; making one
/// takes PROJ some 10 ms, so keep it for many points.
class CrsTransform {
public:
    /// Refused when PROJ knows only a ballpark operation or none, and when `to` is geocentric. The
    /// same horizontal CRS on both sides is no operation at all: points come back bit by bit.
    [[nodiscard]] static Result<CrsTransform> create(const Crs& from, const Crs& to);
    /// Transforms (east, north) in place; z is untouched. Refused when a point is not finite, has
    /// no image, or when the outermost points do not come back by the inverse (10 m, 0.0001
    /// degrees); the points are then as they were.
    [[nodiscard]] Result<void> apply(std::vector<glm::dvec3>& points) const;
    [[nodiscard]] Result<glm::dvec3> apply(const glm::dvec3& point) const;
    /// PROJ's name of the operation used last, and its accuracy in metres (negative: unknown).
    /// Before the first point: of the operation in the middle of the source's area of use.
    [[nodiscard]] const std::string& operationName() const;
    [[nodiscard]] double accuracy() const;

    CrsTransform(CrsTransform&&) noexcept;
    CrsTransform& operator=(CrsTransform&&) noexcept;
    ~CrsTransform();

private:
    struct Impl;
    explicit CrsTransform(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

/// Version of the PROJ library and whether its database opens, for `doctor`.
struct ProjStatus {
    std::string version;
    std::string databasePath;
    bool databaseOpens = false;
};
[[nodiscard]] ProjStatus projStatus();

}  // namespace reflet
