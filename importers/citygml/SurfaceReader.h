// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/citygml/Appearances.h"
#include "importers/citygml/FeatureReader.h"
#include "importers/common/CityPiece.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace reflet::citygml {

/// Geometries that other members name, by id: each in a document of its own.
using Definitions = ById<std::unique_ptr<pugi::xml_document>>;

/// What a member's geometry is read with, beside itself.
struct Surroundings {
    const Namespaces& namespaces;
    const Appearances& appearances;  ///< of the whole file
    const Definitions& definitions;
    ImagePlaces& images;
    bool looksInside = false;  ///< the member names surfaces by reference
};

/// Reads the chosen geometries of a member into a piece: polygons with holes, their semantics and
/// looks, and implicit geometries as templates with instances. A polygon that several geometries
/// name is read once, where it is defined if that is chosen. What is unusable is left out and
/// noted in the piece's report.
class SurfaceReader {
public:
    SurfaceReader(pugi::xml_node root, const Member& member, const Surroundings& surroundings,
                  importers::CityPiece& piece);
    void read();

private:
    /// What holds for a geometry and all in it.
    struct Context {
        std::uint32_t owner = 0;
        std::uint32_t geometry = kNone;  ///< of file.geometries; kNone for templates
        SurfaceType type = SurfaceType::Unknown;
        bool reversed = false;
        bool copy = false;  ///< of a polygon defined elsewhere: not counted as written
        int dimension = 3;
        int depth = 0;
        std::uint32_t material = kNone;
        std::uint32_t texture = kNone;
        const Appearances::Look* look = nullptr;
        const Appearances* source = nullptr;  ///< of `look` and `texture`
    };
    struct Reference {
        std::string id;
        Context context;
    };
    struct Ring {
        pugi::xml_node node;
        std::vector<glm::dvec3> points;  ///< without the closing one
        std::size_t written = 0;         ///< points in the file, the closing one included
    };
    /// Where surfaces of the city, or of templates, go.
    struct Target {
        importers::SurfaceSoup& soup;
        std::vector<glm::dvec3>& vertices;
        std::map<std::array<double, 3>, std::uint32_t> numberOf = {};
    };

    void readGeometry(pugi::xml_node node, Context context);
    void readReferences();
    void follow(const Reference& reference);
    void readPolygon(pugi::xml_node node, const Context& context);
    [[nodiscard]] bool readRings(pugi::xml_node polygon, const Context& context,
                                 std::vector<Ring>& rings);
    [[nodiscard]] bool readRing(pugi::xml_node property, const Context& context,
                                std::vector<Ring>& rings);
    void addSurface(const std::vector<Ring>& rings, const Context& context);
    void addTexture(const std::vector<Ring>& rings, const Context& context,
                    importers::SurfaceSoup::Surface& surface);
    [[nodiscard]] bool addUv(const Ring& ring, const Context& context, std::size_t firstOfRing);
    [[nodiscard]] bool addUvInPlane(const Ring& ring, const Context& context,
                                    const PlaneProjection& projection);
    void addUv(const glm::vec2& uv);
    void lookAtTexturedSurface(pugi::xml_node node, Context& context);
    void lookUp(pugi::xml_node node, Context& context);
    [[nodiscard]] std::uint32_t textureNumber(const Appearances& source, std::uint32_t texture);
    [[nodiscard]] std::uint32_t materialNumber(const Appearances& source, std::uint32_t material);
    [[nodiscard]] std::uint32_t vertexNumber(const glm::dvec3& point);

    void readInstance(pugi::xml_node property, const Context& context);
    [[nodiscard]] std::uint32_t templateOf(pugi::xml_node implicit, const Context& context);
    [[nodiscard]] std::uint32_t makeTemplate(pugi::xml_node geometry, const Context& context);
    [[nodiscard]] pugi::xml_node definitionOf(std::string_view id);
    void noteIds();
    void note(const Context& context, importers::Issue issue, std::string detail = {});

    pugi::xml_node m_root;
    const Member& m_member;
    const Surroundings& m_around;
    importers::CityPiece& m_piece;
    Appearances m_own;  ///< looks that stand in the member itself
    Target m_surfaces;
    Target m_templates;
    Target* m_target;
    std::vector<Reference> m_references;
    std::unordered_map<std::string_view, pugi::xml_node> m_ids;
    std::unordered_set<std::size_t> m_readPolygons;  ///< hashes of their nodes
    std::unordered_set<std::size_t> m_followed;      ///< of references, and of what they led to
    std::unordered_map<std::size_t, std::uint32_t> m_templateOf;  ///< by hash of the geometry
    std::map<std::pair<const Appearances*, std::uint32_t>, std::uint32_t> m_textureOf;
    std::map<std::pair<const Appearances*, std::uint32_t>, std::uint32_t> m_materialOf;
    std::vector<std::size_t> m_inlineCount;     ///< polygons in each geometry itself
    std::vector<std::size_t> m_referenceCount;  ///< and by reference
};

}  // namespace reflet::citygml
