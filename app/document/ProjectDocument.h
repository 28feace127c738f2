// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/document/ProjectChanges.h"
#include "app/document/Selection.h"
#include "core/project/Project.h"

#include <QElapsedTimer>
#include <QObject>
#include <QUndoStack>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

class JobRunner;
class ProjectCommand;
class ProjectLock;

/// The project as the window edits it: a value, the file that it belongs to, and the undo stack
/// that every change goes through. GUI thread only.
///
/// Positions are absolute (project CRS), as in Project. A change that would make no project that
/// can be read again (a position that is no number, a route that goes nowhere, an unknown id) is
/// not made: where nothing is returned, changeRefused() tells why. Numbers of settings are brought
/// into their range. A change that changes nothing makes no step.
class ProjectDocument : public QObject {
    Q_OBJECT
public:
    /// How a file is opened that another window may have open.
    enum class Access {
        Edit,      ///< refused when another window has it
        ReadOnly,  ///< saving is refused, save as is not
        TakeOver,  ///< for a lock whose owner cannot be asked, on another computer
    };
    enum class Condition { Clean, Dirty };  ///< Dirty: holds what no file holds

    explicit ProjectDocument(QObject* parent = nullptr);
    ~ProjectDocument() override;

    [[nodiscard]] const Project& project() const { return m_project; }
    [[nodiscard]] std::filesystem::path file() const { return m_file; }  ///< empty: never saved
    /// The file whose folder paths of models start from, and whose cache folder holds what is
    /// derived: file(), else the origin that an untitled project was adopted with, else a place in
    /// the user's cache that all untitled projects share (maps there are named by their content).
    [[nodiscard]] std::filesystem::path dataFile() const;
    [[nodiscard]] std::filesystem::path origin() const { return m_origin; }
    /// Where relative paths of models start; empty for an untitled project without an origin.
    [[nodiscard]] std::filesystem::path folder() const;
    [[nodiscard]] bool isReadOnly() const { return m_readOnly; }
    [[nodiscard]] bool isDirty() const { return !m_undoStack.isClean(); }
    [[nodiscard]] QUndoStack* undoStack() { return &m_undoStack; }
    [[nodiscard]] Selection* selection() { return &m_selection; }
    [[nodiscard]] const Selection* selection() const { return &m_selection; }

    // ---- files: on any failure the document and the files are as they were ----

    /// Refused when another window has the file open, or when it is of a newer version.
    Result<void> open(const std::filesystem::path& path, Access access = Access::Edit);
    Result<void> save();
    /// The same without waiting for the disk: what the project is now is written by a job, then
    /// `done` is called. The document counts as saved unless it was changed meanwhile. Of several
    /// saves the newest stays, in whatever order they reach the disk.
    void saveInBackground(JobRunner& jobs, std::function<void(Result<void>)> done);
    /// Paths of models are rewritten for the new folder. Derived data are linked, not moved.
    Result<void> saveAs(const std::filesystem::path& path);
    /// Empties the document and gives its file free. Unsaved changes are lost.
    void close();
    /// Takes over a project that was not read from `file` just now: a sample, an import, a
    /// recovery. Read-only when another window has that file open. An untitled project (no `file`)
    /// may keep using the folder and the cache of an `origin` that it is never saved to.
    void adopt(Project project, const std::filesystem::path& file = {},
               Condition condition = Condition::Clean, const std::filesystem::path& origin = {});

    // ---- drags: all changes with the same drag number, one after the other, are one step ----

    /// A number that was not used yet; negative numbers mean no drag.
    [[nodiscard]] int beginDrag();
    void endDrag();
    /// Takes back what the drag has changed, without a trace on the undo stack.
    void cancelDrag(int drag);
    /// A drag was begun and not ended, or changed something a moment ago.
    [[nodiscard]] bool isDragging() const;

    // ---- changes: one undo step each ----

