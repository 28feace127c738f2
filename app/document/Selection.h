// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/project/ProjectItem.h"

#include <QObject>
#include <optional>
#include <vector>

namespace reflet {

/// What is selected, in the order in which it was. GUI thread only. Holds no item twice; the
/// document drops what no longer exists and follows what is renamed.
class Selection : public QObject {
    Q_OBJECT
public:
    explicit Selection(QObject* parent = nullptr);

    [[nodiscard]] const std::vector<ProjectItem>& items() const { return m_items; }
    [[nodiscard]] bool isEmpty() const { return m_items.empty(); }
    [[nodiscard]] bool contains(const ProjectItem& item) const;
    /// The item that inspectors show: the one selected last.
    [[nodiscard]] std::optional<ProjectItem> current() const;
    /// The ids of the selected items of one kind.
    [[nodiscard]] std::vector<std::string> ids(ProjectItem::Kind kind) const;

    void set(std::vector<ProjectItem> items);
    void set(const ProjectItem& item) { set(std::vector{item}); }
    void add(const ProjectItem& item);
    /// Adds the item, or takes it away: a click with Ctrl.
    void toggle(const ProjectItem& item);
    void clear() { set(std::vector<ProjectItem>{}); }

Q_SIGNALS:
    void changed();

private:
    friend class ProjectDocument;
    /// Sets the items, each once, without a signal; tells whether they differ from before.
    bool replace(std::vector<ProjectItem> items);

    std::vector<ProjectItem> m_items;
};

}  // namespace reflet
