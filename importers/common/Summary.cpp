// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/Summary.h"

#include "importers/common/LodChoice.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace reflet::importers {

namespace {

SourceSummary common(const SummaryParts& parts) {
    SourceSummary summary;
    summary.format = parts.file.format;
    summary.version = parts.file.version;
    return summary;
}

void sortLevels(std::vector<std::string>& lods) {
    std::sort(lods.begin(), lods.end(), [](const std::string& a, const std::string& b) {
        return std::pair(lodRank(a), a) < std::pair(lodRank(b), b);
    });
}

/// The levels of geometries that are marked; an instance has none of its own.
std::vector<std::string> lodsOf(const SourceCity& file, const std::vector<bool>& marked) {
    std::vector<bool> present(file.lodNames.size(), false);
    for (std::size_t g = 0; g < file.geometries.size(); ++g) {
        if (marked[g])
            present[file.geometries[g].lod] = true;
    }
    std::vector<std::string> lods;
    for (std::size_t i = 0; i < present.size(); ++i) {
        if (present[i] && !file.lodNames[i].empty())
            lods.push_back(file.lodNames[i]);
    }
    sortLevels(lods);
    return lods;
}

std::size_t templateTriangles(const CityGeometry& geometry, std::uint32_t index) {
    std::size_t count = 0;
    for (std::uint32_t s = geometry.templateBegin[index]; s < geometry.templateBegin[index + 1];
         ++s) {
        const SurfaceSoup::Surface& surface = geometry.templates.surfaces[s];
        count += nominalTriangles(geometry.templates.pointCount(surface), surface.ringCount);
    }
    return count;
}

bool isIn(Fate fate) {
    return fate == Fate::Loaded || fate == Fate::Repaired;
}

/// Counts instances of the objects that `accept` takes.
template <class Accept>
void addInstances(const SummaryParts& parts, const Accept& accept, SourceSummary& summary) {
    std::vector<std::size_t> sizes(parts.file.templates.size());
    for (std::uint32_t t = 0; t < sizes.size(); ++t)
        sizes[t] = templateTriangles(parts.geometry, t);
    for (const InstanceRecord& instance : parts.geometry.instances) {
        if (!accept(instance))
            continue;
        ++summary.instances;
        summary.instanceTriangles += sizes[instance.templateIndex];
    }
}

}  // namespace

PieceSummary summaryOfFile(const SummaryParts& parts) {
    SourceSummary summary = common(parts);
    summary.objects = parts.file.objects.size();
    for (const ObjectOutline& object : parts.file.objects)
        ++summary.byType[object.typeName];
    summary.lods = lodsOf(parts.file, std::vector<bool>(parts.file.geometries.size(), true));
    summary.surfaces = parts.geometry.writtenSurfaces;
    summary.triangles = parts.geometry.writtenTriangles;
    addInstances(
        parts, [](const InstanceRecord&) { return true; }, summary);
    summary.vertices = parts.source.size();
    for (std::size_t v = 0; v < parts.source.size(); ++v) {
        if (parts.geometry.usedBySurface[v] && !std::isnan(parts.source[v].x))
            summary.bounds.add(parts.source[v]);
    }
    return {std::move(summary), std::vector<bool>(parts.file.textures.size(), true)};
}

PieceSummary summaryOfImport(const SummaryParts& parts, const SoupTriangles& triangles) {
    SourceSummary summary = common(parts);
    std::vector<bool> marked(parts.file.geometries.size(), false);
    for (std::uint32_t i = 0; i < parts.file.objects.size(); ++i) {
        const ObjectOutline& object = parts.file.objects[i];
        if (!isIn(parts.report.fate(i)))
            continue;
        ++summary.objects;
        ++summary.byType[object.typeName];
        for (std::uint32_t g = object.firstGeometry;
             g < object.firstGeometry + object.geometryCount; ++g)
            marked[g] = parts.chosen[g];
    }
    summary.lods = lodsOf(parts.file, marked);

    std::vector<bool> usedVertex(parts.source.size(), false);
    std::vector<bool> usedTexture(parts.file.textures.size(), false);
    const SurfaceSoup& soup = parts.geometry.surfaces;
    for (std::size_t s = 0; s < soup.surfaces.size(); ++s) {
        const SurfaceSoup::Surface& surface = soup.surfaces[s];
        const auto state = triangles.states[s];
        if (!isIn(parts.report.fate(surface.owner)) ||
            (state != SoupTriangles::State::Good && state != SoupTriangles::State::Repaired))
            continue;
        const std::uint32_t points = soup.pointCount(surface);
        ++summary.surfaces;
        summary.triangles += nominalTriangles(points, surface.ringCount);
        for (std::uint32_t i = 0; i < points; ++i) {
            const std::uint32_t vertex = soup.points[soup.firstPoint(surface) + i];
            usedVertex[vertex] = true;
            summary.bounds.add(parts.source[vertex]);
        }
        if (surface.texture != kNone)
            usedTexture[surface.texture] = true;
    }
    addInstances(
        parts,
        [&](const InstanceRecord& instance) {
            const bool in = isIn(parts.report.fate(instance.object));
            if (!in)
                return false;
            usedVertex[instance.anchor] = true;
            const auto& begin = parts.geometry.templateBegin;
            for (std::uint32_t s = begin[instance.templateIndex];
                 s < begin[instance.templateIndex + 1]; ++s) {
                const std::uint32_t texture = parts.geometry.templates.surfaces[s].texture;
                if (texture != kNone)
                    usedTexture[texture] = true;
            }
            return true;
        },
        summary);
    summary.vertices =
        static_cast<std::size_t>(std::count(usedVertex.begin(), usedVertex.end(), true));
    return {std::move(summary), std::move(usedTexture)};
}

void addSummary(SourceSummary& sum, const SourceSummary& piece) {
    sum.format = piece.format;
    sum.version = piece.version;
    sum.objects += piece.objects;
    for (const auto& [type, count] : piece.byType)
        sum.byType[type] += count;
    for (const std::string& lod : piece.lods) {
        if (std::find(sum.lods.begin(), sum.lods.end(), lod) == sum.lods.end())
            sum.lods.push_back(lod);
    }
    sortLevels(sum.lods);
    sum.surfaces += piece.surfaces;
    sum.triangles += piece.triangles;
    sum.instanceTriangles += piece.instanceTriangles;
    sum.instances += piece.instances;
    sum.vertices += piece.vertices;
    if (!piece.bounds.empty()) {
        sum.bounds.add(piece.bounds.min);
        sum.bounds.add(piece.bounds.max);
    }
}

}  // namespace reflet::importers
