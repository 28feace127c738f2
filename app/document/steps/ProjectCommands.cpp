// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/document/steps/ProjectCommands.h"

#include "app/document/files/ModelPaths.h"

namespace reflet {

namespace {

/// QUndoStack asks only commands of one id, other than -1, whether they merge.
constexpr int kDragCommandId = 1;

template <class Visit>
void forEachKind(const Visit& visit) {
    using Kind = ProjectItem::Kind;
    for (const Kind kind :
         {Kind::Model, Kind::Probe, Kind::Route, Kind::Vehicle, Kind::Reflector, Kind::View})
        visitKind(kind, visit);
}

}  // namespace

// ---- what all steps share ----

ProjectCommand::ProjectCommand(ProjectDocument& document, ProjectChanges what, const QString& text)
    : QUndoCommand(text), m_document(document), m_what(what) {}

void ProjectCommand::setDrag(std::string key, int drag) {
    m_key = std::move(key);
    m_drag = drag;
}

int ProjectCommand::id() const {
    return m_drag >= 0 ? kDragCommandId : -1;
}

void ProjectCommand::redo() {
    m_document.edit(
        m_what, [this](Project& project) { apply(project); },
        [this](Items now) { return selectedAfterApply(std::move(now)); });
}

void ProjectCommand::undo() {
    m_document.edit(
        m_what, [this](Project& project) { revert(project); },
        [this](Items now) { return selectedAfterRevert(std::move(now)); });
    if (m_document.m_cancellingDrag)
        setObsolete(true);
}

bool ProjectCommand::mergeWith(const QUndoCommand* next) {
    const auto* other = dynamic_cast<const ProjectCommand*>(next);
    if (other == nullptr || m_drag < 0 || other->m_drag != m_drag || other->m_key != m_key)
        return false;
    // This step keeps the value from before the drag; the project has the newest one already.
    if (changesNothing(m_document.project()))
        setObsolete(true);
    return true;
}

// ---- lists ----

ChangeLists::ChangeLists(ProjectDocument& document, Mode mode, std::vector<Place> places,
                         const QString& text)
    : ProjectCommand(document, changesOf(places), text),
      m_mode(mode),
      m_places(std::move(places)),
      m_folder(document.folder()) {}

ProjectChanges ChangeLists::changesOf(const std::vector<Place>& places) {
    ProjectChanges what;
    for (const Place& place : places) {
        std::visit([&]<class Item>(const Item&) { what |= ItemTraits<Item>::kChange; }, place.item);
    }
    return what;
}

std::unique_ptr<ChangeLists> ChangeLists::add(ProjectDocument& document, std::vector<AnyItem> items,
                                              const QString& text) {
    std::vector<Place> places;
    forEachKind([&]<class Item>() {
        std::size_t index = listOf<Item>(document.project()).size();
        for (AnyItem& item : items) {
            if (std::holds_alternative<Item>(item))
                places.push_back({std::move(item), index++});
        }
    });
    return std::unique_ptr<ChangeLists>(
        new ChangeLists(document, Mode::Add, std::move(places), text));
}

std::unique_ptr<ChangeLists> ChangeLists::remove(ProjectDocument& document,
                                                 const std::vector<ProjectItem>& items,
                                                 const QString& text) {
    std::vector<Place> places;
    forEachKind([&]<class Item>() {
        const auto& list = listOf<Item>(document.project());
        for (std::size_t index = 0; index < list.size(); ++index) {
            if (std::find(items.begin(), items.end(), itemOf(list[index])) != items.end())
                places.push_back({list[index], index});
        }
    });
    return std::unique_ptr<ChangeLists>(
        new ChangeLists(document, Mode::Remove, std::move(places), text));
}

void ChangeLists::insert(Project& project) {
    const auto folder = document().folder();
    for (Place& place : m_places) {
        if (auto* model = std::get_if<ModelReference>(&place.item))
            model->path = rebasedPath(model->path, m_folder, folder);
        if (auto* vehicle = std::get_if<VehicleModel>(&place.item))
            vehicle->path = rebasedPath(vehicle->path, m_folder, folder);
        std::visit(
            [&]<class Item>(const Item& item) {
                auto& list = listOf<Item>(project);
                list.insert(list.begin() + std::ptrdiff_t(place.index), item);
            },
            place.item);
    }
    m_folder = folder;
}

void ChangeLists::erase(Project& project) const {
    for (auto place = m_places.rbegin(); place != m_places.rend(); ++place) {
        std::visit(
            [&]<class Item>(const Item&) {
                auto& list = listOf<Item>(project);
                list.erase(list.begin() + std::ptrdiff_t(place->index));
            },
            place->item);
    }
}

void ChangeLists::apply(Project& project) {
    if (m_mode == Mode::Add) {
        insert(project);
    } else {
        erase(project);
    }
}

void ChangeLists::revert(Project& project) {
    if (m_mode == Mode::Add) {
        erase(project);
    } else {
        insert(project);
    }
}

ProjectCommand::Items ChangeLists::items() const {
    Items out;
    for (const Place& place : m_places)
        out.push_back(itemOf(place.item));
    return out;
}

ProjectCommand::Items ChangeLists::selectedAfterApply(Items now) const {
    return m_mode == Mode::Add ? items() : now;
}

ProjectCommand::Items ChangeLists::selectedAfterRevert(Items now) const {
    return m_mode == Mode::Remove ? items() : now;
}

// ---- names ----

RenameItem::RenameItem(ProjectDocument& document, const ProjectItem& item, std::string newId,
                       const QString& text)
    : ProjectCommand(
          document,
          item.kind == ProjectItem::Kind::Route || item.kind == ProjectItem::Kind::Vehicle
              ? ProjectChanges(ProjectChange::Reflectors)
              : ProjectChanges(),
          text),
      m_kind(item.kind),
      m_from(item.id),
      m_to(std::move(newId)),
      m_source(renamedInSource(document.project().source, item, m_to)),
      m_folder(document.folder()) {
    visitKind(m_kind, [&]<class Item>() { addChange(ItemTraits<Item>::kChange); });
}

void RenameItem::rename(Project& project, const std::string& from, const std::string& to) {
    visitKind(m_kind, [&]<class Item>() {
        for (Item& item : listOf<Item>(project)) {
            if (item.*ItemTraits<Item>::kId == from)
                item.*ItemTraits<Item>::kId = to;
        }
    });
    for (Reflector& reflector : project.reflectors) {
        if (m_kind == ProjectItem::Kind::Route && reflector.route == from)
            reflector.route = to;
        if (m_kind == ProjectItem::Kind::Vehicle && reflector.vehicle == from)
            reflector.vehicle = to;
    }
    const auto folder = document().folder();
    m_source = rebasedSource(m_source, m_folder, folder);
    m_folder = folder;
    std::swap(project.source, m_source);
}

namespace {
std::vector<ProjectItem> renamed(std::vector<ProjectItem> items, const ProjectItem& from,
                                 const std::string& to) {
    for (ProjectItem& item : items) {
        if (item == from)
            item.id = to;
    }
    return items;
}
}  // namespace

ProjectCommand::Items RenameItem::selectedAfterApply(Items now) const {
    return renamed(std::move(now), {m_kind, m_from}, m_to);
}

ProjectCommand::Items RenameItem::selectedAfterRevert(Items now) const {
    return renamed(std::move(now), {m_kind, m_to}, m_from);
}

// ---- everything ----

ReplaceProject::ReplaceProject(ProjectDocument& document, Project after, ProjectChanges what,
                               const QString& text)
    : ProjectCommand(document, what, text),
      m_other(std::move(after)),
      m_folder(document.folder()) {}

void ReplaceProject::apply(Project& project) {
    const auto folder = document().folder();
    rebasePaths(m_other, m_folder, folder);
    m_folder = folder;
    std::swap(project, m_other);
}

}  // namespace reflet
