// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/ProjectModel.h"

#include "widgets/common/ItemIcons.h"
#include "widgets/common/Look.h"

#include <QFont>
#include <algorithm>

namespace reflet {

namespace {

/// Rows point at their heading by its number, headings by this.
constexpr quintptr kHeading = ~quintptr(0);

QString text(const std::string& utf8) {
    return QString::fromStdString(utf8);
}

QString fileName(const std::string& path) {
    return text(path.substr(path.find_last_of('/') + 1));
}

}  // namespace

ProjectModel::ProjectModel(Renamed renamed, QObject* parent)
    : QAbstractItemModel(parent), m_renamed(std::move(renamed)) {
    using Kind = ProjectItem::Kind;
    m_groups = {
        {Kind::Model, ProjectTree::tr("City models"), ProjectTree::tr("City model"), {}, {}},
        {Kind::Route, ProjectTree::tr("Routes"), ProjectTree::tr("Route"), {}, {}},
        {Kind::Reflector, ProjectTree::tr("Vehicles"), ProjectTree::tr("Vehicle"), {}, {}},
        {Kind::Vehicle,
         ProjectTree::tr("Vehicle models"),
         ProjectTree::tr("Vehicle model"),
         {},
         {}},
        {Kind::Probe,
         ProjectTree::tr("Reflection probes"),
         ProjectTree::tr("Reflection probe"),
         {},
         {}},
        {Kind::View, ProjectTree::tr("Views"), ProjectTree::tr("View"), {}, {}},
    };
}

void ProjectModel::setProject(const Project& project) {
    std::vector<Row> models, routes, reflectors, vehicles, probes, views;
    for (const ModelReference& model : project.models)
        models.push_back({model.path, fileName(model.path), text(model.path)});
    std::map<std::string, QString> routeNames;
    for (const RouteSpec& route : project.routes) {
        const QString shown = text(route.name.empty() ? route.id : route.name);
        routeNames[route.id] = shown;
        routes.push_back({route.id, shown, text(route.id)});
    }
    for (const Reflector& reflector : project.reflectors)
        reflectors.push_back(
            {reflector.id,
             ProjectTree::tr("%1 (%2)").arg(text(reflector.id), text(reflector.vehicle)),
             ProjectTree::tr("%1 on %2")
                 .arg(text(reflector.vehicle), routeNames[reflector.route])});
    for (const VehicleModel& vehicle : project.vehicles)
        vehicles.push_back({vehicle.id, text(vehicle.id), text(vehicle.path)});
    for (const Probe& probe : project.probes)
        probes.push_back(
            {probe.id,
             probe.locked ? ProjectTree::tr("%1, locked").arg(text(probe.id)) : text(probe.id),
             {}});
    for (const View& view : project.views)
        views.push_back({view.name, text(view.name), text(view.caption)});
    const std::array lists{&models, &routes, &reflectors, &vehicles, &probes, &views};
    for (std::size_t i = 0; i < lists.size(); ++i)
        takeOver(int(i), std::move(*lists[i]));
}

void ProjectModel::number(Group& group) {
    group.place.clear();
    for (std::size_t i = 0; i < group.rows.size(); ++i)
        group.place.emplace(group.rows[i].id, int(i));
}

/// Removes what is gone, then walks along the new rows and inserts what is new. Things that only
/// changed places are taken as removed and inserted.
void ProjectModel::takeOver(int number_, std::vector<Row> rows) {
    Group& group = m_groups[std::size_t(number_)];
    if (group.rows == rows)
        return;
    const QModelIndex heading = index(number_, 0, {});
    const std::size_t before = group.rows.size();
    std::map<std::string, std::size_t> wanted;
    for (std::size_t i = 0; i < rows.size(); ++i)
        wanted.emplace(rows[i].id, i);
    // Kept: the rows whose order is as before; greedy from the front.
    std::size_t reached = 0;
    for (std::size_t i = 0; i < group.rows.size();) {
        const auto found = wanted.find(group.rows[i].id);
        if (found != wanted.end() && found->second >= reached) {
            reached = found->second + 1;
            ++i;
            continue;
        }
        beginRemoveRows(heading, int(i), int(i));
        group.rows.erase(group.rows.begin() + std::ptrdiff_t(i));
        endRemoveRows();
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (i < group.rows.size() && group.rows[i].id == rows[i].id) {
            if (group.rows[i] != rows[i]) {
                group.rows[i] = rows[i];
                const QModelIndex changed = index(int(i), 0, heading);
                Q_EMIT dataChanged(changed, changed);
            }
            continue;
        }
        // All new rows up to the next kept one at once.
        std::size_t last = i;
        while (last + 1 < rows.size() &&
               (i >= group.rows.size() || rows[last + 1].id != group.rows[i].id))
            ++last;
        beginInsertRows(heading, int(i), int(last));
        group.rows.insert(group.rows.begin() + std::ptrdiff_t(i), rows.begin() + std::ptrdiff_t(i),
                          rows.begin() + std::ptrdiff_t(last + 1));
        endInsertRows();
        i = last;
    }
    number(group);
    if (before != group.rows.size())
        Q_EMIT dataChanged(heading, heading);
}

void ProjectModel::setProbeStates(std::map<std::string, ProbeState> states) {
    if (m_states == states)
        return;
    m_states = std::move(states);
    for (int i = 0; i < int(m_groups.size()); ++i) {
        const Group& group = m_groups[std::size_t(i)];
        if (group.kind != ProjectItem::Kind::Probe || group.rows.empty())
            continue;
        const QModelIndex heading = index(i, 0, {});
        Q_EMIT dataChanged(index(0, 0, heading), index(int(group.rows.size()) - 1, 0, heading));
        Q_EMIT dataChanged(heading, heading);
    }
}

void ProjectModel::setModelMarks(std::map<std::string, FileMark> marks) {
    m_marks = std::move(marks);
    const QModelIndex heading = index(0, 0, {});
    if (const int rows = rowCount(heading); rows > 0)
        Q_EMIT dataChanged(index(0, 0, heading), index(rows - 1, 0, heading));
}

std::optional<ProjectItem> ProjectModel::item(const QModelIndex& index) const {
    if (!index.isValid() || index.internalId() == kHeading)
        return std::nullopt;
    const Group& group = m_groups[index.internalId()];
    return ProjectItem{group.kind, group.rows[std::size_t(index.row())].id};
}

QModelIndex ProjectModel::find(const ProjectItem& item) const {
    for (int i = 0; i < int(m_groups.size()); ++i) {
        const Group& group = m_groups[std::size_t(i)];
        if (group.kind != item.kind)
            continue;
        const auto found = group.place.find(item.id);
        if (found != group.place.end())
            return index(found->second, 0, index(i, 0, {}));
    }
    return {};
}

QModelIndex ProjectModel::index(int row, int column, const QModelIndex& parent) const {
    if (column != 0 || row < 0 || row >= rowCount(parent))
        return {};
    return createIndex(row, column, parent.isValid() ? quintptr(parent.row()) : kHeading);
}

QModelIndex ProjectModel::parent(const QModelIndex& child) const {
    if (!child.isValid() || child.internalId() == kHeading)
        return {};
    return createIndex(int(child.internalId()), 0, kHeading);
}

int ProjectModel::rowCount(const QModelIndex& parent) const {
    if (!parent.isValid())
        return int(m_groups.size());
    return parent.internalId() == kHeading ? int(m_groups[std::size_t(parent.row())].rows.size())
                                           : 0;
}

int ProjectModel::columnCount(const QModelIndex& /*parent*/) const {
    return 1;
}

QVariant ProjectModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid())
        return {};
    if (index.internalId() != kHeading) {
        const Group& group = m_groups[index.internalId()];
        return rowData(group, group.rows[std::size_t(index.row())], role);
    }
    const Group& group = m_groups[std::size_t(index.row())];
    if (role == Qt::DisplayRole)
        return ProjectTree::tr("%1 (%2)").arg(group.title).arg(group.rows.size());
    if (role == Qt::FontRole) {
        QFont font;
        font.setBold(true);
        return font;
    }
    return {};
}

