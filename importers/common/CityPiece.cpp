// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/CityPiece.h"

#include "importers/common/SourceCrs.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace reflet::importers {

namespace {

std::uint32_t sizeOf(const auto& list) {
    return static_cast<std::uint32_t>(list.size());
}

void shift(std::uint32_t& index, std::uint32_t by) {
    if (index != kNone)
        index += by;
}

template <class T>
void moveBehind(std::vector<T>& list, std::vector<T>& more) {
    list.insert(list.end(), std::make_move_iterator(more.begin()),
                std::make_move_iterator(more.end()));
}

void appendIndices(std::vector<std::uint32_t>& list, const std::vector<std::uint32_t>& more,
                   std::uint32_t by) {
    for (const std::uint32_t index : more)
        list.push_back(index + by);
}

/// Where the lists of a piece end before something is appended.
struct Ends {
    std::uint32_t objects, geometries, vertices, textureVertices, materials, textures;
};

void appendSurfaces(SurfaceSoup& soup, const SurfaceSoup& more, const Ends& ends) {
    const std::uint32_t rings = sizeOf(soup.ringEnds);
    const std::uint32_t points = sizeOf(soup.points);
    const std::uint32_t uvs = sizeOf(soup.uvs);
    for (SurfaceSoup::Surface surface : more.surfaces) {
        surface.owner += ends.objects;
        surface.firstRing += rings;
        shift(surface.material, ends.materials);
        shift(surface.texture, ends.textures);
        shift(surface.firstUv, uvs);
        soup.surfaces.push_back(surface);
    }
    appendIndices(soup.ringEnds, more.ringEnds, points);
    appendIndices(soup.points, more.points, ends.vertices);
    appendIndices(soup.uvs, more.uvs, ends.textureVertices);
}

/// The numbers that the levels of a part have in the piece.
std::vector<std::uint32_t> levelsOf(SourceCity& file, const SourceCity& part) {
    std::vector<std::uint32_t> numbers;
    for (const std::string& lod : part.lodNames) {
        const auto known = std::find(file.lodNames.begin(), file.lodNames.end(), lod);
        numbers.push_back(static_cast<std::uint32_t>(known - file.lodNames.begin()));
        if (known == file.lodNames.end())
            file.lodNames.push_back(lod);
    }
    return numbers;
}

void appendFile(SourceCity& file, SourceCity& part, const Ends& ends) {
    const std::vector<std::uint32_t> levels = levelsOf(file, part);
    for (ObjectOutline& object : part.objects)
        object.firstGeometry += ends.geometries;
    for (GeometryOutline& geometry : part.geometries)
        geometry.lod = levels[geometry.lod];
    moveBehind(file.objects, part.objects);
    moveBehind(file.geometries, part.geometries);
    moveBehind(file.vertices, part.vertices);
    moveBehind(file.textureVertices, part.textureVertices);
    moveBehind(file.materials, part.materials);
    moveBehind(file.textures, part.textures);
}

void appendTree(ObjectTree& tree, const ObjectTree& part, std::uint32_t objects) {
    for (std::uint32_t parent : part.parent) {
        shift(parent, objects);
        tree.parent.push_back(parent);
    }
    appendIndices(tree.childrenFirst, part.childrenFirst, objects);
}

/// Templates of the part's own, if it has any geometry of them; how far their numbers move.
std::uint32_t appendTemplates(CityPiece& piece, CityPiece& part, const Ends& ends) {
    auto& begin = piece.geometry.templateBegin;
    const auto& more = part.geometry.templateBegin;
    if (more.size() < 2)
        return 0;
    const std::uint32_t templates = sizeOf(piece.file.templates);
    const Ends here{
        templates,    0, sizeOf(piece.file.templateVertices), ends.textureVertices, ends.materials,
        ends.textures};
    if (!begin.empty())
        begin.pop_back();
    appendIndices(begin, more, sizeOf(piece.geometry.templates.surfaces));
    appendSurfaces(piece.geometry.templates, part.geometry.templates, here);
    moveBehind(piece.file.templates, part.file.templates);
    moveBehind(piece.file.templateVertices, part.file.templateVertices);
    auto& notes = piece.geometry.templateNotes;
    notes.resize(templates);
    moveBehind(notes, part.geometry.templateNotes);
    return templates;
}

}  // namespace

void append(CityPiece& piece, CityPiece part) {
    SourceCity& file = piece.file;
    const Ends ends{sizeOf(file.objects),         sizeOf(file.geometries), sizeOf(file.vertices),
                    sizeOf(file.textureVertices), sizeOf(file.materials),  sizeOf(file.textures)};
    appendFile(file, part.file, ends);
    appendTree(piece.tree, part.tree, ends.objects);
    piece.report.append(std::move(part.report));
    piece.chosen.insert(piece.chosen.end(), part.chosen.begin(), part.chosen.end());

    CityGeometry& geometry = piece.geometry;
    CityGeometry& more = part.geometry;
    appendSurfaces(geometry.surfaces, more.surfaces, ends);
    const std::uint32_t templates = appendTemplates(piece, part, ends);
    for (InstanceRecord instance : more.instances) {
        instance.object += ends.objects;
        instance.templateIndex += templates;
        instance.anchor += ends.vertices;
        geometry.instances.push_back(instance);
    }
    more.usedBySurface.resize(file.vertices.size() - ends.vertices);
    geometry.usedBySurface.insert(geometry.usedBySurface.end(), more.usedBySurface.begin(),
                                  more.usedBySurface.end());
    geometry.writtenSurfaces += more.writtenSurfaces;
    geometry.writtenTriangles += more.writtenTriangles;
    geometry.withoutAppearance = geometry.withoutAppearance || more.withoutAppearance;
}

void addTo(Extent& extent, const CityPiece& piece) {
    std::vector<bool> used = piece.geometry.usedBySurface;
    for (const InstanceRecord& instance : piece.geometry.instances)
        used[instance.anchor] = true;
    for (std::size_t v = 0; v < used.size(); ++v) {
        if (used[v])
            extent.add(sourceVertex(piece.file, v));
    }
}

void noteTemplates(const CityGeometry& geometry, ImportReport& report) {
    for (const InstanceRecord& instance : geometry.instances) {
        if (instance.templateIndex >= geometry.templateNotes.size())
            continue;
        for (const TemplateNote& note : geometry.templateNotes[instance.templateIndex])
            report.note(instance.object, note.issue, note.detail, note.count);
    }
}

}  // namespace reflet::importers
