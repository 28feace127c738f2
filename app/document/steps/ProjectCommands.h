// SPDX-License-Identifier: GPL-3.0-or-later
// The steps on the undo stack. Internal to app/document.
#pragma once

#include "app/document/ProjectDocument.h"
#include "app/document/steps/ProjectLists.h"

#include <QUndoCommand>
#include <algorithm>
#include <utility>
#include <vector>

namespace reflet {

/// A step that changes a project: holds ids and values, and cannot fail, because the document
/// checks all that may before it makes one. The document owns the stack that owns the step.
class ProjectCommand : public QUndoCommand {
public:
    ProjectCommand(ProjectDocument& document, ProjectChanges what, const QString& text);

    /// Lets the step swallow a following one of the same key and drag. Negative: none.
    void setDrag(std::string key, int drag);
    [[nodiscard]] int drag() const { return m_drag; }

    void redo() final;
    void undo() final;
    [[nodiscard]] int id() const final;
    [[nodiscard]] bool mergeWith(const QUndoCommand* next) final;

protected:
    virtual void apply(Project& project) = 0;
    virtual void revert(Project& project) = 0;
    /// What was changed and changed back again needs no step.
    [[nodiscard]] virtual bool changesNothing(const Project& project) const = 0;
    /// What shall be selected after the step, from what is: gone items are dropped anyway.
    using Items = std::vector<ProjectItem>;
    [[nodiscard]] virtual Items selectedAfterApply(Items now) const { return now; }
    [[nodiscard]] virtual Items selectedAfterRevert(Items now) const { return now; }

    [[nodiscard]] ProjectDocument& document() const { return m_document; }
    void addChange(ProjectChange what) { m_what |= what; }

private:
    ProjectDocument& m_document;
    ProjectChanges m_what;
    std::string m_key;
    int m_drag = -1;
};

/// Sets one member of the project. Holds the value that the project does not have just now.
template <class Value>
class ChangeMember final : public ProjectCommand {
public:
    ChangeMember(ProjectDocument& document, Value Project::*member, Value value,
                 ProjectChanges what, const QString& text)
        : ProjectCommand(document, what, text), m_member(member), m_value(std::move(value)) {}

protected:
    void apply(Project& project) override { std::swap(project.*m_member, m_value); }
    void revert(Project& project) override { apply(project); }
    [[nodiscard]] bool changesNothing(const Project& project) const override {
        return project.*m_member == m_value;
    }

private:
    Value Project::*m_member;
    Value m_value;
};

/// Sets elements of a list, found by their ids.
template <class Item>
class ChangeElements final : public ProjectCommand {
public:
    ChangeElements(ProjectDocument& document, std::vector<Item> values, const QString& text)
        : ProjectCommand(document, ItemTraits<Item>::kChange, text), m_values(std::move(values)) {}

protected:
    void apply(Project& project) override {
        for (Item& value : m_values)
            std::swap(element(project, value), value);
    }
    void revert(Project& project) override { apply(project); }
    [[nodiscard]] bool changesNothing(const Project& project) const override {
        return std::all_of(m_values.begin(), m_values.end(), [&](const Item& value) {
            const Item* now = findItem<Item>(project, value.*ItemTraits<Item>::kId);
            return now != nullptr && *now == value;
        });
    }

private:
    static Item& element(Project& project, const Item& value) {
        auto& list = listOf<Item>(project);
        const auto found = std::find_if(list.begin(), list.end(), [&](const Item& item) {
            return item.*ItemTraits<Item>::kId == value.*ItemTraits<Item>::kId;
        });
        Q_ASSERT(found != list.end());
        return *found;
    }

    std::vector<Item> m_values;
};

/// Adds elements to lists or takes them out, and puts them back where they were. What comes into
/// being is selected.
class ChangeLists final : public ProjectCommand {
public:
    enum class Mode { Add, Remove };

    /// Add: elements go to the ends of their lists, in this order.
    static std::unique_ptr<ChangeLists> add(ProjectDocument& document, std::vector<AnyItem> items,
                                            const QString& text);
    /// Remove: `items` exist in the project.
    static std::unique_ptr<ChangeLists> remove(ProjectDocument& document,
                                               const std::vector<ProjectItem>& items,
                                               const QString& text);

protected:
    void apply(Project& project) override;
    void revert(Project& project) override;
    [[nodiscard]] bool changesNothing(const Project&) const override { return m_places.empty(); }
    [[nodiscard]] Items selectedAfterApply(Items now) const override;
    [[nodiscard]] Items selectedAfterRevert(Items now) const override;

private:
    struct Place {
        AnyItem item;
        std::size_t index = 0;  ///< in its list, when those before it in m_places are there
    };

    ChangeLists(ProjectDocument& document, Mode mode, std::vector<Place> places,
                const QString& text);
    static ProjectChanges changesOf(const std::vector<Place>& places);
    void insert(Project& project);
    void erase(Project& project) const;
    [[nodiscard]] Items items() const;

    Mode m_mode;
    std::vector<Place> m_places;     ///< of one list: with ascending index
    std::filesystem::path m_folder;  ///< where paths of models in m_places start
};

/// Gives an item another id, and whatever names it.
class RenameItem final : public ProjectCommand {
public:
    RenameItem(ProjectDocument& document, const ProjectItem& item, std::string newId,
               const QString& text);

protected:
    void apply(Project& project) override { rename(project, m_from, m_to); }
    void revert(Project& project) override { rename(project, m_to, m_from); }
    [[nodiscard]] bool changesNothing(const Project&) const override { return m_from == m_to; }
    [[nodiscard]] Items selectedAfterApply(Items now) const override;
    [[nodiscard]] Items selectedAfterRevert(Items now) const override;

private:
    void rename(Project& project, const std::string& from, const std::string& to);

    ProjectItem::Kind m_kind;
    std::string m_from;
    std::string m_to;
    std::string m_source;            ///< Project::source of the other state
    std::filesystem::path m_folder;  ///< where its paths of models start
};

/// Sets everything: imports, *Make it reflect*.
class ReplaceProject final : public ProjectCommand {
public:
    ReplaceProject(ProjectDocument& document, Project after, ProjectChanges what,
                   const QString& text);

protected:
    void apply(Project& project) override;
    void revert(Project& project) override { apply(project); }
    [[nodiscard]] bool changesNothing(const Project&) const override { return false; }

private:
    Project m_other;                 ///< the one that the document does not hold just now
    std::filesystem::path m_folder;  ///< where its paths of models start
};

}  // namespace reflet