    std::string addProbe(const glm::dvec3& absolute);
    void moveProbe(const std::string& id, const glm::dvec3& absolute, int drag = -1);
    /// Resolution and lock of the probe with that id; its position too.
    void setProbe(const Probe& probe, int drag = -1);
    /// Several at once are one step, and none is changed when one is refused; so are routes and
    /// reflectors. Of one drag, each change must be of the same items.
    void setProbes(const std::vector<Probe>& probes, int drag = -1);

    /// Empty when the points are refused.
    std::string addRoute(const std::vector<glm::dvec3>& absolute);
    void setRoute(const RouteSpec& route, int drag = -1);
    void setRoutes(const std::vector<RouteSpec>& routes, int drag = -1);
    /// Empty when the route is unknown.
    std::string addReflector(const std::string& vehicle, const std::string& route);
    void setReflector(const Reflector& reflector, int drag = -1);
    void setReflectors(const std::vector<Reflector>& reflectors, int drag = -1);
    /// Brings in a vehicle's file under the model's id, its file's name, or that with a number: the
    /// first that is free. Empty when the model is refused.
    std::string addVehicle(VehicleModel vehicle);
    void setVehicle(const VehicleModel& vehicle, int drag = -1);
    /// Adds the view, or replaces the one of its name.
    void setView(const View& view);

    /// Copies probes beside themselves, routes beside themselves, vehicles a length behind and
    /// views under a new name; models cannot be copied. The copies are selected.
    Result<std::vector<std::string>> duplicate(const std::vector<ProjectItem>& items);
    /// Routes and vehicle models take the vehicles that need them along. Unknown items are passed
    /// over.
    void remove(const std::vector<ProjectItem>& items);
    /// Usage for a name that is empty or taken. Vehicles follow a renamed route
    /// or vehicle model.
    Result<void> rename(const ProjectItem& item, const std::string& newId);

    void setName(const std::string& name);
    void setTuning(const MemSettings& tuning, int drag = -1);
    void setBake(const BakeSettings& bake, int drag = -1);
    void setHeightfield(const HeightfieldSettings& heightfield, int drag = -1);
    void setDate(const DateTime& date, int drag = -1);
    void setTurbidity(float turbidity, int drag = -1);
    void setExposure(float exposure, int drag = -1);
    void setGeneratedGround(bool generated);

    /// For what changes much at once: an import, *Make it reflect*. Model paths of `after` are
    /// relative to folder().
    void replaceProject(Project after, const QString& text);

Q_SIGNALS:
    void projectChanged(reflet::ProjectChanges what);
    void fileChanged();  ///< another file, name or access
    void changeRefused(const reflet::Error& error);

private:
    friend class ProjectCommand;

    /// Lets a command edit the project, then tells everybody. `select` gets what is selected.
    using Items = std::vector<ProjectItem>;
    void edit(ProjectChanges what, const std::function<void(Project&)>& change,
              const std::function<Items(Items)>& select);
    /// Makes the step unless it changes nothing.
    void push(std::unique_ptr<ProjectCommand> command);
    template <class Value>
    void change(Value Project::*member, Value value, ProjectChange what, const char* key,
                const QString& text, int drag);
    template <class Item>
    void change(const Item& item, const QString& text, int drag);
    template <class Item>
    void changeAll(std::vector<Item> items, int drag);
    void refuse(Error error);
    void replaceAll(Project project, const std::filesystem::path& file,
                    std::unique_ptr<ProjectLock> lock, bool readOnly,
                    const std::filesystem::path& origin = {});
    [[nodiscard]] Result<void> maySave() const;

    Project m_project;
    std::filesystem::path m_file;
    std::filesystem::path m_origin;
    std::unique_ptr<ProjectLock> m_lock;
    bool m_readOnly = false;
    QUndoStack m_undoStack;
    Selection m_selection;
    int m_lastDrag = 0;
    bool m_dragging = false;
    bool m_cancellingDrag = false;
    QElapsedTimer m_sinceDrag;
    quint64 m_revision = 0;  ///< another one after each change
    struct Saves;
    std::shared_ptr<Saves> m_saves;
};

}  // namespace reflet
