// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"
#include "core/traffic/Vehicle.h"

#include <filesystem>
#include <optional>
#include <string>

namespace reflet {

/// Built-in vehicles as they were modelled once, in the folder "vehicle" of a project's cache: a
/// tram takes a third of a second to model and none to read. Safe to delete at any time, renamed
/// into place whole; a file that is damaged, or that another version of Reflet wrote, counts as
/// absent.
class VehicleCache {
public:
    explicit VehicleCache(const std::filesystem::path& folder) : m_folder(folder / "vehicle") {}

    [[nodiscard]] std::optional<Vehicle> find(const std::string& name) const;
    /// WriteFailed.
    [[nodiscard]] Result<void> store(const std::string& name, const Vehicle& vehicle) const;
    [[nodiscard]] std::filesystem::path pathOf(const std::string& name) const;

private:
    std::filesystem::path m_folder;
};

/// builtInVehicle() from the cache, else modelled and kept. A folder that cannot be written to
/// costs time, nothing else.
[[nodiscard]] Result<Vehicle> builtInVehicle(const std::string& name, const VehicleCache& cache);

}  // namespace reflet
