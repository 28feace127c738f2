// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "widgets/inspector/FieldForm.h"
#include "widgets/inspector/HeightsForm.h"
#include "widgets/inspector/Inspector.h"
#include "widgets/inspector/ReadingForm.h"

#include <functional>

class QPushButton;

namespace reflet {

// One page for each kind of thing. A page shows what it is given and reports whole new values
// through its functions; numbers of several things show "several" where they differ.

/// Reflection probes.
class ProbePage : public FieldForm {
    Q_OBJECT

public:
    explicit ProbePage(QWidget* parent);
    void show(const Project& project, const QString& crsName, std::vector<Probe> probes,
              const std::map<std::string, ProbeFacts>& facts);
    using FieldForm::show;

    std::function<void(std::vector<Probe>, DragPhase)> changed;
    std::function<void(ProjectItem, QString)> renamed;
    std::function<void(std::vector<std::string>)> bake;
    std::function<void(std::vector<std::string>, bool)> preview;

private:
    /// The probes as they are once `edit` has been at each of them.
    void change(DragPhase phase, const std::function<void(Probe&, const Probe& first)>& edit);
    void showHeights(const std::map<std::string, ProbeFacts>& facts);
    void showState(const std::map<std::string, ProbeFacts>& facts);
    [[nodiscard]] std::vector<std::string> ids() const;

    std::vector<Probe> m_probes;
    std::vector<std::optional<double>> m_ground;
    QLabel* m_heading;
    QLineEdit* m_name;
    NumberEdit* m_coordinates[3];
    NumberEdit* m_height;
    QLabel* m_crs;
    QComboBox* m_resolution;
    QCheckBox* m_locked;
    QLabel* m_state;
    QPushButton* m_bake;
    QCheckBox* m_preview;
    std::vector<int> m_sizes;
};

class RoutePage : public FieldForm {
    Q_OBJECT

public:
    explicit RoutePage(QWidget* parent);
    void show(std::vector<RouteSpec> routes);
    using FieldForm::show;

    std::function<void(std::vector<RouteSpec>, DragPhase)> changed;

private:
    std::vector<RouteSpec> m_routes;
    QLabel* m_heading;
    QLineEdit* m_name;
    QLabel* m_length;
    NumberEdit* m_radius;
    QLabel* m_points;
};

/// Vehicles on routes.
class ReflectorPage : public FieldForm {
    Q_OBJECT

public:
    explicit ReflectorPage(QWidget* parent);
    void show(const Project& project, std::vector<Reflector> reflectors,
              const std::map<std::string, QString>& figures);
    using FieldForm::show;

    std::function<void(std::vector<Reflector>, DragPhase)> changed;
    std::function<void(ProjectItem, QString)> renamed;

private:
    std::vector<Reflector> m_reflectors;
    std::vector<std::string> m_vehicles;
    std::vector<std::string> m_routes;
    QLabel* m_heading;
    QLineEdit* m_name;
    QComboBox* m_vehicle;
    QComboBox* m_route;
    NumberEdit* m_speed;
    NumberEdit* m_interest = nullptr;
    NumberEdit* m_start;
    QLabel* m_figures;
};

/// A vehicle that the user brought.
class VehiclePage : public FieldForm {
    Q_OBJECT

public:
    explicit VehiclePage(QWidget* parent);
    void show(const VehicleModel& vehicle);
    using FieldForm::show;

    std::function<void(VehicleModel, DragPhase)> changed;

private:
    VehicleModel m_vehicle;
    QLabel* m_heading;
    QLabel* m_path;
    QComboBox* m_up;
    NumberEdit* m_scale;
    NumberEdit* m_turn;
    NumberEdit* m_lift;
    QCheckBox* m_coat;
};

class ModelPage : public FieldForm {
    Q_OBJECT

public:
    explicit ModelPage(QWidget* parent);
    void show(const ModelReference& model, const ModelFacts& facts);
    using FieldForm::show;

    std::function<void(QString)> locate;
    std::function<void(ModelReference)> readingChanged;

private:
    QString m_path;
    QLabel* m_heading;
    QLabel* m_file;
    QLabel* m_format;
    QLabel* m_crs;
    QLabel* m_objects;
    QLabel* m_problem;
    QPushButton* m_locate;
    ReadingForm* m_reading;
};

class ViewPage : public FieldForm {
    Q_OBJECT

public:
    explicit ViewPage(QWidget* parent);
    void show(const View& view);
    using FieldForm::show;

    std::function<void(QString, View)> changed;
    std::function<void(QString)> fromCamera;
    std::function<void(QString)> go;

private:
    View m_view;
    QLabel* m_heading;
    QLineEdit* m_caption;
    NumberEdit* m_fov;
    NumberEdit* m_time;
};

/// Nothing is selected: the project itself.
class ProjectPage : public FieldForm {
    Q_OBJECT

public:
    explicit ProjectPage(QWidget* parent);
    void show(const Project& project, const QString& crsName);
    using FieldForm::show;

    std::function<void(QString)> named;
    std::function<void(HeightfieldSettings, DragPhase)> heightsChanged;

private:
    QLabel* m_heading;
    QLineEdit* m_name;
    QLabel* m_crs;
    QLabel* m_vertical;
    QLabel* m_origin;
    QLabel* m_counts;
    HeightsForm* m_heights;
};

}  // namespace reflet
