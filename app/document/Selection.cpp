// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/document/Selection.h"

#include <algorithm>

namespace reflet {

Selection::Selection(QObject* parent) : QObject(parent) {}

bool Selection::contains(const ProjectItem& item) const {
    return std::find(m_items.begin(), m_items.end(), item) != m_items.end();
}

std::optional<ProjectItem> Selection::current() const {
    return m_items.empty() ? std::nullopt : std::optional(m_items.back());
}

std::vector<std::string> Selection::ids(ProjectItem::Kind kind) const {
    std::vector<std::string> out;
    for (const auto& item : m_items) {
        if (item.kind == kind)
            out.push_back(item.id);
    }
    return out;
}

void Selection::set(std::vector<ProjectItem> items) {
    if (replace(std::move(items)))
        Q_EMIT changed();
}

bool Selection::replace(std::vector<ProjectItem> items) {
    std::vector<ProjectItem> unique;
    for (auto& item : items) {
        if (std::find(unique.begin(), unique.end(), item) == unique.end())
            unique.push_back(std::move(item));
    }
    if (unique == m_items)
        return false;
    m_items = std::move(unique);
    return true;
}

void Selection::add(const ProjectItem& item) {
    auto items = m_items;
    items.push_back(item);
    set(std::move(items));
}

void Selection::toggle(const ProjectItem& item) {
    auto items = m_items;
    if (std::erase(items, item) == 0)
        items.push_back(item);
    set(std::move(items));
}

}  // namespace reflet
