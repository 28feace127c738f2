// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/city/CityModel.h"

#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace reflet::citygml {

/// What the namespace of an element says.
enum class Vocabulary { CityGml, Gml, Other };

/// A name without its prefix, and whose it is.
struct Name {
    Vocabulary vocabulary = Vocabulary::Other;
    std::string_view local;
};

/// Resolves prefixes by the namespaces that the root declares, or an element further in.
class Namespaces {
public:
    /// `root`: the start tag of the root. Unreadable text gives no namespaces.
    explicit Namespaces(const std::string& root);

    [[nodiscard]] Name nameOf(pugi::xml_node node) const;
    /// "1.0", "2.0" or "3.0" by the namespaces of the root; empty when it declares none of CityGML.
    [[nodiscard]] const std::string& version() const { return m_version; }
    /// Whether elements declare namespaces of their own: then they are asked, which takes longer.
    void lookInside(bool inside) { m_inside = inside; }

private:
    [[nodiscard]] Vocabulary vocabularyOf(std::string_view prefix, pugi::xml_node node) const;

    std::vector<std::pair<std::string, Vocabulary>> m_prefixes;
    std::string m_version;
    bool m_inside = false;
};

/// What an element of CityGML's own namespaces is to Reflet.
struct FeatureKind {
    CityObjectType type = CityObjectType::Other;
    bool isBoundary = false;  ///< a surface of the feature around it, of whose type it is
    SurfaceType surface = SurfaceType::Unknown;  ///< of the polygons in it
};
/// nullopt for elements that are no city objects, such as addresses.
[[nodiscard]] std::optional<FeatureKind> featureKind(std::string_view localName);

/// The attribute of a local name, whatever its prefix: "id", "href".
[[nodiscard]] std::string_view attributeOf(pugi::xml_node node, std::string_view localName);
[[nodiscard]] std::string_view localNameOf(pugi::xml_node node);
/// The first child element, whatever its name.
[[nodiscard]] pugi::xml_node firstElement(pugi::xml_node node);
/// The first child of a local name; an empty node if there is none.
[[nodiscard]] pugi::xml_node childOf(pugi::xml_node node, std::string_view localName);

}  // namespace reflet::citygml
