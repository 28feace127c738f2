// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/ui/panels/PanelTestSupport.h"
#include "widgets/common/NumberEdit.h"
#include "widgets/inspector/Inspector.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <vector>

namespace reflet {
namespace {

using Kind = ProjectItem::Kind;

class InspectorTest : public testing::Test {
protected:
    void SetUp() override {
        inspector.setProject(project, QStringLiteral("Amersfoort / RD New"));
        ProbeFacts facts;
        facts.groundHeight = 10.0;
        inspector.setProbeFacts({{"rem-1", facts}, {"rem-2", facts}});
        test::showWidget(inspector, 340, 600);
        QObject::connect(
            &inspector, &Inspector::probesChanged,
            [this](const auto& changed, DragPhase phase) { probes.emplace_back(changed, phase); });
        QObject::connect(&inspector, &Inspector::reflectorsChanged,
                         [this](const auto& changed, DragPhase phase) {
                             reflectors.emplace_back(changed, phase);
                         });
        QObject::connect(
            &inspector, &Inspector::routesChanged,
            [this](const auto& changed, DragPhase phase) { routes.emplace_back(changed, phase); });
    }
    void type(QWidget* edit, const QString& text) {
        edit->setFocus();
        QTest::keyClick(edit, Qt::Key_A, Qt::ControlModifier);
        QTest::keyClicks(edit, text);
        QTest::keyClick(edit, Qt::Key_Return);
    }

