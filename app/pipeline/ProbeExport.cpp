// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/LonLat.h"
#include "app/pipeline/ProbeFiles.h"
#include "core/base/Files.h"
#include "core/io/PlaceTable.h"
#include "core/io/VectorWriter.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <optional>

namespace reflet {

namespace {

using nlohmann::json;

/// Longitude and latitude of each, where the project has a place on the Earth.
std::optional<std::vector<glm::dvec2>> lonLatOf(const std::vector<Probe>& probes,
                                                const ProjectFrame& frame) {
    std::vector<glm::dvec3> places;
    for (const Probe& probe : probes)
        places.push_back(probe.position);
    return reflet::lonLatOf(frame, places);
}

/// The number of the frame's EPSG code; empty for another system.
std::string epsgNumber(const ProjectFrame& frame) {
    constexpr std::string_view kEpsg = "EPSG:";
    return frame.crs && frame.crs->starts_with(kEpsg) ? frame.crs->substr(kEpsg.size())
                                                      : std::string();
}

std::string asTable(const std::vector<Probe>& probes, const ProjectFrame& frame) {
    std::string out = "id,east,north,up,lon,lat,epsg,resolution,locked\n";
    const auto degrees = lonLatOf(probes, frame);
    for (std::size_t k = 0; k < probes.size(); ++k) {
        const Probe& probe = probes[k];
        out += fmt::format("{},{:.4f},{:.4f},{:.4f},{},{},{},{},{}\n", tableField(probe.id),
                           probe.position.x, probe.position.y, probe.position.z,
                           degrees ? fmt::format("{:.9f}", (*degrees)[k].x) : "",
                           degrees ? fmt::format("{:.9f}", (*degrees)[k].y) : "", epsgNumber(frame),
                           probe.resolution ? std::to_string(*probe.resolution) : "",
                           probe.locked ? "true" : "false");
    }
    return out;
}

std::string asJson(const std::vector<Probe>& probes, const ProjectFrame& frame) {
    json list = json::array();
    const auto degrees = lonLatOf(probes, frame);
    for (std::size_t k = 0; k < probes.size(); ++k) {
        const Probe& probe = probes[k];
        list.push_back({{"id", probe.id},
                        {"position", {probe.position.x, probe.position.y, probe.position.z}},
                        {"lon", degrees ? json((*degrees)[k].x) : json()},
                        {"lat", degrees ? json((*degrees)[k].y) : json()},
                        {"resolution", probe.resolution ? json(*probe.resolution) : json()},
                        {"locked", probe.locked}});
    }
    return json{{"crs", frame.crs ? json(*frame.crs) : json()}, {"probes", list}}.dump(2) + "\n";
}

WrittenLayer asLayer(const std::vector<Probe>& probes) {
    using Kind = VectorColumn::Kind;
    WrittenLayer layer{"probes",
                       WrittenLayer::Kind::Points,
                       {{"id", Kind::Text}, {"resolution", Kind::Integer}, {"locked", Kind::Yes}},
                       {}};
    for (const Probe& probe : probes)
        layer.shapes.push_back(
            {{probe.position},
             {probe.id,
              probe.resolution ? VectorValue(std::int64_t(*probe.resolution)) : VectorValue(),
              probe.locked}});
    return layer;
}

}  // namespace

Result<void> writeProbes(const std::vector<Probe>& probes, const ProjectFrame& frame,
                         const std::filesystem::path& path) {
    const std::string suffix = path.extension().string();
    if (suffix == ".csv")
        return writeFileAtomically(path, asTable(probes, frame));
    if (suffix == ".json")
        return writeFileAtomically(path, asJson(probes, frame));
    if (suffix == ".geojson" || suffix == ".gpkg")
        return writeVector({asLayer(probes)}, frame, path);
    return fail(ErrorCode::Usage, "is in no form that probes are written in", path.string(),
                "End it in .csv, .geojson, .gpkg or .json.");
}

}  // namespace reflet
