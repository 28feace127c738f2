// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/document/Autosave.h"
#include "app/document/ProjectDocument.h"
#include "app/document/Recovery.h"
#include "core/project/ProjectFile.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/unit/document/TestProjects.h"
#include "tests/unit/document/Victim.h"

#include <gtest/gtest.h>

#include <QCoreApplication>
#include <QDeadlineTimer>
#include <QEventLoop>
#include <chrono>
#include <functional>
#include <thread>

namespace reflet {
namespace {

namespace fs = std::filesystem;

constexpr int kPatience = 60'000;

/// Lets events pass until the condition holds; false when patience ends.
bool waitFor(const std::function<bool()>& condition) {
    const QDeadlineTimer deadline(kPatience);
    while (!condition() && !deadline.hasExpired()) {
        QCoreApplication::processEvents(QEventLoop::AllEvents);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return condition();
}

void letPass(int milliseconds) {
    const QDeadlineTimer deadline(milliseconds);
    while (!deadline.hasExpired()) {
        QCoreApplication::processEvents(QEventLoop::AllEvents);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

/// A window with changes that are not saved but by itself, until it is killed.
void autosaveAndWait(const fs::path& file, const fs::path& state,
                     const std::function<void()>& ready) {
    ProjectDocument window;
    if (!file.empty() && !window.open(file))
        return;
    Autosave autosave(window, state);
    window.addProbe({1.0, 2.0, 3.0});
    if (!autosave.saveNow())
        return;
    ready();
    for (;;)
        ::pause();
}

class AutosaveTest : public testing::Test {
protected:
    AutosaveTest()
        : file(folder.write("town.reflet", projectToJson(test::richProject()))),
          state(folder / "state") {}
    void SetUp() override { ASSERT_TRUE(document.open(file).has_value()); }

    /// A window with that file open ("" = untitled) changes something and is killed.
    void killAWindow(const fs::path& opened) {
        const test::Victim victim(
            [&](const auto& ready) { autosaveAndWait(opened, state, ready); });
        ASSERT_TRUE(victim.isReady());
    }

    test::TemporaryFolder folder;
    fs::path file;
    fs::path state;
    ProjectDocument document;
};

TEST_F(AutosaveTest, WritesUnsavedChangesByItself) {
    Autosave autosave(document, state);
    autosave.setInterval(5);
    letPass(50);
    EXPECT_FALSE(fs::exists(autosave.file())) << "nothing is unsaved";
    document.setExposure(2.0F);
    ASSERT_TRUE(waitFor([&] { return fs::exists(autosave.file()); }));
    const auto record = recoveryFromJson(test::bytesOf(autosave.file()), "autosave");
    ASSERT_TRUE(record.has_value()) << record.error().message();
    EXPECT_EQ(record->project.exposure, 2.0F);
    EXPECT_EQ(record->original, document.file());
    EXPECT_TRUE(record->time.isValid());
    EXPECT_EQ(loadProject(file)->exposure, 1.0F) << "the project's own file is the user's";
}

TEST_F(AutosaveTest, RemovesItsFileOnceTheProjectIsSavedOrGivenUp) {
    Autosave autosave(document, state);
    document.setExposure(2.0F);
    ASSERT_TRUE(autosave.saveNow().has_value());
    EXPECT_TRUE(fs::exists(autosave.file()));
    ASSERT_TRUE(document.save().has_value());
    EXPECT_FALSE(fs::exists(autosave.file()));
    document.setExposure(3.0F);
    ASSERT_TRUE(autosave.saveNow().has_value());
    EXPECT_TRUE(fs::exists(autosave.file()));
    document.close();
    EXPECT_FALSE(fs::exists(autosave.file()));
    EXPECT_TRUE(fs::is_empty(state));
}

TEST_F(AutosaveTest, WaitsForTheEndOfADrag) {
    Autosave autosave(document, state);
    autosave.setInterval(5);
    const int drag = document.beginDrag();
    document.moveProbe("p1", {1, 1, 1}, drag);
    letPass(100);
    EXPECT_FALSE(fs::exists(autosave.file()));
    document.endDrag();
    EXPECT_TRUE(waitFor([&] { return fs::exists(autosave.file()); }));
}

TEST_F(AutosaveTest, TellsOnceThatItCannotWrite) {
    folder.write("blocked", "a file where the folder should be");
    Autosave autosave(document, folder / "blocked");
    std::vector<Error> failures;
    QObject::connect(&autosave, &Autosave::failed,
                     [&](const Error& error) { failures.push_back(error); });
    document.setExposure(2.0F);
    EXPECT_FALSE(autosave.saveNow().has_value());
    EXPECT_FALSE(autosave.saveNow().has_value());
    ASSERT_EQ(failures.size(), 1U);
    EXPECT_EQ(failures[0].code, ErrorCode::WriteFailed);
    EXPECT_FALSE(failures[0].remedy.empty());
}

TEST_F(AutosaveTest, LeavesNothingToRecoverWhileItsWindowLivesOrHasEnded) {
    const Recovery recovery(state);
    EXPECT_TRUE(recovery.list().empty()) << "there is no folder yet";
    {
        Autosave autosave(document, state);
        document.setExposure(2.0F);
        ASSERT_TRUE(autosave.saveNow().has_value());
        EXPECT_TRUE(recovery.list().empty());
    }
    EXPECT_TRUE(recovery.list().empty());
}

TEST_F(AutosaveTest, RecoversWhatAKilledWindowHadNotSaved) {
    document.close();
    killAWindow(file);
    const Recovery recovery(state);
    const auto found = recovery.list();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].original, fs::canonical(file));
    EXPECT_EQ(found[0].name, "rich");
    EXPECT_LT(found[0].time.secsTo(QDateTime::currentDateTimeUtc()), kPatience);

    ASSERT_TRUE(recovery.recover(found[0], document).has_value());
    EXPECT_TRUE(document.isDirty());
    EXPECT_FALSE(document.isReadOnly()) << "the lock of the dead counts for nothing";
    EXPECT_EQ(document.file(), fs::canonical(file));
    Project expected = test::richProject();
    expected.probes.push_back({"probe-1", {1, 2, 3}, std::nullopt, false});
    EXPECT_EQ(projectToJson(document.project()), projectToJson(expected));
    ASSERT_TRUE(document.save().has_value());
    recovery.discard(found[0]);
    EXPECT_TRUE(recovery.list().empty());
    EXPECT_TRUE(fs::is_empty(state));
    EXPECT_EQ(test::bytesOf(file), projectToJson(expected));
}

TEST_F(AutosaveTest, RecoversAProjectThatNeverHadAFile) {
    killAWindow({});
    const Recovery recovery(state);
    const auto found = recovery.list();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_TRUE(found[0].original.empty());
    ASSERT_TRUE(recovery.recover(found[0], document).has_value());
    EXPECT_TRUE(document.file().empty());
    EXPECT_TRUE(document.isDirty());
    EXPECT_EQ(document.project().probes.size(), 1U);
}

TEST_F(AutosaveTest, RecoversReadOnlyWhatAnotherWindowHasOpenByNow) {
    document.close();
    killAWindow(file);
    ProjectDocument other;
    ASSERT_TRUE(other.open(file).has_value());
    const Recovery recovery(state);
    ASSERT_EQ(recovery.list().size(), 1U);
    ASSERT_TRUE(recovery.recover(recovery.list()[0], document).has_value());
    EXPECT_TRUE(document.isReadOnly());
    EXPECT_TRUE(document.saveAs(folder / "rescued.reflet").has_value());
}

TEST_F(AutosaveTest, PassesOverRecoveryFilesThatAreNone) {
    folder.write(std::string("state/cut") + kRecoveryEnding, R"({"schema": "reflet-rec)");
    folder.write(std::string("state/empty") + kRecoveryEnding, "");
    folder.write(std::string("state/list") + kRecoveryEnding, "[1]");
    folder.write(std::string("state/newer") + kRecoveryEnding,
                 R"({"schema": "reflet-recovery", "version": 9, "project": {}})");
    folder.write(std::string("state/bad") + kRecoveryEnding,
                 R"({"schema": "reflet-recovery", "version": 1, "project": 7})");
    const Recovery recovery(state);
    EXPECT_TRUE(recovery.list().empty());
    const std::string before = projectToJson(document.project());
    const auto recovered =
        recovery.recover({state / (std::string("cut") + kRecoveryEnding), {}, "", {}}, document);
    ASSERT_FALSE(recovered.has_value());
    EXPECT_EQ(recovered.error().code, ErrorCode::Unreadable);
    EXPECT_EQ(projectToJson(document.project()), before);
}

}  // namespace
}  // namespace reflet
