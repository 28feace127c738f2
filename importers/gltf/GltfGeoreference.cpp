// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/gltf/GltfGeoreference.h"

#include "core/base/Files.h"
#include "core/math/Geometry.h"
#include "importers/common/Geocentric.h"
#include "importers/gltf/GltfDocument.h"

#include <glm/ext/matrix_transform.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <pugixml.hpp>
#include <system_error>

namespace reflet::gltf {

using nlohmann::json;
namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLongest = std::size_t(1) << 20;  // of a file beside
constexpr double kRadians = 3.14159265358979323846 / 180.0;

fs::path besideAs(const fs::path& path, const char* suffix) {
    fs::path beside = path;
    return beside.replace_extension(suffix);
}

fs::path geoJsonBeside(const fs::path& path) {
    fs::path beside = path;
    return beside += ".geo.json";
}

std::string textIn(const json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

/// {"crs": "EPSG:25832", "vertical": "EPSG:7837", "origin": [east, north, up], "upAxis": "Y"}
std::optional<Georeference> georeferenceIn(const json& object) {
    Georeference out;
    if (!object.is_object() || (out.crs = textIn(object, "crs")).empty())
        return std::nullopt;
    if (const std::string vertical = textIn(object, "vertical"); vertical.starts_with("EPSG:"))
        out.crs += "+" + vertical.substr(5);
    const std::string up = textIn(object, "upAxis");
    out.zUp = up == "Z" || up == "z";
    const auto origin = object.find("origin");
    if (origin == object.end() || !origin->is_array() || origin->size() != 3)
        return out;
    for (int i = 0; i < 3; ++i) {
        const json& value = (*origin)[std::size_t(i)];
        out.crs_from_file[3][i] = value.is_number() ? value.get<double>() : 0.0;
    }
    return out;
}

std::optional<Georeference> inExtras(const Document& document) {
    const auto& said = member(document.model().asset.extras, "georeference");
    if (!said.IsObject())
        return std::nullopt;
    json own{{"origin", numbers(said, "origin")}};
    for (const char* key : {"crs", "vertical", "upAxis"}) {
        if (member(said, key).IsString())
            own[key] = member(said, key).Get<std::string>();
    }
    return georeferenceIn(own);
}

/// EXT_geospatial_crs with EXT_geospatial_crs_wkid or _wkt2. Its coordinates are those of the
/// reference system: they have z up.
std::optional<Georeference> inExtension(const Document& document,
                                        std::vector<Diagnostic>& remarks) {
    const auto& crs = extensionOf(document.model().extensions, "EXT_geospatial_crs");
    if (!crs.IsObject())
        return std::nullopt;
    const auto& formats = member(crs, "extensions");
    const auto& wkid = member(formats, "EXT_geospatial_crs_wkid");
    const auto& wkt = member(member(formats, "EXT_geospatial_crs_wkt2"), "wkt2");
    Georeference out;
    out.zUp = true;
    if (const int code = indexIn(wkid, "wkid"); code > 0) {
        const auto& authority = member(wkid, "authority");
        out.crs = (authority.IsString() ? authority.Get<std::string>() : "EPSG") + ":" +
                  std::to_string(code);
        if (const int vertical = indexIn(wkid, "vcsWkid"); vertical > 0)
            out.crs += "+" + std::to_string(vertical);
    } else if (wkt.IsString()) {
        out.crs = wkt.Get<std::string>();
    } else {
        remark(remarks, Severity::Warning, "crs-format", "EXT_geospatial_crs",
               "its reference system is written in a way that Reflet does not know",
               "Say it with --crs; known are EXT_geospatial_crs_wkid and _wkt2.");
    }
    return out;
}

void tellUnusable(const fs::path& file, const char* what, std::vector<Diagnostic>& remarks) {
    remark(remarks, Severity::Warning, "georeference-unusable", file.filename().string(),
           std::string("it lies beside the model and ") + what + "; it was passed over");
}

std::optional<Georeference> besideFile(const fs::path& path, std::vector<Diagnostic>& remarks) {
    if (const auto text = readFile(geoJsonBeside(path), kLongest)) {
        if (auto found = georeferenceIn(json::parse(*text, nullptr, false)))
            return found;
        tellUnusable(geoJsonBeside(path), "names no reference system (\"crs\")", remarks);
    }
    const fs::path world = besideAs(path, ".wld3");
    if (const auto text = readFile(world, kLongest)) {
        if (const auto crs_from_file = readWorldFile(*text))
            return Georeference{"", *crs_from_file, false};
        tellUnusable(world, "has no pairs of points \"x,y,z X,Y,Z\"", remarks);
    }
    const fs::path kml = besideAs(path, ".kml");
    if (const auto text = readFile(kml, kLongest)) {
        if (const auto geocentric_from_file = readKmlModel(*text))
            return Georeference{"EPSG:4978", *geocentric_from_file, false};
        tellUnusable(kml, "has no upright Model with a Location", remarks);
    }
    return std::nullopt;
}

/// The numbers of a text that are separated by commas and blanks; empty where there is anything
/// else.
std::vector<double> numbersIn(std::string_view text) {
    constexpr std::string_view kBetween = ", \t\r\n";
    std::vector<double> out;
    for (std::size_t at = text.find_first_not_of(kBetween); at != std::string_view::npos;
         at = text.find_first_not_of(kBetween, at)) {
        const std::size_t end = std::min(text.find_first_of(kBetween, at), text.size());
        double value = 0.0;
        const auto [stop, error] = std::from_chars(text.data() + at, text.data() + end, value);
        if (error != std::errc() || stop != text.data() + end || !std::isfinite(value))
            return {};
        out.push_back(value);
        at = end;
    }
    return out;
}

}  // namespace

std::optional<glm::dmat4> readWorldFile(std::string_view text) {
    const std::vector<double> v = numbersIn(text);
    if (v.size() != 6 && v.size() != 12)
        return std::nullopt;
    const auto point = [&](std::size_t i) {
        return glm::dvec3(v[3 * i], v[3 * i + 1], v[3 * i + 2]);
    };
    glm::dmat4 out(1.0);
    if (v.size() == 12) {
        // As complex numbers: rotation and scale are the quotient of the two ways.
        const glm::dvec3 from = point(2) - point(0), to = point(3) - point(1);
        const double square = from.x * from.x + from.y * from.y;
        const double c = (from.x * to.x + from.y * to.y) / square;
        const double s = (from.x * to.y - from.y * to.x) / square;
        const double scale = std::hypot(c, s);
        if (!(square > 0.0) || !(scale > 0.0) || !std::isfinite(scale))
            return std::nullopt;
        out[0] = {c, s, 0.0, 0.0};
        out[1] = {-s, c, 0.0, 0.0};
        out[2][2] = scale;
    }
    out[3] = glm::dvec4(point(1) - glm::dvec3(out * glm::dvec4(point(0), 0.0)), 1.0);
    return out;
}

std::optional<glm::dmat4> readKmlModel(std::string_view text) {
    pugi::xml_document xml;
    if (!xml.load_buffer(text.data(), text.size()))
        return std::nullopt;
    const pugi::xml_node model = xml.find_node(
        [](const pugi::xml_node& node) { return std::string_view(node.name()) == "Model"; });
    const pugi::xml_node location = model.child("Location");
    const pugi::xml_node orientation = model.child("Orientation");
    const double longitude = location.child("longitude").text().as_double(std::nan(""));
    const double latitude = location.child("latitude").text().as_double(std::nan(""));
    const double height = location.child("altitude").text().as_double(0.0);
    const double heading = orientation.child("heading").text().as_double(0.0);
    const bool upright = orientation.child("tilt").text().as_double(0.0) == 0.0 &&
                         orientation.child("roll").text().as_double(0.0) == 0.0;
    glm::dvec3 scale(1.0);
    for (int i = 0; i < 3; ++i) {
        constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
        scale[i] = model.child("Scale").child(kAxes[std::size_t(i)]).text().as_double(1.0);
    }
    const bool sound = std::abs(longitude) <= 180.0 && std::abs(latitude) <= 90.0 &&
                       std::isfinite(height + heading + scale.x + scale.y + scale.z) && upright &&
                       std::min({scale.x, scale.y, scale.z}) > 0.0;
    if (!sound)
        return std::nullopt;
    // A heading counts clockwise from north.
    return importers::geocentric_from_local(longitude * kRadians, latitude * kRadians, height) *
           glm::rotate(glm::dmat4(1.0), -heading * kRadians, glm::dvec3(0.0, 0.0, 1.0)) *
           glm::scale(glm::dmat4(1.0), scale);
}

std::optional<Georeference> georeferenceOf(const Document& document,
                                           std::vector<Diagnostic>& remarks) {
    const auto& nodes = document.model().nodes;
    const bool onEarth = std::any_of(nodes.begin(), nodes.end(), [](const tinygltf::Node& node) {
        return extensionOf(node.extensions, "EXT_georeference").IsObject();
    });
    if (onEarth)
        return Georeference{"EPSG:4978", glm::dmat4(1.0), true};
    if (auto found = inExtension(document, remarks))
        return found;
    if (auto found = inExtras(document))
        return found;
    return besideFile(document.path(), remarks);
}

bool hasGeoreferenceBeside(const fs::path& path) {
    std::error_code ignored;
    constexpr std::array<const char*, 3> kSuffixes{".prj", ".wld3", ".kml"};
    return fs::is_regular_file(geoJsonBeside(path), ignored) ||
           std::any_of(kSuffixes.begin(), kSuffixes.end(), [&](const char* suffix) {
               return fs::is_regular_file(besideAs(path, suffix), ignored);
           });
}

}  // namespace reflet::gltf
