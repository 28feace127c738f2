// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/footprints/FootprintHeights.h"

#include "importers/extrusion/Lengths.h"

#include <algorithm>
#include <utility>

namespace reflet::footprints {

using namespace extrusion;

void HeightTally::add(const HeightTally& more) {
    buildings += more.buildings;
    assumed += more.assumed;
    unreadable += more.unreadable;
    if (example.empty())
        example = more.example;
}

HeightReader::HeightReader(FieldChoice choice, const ImportOptions& options)
    : m_choice(std::move(choice)), m_default(defaultHeight(options)) {
    for (const auto& field :
         {m_choice.id, m_choice.height, m_choice.top, m_choice.base, m_choice.storeys,
          m_choice.lifted, m_choice.roofShape, m_choice.roofHeight}) {
        if (field)
            m_fields.push_back(*field);
    }
    std::sort(m_fields.begin(), m_fields.end());
    m_fields.erase(std::unique(m_fields.begin(), m_fields.end()), m_fields.end());
}

double HeightReader::defaultHeight(const ImportOptions& options) {
    return options.defaultHeight.value_or(kUnknownHeight);
}

std::string_view HeightReader::value(const AreaFeature& feature,
                                     std::optional<std::size_t> field) const {
    if (!field)
        return {};
    const auto found = std::lower_bound(m_fields.begin(), m_fields.end(), *field);
    return feature.values[std::size_t(found - m_fields.begin())];
}

std::string_view HeightReader::id(const AreaFeature& feature) const {
    return value(feature, m_choice.id);
}

std::optional<double> HeightReader::length(const AreaFeature& feature,
                                           std::optional<std::size_t> field, double unit) {
    const std::string_view text = value(feature, field);
    if (text.empty())
        return std::nullopt;
    const auto metres = parseLength(text, unit);
    if (!metres) {
        ++m_tally.unreadable;
        if (m_tally.example.empty())
            m_tally.example = text;
    }
    return metres;
}

std::optional<double> HeightReader::height(const AreaFeature& feature, double unit) {
    if (const auto metres = length(feature, m_choice.height, unit); metres && *metres > 0.0)
        return metres;
    if (m_choice.top && m_choice.base) {
        const auto top = length(feature, m_choice.top, unit);
        const auto base = length(feature, m_choice.base, unit);
        if (top && base && *top > *base)
            return *top - *base;
    }
    const auto storeys = parseStoreys(value(feature, m_choice.storeys));
    if (storeys && *storeys > 0.0)
        return *storeys * kStorey;
    return std::nullopt;
}

void HeightReader::read(const AreaFeature& feature, const MetricScale& metres, Building& building) {
    if (building.polygons.empty())
        return;
    ++m_tally.buildings;
    const double unit = metres.heightUnit();
    const auto told = height(feature, unit);
    m_tally.assumed += told ? 0 : 1;
    const double top = told.value_or(m_default);
    const double lifted = length(feature, m_choice.lifted, unit).value_or(0.0);
    building.levels = {lifted > 0.0 && lifted < top ? lifted : 0.0, top, top};
    readRoof(feature, unit, building);
    if (const auto base = length(feature, m_choice.base, unit)) {
        building.aboveGround = false;
        building.levels.bottom += *base;
        building.levels.eaves += *base;
        building.levels.top += *base;
    }
}

void HeightReader::readRoof(const AreaFeature& feature, double unit, Building& building) {
    const auto shape = roofShape(value(feature, m_choice.roofShape));
    const auto rise = length(feature, m_choice.roofHeight, unit);
    if (!shape || *shape == RoofShape::Flat || !rise || *rise <= 0.0)
        return;
    building.roof.shape = *shape;
    building.levels.eaves = std::max(building.levels.bottom, building.levels.top - *rise);
}

PlanPolygon turned(PlanPolygon polygon) {
    for (auto& ring : polygon.rings) {
        for (glm::dvec2& p : ring)
            std::swap(p.x, p.y);
    }
    return polygon;
}

}  // namespace reflet::footprints
