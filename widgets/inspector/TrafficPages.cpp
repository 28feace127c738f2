// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/math/Geometry.h"
#include "core/traffic/Route.h"
#include "core/traffic/Vehicle.h"
#include "widgets/common/Look.h"
#include "widgets/inspector/InspectorPages.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QLocale>
#include <algorithm>

namespace reflet {

namespace {

constexpr double kKmhAMs = 3.6;  ///< kilometres an hour of a metre a second

QString utf16(const std::string& utf8) {
    return QString::fromStdString(utf8);
}

double lengthOf(const RouteSpec& spec) {
    std::vector<glm::dvec3> points;
    for (const glm::dvec3& point : spec.points)
        if (points.empty() || glm::length(glm::dvec2(point - points.back())) > 1e-6)
            points.push_back(point);
    if (points.size() < 2)
        return 0.0;
    const Route route(points);
    return spec.cornerRadius > 0.0 ? route.smoothed(spec.cornerRadius).length() : route.length();
}

QString displayName(const Reflector& reflector) {
    return utf16(reflector.id);
}

template <class T, class Get>
bool agree(const std::vector<T>& things, const Get& get) {
    return std::all_of(things.begin(), things.end(),
                       [&](const T& thing) { return get(thing) == get(things.front()); });
}

}  // namespace

RoutePage::RoutePage(QWidget* parent) : FieldForm(parent) {
    m_heading = heading();
    m_name = FieldForm::text(tr("&Name"), tr("What people call this route, for instance a street"),
                             [this](const QString& name) {
                                 m_routes.front().name = name.toStdString();
                                 changed(m_routes, DragPhase::End);
                             });
    m_name->setObjectName(QStringLiteral("routeName"));
    m_length = fact(tr("Length"), tr("Along the route, corners rounded"));
    m_radius = number(tr("&Corner radius"),
                      tr("Corners are rounded with arcs of at most this radius; trams need 20 m "
                         "and more"),
                      {0.0, 500.0, 1.0, 1, tr(" m")}, [this](double value, DragPhase phase) {
                          for (RouteSpec& route : m_routes)
                              route.cornerRadius = value;
                          changed(m_routes, phase);
                      });
    m_radius->setObjectName(QStringLiteral("routeRadius"));
    m_points = fact(tr("Corners"), tr("Drag them in the plan or in the 3D view"));
}

void RoutePage::show(std::vector<RouteSpec> routes) {
    m_routes = std::move(routes);
    const bool one = m_routes.size() == 1;
    m_heading->setText(one ? tr("Route %1").arg(utf16(m_routes.front().id))
                           : tr("%n routes", nullptr, int(m_routes.size())));
    setShown(m_name, one);
    showText(m_name, utf16(m_routes.front().name));
    double length = 0.0;
    std::size_t points = 0;
    for (const RouteSpec& route : m_routes) {
        length += lengthOf(route);
        points += route.points.size();
    }
    m_length->setText(metresText(length, 0));
    m_points->setText(QLocale().toString(qulonglong(points)));
    if (agree(m_routes, [](const RouteSpec& route) { return route.cornerRadius; }))
        m_radius->show(m_routes.front().cornerRadius);
    else
        m_radius->showSeveral(m_routes.front().cornerRadius);
}

ReflectorPage::ReflectorPage(QWidget* parent) : FieldForm(parent) {
    m_heading = heading();
    m_name = FieldForm::text(
        tr("&Name"), tr("The vehicle's name in lists and reports"), [this](const QString& name) {
            renamed({ProjectItem::Kind::Reflector, m_reflectors.front().id}, name);
        });
    m_vehicle = choice(tr("&Vehicle"), tr("What drives: a built-in vehicle or one of yours"),
                       [this](int index) {
                           for (Reflector& reflector : m_reflectors)
                               reflector.vehicle = m_vehicles[std::size_t(index)];
                           changed(m_reflectors, DragPhase::End);
                       });
    m_vehicle->setObjectName(QStringLiteral("reflectorVehicle"));
    m_route = choice(tr("&Route"), tr("The route that it drives"), [this](int index) {
        for (Reflector& reflector : m_reflectors)
            reflector.route = m_routes[std::size_t(index)];
        changed(m_reflectors, DragPhase::End);
    });
    m_route->setObjectName(QStringLiteral("reflectorRoute"));
    m_speed = number(tr("&Speed"), tr("How fast it drives"), {0.0, 300.0, 1.0, 1, tr(" km/h")},
                     [this](double value, DragPhase phase) {
                         for (Reflector& reflector : m_reflectors)
                             reflector.speed = value / kKmhAMs;
                         changed(m_reflectors, phase);
                     });
    m_speed->setObjectName(QStringLiteral("reflectorSpeed"));
    m_start = number(tr("S&tarts at"), tr("Metres along the route where it is at time 0"),
                     {0.0, 1e6, 1.0, 1, tr(" m")}, [this](double value, DragPhase phase) {
                         for (Reflector& reflector : m_reflectors)
                             reflector.start = value;
                         changed(m_reflectors, phase);
                     });
    m_start->setObjectName(QStringLiteral("reflectorStart"));
    m_interest = number(
        tr("&Importance"),
        tr("How much its reflection matters when not all can be drawn in time: 2 counts as twice "
           "as large, 0 as far away"),
        {0.0, kMostInterest, 0.5, 1, {}}, [this](double value, DragPhase phase) {
            for (Reflector& reflector : m_reflectors)
                reflector.interest = value;
            changed(m_reflectors, phase);
        });
    m_interest->setObjectName(QStringLiteral("reflectorInterest"));
    m_figures = fact(tr("Reflections"), tr("How its reflections do, as last measured"));
}

void ReflectorPage::show(const Project& project, std::vector<Reflector> reflectors,
                         const std::map<std::string, QString>& figures) {
    m_reflectors = std::move(reflectors);
    const Reflector& first = m_reflectors.front();
    const bool one = m_reflectors.size() == 1;
    m_heading->setText(one ? tr("Vehicle on a route")
                           : tr("%n vehicles", nullptr, int(m_reflectors.size())));
    setShown(m_name, one);
    showText(m_name, displayName(first));

    m_vehicles = builtInVehicleNames();
    for (const VehicleModel& vehicle : project.vehicles)
        m_vehicles.push_back(vehicle.id);
    const auto fill = [](QComboBox* box, const std::vector<std::string>& values,
                         const std::string& now, bool same) {
        box->setCurrentIndex(-1);
        if (same)
            for (std::size_t i = 0; i < values.size(); ++i)
                if (values[i] == now)
                    box->setCurrentIndex(int(i));
    };
    m_vehicle->clear();
    for (const std::string& vehicle : m_vehicles)
        m_vehicle->addItem(utf16(vehicle));
    fill(m_vehicle, m_vehicles, first.vehicle,
         agree(m_reflectors, [](const Reflector& r) { return r.vehicle; }));
    m_routes.clear();
    m_route->clear();
    for (const RouteSpec& route : project.routes) {
        m_routes.push_back(route.id);
        m_route->addItem(utf16(route.name.empty() ? route.id : route.name));
    }
    fill(m_route, m_routes, first.route,
         agree(m_reflectors, [](const Reflector& r) { return r.route; }));
    const auto number = [&](NumberEdit* edit, const auto& get) {
        if (agree(m_reflectors, get))
            edit->show(get(first));
        else
            edit->showSeveral(get(first));
    };
    number(m_speed, [](const Reflector& r) { return r.speed * kKmhAMs; });
    number(m_start, [](const Reflector& r) { return r.start; });
    number(m_interest, [](const Reflector& r) { return r.interest; });
    const auto found = figures.find(first.id);
    m_figures->setText(one && found != figures.end() ? found->second : tr("not measured yet"));
}

VehiclePage::VehiclePage(QWidget* parent) : FieldForm(parent) {
    m_heading = heading();
    m_path = fact(tr("File"));
    const auto report = [this](DragPhase phase) { changed(m_vehicle, phase); };
    m_up = choice(tr("&Up in the file"), tr("Which way is up in the vehicle's file"),
                  [this, report](int index) {
                      m_vehicle.up = VehicleUp(index);
                      report(DragPhase::End);
                  });
    m_up->addItems(
        {tr("+Y (glTF)"), tr("−Y (upside down)"), tr("+Z"), tr("−Z"), tr("+X"), tr("−X")});
    m_scale = number(tr("&Scale"), tr("Metres per unit of the file; 0.001 for millimetres"),
                     {1e-6, 1e6, 0.01, 6, {}}, [this, report](double value, DragPhase phase) {
                         m_vehicle.scale = value;
                         report(phase);
                     });
    m_turn =
        number(tr("&Turn"), tr("Turns the vehicle so that its front looks ahead"),
               {-360.0, 360.0, 5.0, 1, tr("°")}, [this, report](double value, DragPhase phase) {
                   m_vehicle.heading = value * kPi / 180.0;
                   report(phase);
               });
    m_lift =
        number(tr("&Lift"), tr("Raises the vehicle until its wheels stand on the ground"),
               {-100.0, 100.0, 0.01, 3, tr(" m")}, [this, report](double value, DragPhase phase) {
                   m_vehicle.offset.z = value;
                   report(phase);
               });
    m_coat = check(tr("Clear coat and &glass"),
                   tr("Gives paint a clear coat and windows glass where the file has none, so that "
                      "they reflect"),
                   [this, report](bool on) {
                       m_vehicle.coat = on;
                       report(DragPhase::End);
                   });
    m_up->setObjectName(QStringLiteral("vehicleUp"));
    m_scale->setObjectName(QStringLiteral("vehicleScale"));
    m_turn->setObjectName(QStringLiteral("vehicleTurn"));
    m_lift->setObjectName(QStringLiteral("vehicleLift"));
    m_coat->setObjectName(QStringLiteral("vehicleCoat"));
}

void VehiclePage::show(const VehicleModel& vehicle) {
    m_vehicle = vehicle;
    m_heading->setText(tr("Vehicle model %1").arg(utf16(vehicle.id)));
    m_path->setText(utf16(vehicle.path));
    m_up->setCurrentIndex(int(vehicle.up));
    m_scale->show(vehicle.scale);
    m_turn->show(vehicle.heading * 180.0 / kPi);
    m_lift->show(vehicle.offset.z);
    m_coat->setChecked(vehicle.coat);
}

}  // namespace reflet
