// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/VehicleFile.h"

#include "app/pipeline/LoadedCity.h"
#include "app/pipeline/Traffic.h"
#include "importers/gltf/GltfImporter.h"
#include "importers/gltf/GltfOutline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace reflet {

namespace {

const char* const kBringAgain =
    "Put the file back, or bring it in again with `reflet-cli edit "
    "--vehicle ID=FILE,ROUTE`.";

bool taken(const Project& project, const std::string& id) {
    const auto builtIn = builtInVehicleNames();
    return std::find(builtIn.begin(), builtIn.end(), id) != builtIn.end() ||
           std::any_of(project.vehicles.begin(), project.vehicles.end(),
                       [&](const VehicleModel& v) { return v.id == id; });
}

std::string freeId(const Project& project, const std::string& wish) {
    std::string id = wish.empty() ? "vehicle" : wish;
    for (int i = 2; taken(project, id); ++i)
        id = fmt::format("{}-{}", wish, i);
    return id;
}

/// Relative to the project's folder where that is possible.
std::string storedPath(const std::filesystem::path& file, const std::filesystem::path& folder) {
    std::error_code error;
    const auto absolute = std::filesystem::absolute(file).lexically_normal();
    const auto base = std::filesystem::absolute(folder.empty() ? "." : folder).lexically_normal();
    const auto relative = std::filesystem::relative(absolute, base, error);
    return (error || relative.empty() ? absolute : relative).generic_string();
}

}  // namespace

bool isVehicleFile(const std::filesystem::path& path) {
    std::string suffix = path.extension().string();
    std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return suffix == ".gltf" || suffix == ".glb";
}

Result<VehicleOffer> proposeVehicle(const std::filesystem::path& path, const JobContext& job) {
    auto imported = importVehicle(path, {}, job);
    if (!imported)
        return tl::unexpected(imported.error());
    const auto hash = fileHash(path);
    if (!hash)
        return tl::unexpected(hash.error());
    VehicleOffer offer;
    offer.remarks = std::move(imported->diagnostics);
    offer.proposal = proposeFit(imported->value);
    offer.proposal.model.path = path.generic_string();
    offer.proposal.model.hash = *hash;
    offer.model = std::make_shared<const GltfModel>(std::move(imported->value));
    return offer;
}

Result<Vehicle> loadVehicle(const VehicleModel& vehicle, const std::filesystem::path& folder,
                            const JobContext& job) {
    const std::filesystem::path path = vehiclePath(vehicle, folder);
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) {
        return fail(ErrorCode::Unreadable, "the file of the vehicle " + vehicle.id + " is missing",
                    path.string(), kBringAgain);
    }
    const auto hash = fileHash(path);
    if (!hash)
        return tl::unexpected(hash.error());
    if (!vehicle.hash.empty() && *hash != vehicle.hash) {
        return fail(ErrorCode::Refused,
                    "the file of the vehicle " + vehicle.id + " is not the one that was brought in",
                    path.string(), kBringAgain);
    }
    const auto imported = importVehicle(path, {}, job);
    if (!imported)
        return tl::unexpected(imported.error());
    return makeVehicle(imported->value, vehicle);
}

GltfGuess guessGltf(const std::filesystem::path& path) {
    constexpr double kLongestVehicle = 60.0;  // metres
    constexpr double kFlat = 0.3;             // height by width: vehicles are higher
    const auto outline = gltf::readOutline(path);
    if (!outline)
        return {};
    const glm::dvec3 size = outline->bounds.size();
    // Some files have z up, whatever glTF says: the least of the three is the height of a city.
    const double least = std::min({size.x, size.y, size.z});
    const double length = std::max({size.x, size.y, size.z});
    const double width = size.x + size.y + size.z - least - length;
    GltfGuess guess{GltfKind::Vehicle, std::isfinite(length) ? std::max(length, 0.0) : 0.0};
    if (outline->georeferenced)
        guess.kind = GltfKind::City;
    else if (guess.length > kLongestVehicle)
        guess.kind = least < kFlat * width ? GltfKind::City : GltfKind::Unclear;
    return guess;
}

Result<std::string> adoptVehicle(Project& project, const std::string& name,
                                 const std::filesystem::path& folder,
                                 std::vector<Diagnostic>& remarks, const JobContext& job) {
    if (!isVehicleFile(name)) {
        if (taken(project, name))
            return name;
        return fail(
            ErrorCode::Usage, "there is no vehicle of this name", name,
            "Use tram, bus, car, sphere, woman, man, child, whale or mirror-tree, or a glTF "
            "file (.glb or .gltf).");
    }
    auto offer = proposeVehicle(name, job);
    if (!offer)
        return tl::unexpected(offer.error());
    VehicleModel model = offer->proposal.model;
    model.path = storedPath(name, folder);
    for (auto& remark : offer->remarks)
        remarks.push_back(std::move(remark));
    for (const auto& concern : offer->proposal.concerns)
        remarks.push_back({Severity::Warning, "vehicle-guessed", model.id, concern,
                           "Change it under \"vehicles\" in the project."});
    const auto same = std::find_if(project.vehicles.begin(), project.vehicles.end(),
                                   [&](const VehicleModel& v) { return v.path == model.path; });
    if (same != project.vehicles.end()) {
        model.id = same->id;
        *same = model;
    } else {
        model.id = freeId(project, model.id);
        project.vehicles.push_back(model);
    }
    return model.id;
}

}  // namespace reflet
