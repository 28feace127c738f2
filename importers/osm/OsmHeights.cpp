// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/osm/OsmHeights.h"

#include "importers/extrusion/Lengths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace reflet::osm {

namespace {

using namespace extrusion;

constexpr double kSlab = 0.3;      // metres: the thickness of a canopy
constexpr double kCanopy = 4.0;    // metres: its height where nothing tells it
constexpr double kThinnest = 0.1;  // metres of a building
constexpr double kPitch = 30.0 * kPi / 180.0;

bool isOneOf(std::string_view value, std::initializer_list<std::string_view> values) {
    return std::find(values.begin(), values.end(), value) != values.end();
}

std::string_view kindOf(const Tags& tags) {
    return tags.first({"building:part", "building"});
}

bool isCanopy(const Tags& tags) {
    return isOneOf(kindOf(tags), {"roof", "carport", "canopy"});
}

bool isLow(const Tags& tags) {
    return isOneOf(kindOf(tags), {"garage", "garages", "shed", "hut", "kiosk", "cabin", "toilets",
                                  "static_caravan", "greenhouse", "bungalow", "guardhouse"});
}

class ShapeReader {
public:
    ShapeReader(const Tags& tags, const PlanPolygon& metres, double defaultHeight)
        : m_tags(tags), m_metres(metres), m_default(defaultHeight) {}

    OsmShape read() {
        readRoof();
        const double rise = roofRise();
        const auto height = length({"height", "building:height", "est_height"});
        const auto storeys = count({"building:levels", "levels"});
        Levels& levels = m_shape.levels;
        if (height && *height > 0.0) {
            levels.top = *height;
        } else if (storeys && *storeys > 0.0) {
            levels.top = *storeys * kStorey + rise;
        } else {
            m_shape.assumed = true;
            levels.top = isCanopy(m_tags) ? kCanopy : (isLow(m_tags) ? kStorey : m_default);
        }
        levels.bottom = bottom();
        levels.eaves = std::max(levels.bottom, levels.top - std::min(rise, risesAtMost(rise)));
        if (isCanopy(m_tags) && levels.bottom == 0.0)
            levels.bottom = std::max(0.0, levels.eaves - kSlab);
        return m_shape;
    }

private:
    std::optional<double> length(std::initializer_list<std::string_view> keys) {
        return told(m_tags.first(keys), [](std::string_view text) { return parseLength(text); });
    }
    std::optional<double> count(std::initializer_list<std::string_view> keys) {
        return told(m_tags.first(keys), [](std::string_view text) { return parseStoreys(text); });
    }
    template <class Parse>
    std::optional<double> told(std::string_view text, const Parse& parse) {
        if (text.empty())
            return std::nullopt;
        const auto value = parse(text);
        m_shape.unreadable = m_shape.unreadable || !value;
        return value;
    }

    void readRoof() {
        const std::string_view name = m_tags.first({"roof:shape", "building:roof:shape"});
        const auto shape = roofShape(name);
        m_shape.unknownRoof = !name.empty() && !shape;
        m_shape.roof.shape = shape.value_or(RoofShape::Flat);
        m_shape.roof.ridgeAcross = m_tags["roof:orientation"] == "across";
        if (const auto degrees = direction(m_tags["roof:direction"]))
            m_shape.roof.slopesTo = *degrees * kPi / 180.0;
    }

    /// Clockwise from north, in degrees: a number, or a point of the compass.
    static std::optional<double> direction(std::string_view text) {
        static constexpr std::array<std::string_view, 16> kPoints{
            "N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE",
            "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW"};
        const auto point = std::find(kPoints.begin(), kPoints.end(), text);
        if (point != kPoints.end())
            return 22.5 * double(point - kPoints.begin());
        return parseLength(text);
    }

    /// Metres from the eaves to the top, 0 for flat roofs.
    double roofRise() {
        if (m_shape.roof.shape == RoofShape::Flat)
            return 0.0;
        if (const auto height = length({"roof:height"}); height && *height > 0.0)
            return *height;
        if (const auto storeys = count({"roof:levels"}); storeys && *storeys > 0.0)
            return *storeys * kStorey;
        const double half = halfSpan(m_metres, m_shape.roof.ridgeAcross);
        const double span = m_shape.roof.shape == RoofShape::Skillion ? 2.0 * half : half;
        const auto angle = length({"roof:angle"});
        constexpr double kSteepest = 80.0;  // degrees
        if (angle && *angle > 0.0 && *angle <= kSteepest)
            return span * std::tan(*angle * kPi / 180.0);
        m_guessed = true;
        constexpr double kHighest = 2.0 * kStorey;
        return std::min(span * std::tan(kPitch), kHighest);
    }

    /// A rise that nobody has told must leave walls.
    [[nodiscard]] double risesAtMost(double rise) const {
        const double whole = m_shape.levels.top - m_shape.levels.bottom;
        return m_guessed ? 0.5 * whole : std::min(rise, whole);
    }

    double bottom() {
        const auto metres = length({"min_height", "building:min_height"});
        const auto storeys = count({"building:min_level"});
        const double bottom = metres ? *metres : storeys.value_or(0.0) * kStorey;
        const bool sound = bottom >= 0.0 && bottom < m_shape.levels.top - kThinnest;
        m_shape.unreadable = m_shape.unreadable || !sound;
        return sound ? bottom : 0.0;
    }

    const Tags& m_tags;
    const PlanPolygon& m_metres;
    double m_default;
    bool m_guessed = false;
    OsmShape m_shape;
};

bool says(std::string_view value) {
    return !value.empty() && value != "no";
}

}  // namespace

bool isBuilding(const Tags& tags) {
    return says(tags["building"]);
}

bool isBuildingPart(const Tags& tags) {
    return says(tags["building:part"]);
}

bool isUnderground(const Tags& tags) {
    return tags["location"] == "underground" || tags["parking"] == "underground" ||
           (tags["building:levels"] == "0" && tags["height"].empty() &&
            says(tags["building:levels:underground"]));
}

OsmShape shapeOf(const Tags& tags, const PlanPolygon& metres, double defaultHeight) {
    return ShapeReader(tags, metres, defaultHeight).read();
}

}  // namespace reflet::osm
