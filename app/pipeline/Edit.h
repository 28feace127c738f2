// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/Place.h"
#include "app/pipeline/PreparedCity.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

struct ProbeRequest {
    std::string id;
    double east = 0.0, north = 0.0;  ///< absolute, project CRS
    std::optional<double> up;        ///< project datum; nullopt = 1.75 m above the ground
};

struct VehicleRequest {
    std::string id;       ///< of the reflector
    std::string vehicle;  ///< built-in, of the project, or a glTF file
    std::string route;
};

struct EditRequest {
    /// Orders of coordinates by models (see withAxisOrder()); before everything else.
    std::vector<std::pair<std::string, std::string>> axes;
    std::vector<PlaceRequest> places;  ///< of models; before what stands in the project
    std::vector<ProbeRequest> probes;
    std::optional<double>
        probesEvery;  ///< metres along the routes of the reflectors (or all routes)
    std::vector<NoProbeArea> noProbes;      ///< added, or changed where the id is known
    std::vector<std::string> lock, unlock;  ///< ids of probes
    std::vector<std::string> remove;        ///< ids of probes, routes, reflectors or names of views
    std::vector<std::filesystem::path> routes;
    std::vector<VehicleRequest> vehicles;
    std::vector<std::pair<std::string, double>> interests;      ///< of reflectors, by id
    std::vector<std::pair<std::string, std::string>> settings;  ///< dotted key, value
};

struct EditReport {
    Project project;
    std::size_t probesAdded = 0;
    std::size_t routesAdded = 0;
    std::vector<Diagnostic> remarks;
};

/// Changes a project file; all or nothing. Usage for unknown ids and keys, with the known ones.
[[nodiscard]] Result<EditReport> editProject(const std::filesystem::path& projectFile,
                                             const EditRequest& request, const JobContext& job);

/// Reads lines of a vector file as routes, draped on the ground where they have no height, and puts
/// `vehicle` ("" = none; a
/// built-in vehicle, one of the project, or a glTF file, see adoptVehicle) on each. `projectFile`
/// decides where the models are looked for.
[[nodiscard]] Result<std::size_t> addRoutes(
    Project& project, const std::filesystem::path& projectFile, const std::filesystem::path& lines,
    const std::string& vehicle, std::vector<Diagnostic>& remarks, const JobContext& job);

/// Adds probes every `step` metres along the routes that vehicles drive (all routes without any
/// vehicle), as many as are returned. Usage when the step is out of range or there is no route.
[[nodiscard]] Result<std::size_t> placeProbesEvery(Project& project, double step);

/// Height of probes above the running surface: the middle of a vehicle's body.
inline constexpr double kProbeHeight = 1.75;

}  // namespace reflet
