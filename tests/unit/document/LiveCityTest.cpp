// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/document/LiveCity.h"
#include "app/pipeline/Import.h"
#include "app/pipeline/MakeItReflect.h"
#include "core/project/ProjectFile.h"
#include "tests/support/StreetProject.h"
#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QThread>
#include <set>

namespace reflet {
namespace {

constexpr int kPatience = 120'000;  // milliseconds, for a busy machine

/// A street with a car and five probes on the disk, opened in a document that is followed.
class LiveCityTest : public testing::Test {
protected:
    void SetUp() override {
        ASSERT_TRUE(test::importStreetWithCar(folder, file).has_value());
        Project project = *loadProject(file);
        project.bake = {32, 1};
        project.tuning.resolution = 32;
        project.probes = {{"near", {690'005.0, 5'335'000.0, 1.75}, std::nullopt, false},
                          {"far", {690'050.0, 5'335'000.0, 1.75}, std::nullopt, false}};
        ASSERT_TRUE(saveProject(project, file).has_value());
    }

    void open() {
        ASSERT_TRUE(document.open(file).has_value());
        live = std::make_unique<LiveCity>(document, jobs);
        QObject::connect(live.get(), &LiveCity::problem,
                         [this](const Error& error) { problems.push_back(error); });
    }

    template <class Condition>
    [[nodiscard]] static bool until(const Condition& holds) {
        QElapsedTimer timer;
        timer.start();
        while (!holds() && timer.elapsed() < kPatience) {
            QCoreApplication::processEvents(QEventLoop::AllEvents, 20);
            QThread::msleep(1);
        }
        return holds();
    }

    [[nodiscard]] bool untilState(const std::string& id, ProbeState state) {
        return until([&] { return live->probeState(id) == state; });
    }

    test::TemporaryFolder folder;
    std::filesystem::path file = folder / "street.reflet";
    ProjectDocument document;
    JobRunner jobs;
    std::unique_ptr<LiveCity> live;
    std::vector<Error> problems;
};

TEST_F(LiveCityTest, PublishesCityLightAndTrafficAndBakesWhatIsMissing) {
    open();
    EXPECT_TRUE(live->loading());
    EXPECT_EQ(live->city(), nullptr);
    EXPECT_EQ(live->probeState("near"), ProbeState::Missing);
    ASSERT_TRUE(until([&] { return live->city() != nullptr; }));
    EXPECT_FALSE(live->loading());
    EXPECT_GT(live->lighting().sunDirection.z, 0.5);
    EXPECT_EQ(live->groundHeight(10.0, 0.0), 0.0);
    EXPECT_EQ(live->reports().size(), 1U);
    ASSERT_TRUE(untilState("near", ProbeState::Fresh));
    ASSERT_TRUE(untilState("far", ProbeState::Fresh));
    EXPECT_EQ(live->rems().size(), 2U);
    EXPECT_EQ(live->rems()[0].id, "near");  // the project's order
    ASSERT_TRUE(until([&] { return live->traffic()->size() == 1; }));
    ASSERT_TRUE(until([&] { return live->ambient() != nullptr; }));
    EXPECT_NEAR(live->streetCamera(0, 1.0).position.z, 1.6, 0.5);
    EXPECT_FALSE(live->baking());
    EXPECT_TRUE(problems.empty());
}

TEST_F(LiveCityTest, BeginsNothingLongWhileWorkIsHeldForTheFirstPicture) {
    open();
    QObject::connect(live.get(), &LiveCity::cityChanged, [this] { live->holdWork(); });
    ASSERT_TRUE(until([&] { return live->city() != nullptr && live->traffic()->size() == 1; }));
    EXPECT_FALSE(live->baking());
    QElapsedTimer held;
    held.start();
    static_cast<void>(until([&] { return held.elapsed() > 800; }));
    EXPECT_EQ(live->probesToBake(), 2) << "longer than it waits after any change";
    EXPECT_TRUE(jobs.isIdle());
    live->letWorkGoOn();
    EXPECT_TRUE(untilState("near", ProbeState::Fresh));
    EXPECT_TRUE(until([&] { return live->ambient() != nullptr; }));
}

TEST_F(LiveCityTest, GoesOnByItselfWhenNoFirstPictureComes) {
    open();
    QObject::connect(live.get(), &LiveCity::cityChanged, [this] { live->holdWork(); });
    EXPECT_TRUE(untilState("near", ProbeState::Fresh));
    EXPECT_TRUE(until([&] { return live->ambient() != nullptr; }));
}

TEST_F(LiveCityTest, TakesTheCityThatWasReadAhead) {
    const auto ahead = std::make_shared<const HeadStart>(file);
    const HeadStart::City read = ahead->city({});
    ASSERT_NE(read.drawn, nullptr);
    live = std::make_unique<LiveCity>(document, jobs);
    live->setHeadStart(ahead);
    ASSERT_TRUE(document.open(file).has_value());
    ASSERT_TRUE(until([&] { return live->city() != nullptr; }));
    EXPECT_EQ(live->city(), read.drawn) << "nothing was read twice";
    EXPECT_EQ(projectToJson(live->prepared()->project()), projectToJson(document.project()));
}

TEST_F(LiveCityTest, ReadsForItselfWhatWasNotReadAhead) {
    Project coarser = *loadProject(file);
    coarser.heightfield.cellSize = 4.0;
    ASSERT_TRUE(saveProject(coarser, folder / "coarser.reflet").has_value());
    for (const auto& path : {folder / "coarser.reflet", folder / "missing.reflet"}) {
        const auto ahead = std::make_shared<const HeadStart>(path);
        ProjectDocument opened;
        LiveCity city(opened, jobs);
        city.setHeadStart(ahead);
        ASSERT_TRUE(opened.open(file).has_value());
        ASSERT_TRUE(until([&] { return city.city() != nullptr; }));
        EXPECT_EQ(projectToJson(city.prepared()->project()), projectToJson(opened.project()));
        EXPECT_LT(city.city()->heightfield->grid.cellSize, 4.0);
    }
}

TEST_F(LiveCityTest, BakesTheProbeNearestToTheVehicleFirst) {
    Project project = *loadProject(file);
    std::swap(project.probes[0], project.probes[1]);
    ASSERT_TRUE(saveProject(project, file).has_value());
    open();
    live->setAutoBake(false);
    ASSERT_TRUE(until([&] { return live->traffic()->size() == 1; }));
    std::vector<std::string> order;
    QObject::connect(live.get(), &LiveCity::remsChanged, [&] {
        const RemSet rems = live->rems();
        for (const auto& rem : rems.pointers()) {
            if (std::find(order.begin(), order.end(), rem->id) == order.end())
                order.push_back(rem->id);
        }
    });
    live->bakeNow();
    ASSERT_TRUE(untilState("far", ProbeState::Fresh));
    EXPECT_EQ(order, (std::vector<std::string>{"near", "far"}));
}

TEST_F(LiveCityTest, KeepsTheOldMapAtItsOldPlaceUntilTheNewOneIsBaked) {
    open();
    ASSERT_TRUE(untilState("near", ProbeState::Fresh));
    const auto old = live->rem("near");
    live->setAutoBake(false);
    document.moveProbe("near", {690'010.0, 5'335'001.0, 2.0});
    EXPECT_EQ(live->probeState("near"), ProbeState::Stale);
    EXPECT_EQ(live->rem("near"), old);
    EXPECT_NEAR(live->rem("near")->center.x, 5.0, 1e-9);
    live->bakeNow();
    ASSERT_TRUE(untilState("near", ProbeState::Fresh));
    EXPECT_NEAR(live->rem("near")->center.x, 10.0, 1e-9);

    // Undo finds the map in the cache, without baking.
    document.undoStack()->undo();
    ASSERT_TRUE(untilState("near", ProbeState::Fresh));
    EXPECT_EQ(live->rem("near")->radiance.texels(), old->radiance.texels());
}

TEST_F(LiveCityTest, MakesAllMapsStaleWhenTheSunMovesAndKeepsTheCity) {
    open();
    ASSERT_TRUE(untilState("far", ProbeState::Fresh));
    const auto city = live->city();
    const Lighting morning = live->lighting();
    live->setAutoBake(false);
    DateTime evening = document.project().date;
    evening.hour = 18;
    document.setDate(evening);
    EXPECT_NE(live->lighting(), morning);  // at once
    EXPECT_EQ(live->probeState("near"), ProbeState::Stale);
    EXPECT_EQ(live->probesToBake(), 2);
    EXPECT_EQ(live->rems().size(), 2U);
    live->setAutoBake(true);
    ASSERT_TRUE(untilState("near", ProbeState::Fresh));
    ASSERT_TRUE(untilState("far", ProbeState::Fresh));
    EXPECT_EQ(live->city(), city);
}

TEST_F(LiveCityTest, RefusesAProbeInAHouseAndOffersAPlaceBeside) {
    open();
    ASSERT_TRUE(untilState("far", ProbeState::Fresh));
    document.moveProbe("near", {690'004.5, 5'335'010.0, 2.0});
    ASSERT_TRUE(untilState("near", ProbeState::Refused));
    EXPECT_FALSE(live->probeProblem("near").isEmpty());
    ASSERT_TRUE(live->freePlace("near").has_value());
    document.moveProbe("near", *live->freePlace("near"));
    ASSERT_TRUE(untilState("near", ProbeState::Fresh));
    EXPECT_TRUE(live->probeProblem("near").isEmpty());
    EXPECT_TRUE(problems.empty());
}

TEST_F(LiveCityTest, StopsBakingWhenAskedUntilItIsAskedToGoOn) {
    Project project = *loadProject(file);
    project.bake = {512, 4};  // slow
    ASSERT_TRUE(saveProject(project, file).has_value());
    open();
    ASSERT_TRUE(until([&] { return live->baking(); }));
    const auto isBaking = [&](const char* id) {
        return live->probeState(id) == ProbeState::Baking;
    };
    EXPECT_TRUE(isBaking("near") || isBaking("far"));
    live->cancelBaking();
    EXPECT_FALSE(live->baking());
    EXPECT_EQ(live->probeState("near"), ProbeState::Missing);
    EXPECT_EQ(live->probesToBake(), 2);
    document.setBake({32, 1});  // a change: on it goes
    ASSERT_TRUE(untilState("near", ProbeState::Fresh));
}

TEST_F(LiveCityTest, ForgetsAProbeThatIsRemovedAndReadsItBackAfterUndo) {
    open();
    ASSERT_TRUE(untilState("near", ProbeState::Fresh));
    ASSERT_TRUE(untilState("far", ProbeState::Fresh));
    document.remove({{ProjectItem::Kind::Probe, "near"}});
    EXPECT_EQ(live->rems().size(), 1U);
    EXPECT_EQ(live->rem("near"), nullptr);
    document.undoStack()->undo();
    ASSERT_TRUE(untilState("near", ProbeState::Fresh));
    EXPECT_EQ(live->rems().size(), 2U);
}

TEST_F(LiveCityTest, TellsOfAMissingModelAndOpensWhenItIsBack) {
    const auto model = folder / "street.city.json";
    std::filesystem::rename(model, folder / "away");
    open();
    ASSERT_TRUE(until([&] { return !problems.empty(); }));
    EXPECT_NE(problems[0].subject.find("street.city.json"), std::string::npos);
    EXPECT_FALSE(problems[0].remedy.empty());
    EXPECT_FALSE(live->loading());
    EXPECT_EQ(live->city(), nullptr);
    EXPECT_EQ(document.project().probes.size(), 2U);  // the project is open all the same
    std::filesystem::rename(folder / "away", model);
    live->reload();
    ASSERT_TRUE(until([&] { return live->city() != nullptr; }));
}

TEST_F(LiveCityTest, FollowsRoutesAndVehicles) {
    open();
    ASSERT_TRUE(until([&] { return live->traffic()->size() == 1; }));
    const std::string route =
        document.addRoute({{690'002.0, 5'335'002.0, 0.0}, {690'050.0, 5'335'002.0, 0.0}});
    document.addReflector("sphere", route);
    ASSERT_TRUE(until([&] { return live->traffic()->size() == 2; }));
    EXPECT_TRUE(problems.empty());
}

TEST_F(LiveCityTest, MeasuresAPoseAndKeepsItsReferences) {
    open();
    ASSERT_TRUE(untilState("near", ProbeState::Fresh));
    ASSERT_TRUE(untilState("far", ProbeState::Fresh));
    ASSERT_TRUE(until([&] { return live->traffic()->size() == 1; }));
    const std::string car = document.project().reflectors[0].id;
    live->measure(2.0, car, {Method::Sky, Method::Mem});
    ASSERT_TRUE(until([&] { return live->figures().has_value(); }));
    EXPECT_GT(*live->figures()->methods.at(Method::Mem).map.psnr,
              *live->figures()->methods.at(Method::Sky).map.psnr);
    const GivenMaps references = live->referenceMaps();
    ASSERT_EQ(references.count(car), 1U);
    EXPECT_EQ(references.at(car).size(), live->traffic()->at(0, 0.0).poses.size());
}

TEST_F(LiveCityTest, WhatWasMeasuredGoesWithItsProjectButNotWithItsName) {
    open();
    ASSERT_TRUE(untilState("near", ProbeState::Fresh));
    ASSERT_TRUE(until([&] { return live->traffic()->size() == 1; }));
    const std::string car = document.project().reflectors[0].id;
    live->measure(2.0, car, {Method::Sky});
    ASSERT_TRUE(until([&] { return live->figures().has_value(); }));
    ASSERT_TRUE(document.saveAs(folder / "renamed.reflet").has_value());
    EXPECT_TRUE(live->figures().has_value());
    ASSERT_TRUE(document.open(file).has_value());
    EXPECT_FALSE(live->figures().has_value()) << "another project's vehicle may have the same id";
    EXPECT_TRUE(live->referenceMaps().empty());
    EXPECT_TRUE(problems.empty());
}

TEST_F(LiveCityTest, OpeningAnotherProjectEndsTheMeasurementOfThisOne) {
    open();
    live->setAutoBake(false);
    ASSERT_TRUE(until([&] { return live->city() != nullptr && live->traffic()->size() == 1; }));
    int failed = 0;
    QObject::connect(live.get(), &LiveCity::measuringFailed, [&] { ++failed; });
    // Long enough to be running still.
    live->measure(2.0, document.project().reflectors[0].id, {Method::Sky, Method::Mem}, 1024);
    ASSERT_TRUE(jobs.isBusy("figures"));
    Project other = document.project();
    other.name = "other";
    document.adopt(std::move(other));
    ASSERT_TRUE(until([&] { return failed > 0; }));
    ASSERT_TRUE(until([&] { return jobs.isIdle(); }));
    EXPECT_EQ(failed, 1);
    EXPECT_FALSE(live->figures().has_value());
}

TEST_F(LiveCityTest, IsEmptyAgainWhenTheDocumentIsClosed) {
    open();
    ASSERT_TRUE(until([&] { return live->city() != nullptr; }));
    document.close();
    ASSERT_TRUE(until([&] { return live->city() == nullptr; }));
    EXPECT_TRUE(live->rems().empty());
    EXPECT_FALSE(live->loading());
    EXPECT_TRUE(problems.empty());
}

}  // namespace
}  // namespace reflet
