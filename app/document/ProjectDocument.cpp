// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/document/ProjectDocument.h"

#include "app/document/files/ProjectLock.h"
#include "app/document/steps/ProjectChecks.h"
#include "app/document/steps/ProjectCommands.h"
#include "core/traffic/UsualSpeed.h"
#include "core/traffic/Vehicle.h"

#include <cctype>

namespace reflet {

namespace {

/// A drag whose end was never told, or that rests, holds up the autosave for this long.
constexpr qint64 kLongestRestMilliseconds = 10'000;
constexpr qint64 kAfterDragMilliseconds = 1'000;

QString idText(const std::string& id) {
    return QString::fromStdString(id);
}

Error unknown(const QString& label) {
    return {ErrorCode::Usage,
            "the project has nothing of that name",
            label.toStdString(),
            "Choose one from the project tree.",
            {}};
}

}  // namespace

ProjectDocument::~ProjectDocument() {
    const QSignalBlocker silent(m_undoStack);
    m_undoStack.clear();
}

// ---- the way of every change ----

void ProjectDocument::edit(ProjectChanges what, const std::function<void(Project&)>& change,
                           const std::function<Items(Items)>& select) {
    change(m_project);
    ++m_revision;
    Items selected = select(m_selection.items());
    std::erase_if(selected, [&](const ProjectItem& item) { return !existsIn(m_project, item); });
    const bool reselected = m_selection.replace(std::move(selected));
    Q_EMIT projectChanged(what);
    if (reselected)
        Q_EMIT m_selection.changed();
}

void ProjectDocument::push(std::unique_ptr<ProjectCommand> command) {
    if (command->drag() >= 0) {
        m_lastDrag = std::max(m_lastDrag, command->drag());
        m_sinceDrag.start();
    }
    m_undoStack.push(command.release());
}

template <class Value>
void ProjectDocument::change(Value Project::*member, Value value, ProjectChange what,
                             const char* key, const QString& text, int drag) {
    if (m_project.*member == value)
        return;
    auto command =
        std::make_unique<ChangeMember<Value>>(*this, member, std::move(value), what, text);
    command->setDrag(key, drag);
    push(std::move(command));
}

template <class Item>
void ProjectDocument::change(const Item& item, const QString& text, int drag) {
    const ProjectItem name = itemOf(item);
    const Item* now = findItem<Item>(m_project, name.id);
    if (now == nullptr)
        return refuse(unknown(labelOf(name)));
    if (*now == item)
        return;
    auto command = std::make_unique<ChangeElements<Item>>(*this, std::vector<Item>{item}, text);
    command->setDrag(std::string(ItemTraits<Item>::kJsonList) + "/" + name.id, drag);
    push(std::move(command));
}

template <class Item>
void ProjectDocument::changeAll(std::vector<Item> items, int drag) {
    std::string key = ItemTraits<Item>::kJsonList;
    bool changed = false;
    for (const Item& item : items) {
        const ProjectItem name = itemOf(item);
        const Item* now = findItem<Item>(m_project, name.id);
        if (now == nullptr)
            return refuse(unknown(labelOf(name)));
        changed = changed || !(*now == item);
        key += "/" + name.id;
    }
    if (!changed)
        return;
    const QString text = tr("Change %n things", nullptr, int(items.size()));
    auto command = std::make_unique<ChangeElements<Item>>(*this, std::move(items), text);
    command->setDrag(std::move(key), drag);
    push(std::move(command));
}

void ProjectDocument::refuse(Error error) {
    Q_EMIT changeRefused(error);
}

// ---- drags ----

int ProjectDocument::beginDrag() {
    m_dragging = true;
    m_sinceDrag.start();
    return ++m_lastDrag;
}

void ProjectDocument::endDrag() {
    m_dragging = false;
    m_sinceDrag.invalidate();
}

void ProjectDocument::cancelDrag(int drag) {
    endDrag();
    const int top = m_undoStack.index() - 1;
    if (drag < 0 || top < 0)
        return;
    const auto* command = dynamic_cast<const ProjectCommand*>(m_undoStack.command(top));
    if (command == nullptr || command->drag() != drag)
        return;
    m_cancellingDrag = true;
    m_undoStack.undo();
    m_cancellingDrag = false;
}

bool ProjectDocument::isDragging() const {
    const qint64 rest = m_dragging ? kLongestRestMilliseconds : kAfterDragMilliseconds;
    return m_sinceDrag.isValid() && !m_sinceDrag.hasExpired(rest);
}

// ---- probes, routes, vehicles, views ----

std::string ProjectDocument::addProbe(const glm::dvec3& absolute) {
    Probe probe;
    probe.id = freeId("probe", takenIds(m_project, ProjectItem::Kind::Probe));
    probe.position = absolute;
    if (auto fault = faultOf(probe)) {
        refuse(std::move(*fault));
        return {};
    }
    push(ChangeLists::add(*this, {probe}, tr("Add %1").arg(labelOf(itemOf(probe)))));
    return probe.id;
}

void ProjectDocument::moveProbe(const std::string& id, const glm::dvec3& absolute, int drag) {
    const Probe* now = findItem<Probe>(m_project, id);
    if (now == nullptr)
        return refuse(unknown(labelOf(ProjectItem{ProjectItem::Kind::Probe, id})));
    Probe moved = *now;
    moved.position = absolute;
    setProbe(moved, drag);
}

void ProjectDocument::setProbe(const Probe& probe, int drag) {
    if (auto fault = faultOf(probe))
        return refuse(std::move(*fault));
    const Probe* now = findItem<Probe>(m_project, probe.id);
    const bool moved = now != nullptr && now->position != probe.position;
    const bool locked = now != nullptr && now->locked != probe.locked;
    const QString text = moved          ? tr("Move %1")
                         : !locked      ? tr("Change resolution of %1")
                         : probe.locked ? tr("Lock %1")
                                        : tr("Unlock %1");
    change(probe, text.arg(labelOf(itemOf(probe))), drag);
}

void ProjectDocument::setProbes(const std::vector<Probe>& probes, int drag) {
    if (probes.size() == 1)
        return setProbe(probes.front(), drag);
    for (const Probe& probe : probes) {
        if (auto fault = faultOf(probe))
            return refuse(std::move(*fault));
    }
    changeAll(probes, drag);
}

std::string ProjectDocument::addRoute(const std::vector<glm::dvec3>& absolute) {
    /// Metres; a tram's tightest curve is about 18 m.
    constexpr double kCornerRadius = 12.0;
    RouteSpec route;
    route.id = freeId("route", takenIds(m_project, ProjectItem::Kind::Route));
    route.points = absolute;
    route.cornerRadius = kCornerRadius;
    if (auto fault = faultOf(route)) {
        refuse(std::move(*fault));
        return {};
    }
    push(ChangeLists::add(*this, {route}, tr("Draw %1").arg(labelOf(itemOf(route)))));
    return route.id;
}

void ProjectDocument::setRoute(const RouteSpec& route, int drag) {
    if (auto fault = faultOf(route))
        return refuse(std::move(*fault));
    change(route, tr("Change %1").arg(labelOf(itemOf(route))), drag);
}

void ProjectDocument::setRoutes(const std::vector<RouteSpec>& routes, int drag) {
    if (routes.size() == 1)
        return setRoute(routes.front(), drag);
    for (const RouteSpec& route : routes) {
        if (auto fault = faultOf(route))
            return refuse(std::move(*fault));
    }
    changeAll(routes, drag);
}

std::string ProjectDocument::addReflector(const std::string& vehicle, const std::string& route) {
    if (findItem<RouteSpec>(m_project, route) == nullptr) {
        refuse(unknown(labelOf(ProjectItem{ProjectItem::Kind::Route, route})));
        return {};
    }
    Reflector reflector;
    reflector.vehicle = vehicle;
    reflector.speed = usualSpeed(vehicle);
    reflector.route = route;
    reflector.id = freeId(vehicle.empty() ? "vehicle" : vehicle,
                          takenIds(m_project, ProjectItem::Kind::Reflector));
    push(ChangeLists::add(*this, {reflector}, tr("Add %1").arg(idText(reflector.id))));
    return reflector.id;
}

void ProjectDocument::setReflector(const Reflector& reflector, int drag) {
    const Reflector* now = findItem<Reflector>(m_project, reflector.id);
    if (findItem<RouteSpec>(m_project, reflector.route) == nullptr)
        return refuse(unknown(labelOf(ProjectItem{ProjectItem::Kind::Route, reflector.route})));
    const Reflector fitting = withinRange(reflector, now != nullptr ? *now : Reflector{});
    const bool moved = now != nullptr && now->start != fitting.start;
    change(fitting, (moved ? tr("Move %1") : tr("Change %1")).arg(idText(fitting.id)), drag);
}

void ProjectDocument::setReflectors(const std::vector<Reflector>& reflectors, int drag) {
    if (reflectors.size() == 1)
        return setReflector(reflectors.front(), drag);
    std::vector<Reflector> fitting;
    for (const Reflector& reflector : reflectors) {
        const Reflector* now = findItem<Reflector>(m_project, reflector.id);
        if (findItem<RouteSpec>(m_project, reflector.route) == nullptr)
            return refuse(unknown(labelOf(ProjectItem{ProjectItem::Kind::Route, reflector.route})));
        fitting.push_back(withinRange(reflector, now != nullptr ? *now : Reflector{}));
    }
    changeAll(std::move(fitting), drag);
}

std::string ProjectDocument::addVehicle(VehicleModel vehicle) {
    vehicle = withinRange(std::move(vehicle), VehicleModel{});
    if (auto fault = faultOf(vehicle)) {
        refuse(std::move(*fault));
        return {};
    }
    std::set<std::string> taken = takenIds(m_project, ProjectItem::Kind::Vehicle);
    for (const auto& name : builtInVehicleNames())
        taken.insert(name);
    const std::string wish =
        vehicle.id.empty() ? std::filesystem::path(vehicle.path).stem().string() : vehicle.id;
    vehicle.id = taken.count(wish) == 0 ? wish : freeId(wish, taken);
    push(ChangeLists::add(*this, {vehicle}, tr("Add %1").arg(labelOf(itemOf(vehicle)))));
    return vehicle.id;
}

void ProjectDocument::setVehicle(const VehicleModel& vehicle, int drag) {
    const VehicleModel* now = findItem<VehicleModel>(m_project, vehicle.id);
    const VehicleModel fitting = withinRange(vehicle, now != nullptr ? *now : VehicleModel{});
    if (auto fault = faultOf(fitting))
        return refuse(std::move(*fault));
    change(fitting, tr("Change %1").arg(labelOf(itemOf(fitting))), drag);
}

void ProjectDocument::setView(const View& view) {
    const View fitting = withinRange(view);
    if (auto fault = faultOf(fitting))
        return refuse(std::move(*fault));
    const QString label = labelOf(itemOf(fitting));
    if (findItem<View>(m_project, fitting.name) != nullptr)
        return change(fitting, tr("Change %1").arg(label), -1);
    push(ChangeLists::add(*this, {fitting}, tr("Add %1").arg(label)));
}

// ---- settings ----

void ProjectDocument::setName(const std::string& name) {
    change(&Project::name, name, ProjectChange::Name, "name", tr("Rename the project"), -1);
}

void ProjectDocument::setTuning(const MemSettings& tuning, int drag) {
    change(&Project::tuning, withinRange(tuning, m_project.tuning), ProjectChange::Tuning, "tuning",
           tr("Tune the reflections"), drag);
}

void ProjectDocument::setBake(const BakeSettings& bake, int drag) {
    change(&Project::bake, withinRange(bake), ProjectChange::Bake, "bake",
           tr("Change how probes are baked"), drag);
}

void ProjectDocument::setHeightfield(const HeightfieldSettings& heightfield, int drag) {
    change(&Project::heightfield, withinRange(heightfield, m_project.heightfield),
           ProjectChange::Heightfield, "heightfield", tr("Change the heightfield"), drag);
}

void ProjectDocument::setDate(const DateTime& date, int drag) {
    if (auto fault = faultOf(date))
        return refuse(std::move(*fault));
    change(&Project::date, date, ProjectChange::Light, "date", tr("Move the sun"), drag);
}

void ProjectDocument::setTurbidity(float turbidity, int drag) {
    change(&Project::turbidity, turbidityWithinRange(turbidity, m_project.turbidity),
           ProjectChange::Light, "turbidity", tr("Change the haze"), drag);
}

void ProjectDocument::setExposure(float exposure, int drag) {
    change(&Project::exposure, exposureWithinRange(exposure, m_project.exposure),
           ProjectChange::Exposure, "exposure", tr("Change the exposure"), drag);
}

void ProjectDocument::setGeneratedGround(bool generated) {
    change(&Project::generatedGround, generated, ProjectChange::Models, "generatedGround",
           generated ? tr("Add a generated ground") : tr("Take the generated ground away"), -1);
}

void ProjectDocument::replaceProject(Project after, const QString& text) {
    const ProjectChanges what = changesBetween(m_project, after);
    if (!what && m_project.source == after.source)
        return;
    push(std::make_unique<ReplaceProject>(*this, std::move(after), what, text));
}

}  // namespace reflet
