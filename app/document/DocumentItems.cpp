// SPDX-License-Identifier: GPL-3.0-or-later
// What ProjectDocument does with any kind of item: duplicate, remove, rename.
#include "app/document/ProjectDocument.h"
#include "app/document/steps/ProjectChecks.h"
#include "app/document/steps/ProjectCommands.h"
#include "core/traffic/Vehicle.h"

#include <algorithm>

namespace reflet {

namespace {

using Kind = ProjectItem::Kind;

/// Metres that copies stand beside what they were copied from: seen, and still in the street.
constexpr glm::dvec3 kCopyOffset(2.0, 2.0, 0.0);
/// Metres between a vehicle and its copy behind it: a tram's length and some.
constexpr double kCopyHeadway = 40.0;

Probe copyOf(const Probe& probe) {
    Probe copy = probe;
    copy.position += kCopyOffset;
    return copy;
}

RouteSpec copyOf(const RouteSpec& route) {
    RouteSpec copy = route;
    for (auto& point : copy.points)
        point += kCopyOffset;
    return copy;
}

Reflector copyOf(const Reflector& reflector) {
    Reflector copy = reflector;
    copy.start = copy.start >= kCopyHeadway ? copy.start - kCopyHeadway : copy.start + kCopyHeadway;
    return copy;
}

View copyOf(const View& view) {
    return view;
}

ModelReference copyOf(const ModelReference& model) {
    return model;
}

VehicleModel copyOf(const VehicleModel& vehicle) {
    return vehicle;
}

/// The next name of its row that is free: "p009" gives "p010", "bridge" gives "bridge-2".
std::string copyName(const ProjectItem& item, const std::set<std::string>& taken) {
    constexpr std::size_t kMostDigits = 6;
    const std::size_t stemLength = item.id.find_last_not_of("0123456789") + 1;
    const std::size_t digits = std::min(item.id.size() - stemLength, kMostDigits);
    std::string stem = item.id.substr(0, item.id.size() - digits);
    int number = 1;
    if (digits > 0) {
        number = std::stoi(item.id.substr(item.id.size() - digits));
    } else {
        stem += item.kind == Kind::View ? " " : "-";
    }
    for (;;) {
        std::string text = std::to_string(++number);
        if (text.size() < digits)
            text.insert(0, digits - text.size(), '0');
        if (taken.count(stem + text) == 0)
            return stem + text;
    }
}

Error nothingThere(const ProjectItem& item) {
    return {ErrorCode::Usage,
            "the project has nothing of that name",
            labelOf(item).toStdString(),
            "Choose one from the project tree.",
            {}};
}

/// The items that exist, and the vehicles that need routes or vehicle models among them.
std::vector<ProjectItem> withDependents(const Project& project,
                                        const std::vector<ProjectItem>& items) {
    std::vector<ProjectItem> out;
    const auto add = [&](const ProjectItem& item) {
        if (existsIn(project, item) && std::find(out.begin(), out.end(), item) == out.end())
            out.push_back(item);
    };
    for (const ProjectItem& item : items) {
        add(item);
        for (const Reflector& reflector : project.reflectors) {
            const bool needsIt = (item.kind == Kind::Route && reflector.route == item.id) ||
                                 (item.kind == Kind::Vehicle && reflector.vehicle == item.id);
            if (needsIt)
                add({Kind::Reflector, reflector.id});
        }
    }
    return out;
}

}  // namespace

Result<std::vector<std::string>> ProjectDocument::duplicate(const std::vector<ProjectItem>& items) {
    std::vector<AnyItem> copies;
    std::vector<std::string> ids;
    std::set<std::string> taken;
    for (const ProjectItem& item : items) {
        if (item.kind == Kind::Model || item.kind == Kind::Vehicle) {
            return fail(ErrorCode::Usage, "city models and vehicle models are not copied",
                        labelOf(item).toStdString(), "Import the file again.");
        }
        if (!existsIn(m_project, item))
            return tl::unexpected(nothingThere(item));
        taken.merge(takenIds(m_project, item.kind));
        visitKind(item.kind, [&]<class Item>() {
            Item copy = copyOf(*findItem<Item>(m_project, item.id));
            std::string& id = copy.*ItemTraits<Item>::kId;
            id = copyName(item, taken);
            taken.insert(id);
            ids.push_back(id);
            copies.push_back(std::move(copy));
        });
    }
    for (const AnyItem& copy : copies) {
        const auto* probe = std::get_if<Probe>(&copy);
        const auto* route = std::get_if<RouteSpec>(&copy);
        const auto fault = probe ? faultOf(*probe) : route ? faultOf(*route) : std::nullopt;
        if (fault)
            return tl::unexpected(*fault);
    }
    if (!copies.empty())
        push(ChangeLists::add(*this, std::move(copies), tr("Duplicate %1").arg(labelOf(items))));
    return ids;
}

void ProjectDocument::remove(const std::vector<ProjectItem>& items) {
    const auto all = withDependents(m_project, items);
    if (all.empty())
        return;
    // The text speaks of what was asked for: vehicles go without saying.
    std::vector<ProjectItem> asked = items;
    std::erase_if(asked, [&](const ProjectItem& item) { return !existsIn(m_project, item); });
    push(ChangeLists::remove(*this, all, tr("Remove %1").arg(labelOf(asked))));
}

Result<void> ProjectDocument::rename(const ProjectItem& item, const std::string& newId) {
    if (!existsIn(m_project, item))
        return tl::unexpected(nothingThere(item));
    if (item.id == newId)
        return {};
    if (item.kind == Kind::Model) {
        return fail(ErrorCode::Usage, "a model has the name of its file",
                    labelOf(item).toStdString(), "Rename the file, and import it again.");
    }
    const auto builtIn = builtInVehicleNames();
    if (item.kind == Kind::Vehicle &&
        std::find(builtIn.begin(), builtIn.end(), newId) != builtIn.end()) {
        return fail(ErrorCode::Usage, "a built-in vehicle has this name", newId,
                    "Choose another name.");
    }
    const bool blank = QString::fromStdString(newId).trimmed().isEmpty();
    if (blank || existsIn(m_project, {item.kind, newId})) {
        return fail(ErrorCode::Usage, blank ? "the name is empty" : "the name is taken", newId,
                    "Choose a name that nothing else of this kind has.");
    }
    const QString text = tr("Rename %1 to %2").arg(labelOf(item), QString::fromStdString(newId));
    push(std::make_unique<RenameItem>(*this, item, newId, text));
    return {};
}

}  // namespace reflet
