// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/citygml/Appearances.h"
#include "importers/citygml/GmlNames.h"
#include "importers/common/SourceCity.h"

#include <cstddef>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace reflet::citygml {

/// A top-level feature with all that is in it, before its geometry is read.
struct Member {
    importers::SourceCity file;
    std::vector<pugi::xml_node> properties;  ///< of each of file.geometries: lod2Solid, tin, ...
    std::vector<SurfaceType> surfaceTypes;   ///< of each of file.objects
};

/// Finds the city objects of the members of a file and what geometry they have. Keeps in mind
/// which ids it has met.
class FeatureReader {
public:
    explicit FeatureReader(const Namespaces& namespaces) : m_namespaces(namespaces) {}

    /// `root` is the member property (cityObjectMember). A feature whose id an earlier member has
    /// is marked as a duplicate, with all that is in it.
    [[nodiscard]] Member read(pugi::xml_node root);
    /// Elements of vocabularies other than CityGML and GML (ADEs), which were passed over.
    [[nodiscard]] std::size_t foreignElements() const { return m_foreign; }

private:
    struct Place {
        std::uint32_t parent = kNone;
        CityObjectType hostType = CityObjectType::Other;
        int depth = 0;
    };
    void readFeature(pugi::xml_node node, const Place& place, Member& member);
    void readGeometries(pugi::xml_node node, Member& member);
    void readInside(pugi::xml_node node, const Place& place, Member& member);
    [[nodiscard]] std::string idOf(pugi::xml_node node, std::string_view type, bool& known);
    [[nodiscard]] std::uint32_t level(const std::string& name, importers::SourceCity& file) const;

    const Namespaces& m_namespaces;
    std::unordered_set<std::string> m_ids;
    std::size_t m_unnamed = 0;
    std::size_t m_foreign = 0;
};

}  // namespace reflet::citygml
