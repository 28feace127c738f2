// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/cityjson/GeometryReader.h"
#include "importers/cityjson/GeometryText.h"

namespace reflet::cityjson {

/// Turns geometries as they are written into surfaces whose indices are all valid.
class SurfaceBuilder {
public:
    /// `vertexCount` is the number of vertices that boundaries may refer to.
    SurfaceBuilder(const SourceCity& file, std::size_t vertexCount, SurfaceSoup& into)
        : m_file(file), m_vertexCount(vertexCount), m_into(into) {}

    /// Adds the surfaces of a geometry of `owner`; unusable ones are left out and noted.
    void add(const GeometryText& geometry, std::uint32_t owner, Noter note);

    [[nodiscard]] std::size_t writtenSurfaces() const { return m_writtenSurfaces; }
    [[nodiscard]] std::size_t writtenTriangles() const { return m_writtenTriangles; }
    [[nodiscard]] bool withoutAppearance() const { return m_withoutAppearance; }

private:
    void noteEmptyParts(const NestedIndices& boundaries, Noter note) const;
    bool addPoints(std::size_t firstLeaf, std::size_t leafCount, Noter note);
    void setSemantics(std::uint32_t leaf, Noter note, SurfaceSoup::Surface& surface) const;
    void setMaterial(std::uint32_t leaf, SurfaceSoup::Surface& surface) const;
    bool addRingUv(const Alignment& rings, std::size_t entry, std::uint32_t ring, Noter note);
    static bool isReadable(const GeometryText& geometry, Noter note);
    void setTexture(const Alignment& rings, std::size_t firstRing, Noter note,
                    SurfaceSoup::Surface& surface);

    const SourceCity& m_file;
    std::size_t m_vertexCount;
    SurfaceSoup& m_into;
    const GeometryText* m_geometry = nullptr;
    std::size_t m_writtenSurfaces = 0;
    std::size_t m_writtenTriangles = 0;
    bool m_withoutAppearance = false;
};

}  // namespace reflet::cityjson
