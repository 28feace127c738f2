// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/inspector/HeightsForm.h"

#include <QComboBox>
#include <QLabel>
#include <algorithm>
#include <array>

namespace reflet {

HeightsForm::HeightsForm(QWidget* parent) : FieldForm(parent) {
    heading()->setText(tr("Height model"));
    m_cell = number(tr("C&ell"), tr("Edge of a cell; 0 leaves it to Reflet"),
                    {0.0, 1000.0, 0.5, 3, tr(" m")}, [this](double value, DragPhase phase) {
                        m_settings.cellSize = value;
                        changed(m_settings, phase);
                    });
    m_cell->setObjectName(QStringLiteral("heightsCell"));
    m_clearance =
        number(tr("&Lowest hollow"),
               tr("Hollows under bridges, arches and crowns that are lower count as solid"),
               {0.0, 100.0, 0.5, 2, tr(" m")}, [this](double value, DragPhase phase) {
                   m_settings.rules.clearance = value;
                   changed(m_settings, phase);
               });
    m_clearance->setObjectName(QStringLiteral("heightsClearance"));
    using Type = CityObjectType;
    addKind(tr("Buildings"), "heightsBuildings", {Type::Building, Type::BuildingPart});
    addKind(tr("Installations"), "heightsInstallations", {Type::BuildingInstallation});
    addKind(tr("Bridges"), "heightsBridges", {Type::Bridge, Type::BridgePart});
    addKind(tr("Tunnels"), "heightsTunnels", {Type::Tunnel});
    addKind(tr("Trees"), "heightsTrees", {Type::SolitaryVegetation});
    addKind(tr("Plant cover"), "heightsPlantCover", {Type::PlantCover});
    addKind(tr("Furniture"), "heightsFurniture", {Type::CityFurniture});
    addKind(tr("Constructions"), "heightsConstructions", {Type::OtherConstruction});
    addKind(tr("Roads and rails"), "heightsRoads",
            {Type::Road, Type::Railway, Type::TransportSquare});
    addKind(tr("Terrain"), "heightsTerrain", {Type::TinRelief, Type::LandUse});
    addKind(tr("Water"), "heightsWater", {Type::WaterBody});
    addKind(tr("Other things"), "heightsOthers", {Type::Generic, Type::Group, Type::Other});
}

void HeightsForm::addKind(const QString& name, const char* objectName,
                          std::vector<CityObjectType> types) {
    const std::array<QString, kHeightPolicyCount> names{
        tr("left out"),
        tr("ground"),
        tr("ground, or stands on it"),
        tr("solid from top to ground"),
        tr("stands on the ground"),
        tr("hangs over the ground"),
        tr("crown over a trunk"),
        tr("cut out of the ground"),
    };
    const std::size_t at = m_kinds.size();
    QComboBox* box = choice(
        name, tr("What these count as for vehicles and for rays of light"), [this, at](int chosen) {
            for (const CityObjectType type : m_kinds[at].types)
                m_settings.rules.policies[std::size_t(type)] = HeightPolicy(chosen);
            changed(m_settings, DragPhase::End);
        });
    box->setObjectName(QLatin1String(objectName));
    for (const QString& text : names)
        box->addItem(text);
    m_kinds.push_back({std::move(types), box});
}

void HeightsForm::show(const HeightfieldSettings& settings) {
    m_settings = settings;
    m_cell->show(settings.cellSize);
    m_clearance->show(settings.rules.clearance);
    for (const Kind& kind : m_kinds) {
        const HeightPolicy first = settings.rules.policy(kind.types.front());
        const bool same =
            std::all_of(kind.types.begin(), kind.types.end(),
                        [&](CityObjectType type) { return settings.rules.policy(type) == first; });
        kind.box->setCurrentIndex(same ? int(first) : -1);
    }
}

}  // namespace reflet
