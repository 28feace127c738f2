// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/ObjectSelection.h"

#include "importers/common/ObjectNames.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace reflet::importers {

namespace {

bool isOneLevel(const std::string& lod) {
    return lod != "highest" && lod != "all" && !lod.empty();
}

template <class Visit>
void forGeometriesOf(const ObjectOutline& object, const Visit& visit) {
    for (std::uint32_t g = object.firstGeometry; g < object.firstGeometry + object.geometryCount;
         ++g)
        visit(g);
}

/// The levels at which objects have surfaces, for a message.
std::string presentLods(const SourceCity& file) {
    std::vector<std::string> names;
    for (const GeometryOutline& geometry : file.geometries) {
        const std::string& name = file.lodNames[lodOf(geometry, file)];
        if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end())
            names.push_back(name);
        constexpr std::size_t kEnough = 12;
        if (names.size() == kEnough)
            break;
    }
    std::sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
        return std::pair(lodRank(a), a) < std::pair(lodRank(b), b);
    });
    std::string list;
    for (const std::string& name : names)
        list += fmt::format("{}{:.20}", list.empty() ? "" : ", ", name);
    return list.empty() ? "none" : list;
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
        else if (!isKnownCityObjectType(object.typeName))
            report.note(i, Issue::UnknownType, fmt::format("{:.60}", object.typeName));
        if (object.badGeometry)
            report.note(i, Issue::BadGeometry, "\"geometry\" is no array");
        else if (object.geometryCount == 0 && !object.hasChildren &&
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

Result<std::vector<bool>> selectGeometries(const SourceCity& file, const ObjectTree& tree,
                                           const ImportOptions& options, const std::string& subject,
                                           ImportReport& report) {
    std::vector<bool> chosen = chooseGeometries(file, tree, options.lod);
    if (isOneLevel(options.lod) && !file.geometries.empty() &&
        std::find(chosen.begin(), chosen.end(), true) == chosen.end()) {
        return fail(ErrorCode::Usage,
                    fmt::format("has no geometry of level of detail {:.20}", options.lod), subject,
                    fmt::format("It has: {}.", presentLods(file)));
    }
    const std::vector<bool> wanted = objectsOfTypes(file.objects, tree, options.types);
    std::size_t others = 0;
    for (std::uint32_t i = 0; i < file.objects.size(); ++i) {
        if (!wanted[i]) {
            report.leaveOut(i);
            ++others;
        }
        if (!wanted[i] || report.fate(i) == Fate::Skipped)
            forGeometriesOf(file.objects[i], [&](std::uint32_t g) { chosen[g] = false; });
    }
    if (others > 0)
        report.file({Severity::Info, "filtered-by-type", "",
                     fmt::format("{} objects of other types were left out", others), ""});
    return chosen;
}

void leaveOutUnwanted(const SourceCity& file, const ObjectTree& tree, const CityGeometry& geometry,
                      const std::vector<bool>& chosen, const std::vector<glm::dvec3>& local,
                      const glm::dvec3& origin, const ImportOptions& options,
                      ImportReport& report) {
    const bool oneLevel = isOneLevel(options.lod);
    if (!oneLevel && !options.bbox)
        return;
    const std::vector<Box> boxes =
        options.bbox ? objectBoxes(geometry, file.objects.size(), local) : std::vector<Box>();
    std::vector<bool> shown(file.objects.size(), false);
    std::size_t byLevel = 0;
    std::size_t byBox = 0;
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
        ++(atLevel || !oneLevel ? byBox : byLevel);
    }
    if (byLevel > 0)
        report.file({Severity::Info, "filtered-by-lod", "",
                     fmt::format("{} objects have nothing at level of detail {} and were left out",
                                 byLevel, options.lod),
                     ""});
    if (byBox > 0)
        report.file({Severity::Info, "filtered-by-box", "",
                     fmt::format("{} objects outside the box were left out", byBox), ""});
}

void skipWhatShowsNothing(const SourceCity& file, const std::vector<bool>& chosen,
                          const std::vector<bool>& showsSomething, ImportReport& report) {
    for (std::uint32_t i = 0; i < file.objects.size(); ++i) {
        if (showsSomething[i] || report.leftOut(i) || report.fate(i) == Fate::Skipped)
            continue;
        bool expected = file.objects[i].badGeometry;
        bool known = false;
        forGeometriesOf(file.objects[i], [&](std::uint32_t g) {
            expected = expected || chosen[g];
            known = known || file.geometries[g].type != GeometryType::Unknown;
        });
        if (expected || (file.objects[i].geometryCount > 0 && !known))
            report.note(i, Issue::NothingUsable);
    }
}

}  // namespace reflet::importers
