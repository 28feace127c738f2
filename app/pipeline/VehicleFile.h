// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"
#include "core/base/JobContext.h"
#include "core/project/Project.h"
#include "core/traffic/GltfModel.h"
#include "core/traffic/VehicleProposal.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace reflet {

/// A vehicle's file as it came in, with what Reflet proposes to do with it: for the dialog of the
/// window and for `reflet-cli info`.
struct VehicleOffer {
    std::shared_ptr<const GltfModel> model;
    VehicleProposal proposal;  ///< path as given, hash of the file
    std::vector<Diagnostic> remarks;
};

/// Errors are those of importVehicle().
[[nodiscard]] Result<VehicleOffer> proposeVehicle(const std::filesystem::path& path,
                                                  const JobContext& job);

/// The vehicle of a project, read from its file. Unreadable when the file is missing, Refused when
/// it is not the one that was brought in.
[[nodiscard]] Result<Vehicle> loadVehicle(const VehicleModel& vehicle,
                                          const std::filesystem::path& folder,
                                          const JobContext& job);

/// By its suffix: .gltf or .glb.
[[nodiscard]] bool isVehicleFile(const std::filesystem::path& path);

/// What a glTF file seems to be.
enum class GltfKind {
    Vehicle,
    City,    ///< it says where it lies, or it is longer and flatter than a vehicle can be
    Unclear  ///< longer than a vehicle can be if its units are metres, and not flat
};
struct GltfGuess {
    GltfKind kind = GltfKind::Vehicle;
    double length = 0.0;  ///< metres, as the file counts
};
/// By its description, without reading its data. What cannot be read is no city.
[[nodiscard]] GltfGuess guessGltf(const std::filesystem::path& path);

/// `name` when it is a built-in vehicle or one of the project's; else the id of a new vehicle of
/// the project, made from the file of that name as proposed. The same file brought in again takes
/// the place of the old one. `folder` is the project file's.
[[nodiscard]] Result<std::string> adoptVehicle(Project& project, const std::string& name,
                                               const std::filesystem::path& folder,
                                               std::vector<Diagnostic>& remarks,
                                               const JobContext& job);

}  // namespace reflet
