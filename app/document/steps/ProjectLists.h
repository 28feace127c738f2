// SPDX-License-Identifier: GPL-3.0-or-later
// How the lists of a project are addressed by kind and id. Internal to app/document.
#pragma once

#include "app/document/ProjectChanges.h"
#include "core/project/Project.h"
#include "core/project/ProjectItem.h"

#include <QString>
#include <algorithm>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace reflet {

template <class Item>
struct ItemTraits;

template <>
struct ItemTraits<ModelReference> {
    static constexpr auto kKind = ProjectItem::Kind::Model;
    static constexpr auto kChange = ProjectChange::Models;
    static constexpr auto kList = &Project::models;
    static constexpr auto kId = &ModelReference::path;
    static constexpr const char* kJsonList = "models";
    static constexpr const char* kJsonId = "path";
};
template <>
struct ItemTraits<Probe> {
    static constexpr auto kKind = ProjectItem::Kind::Probe;
    static constexpr auto kChange = ProjectChange::Probes;
    static constexpr auto kList = &Project::probes;
    static constexpr auto kId = &Probe::id;
    static constexpr const char* kJsonList = "probes";
    static constexpr const char* kJsonId = "id";
};
template <>
struct ItemTraits<RouteSpec> {
    static constexpr auto kKind = ProjectItem::Kind::Route;
    static constexpr auto kChange = ProjectChange::Routes;
    static constexpr auto kList = &Project::routes;
    static constexpr auto kId = &RouteSpec::id;
    static constexpr const char* kJsonList = "routes";
    static constexpr const char* kJsonId = "id";
};
template <>
struct ItemTraits<VehicleModel> {
    static constexpr auto kKind = ProjectItem::Kind::Vehicle;
    static constexpr auto kChange = ProjectChange::Vehicles;
    static constexpr auto kList = &Project::vehicles;
    static constexpr auto kId = &VehicleModel::id;
    static constexpr const char* kJsonList = "vehicles";
    static constexpr const char* kJsonId = "id";
};
template <>
struct ItemTraits<Reflector> {
    static constexpr auto kKind = ProjectItem::Kind::Reflector;
    static constexpr auto kChange = ProjectChange::Reflectors;
    static constexpr auto kList = &Project::reflectors;
    static constexpr auto kId = &Reflector::id;
    static constexpr const char* kJsonList = "reflectors";
    static constexpr const char* kJsonId = "id";
};
template <>
struct ItemTraits<View> {
    static constexpr auto kKind = ProjectItem::Kind::View;
    static constexpr auto kChange = ProjectChange::Views;
    static constexpr auto kList = &Project::views;
    static constexpr auto kId = &View::name;
    static constexpr const char* kJsonList = "views";
    static constexpr const char* kJsonId = "name";
};

/// One element of any of the lists.
using AnyItem = std::variant<ModelReference, Probe, RouteSpec, VehicleModel, Reflector, View>;

template <class Item>
[[nodiscard]] std::vector<Item>& listOf(Project& project) {
    return project.*ItemTraits<Item>::kList;
}
template <class Item>
[[nodiscard]] const std::vector<Item>& listOf(const Project& project) {
    return project.*ItemTraits<Item>::kList;
}

/// The element with that id, or null. The pointer lives until the project changes.
template <class Item>
[[nodiscard]] const Item* findItem(const Project& project, const std::string& id) {
    const auto& list = listOf<Item>(project);
    const auto found = std::find_if(list.begin(), list.end(), [&](const Item& item) {
        return item.*ItemTraits<Item>::kId == id;
    });
    return found == list.end() ? nullptr : &*found;
}

/// Calls `visit.template operator()<Item>()` for the type of that kind.
template <class Visit>
void visitKind(ProjectItem::Kind kind, const Visit& visit) {
    switch (kind) {
        case ProjectItem::Kind::Model:
            return visit.template operator()<ModelReference>();
        case ProjectItem::Kind::Probe:
            return visit.template operator()<Probe>();
        case ProjectItem::Kind::Route:
            return visit.template operator()<RouteSpec>();
        case ProjectItem::Kind::Vehicle:
            return visit.template operator()<VehicleModel>();
        case ProjectItem::Kind::Reflector:
            return visit.template operator()<Reflector>();
        case ProjectItem::Kind::View:
            return visit.template operator()<View>();
    }
}

[[nodiscard]] bool existsIn(const Project& project, const ProjectItem& item);
[[nodiscard]] ProjectItem itemOf(const AnyItem& item);

/// "probe p7", or the id alone where it says what it is: "probe-7".
[[nodiscard]] QString labelOf(const ProjectItem& item);
/// "probe p7", or "3 probes", or "5 items".
[[nodiscard]] QString labelOf(const std::vector<ProjectItem>& items);

/// `prefix`-1, `prefix`-2 ...: the first that is not taken.
[[nodiscard]] std::string freeId(const std::string& prefix, const std::set<std::string>& taken);
/// The ids of one kind, with those that the project's source knows (of things removed since).
[[nodiscard]] std::set<std::string> takenIds(const Project& project, ProjectItem::Kind kind);

/// What differs between two projects.
[[nodiscard]] ProjectChanges changesBetween(const Project& before, const Project& after);

/// The text `source` with the item of that kind under a new id, so that its unknown keys follow.
[[nodiscard]] std::string renamedInSource(const std::string& source, const ProjectItem& item,
                                          const std::string& newId);

}  // namespace reflet