QVariant ProjectModel::rowData(const Group& group, const Row& row, int role) const {
    const auto stateOf = [&] {
        const auto found = m_states.find(row.id);
        return found == m_states.end() ? ProbeState::Missing : found->second;
    };
    const auto markOf = [&] {
        const auto found = m_marks.find(row.id);
        return found == m_marks.end() ? FileMark::Fine : found->second;
    };
    const bool probe = group.kind == ProjectItem::Kind::Probe;
    const bool model = group.kind == ProjectItem::Kind::Model;
    switch (role) {
        case Qt::DisplayRole:
            if (model && markOf() == FileMark::Missing)
                return ProjectTree::tr("%1 – missing").arg(row.text);
            if (model && markOf() == FileMark::Changed)
                return ProjectTree::tr("%1 – changed").arg(row.text);
            return row.text;
        case Qt::EditRole:
            return text(row.id);
        case Qt::DecorationRole:
            if (probe)
                return probeIcon(stateOf());
            if (model && markOf() != FileMark::Fine)
                return severityIcon(markOf() == FileMark::Missing ? Severity::Error
                                                                  : Severity::Warning);
            return itemIcon(group.kind);
        case Qt::ToolTipRole:
            if (probe)
                return ProjectTree::tr("%1, %2").arg(group.one, probeStateText(stateOf()));
            if (model && markOf() == FileMark::Missing)
                return ProjectTree::tr(
                           "%1 is not there any more. Choose it again in the inspector.")
                    .arg(row.help);
            if (model && markOf() == FileMark::Changed)
                return ProjectTree::tr("%1 has changed since it was imported.").arg(row.help);
            return row.help.isEmpty() ? group.one
                                      : ProjectTree::tr("%1: %2").arg(group.one, row.help);
        default:
            return {};
    }
}

/// Only asks: the row changes when the project has.
bool ProjectModel::setData(const QModelIndex& index, const QVariant& value, int role) {
    const QString name = value.toString().trimmed();
    const auto named = item(index);
    if (role == Qt::EditRole && named && !name.isEmpty() && name != text(named->id))
        m_renamed(*named, name);
    return false;
}

Qt::ItemFlags ProjectModel::flags(const QModelIndex& index) const {
    const auto named = item(index);
    if (!named)
        return Qt::ItemIsEnabled;
    const Qt::ItemFlags flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemNeverHasChildren;
    return named->kind == ProjectItem::Kind::Model ? flags : flags | Qt::ItemIsEditable;
}

}  // namespace reflet
