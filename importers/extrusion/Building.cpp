// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/extrusion/Building.h"

#include <cmath>
#include <cstddef>

namespace reflet::extrusion {

namespace {

using namespace importers;

constexpr std::uint32_t kFlatLod = 0, kRoofLod = 1;

class PieceMaker {
public:
    PieceMaker(CityPiece& piece, const MetricScale& metres) : m_piece(piece), m_metres(metres) {}

    void add(std::uint32_t object, const PlanPolygon& polygon, const Levels& levels,
             const Roof& roof) {
        const glm::dvec2 origin = polygon.rings.front().front();
        const glm::dvec2 scale = m_metres.at(origin);
        const Extruded made = extruded(inMetres(polygon, origin, scale), levels, roof);
        const auto first = std::uint32_t(m_piece.file.vertices.size());
        for (const glm::dvec3& p : made.solid.points) {
            m_piece.file.vertices.emplace_back(origin + glm::dvec2(p) / scale,
                                               p.z / m_metres.heightUnit());
        }
        for (const Face& face : made.solid.faces)
            addFace(object, face, first);
        if (made.made != roof.shape && levels.top > levels.eaves)
            m_piece.report.note(object, Issue::RoofSimplified);
    }
    void finish() {
        m_piece.geometry.usedBySurface.assign(m_piece.file.vertices.size(), true);
        m_piece.geometry.templateBegin = {0};  // there are none
    }

private:
    void addFace(std::uint32_t object, const Face& face, std::uint32_t first) {
        SurfaceSoup& soup = m_piece.geometry.surfaces;
        SurfaceSoup::Surface surface;
        surface.owner = object;
        surface.type = face.type;
        surface.firstRing = std::uint32_t(soup.ringEnds.size());
        surface.ringCount = std::uint32_t(face.rings.size());
        std::size_t points = 0;
        for (const auto& ring : face.rings) {
            for (const std::uint32_t point : ring)
                soup.points.push_back(first + point);
            soup.ringEnds.push_back(std::uint32_t(soup.points.size()));
            points += ring.size();
        }
        soup.surfaces.push_back(surface);
        ++m_piece.geometry.writtenSurfaces;
        m_piece.geometry.writtenTriangles += nominalTriangles(points, face.rings.size());
    }

    CityPiece& m_piece;
    const MetricScale& m_metres;
};

bool hasRoof(const Building& building) {
    return building.roof.shape != RoofShape::Flat && building.levels.top > building.levels.eaves;
}

SourceCity outlinesOf(std::vector<Building>& buildings) {
    SourceCity file;
    file.lodNames = {"1", "2"};
    for (Building& building : buildings) {
        ObjectOutline& outline = building.outline;
        outline.firstGeometry = std::uint32_t(file.geometries.size());
        outline.geometryCount = building.polygons.empty() ? 0 : 1;
        outline.aboveGround = building.aboveGround;
        outline.explained = building.polygons.empty() && !building.notes.empty();
        if (!building.polygons.empty()) {
            file.geometries.push_back(
                {building.polygons.size() == 1 ? GeometryType::Solid : GeometryType::MultiSolid,
                 {},
                 hasRoof(building) ? kRoofLod : kFlatLod,
                 kNone});
        }
        file.objects.push_back(std::move(outline));
    }
    return file;
}

}  // namespace

MetricScale::MetricScale(const std::optional<Crs>& crs)
    : m_degrees(crs && crs->isGeographic()),
      m_unit(crs && crs->isProjected() ? crs->metresPerUnit() : 1.0) {}

/// Radii of curvature of the WGS 84 ellipsoid: of the parallel and of the meridian.
glm::dvec2 MetricScale::at(const glm::dvec2& place) const {
    if (!m_degrees)
        return glm::dvec2(m_unit);
    constexpr double kMajor = 6378137.0, kEccentricity2 = 6.69437999014e-3;
    constexpr double kNearPole = 89.9;  // where a degree of longitude means nothing
    const double latitude = std::min(std::abs(place.y), kNearPole) * kPi / 180.0;
    const double w2 = 1.0 - kEccentricity2 * std::sin(latitude) * std::sin(latitude);
    const double east = kMajor / std::sqrt(w2) * std::cos(latitude);
    const double north = kMajor * (1.0 - kEccentricity2) / (w2 * std::sqrt(w2));
    return glm::dvec2(east, north) * (kPi / 180.0);
}

PlanPolygon inMetres(const PlanPolygon& polygon, const glm::dvec2& origin,
                     const glm::dvec2& metres) {
    PlanPolygon local = polygon;
    for (auto& ring : local.rings) {
        for (glm::dvec2& p : ring)
            p = (p - origin) * metres;
    }
    return local;
}

CityPiece pieceOf(CityBuilder& builder, std::vector<Building> buildings,
                  const MetricScale& metres) {
    CityPiece piece = builder.begin(outlinesOf(buildings));
    PieceMaker maker(piece, metres);
    for (std::uint32_t i = 0; i < buildings.size(); ++i) {
        const Building& building = buildings[i];
        for (const auto& [issue, detail] : building.notes)
            piece.report.note(i, issue, detail);
        const ObjectOutline& outline = piece.file.objects[i];
        if (outline.geometryCount == 0 || !piece.chosen[outline.firstGeometry])
            continue;
        for (const PlanPolygon& polygon : building.polygons)
            maker.add(i, polygon, building.levels, building.roof);
    }
    maker.finish();
    return piece;
}

}  // namespace reflet::extrusion
