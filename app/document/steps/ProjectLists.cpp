// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/document/steps/ProjectLists.h"

#include <nlohmann/json.hpp>

#include <QCoreApplication>

namespace reflet {

namespace {

using nlohmann::json;
using Kind = ProjectItem::Kind;

QString tr(const char* text, int count = -1) {
    return QCoreApplication::translate("reflet::ProjectDocument", text, nullptr, count);
}

QString noun(Kind kind) {
    switch (kind) {
        case Kind::Model:
            return tr("model");
        case Kind::Probe:
            return tr("probe");
        case Kind::Route:
            return tr("route");
        case Kind::Reflector:
            return tr("vehicle");
        case Kind::Vehicle:
            return tr("vehicle model");
        case Kind::View:
            return tr("view");
    }
    return tr("item");
}

QString counted(Kind kind, int count) {
    switch (kind) {
        case Kind::Model:
            return tr("%n models", count);
        case Kind::Probe:
            return tr("%n probes", count);
        case Kind::Route:
            return tr("%n routes", count);
        case Kind::Reflector:
            return tr("%n vehicles", count);
        case Kind::Vehicle:
            return tr("%n vehicle models", count);
        case Kind::View:
            return tr("%n views", count);
    }
    return tr("%n items", count);
}

}  // namespace

bool existsIn(const Project& project, const ProjectItem& item) {
    bool exists = false;
    visitKind(item.kind,
              [&]<class Item>() { exists = findItem<Item>(project, item.id) != nullptr; });
    return exists;
}

ProjectItem itemOf(const AnyItem& item) {
    return std::visit(
        []<class Item>(const Item& value) {
            return ProjectItem{ItemTraits<Item>::kKind, value.*ItemTraits<Item>::kId};
        },
        item);
}

QString labelOf(const ProjectItem& item) {
    const QString id = QString::fromStdString(item.id);
    if (item.kind == Kind::Model)
        return noun(item.kind) + u' ' + id.section(u'/', -1);
    const bool speaks =
        item.kind == Kind::Reflector || id.startsWith(noun(item.kind) + u'-', Qt::CaseInsensitive);
    return speaks ? id : noun(item.kind) + u' ' + id;
}

QString labelOf(const std::vector<ProjectItem>& items) {
    if (items.size() == 1)
        return labelOf(items.front());
    const int count = static_cast<int>(items.size());
    const bool alike = std::all_of(items.begin(), items.end(), [&](const ProjectItem& item) {
        return item.kind == items.front().kind;
    });
    return alike && !items.empty() ? counted(items.front().kind, count) : tr("%n items", count);
}

std::string freeId(const std::string& prefix, const std::set<std::string>& taken) {
    for (int number = 1;; ++number) {
        std::string id = prefix + "-" + std::to_string(number);
        if (taken.count(id) == 0)
            return id;
    }
}

std::set<std::string> takenIds(const Project& project, Kind kind) {
    std::set<std::string> taken;
    const json source = json::parse(project.source, nullptr, false);
    visitKind(kind, [&]<class Item>() {
        using Traits = ItemTraits<Item>;
        for (const Item& item : listOf<Item>(project))
            taken.insert(item.*Traits::kId);
        if (!source.is_object())
            return;
        for (const json& element : source.value(Traits::kJsonList, json::array())) {
            const json id = element.is_object() ? element.value(Traits::kJsonId, json()) : json();
            if (id.is_string())
                taken.insert(id.get<std::string>());
        }
    });
    return taken;
}

ProjectChanges changesBetween(const Project& a, const Project& b) {
    if (!(a.frame == b.frame))
        return ProjectChange::All;
    ProjectChanges what;
    what.setFlag(ProjectChange::Models,
                 a.models != b.models || a.generatedGround != b.generatedGround);
    what.setFlag(ProjectChange::Heightfield, !(a.heightfield == b.heightfield));
    what.setFlag(ProjectChange::Bake, !(a.bake == b.bake));
    what.setFlag(ProjectChange::Tuning, !(a.tuning == b.tuning));
    what.setFlag(ProjectChange::Probes, a.probes != b.probes);
    what.setFlag(ProjectChange::Routes, a.routes != b.routes);
    what.setFlag(ProjectChange::Vehicles, a.vehicles != b.vehicles);
    what.setFlag(ProjectChange::Reflectors, a.reflectors != b.reflectors);
    what.setFlag(ProjectChange::Views, a.views != b.views);
    what.setFlag(ProjectChange::Light, !(a.date == b.date) || a.turbidity != b.turbidity);
    what.setFlag(ProjectChange::Exposure, a.exposure != b.exposure);
    what.setFlag(ProjectChange::Name, a.name != b.name);
    return what;
}

std::string renamedInSource(const std::string& source, const ProjectItem& item,
                            const std::string& newId) {
    json root = json::parse(source, nullptr, false);
    if (!root.is_object())
        return source;
    visitKind(item.kind, [&]<class Item>() {
        using Traits = ItemTraits<Item>;
        const auto list = root.find(Traits::kJsonList);
        if (list == root.end() || !list->is_array())
            return;
        const auto named = [](const json& element, const std::string& id) {
            return element.is_object() && element.value(Traits::kJsonId, json()) == json(id);
        };
        json renamed = json::array();
        for (json& element : *list) {
            if (named(element, newId))
                continue;  // of something removed: its keys are not the renamed item's
            if (named(element, item.id))
                element[Traits::kJsonId] = newId;
            renamed.push_back(std::move(element));
        }
        *list = std::move(renamed);
    });
    return root.dump();
}

}  // namespace reflet
