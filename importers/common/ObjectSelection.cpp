// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/ObjectSelection.h"

#include "importers/common/ObjectNames.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace reflet::importers {

namespace {

template <class Visit>
void forGeometriesOf(const ObjectOutline& object, const Visit& visit) {
    for (std::uint32_t g = object.firstGeometry; g < object.firstGeometry + object.geometryCount;
         ++g)
        visit(g);
}

/// The boxes of objects in the plane of the frame, from their surfaces and the anchors of their
/// instances.
std::vector<Box> objectBoxes(const CityGeometry& geometry, std::size_t objects,
                             const std::vector<glm::dvec3>& local) {
    std::vector<Box> boxes(objects);
    const auto add = [&](std::uint32_t object, std::uint32_t vertex) {
        if (!std::isnan(local[vertex].x))
            boxes[object].add(local[vertex]);
    };
    for (const SurfaceSoup::Surface& surface : geometry.surfaces.surfaces) {
        const std::uint32_t first = geometry.surfaces.firstPoint(surface);
        for (std::uint32_t i = 0; i < geometry.surfaces.pointCount(surface); ++i)
            add(surface.owner, geometry.surfaces.points[first + i]);
    }
    for (const InstanceRecord& instance : geometry.instances)
        add(instance.object, instance.anchor);
    return boxes;
}

/// An object and its surfaces are in the box together: no wall is cut out of a house.
void shareBoxes(const SourceCity& file, const ObjectTree& tree, std::vector<Box>& boxes) {
    const auto share = [&](std::uint32_t from, std::uint32_t to) {
        if (!boxes[from].empty()) {
            boxes[to].add(boxes[from].min);
            boxes[to].add(boxes[from].max);
        }
    };
    const auto bounds = [&](std::uint32_t i) {
        return file.objects[i].isBoundary && tree.parent[i] != kNone;
    };
    for (const std::uint32_t i : tree.childrenFirst) {
        if (bounds(i))
            share(i, tree.parent[i]);
    }
    for (auto i = tree.childrenFirst.rbegin(); i != tree.childrenFirst.rend(); ++i) {
        if (bounds(*i))
            share(tree.parent[*i], *i);
    }
}

bool touches(const Box& box, const std::array<double, 4>& bbox, const glm::dvec3& origin) {
    return !box.empty() && box.min.x + origin.x <= bbox[2] && box.max.x + origin.x >= bbox[0] &&
           box.min.y + origin.y <= bbox[3] && box.max.y + origin.y >= bbox[1];
}

}  // namespace

void noteOddObjects(const SourceCity& file, ImportReport& report) {
    for (std::uint32_t i = 0; i < file.objects.size(); ++i) {
        const ObjectOutline& object = file.objects[i];
        if (!object.isObject) {
            report.note(i, Issue::NotAnObject);
            continue;
        }
        if (object.duplicate)
            report.note(i, Issue::DuplicateId);
        if (object.typeName.empty())
            report.note(i, Issue::NoType);
        else if (!object.isKnown)
            report.note(i, Issue::UnknownType, fmt::format("{:.60}", object.typeName));
        if (object.badGeometry)
            report.note(i, Issue::BadGeometry, "\"geometry\" is no array");
        else if (object.geometryCount == 0 && !object.hasChildren && !object.explained &&
                 object.type != CityObjectType::Group)
            report.note(i, Issue::NoGeometry);

        bool surfaces = object.geometryCount == 0;
        forGeometriesOf(object, [&](std::uint32_t g) {
            const GeometryOutline& geometry = file.geometries[g];
            surfaces = surfaces || (geometry.type != GeometryType::MultiPoint &&
                                    geometry.type != GeometryType::MultiLineString);
            if (geometry.type == GeometryType::Unknown)
                report.note(i, Issue::UnknownGeometryType,
                            fmt::format("{:.60}", geometry.typeName));
        });
        if (!surfaces)
            report.note(i, Issue::NoSurfaces);
    }
}

std::vector<bool> selectGeometries(const SourceCity& file, const ObjectTree& tree,
                                   const ImportOptions& options, ImportReport& report,
                                   Tallies& tallies) {
    std::vector<bool> chosen = chooseGeometries(file, tree, options.lod);
    for (std::size_t g = 0; g < chosen.size(); ++g) {
        tallies.anyGeometry = true;
        tallies.anyChosen = tallies.anyChosen || chosen[g];
        tallies.lods.insert(file.lodNames[lodOf(file.geometries[g], file)]);
    }
    const std::vector<bool> wanted = objectsOfTypes(file.objects, tree, options.types);
    for (std::uint32_t i = 0; i < file.objects.size(); ++i) {
        if (!wanted[i]) {
            report.leaveOut(i);
            ++tallies.otherTypes;
        }
        if (!wanted[i] || report.fate(i) == Fate::Skipped)
            forGeometriesOf(file.objects[i], [&](std::uint32_t g) { chosen[g] = false; });
    }
    return chosen;
}

void leaveOutUnwanted(const SourceCity& file, const ObjectTree& tree, const CityGeometry& geometry,
                      const std::vector<bool>& chosen, const std::vector<glm::dvec3>& local,
                      const glm::dvec3& origin, const ImportOptions& options, ImportReport& report,
                      Tallies& tallies) {
    const bool oneLevel = isOneLevel(options.lod);
    if (!oneLevel && !options.bbox)
        return;
    std::vector<Box> boxes =
        options.bbox ? objectBoxes(geometry, file.objects.size(), local) : std::vector<Box>();
    if (options.bbox)
        shareBoxes(file, tree, boxes);
    std::vector<bool> shown(file.objects.size(), false);
    for (const std::uint32_t i : tree.childrenFirst) {
        bool atLevel = false;
        forGeometriesOf(file.objects[i], [&](std::uint32_t g) { atLevel = atLevel || chosen[g]; });
        const bool inBox = !options.bbox || touches(boxes[i], *options.bbox, origin);
        const bool itself = atLevel && inBox && !report.leftOut(i);
        const std::uint32_t parent = tree.parent[i];
        if ((itself || shown[i]) && parent != kNone)
            shown[parent] = true;
        if (itself || shown[i] || report.leftOut(i))
            continue;
        report.leaveOut(i);
        ++(atLevel || !oneLevel ? tallies.outOfBox : tallies.offLevel);
    }
}

void skipWhatShowsNothing(const SourceCity& file, const ObjectTree& tree,
                          const std::vector<bool>& chosen, const std::vector<bool>& showsSomething,
                          ImportReport& report) {
    std::vector<bool> shown = showsSomething;
    for (const std::uint32_t i : tree.childrenFirst) {
        if (shown[i] && file.objects[i].isBoundary && tree.parent[i] != kNone)
            shown[tree.parent[i]] = true;
    }
    for (std::uint32_t i = 0; i < file.objects.size(); ++i) {
        if (shown[i] || report.leftOut(i) || report.fate(i) == Fate::Skipped)
            continue;
        bool expected = file.objects[i].badGeometry;
        bool known = false;
        forGeometriesOf(file.objects[i], [&](std::uint32_t g) {
            expected = expected || (chosen[g] && !file.geometries[g].onlyReferences);
            known = known || file.geometries[g].type != GeometryType::Unknown;
        });
        if (expected || (file.objects[i].geometryCount > 0 && !known))
            report.note(i, Issue::NothingUsable);
    }
}

}  // namespace reflet::importers
