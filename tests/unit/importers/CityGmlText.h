// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/citygml/CityGmlImporter.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

// Small CityGML texts made in the tests.
namespace reflet::test {

using Corner = std::array<double, 3>;

inline std::string posList(const std::vector<Corner>& corners) {
    std::string text;
    for (const Corner& corner : corners)
        text += fmt::format("{} {} {} ", corner[0], corner[1], corner[2]);
    return text;
}

/// A polygon with the id `id`, its ring with the id `id`-r, closed here.
inline std::string polygon(std::vector<Corner> ring, const std::string& id = {}) {
    ring.push_back(ring.front());
    const std::string polygonId = id.empty() ? "" : fmt::format(" gml:id=\"{}\"", id);
    const std::string ringId = id.empty() ? "" : fmt::format(" gml:id=\"{}-r\"", id);
    return fmt::format(
        "<gml:Polygon{}><gml:exterior><gml:LinearRing{}><gml:posList>{}</gml:posList>"
        "</gml:LinearRing></gml:exterior></gml:Polygon>",
        polygonId, ringId, posList(ring));
}

inline std::string members(const std::vector<std::string>& surfaces) {
    std::string text;
    for (const std::string& surface : surfaces)
        text += "<gml:surfaceMember>" + surface + "</gml:surfaceMember>";
    return text;
}

inline std::string multiSurface(const std::vector<std::string>& surfaces) {
    return "<gml:MultiSurface>" + members(surfaces) + "</gml:MultiSurface>";
}

/// Six outward faces of a box of 10 by 8 by 6 m with its lower corner at (x, y, 0).
inline std::vector<std::string> boxFaces(double x, double y, const std::string& id = {}) {
    const double X = x + 10;
    const double Y = y + 8;
    const std::vector<std::vector<Corner>> rings{
        {{x, y, 0}, {x, Y, 0}, {X, Y, 0}, {X, y, 0}}, {{x, y, 6}, {X, y, 6}, {X, Y, 6}, {x, Y, 6}},
        {{x, y, 0}, {X, y, 0}, {X, y, 6}, {x, y, 6}}, {{X, y, 0}, {X, Y, 0}, {X, Y, 6}, {X, y, 6}},
        {{X, Y, 0}, {x, Y, 0}, {x, Y, 6}, {X, Y, 6}}, {{x, Y, 0}, {x, y, 0}, {x, y, 6}, {x, Y, 6}}};
    std::vector<std::string> faces;
    for (std::size_t i = 0; i < rings.size(); ++i)
        faces.push_back(polygon(rings[i], id.empty() ? "" : fmt::format("{}{}", id, i)));
    return faces;
}

inline std::string solidOf(const std::vector<std::string>& faces) {
    return "<gml:Solid><gml:exterior><gml:CompositeSurface>" + members(faces) +
           "</gml:CompositeSurface></gml:exterior></gml:Solid>";
}

inline std::string building(const std::string& id, const std::string& content) {
    return fmt::format(
        "<cityObjectMember><bldg:Building gml:id=\"{}\">{}</bldg:Building></cityObjectMember>\n",
        id, content);
}

inline std::string cityGml(const std::string& content, const std::string& srsName = "EPSG:25832",
                           const std::string& version = "2.0") {
    const std::string gml =
        version == "3.0" ? "http://www.opengis.net/gml/3.2" : "http://www.opengis.net/gml";
    const auto module = [&](const char* prefix, const char* name) {
        return fmt::format(" xmlns:{}=\"http://www.opengis.net/citygml/{}/{}\"", prefix, name,
                           version);
    };
    const std::string envelope = srsName.empty()
                                     ? ""
                                     : fmt::format(
                                           "<gml:boundedBy><gml:Envelope srsName=\"{}\"/>"
                                           "</gml:boundedBy>\n",
                                           srsName);
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<CityModel "
        "xmlns=\"http://www.opengis.net/citygml/{}\" xmlns:gml=\"{}\" "
        "xmlns:xlink=\"http://www.w3.org/1999/xlink\"{}{}{}{}{}{}>\n{}{}</CityModel>\n",
        version, gml, module("bldg", "building"), module("app", "appearance"),
        module("dem", "relief"), module("veg", "vegetation"), module("tran", "transportation"),
        module("con", "construction"), envelope, content);
}

inline Imported<CityImport> importGml(const std::string& text, const ImportOptions& options = {}) {
    auto result = importCityGmlText(text, "city.gml", options, {});
    if (!result) {
        ADD_FAILURE() << result.error().message();
        return {};
    }
    return *std::move(result);
}

inline Error gmlError(const std::string& text, const ImportOptions& options = {}) {
    auto result = importCityGmlText(text, "city.gml", options, {});
    if (result) {
        ADD_FAILURE() << "the import went through";
        return {};
    }
    return result.error();
}

}  // namespace reflet::test
