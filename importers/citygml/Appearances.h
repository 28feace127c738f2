// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/city/CityModel.h"
#include "importers/citygml/ImagePlaces.h"
#include "importers/common/SourceCity.h"

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace reflet::citygml {

/// A hash that takes views, so that looking up makes no string.
struct TextHash {
    using is_transparent = void;
    std::size_t operator()(std::string_view text) const {
        return std::hash<std::string_view>{}(text);
    }
};
template <class Value>
using ById = std::unordered_map<std::string, Value, TextHash, std::equal_to<>>;

/// What the Appearances of a file, or of one object, say about surfaces, by their gml:id. Of
/// several themes, the first that says something about a surface counts. Only fronts.
class Appearances {
public:
    struct Look {
        std::uint32_t material = kNone;
        std::uint32_t texture = kNone;
        std::optional<std::array<double, 12>> worldToTexture;  ///< rows of 4, of the texture
        /// Of a TexturedSurface of CityGML 1: for the points of its rings as they are written.
        std::vector<glm::vec2> uv = {};
    };

    /// Reads app:Appearance elements at any depth below the node.
    void addAllOf(pugi::xml_node node);
    /// What a TexturedSurface of CityGML 1 says of itself, by Material and SimpleTexture. The look
    /// is valid as long as this.
    [[nodiscard]] const Look& addTexturedSurface(pugi::xml_node node);

    [[nodiscard]] const Look* find(std::string_view surfaceId) const;
    /// The coordinates in `texture` of a ring's points, the closing one included.
    [[nodiscard]] const std::vector<glm::vec2>* ring(std::string_view ringId,
                                                     std::uint32_t texture) const;
    /// Of a texture whose coordinates follow from where its image lies; null for others.
    [[nodiscard]] const Georeference* georeference(std::uint32_t texture) const;
    [[nodiscard]] const std::vector<CityMaterial>& materials() const { return m_materials; }
    [[nodiscard]] const std::vector<importers::TextureEntry>& textures() const {
        return m_textures;
    }
    [[nodiscard]] bool empty() const { return m_looks.empty(); }

private:
    void addAppearance(pugi::xml_node appearance);
    [[nodiscard]] std::uint32_t addMaterial(pugi::xml_node node);
    void addMaterialOfTargets(pugi::xml_node node);
    void giveTargets(pugi::xml_node node, std::uint32_t number, std::uint32_t Look::*member);
    void addTexture(pugi::xml_node node);
    void addGeoreferenced(pugi::xml_node node);
    void addTarget(std::string_view id, pugi::xml_node mapping, std::uint32_t texture);
    void addRings(pugi::xml_node list, std::uint32_t texture);
    void addRing(std::string_view id, const char* numbers, std::uint32_t texture);

    struct RingUv {
        std::uint32_t texture;
        std::vector<glm::vec2> uv;
    };
    ById<Look> m_looks;
    ById<RingUv> m_rings;
    std::vector<CityMaterial> m_materials;
    std::vector<importers::TextureEntry> m_textures;
    std::unordered_map<std::uint32_t, Georeference> m_georeferences;  ///< by texture
    std::deque<Look> m_inline;
};

/// "id" of "#id"; empty for references that lead out of the file.
[[nodiscard]] std::string_view idOfReference(std::string_view reference);

}  // namespace reflet::citygml