    Project project = test::streetProject(3);
    Inspector inspector;
    std::vector<std::pair<std::vector<Probe>, DragPhase>> probes;
    std::vector<std::pair<std::vector<Reflector>, DragPhase>> reflectors;
    std::vector<std::pair<std::vector<RouteSpec>, DragPhase>> routes;
};

TEST_F(InspectorTest, TypingACoordinateIsOneChange) {
    inspector.setSelection({{Kind::Probe, "rem-1"}});
    auto* east = test::child<NumberEdit>(inspector, "probeE");
    EXPECT_DOUBLE_EQ(east->value(), 84'900.0);
    type(east, QStringLiteral("84950.5"));
    ASSERT_EQ(probes.size(), 1U);
    EXPECT_EQ(probes[0].second, DragPhase::End);
    ASSERT_EQ(probes[0].first.size(), 1U);
    EXPECT_DOUBLE_EQ(probes[0].first[0].position.x, 84'950.5);
    EXPECT_DOUBLE_EQ(probes[0].first[0].position.y, 446'000.0);
}

TEST_F(InspectorTest, AHeldArrowKeyIsOneSequence) {
    inspector.setSelection({{Kind::Probe, "rem-1"}});
    auto* up = test::child<NumberEdit>(inspector, "probeU");
    up->setFocus();
    QTest::keyPress(up, Qt::Key_Up);
    QKeyEvent repeat(QEvent::KeyPress, Qt::Key_Up, {}, QString(), true);
    QApplication::sendEvent(up, &repeat);
    QTest::keyRelease(up, Qt::Key_Up);
    ASSERT_GE(probes.size(), 3U);
    EXPECT_EQ(probes.front().second, DragPhase::Begin);
    EXPECT_EQ(probes.back().second, DragPhase::End);
    for (std::size_t i = 1; i + 1 < probes.size(); ++i)
        EXPECT_EQ(probes[i].second, DragPhase::Move);
}

TEST_F(InspectorTest, DraggingALabelIsOneSequenceAndEscapeTakesItBack) {
    inspector.setSelection({{Kind::Probe, "rem-1"}});
    auto* east = test::child<NumberEdit>(inspector, "probeE");
    DragLabel* label = nullptr;
    for (auto* each : inspector.findChildren<DragLabel*>())
        if (each->buddy() == east)
            label = each;
    ASSERT_NE(label, nullptr);
    QTest::mousePress(label, Qt::LeftButton, {}, {5, 5});
    test::moveMouse(*label, {25, 5});
    test::moveMouse(*label, {45, 5});
    QTest::keyClick(east, Qt::Key_Escape);
    test::moveMouse(*label, {65, 5});
    QTest::mouseRelease(label, Qt::LeftButton, {}, {65, 5});
    ASSERT_GE(probes.size(), 2U);
    EXPECT_EQ(probes.front().second, DragPhase::Begin);
    EXPECT_GT(probes.front().first[0].position.x, 84'900.0);
    EXPECT_EQ(probes.back().second, DragPhase::Cancel);
    EXPECT_DOUBLE_EQ(probes.back().first[0].position.x, 84'900.0);
}

TEST_F(InspectorTest, EscapeWhileTypingChangesNothing) {
    inspector.setSelection({{Kind::Probe, "rem-1"}});
    auto* east = test::child<NumberEdit>(inspector, "probeE");
    east->setFocus();
    QTest::keyClick(east, Qt::Key_A, Qt::ControlModifier);
    QTest::keyClicks(east, QStringLiteral("1"));
    QTest::keyClick(east, Qt::Key_Escape);
    QTest::keyClick(east, Qt::Key_Return);
    EXPECT_TRUE(probes.empty());
    EXPECT_DOUBLE_EQ(east->value(), 84'900.0);
}

TEST_F(InspectorTest, AModelShowsWhatItsKindOfFileCanBeTold) {
    const std::string path = project.models.front().path;
    std::vector<ModelReference> read;
    QObject::connect(&inspector, &Inspector::readingChanged,
                     [&](const ModelReference& model) { read.push_back(model); });
    const auto shown = [&](const char* name) {
        auto* field = inspector.findChild<QWidget*>(QString::fromLatin1(name));
        return field != nullptr && field->isVisible();
    };
    ModelFacts facts;
    facts.kind = ModelFacts::Kind::Objects;
    facts.lods = {QStringLiteral("1.2"), QStringLiteral("2.2")};
    inspector.setModelFacts({{path, facts}});
    inspector.setSelection({{Kind::Model, path}});
    EXPECT_TRUE(shown("modelDetail"));
    EXPECT_TRUE(shown("modelTypes"));
    EXPECT_FALSE(shown("modelHeightField"));
    EXPECT_FALSE(shown("modelUnit"));
    auto* detail = test::child<QComboBox>(inspector, "modelDetail");
    EXPECT_EQ(detail->count(), 3);
    detail->setFocus();
    QTest::keyClick(detail, Qt::Key_Down);
    type(test::child<QLineEdit>(inspector, "modelTypes"), QStringLiteral("Building, , Road "));
    ASSERT_EQ(read.size(), 2U);
    EXPECT_EQ(read[0].lod, "1.2");
    EXPECT_EQ(read[1].types, (std::vector<std::string>{"Building", "Road"}));
    EXPECT_EQ(read[1].path, path);

    facts.kind = ModelFacts::Kind::Mesh;
    facts.lods = {};
    inspector.setModelFacts({{path, facts}});
    EXPECT_TRUE(shown("modelUp"));
    EXPECT_FALSE(shown("modelTypes"));
    type(test::child<NumberEdit>(inspector, "modelUnit"), QStringLiteral("0.001"));
    ASSERT_EQ(read.size(), 3U);
    ASSERT_TRUE(read[2].unit);
    EXPECT_DOUBLE_EQ(*read[2].unit, 0.001);

    facts.kind = ModelFacts::Kind::Other;
    inspector.setModelFacts({{path, facts}});
    for (const char* name : {"modelUp", "modelUnit", "modelTypes", "modelHeightField"})
        EXPECT_FALSE(shown(name)) << name;
}

TEST_F(InspectorTest, SeveralProbesKeepTheirShapeAndSaySeveral) {
    inspector.setSelection({{Kind::Probe, "rem-1"}, {Kind::Probe, "rem-2"}});
    auto* east = test::child<NumberEdit>(inspector, "probeE");
    EXPECT_EQ(east->text(), QStringLiteral("several"));
    type(east, QStringLiteral("84910"));
    ASSERT_EQ(probes.size(), 1U);
    ASSERT_EQ(probes[0].first.size(), 2U);
    EXPECT_DOUBLE_EQ(probes[0].first[0].position.x, 84'910.0);
    EXPECT_DOUBLE_EQ(probes[0].first[1].position.x, 84'930.0);
}

TEST_F(InspectorTest, HeightAboveGroundIsSetForAll) {
    inspector.setSelection({{Kind::Probe, "rem-1"}, {Kind::Probe, "rem-2"}});
    type(test::child<NumberEdit>(inspector, "probeHeight"), QStringLiteral("1.6"));
    ASSERT_EQ(probes.size(), 1U);
    for (const Probe& probe : probes[0].first)
        EXPECT_DOUBLE_EQ(probe.position.z, 11.6);
}

TEST_F(InspectorTest, ResolutionLockedBakeAndPreview) {
    inspector.setSelection({{Kind::Probe, "rem-2"}});
    auto* resolution = test::child<QComboBox>(inspector, "probeResolution");
    resolution->setFocus();
    QTest::keyClick(resolution, Qt::Key_Down);  // from automatic to 32
    ASSERT_EQ(probes.size(), 1U);
    EXPECT_EQ(probes[0].first[0].resolution, std::optional(32));
    QTest::mouseClick(test::child<QCheckBox>(inspector, "probeLocked"), Qt::LeftButton, {}, {8, 8});
    ASSERT_EQ(probes.size(), 2U);
    EXPECT_TRUE(probes[1].first[0].locked);

    std::vector<std::string> baked, shown;
    QObject::connect(&inspector, &Inspector::bakeRequested, [&](const auto& ids) { baked = ids; });
    QObject::connect(&inspector, &Inspector::previewToggled,
                     [&](const auto& ids, bool on) { shown = on ? ids : decltype(ids){}; });
    QTest::mouseClick(test::child<QPushButton>(inspector, "probeBake"), Qt::LeftButton);
    QTest::mouseClick(test::child<QCheckBox>(inspector, "probePreview"), Qt::LeftButton, {},
                      {8, 8});
    EXPECT_EQ(baked, std::vector<std::string>{"rem-2"});
    EXPECT_EQ(shown, std::vector<std::string>{"rem-2"});
}

TEST_F(InspectorTest, SpeedIsInKilometresAnHour) {
    inspector.setSelection({{Kind::Reflector, "tram-1"}});
    auto* speed = test::child<NumberEdit>(inspector, "reflectorSpeed");
    EXPECT_NEAR(speed->value(), 28.8, 1e-9);
    type(speed, QStringLiteral("36"));
    ASSERT_EQ(reflectors.size(), 1U);
    EXPECT_NEAR(reflectors[0].first[0].speed, 10.0, 1e-9);
}

TEST_F(InspectorTest, AVehicleMayMatterMoreThanOthers) {
    inspector.setSelection({{Kind::Reflector, "tram-1"}});
    auto* interest = test::child<NumberEdit>(inspector, "reflectorInterest");
    EXPECT_EQ(interest->value(), 1.0);
    type(interest, QStringLiteral("2.5"));
    ASSERT_EQ(reflectors.size(), 1U);
    EXPECT_EQ(reflectors[0].first[0].interest, 2.5);
}

TEST_F(InspectorTest, AVehiclesVehicleMayBeOneThatTheUserBrought) {
    inspector.setSelection({{Kind::Reflector, "tram-1"}});
    auto* vehicle = test::child<QComboBox>(inspector, "reflectorVehicle");
    EXPECT_EQ(vehicle->currentText(), QStringLiteral("tram"));
    vehicle->setFocus();
    QTest::keyClick(vehicle, Qt::Key_End);
    ASSERT_EQ(reflectors.size(), 1U);
    EXPECT_EQ(reflectors[0].first[0].vehicle, "delivery van");
}

TEST_F(InspectorTest, ARoutesNameAndRadius) {
    inspector.setSelection({{Kind::Route, "route-1"}});
    type(test::child<QLineEdit>(inspector, "routeName"), QStringLiteral("High street"));
    type(test::child<NumberEdit>(inspector, "routeRadius"), QStringLiteral("25"));
    ASSERT_EQ(routes.size(), 2U);
    EXPECT_EQ(routes[0].first[0].name, "High street");
    EXPECT_DOUBLE_EQ(routes[1].first[0].cornerRadius, 25.0);
}

TEST_F(InspectorTest, ThingsThatAreGoneShowTheProject) {
    inspector.setSelection({{Kind::Probe, "no such probe"}});
    EXPECT_TRUE(test::child<QLineEdit>(inspector, "projectName")->isVisible());
}

TEST_F(InspectorTest, WhatAClassCountsAsIsChosenWithTheProject) {
    std::vector<std::pair<HeightfieldSettings, DragPhase>> heights;
    QObject::connect(&inspector, &Inspector::heightfieldChanged,
                     [&](const HeightfieldSettings& changed, DragPhase phase) {
                         heights.emplace_back(changed, phase);
                     });
    inspector.setSelection({});
    auto* bridges = test::child<QComboBox>(inspector, "heightsBridges");
    EXPECT_EQ(bridges->currentIndex(), int(HeightPolicy::Overhead));
    ASSERT_EQ(bridges->count(), int(kHeightPolicyCount));
    bridges->setFocus();
    QTest::keyClick(bridges, Qt::Key_Home);
    ASSERT_EQ(heights.size(), 1U);
    EXPECT_EQ(heights[0].second, DragPhase::End);
    HeightfieldSettings expected = project.heightfield;
    for (const CityObjectType type : {CityObjectType::Bridge, CityObjectType::BridgePart})
        expected.rules.policies[std::size_t(type)] = HeightPolicy::None;
    EXPECT_EQ(heights[0].first, expected);

    project.heightfield = expected;
    project.heightfield.rules.policies[std::size_t(CityObjectType::BridgePart)] =
        HeightPolicy::Solid;
    inspector.setProject(project, QString());
    EXPECT_EQ(bridges->currentIndex(), -1) << "its classes differ";
    type(test::child<NumberEdit>(inspector, "heightsClearance"), QStringLiteral("2.5"));
    ASSERT_EQ(heights.size(), 2U);
    EXPECT_DOUBLE_EQ(heights[1].first.rules.clearance, 2.5);
}

}  // namespace
}  // namespace reflet
