// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/city/CityModel.h"

#include <cstddef>
#include <string>
#include <vector>

namespace reflet {

/// What became of a city object between two deliveries of a city.
struct ObjectChange {
    enum class Kind { Added, Removed, Changed };
    Kind kind = Kind::Changed;
    std::string id, type;      ///< type as the file has it, of the newer delivery where it is there
    bool geometry = false;     ///< of a changed one: another shape, place or level of detail
    bool appearance = false;   ///< other materials, textures or semantic surfaces
    bool description = false;  ///< another type or another parent
    bool attributes = false;   ///< set by who knows them: the model does not
    Box before, after;         ///< frame; empty where it shows nothing
};
[[nodiscard]] const char* toString(ObjectChange::Kind kind);

struct CityChanges {
    std::vector<ObjectChange> objects;  ///< added, removed, changed; by id within each
    std::size_t unchanged = 0;
    std::size_t common = 0;  ///< ids that both deliveries have

    [[nodiscard]] std::size_t count(ObjectChange::Kind kind) const;
    void sort();
};

/// Compares two cities in one frame, object by object by their ids. Geometry is compared to a
/// millimetre, surface by surface, whatever the order of surfaces and of the points in a ring.
[[nodiscard]] CityChanges changesBetween(const CityModel& before, const CityModel& after);

}  // namespace reflet
