// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/Frame.h"
#include "core/project/Project.h"
#include "core/project/ProjectItem.h"
#include "widgets/ViewIntents.h"

#include <QString>
#include <QStringList>
#include <QWidget>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

/// What is derived about a probe, for the inspector.
struct ProbeFacts {
    ProbeState state = ProbeState::Missing;
    QString problem;                     ///< why it was refused; else empty
    std::optional<double> groundHeight;  ///< absolute, metres, below the probe
    bool preview = false;                ///< its preview sphere is shown
};

/// What is known about a city model's file.
struct ModelFacts {
    /// What can be told of how it is read.
    enum class Kind {
        Other,      ///< nothing: it is not loaded, or a raster
        Objects,    ///< city objects of types, in levels of detail
        Outlines,   ///< footprints or trees with attributes
        StreetMap,  ///< OpenStreetMap: its attributes have names of their own
        Mesh,       ///< triangles without a meaning: units and axes may be any
    };
    Kind kind = Kind::Other;
    QString format, crs;
    QStringList lods;
    qsizetype objects = 0;
    qsizetype triangles = 0;
    bool missing = false;
    bool changed = false;
};

/// Shows and edits what is selected, one or several at once (only fields that all have are shown;
/// a change applies to all). Emits whole new values; each edit is one change, and dragging a label
/// or holding an arrow key is one sequence of phases.
class Inspector : public QWidget {
    Q_OBJECT

public:
    explicit Inspector(QWidget* parent = nullptr);
    ~Inspector() override;

    /// crsName: for people, empty for local metres.
    void setProject(const Project& project, const QString& crsName);
    void setSelection(const std::vector<ProjectItem>& items);
    void setProbeFacts(std::map<std::string, ProbeFacts> facts);
    void setModelFacts(std::map<std::string, ModelFacts> facts);  ///< by path
    /// A line on how a vehicle's reflections do, by reflector; may be empty.
    void setReflectorFigures(std::map<std::string, QString> figures);

Q_SIGNALS:
    void probesChanged(std::vector<reflet::Probe> probes, reflet::DragPhase phase);
    void routesChanged(std::vector<reflet::RouteSpec> routes, reflet::DragPhase phase);
    void reflectorsChanged(std::vector<reflet::Reflector> reflectors, reflet::DragPhase phase);
    void vehicleChanged(reflet::VehicleModel vehicle, reflet::DragPhase phase);
    /// name: the view's name before the change.
    void viewChanged(QString name, reflet::View view);
    void renamed(reflet::ProjectItem item, QString name);
    void projectNameChanged(QString name);
    void heightfieldChanged(reflet::HeightfieldSettings heightfield, reflet::DragPhase phase);
    void bakeRequested(std::vector<std::string> probes);
    void previewToggled(std::vector<std::string> probes, bool shown);
    void viewFromCameraRequested(QString name);         ///< take the 3D view's camera for this view
    void viewShown(QString name);                       ///< go there
    void locateFileRequested(QString path);             ///< a missing or changed model
    void readingChanged(reflet::ModelReference model);  ///< of the model with its path

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

}  // namespace reflet
