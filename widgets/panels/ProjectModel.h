// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/project/Project.h"
#include "core/project/ProjectItem.h"
#include "widgets/panels/ProjectTree.h"

#include <QAbstractItemModel>
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

/// The rows of the project tree: headings with counts, and below each the things of one kind.
/// New projects are taken over row by row, so that views keep their selection and scroll place.
class ProjectModel : public QAbstractItemModel {
public:
    using Renamed = std::function<void(const ProjectItem&, const QString&)>;

    ProjectModel(Renamed renamed, QObject* parent);

    void setProject(const Project& project);
    void setProbeStates(std::map<std::string, ProbeState> states);
    void setModelMarks(std::map<std::string, FileMark> marks);

    /// nullopt for headings.
    [[nodiscard]] std::optional<ProjectItem> item(const QModelIndex& index) const;
    [[nodiscard]] QModelIndex find(const ProjectItem& item) const;

    [[nodiscard]] QModelIndex index(int row, int column, const QModelIndex& parent) const override;
    [[nodiscard]] QModelIndex parent(const QModelIndex& child) const override;
    [[nodiscard]] int rowCount(const QModelIndex& parent) const override;
    [[nodiscard]] int columnCount(const QModelIndex& parent) const override;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
    bool setData(const QModelIndex& index, const QVariant& value, int role) override;
    [[nodiscard]] Qt::ItemFlags flags(const QModelIndex& index) const override;

private:
    struct Row {
        std::string id;
        QString text;
        QString help;
        friend bool operator==(const Row&, const Row&) = default;
    };
    struct Group {
        ProjectItem::Kind kind;
        QString title;
        QString one;  ///< what a single row is, for tool tips
        std::vector<Row> rows;
        std::map<std::string, int> place;  ///< of each id in rows
    };
    void takeOver(int group, std::vector<Row> rows);
    void number(Group& group);
    [[nodiscard]] QVariant rowData(const Group& group, const Row& row, int role) const;

    std::vector<Group> m_groups;
    std::map<std::string, ProbeState> m_states;
    std::map<std::string, FileMark> m_marks;
    Renamed m_renamed;
};

}  // namespace reflet
