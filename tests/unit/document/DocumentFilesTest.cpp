// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/document/JobRunner.h"
#include "app/document/ProjectDocument.h"
#include "app/pipeline/PreparedCity.h"
#include "core/project/ProjectFile.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/unit/document/TestProjects.h"
#include "tests/unit/document/Victim.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <random>
#include <thread>

namespace reflet {
namespace {

namespace fs = std::filesystem;
using Kind = ProjectItem::Kind;

/// A window that saves two projects by turns until it is killed.
void saveForEver(const fs::path& file, const std::function<void()>& ready) {
    ProjectDocument window;
    if (!window.open(file))
        return;
    ready();
    for (bool odd = true;; odd = !odd) {
        window.replaceProject(test::largeProject(odd), QStringLiteral("turn"));
        if (!window.save())
            return;
        window.undoStack()->clear();
    }
}

/// A project saved in a folder, and a document that has it open.
class DocumentFilesTest : public testing::Test {
protected:
    DocumentFilesTest() : file(folder.write("town.reflet", projectToJson(test::richProject()))) {}
    void SetUp() override { ASSERT_TRUE(document.open(file).has_value()); }

    test::TemporaryFolder folder;
    fs::path file;
    ProjectDocument document;
};

TEST_F(DocumentFilesTest, OpensAndSavesAndKnowsWhatIsUnsaved) {
    EXPECT_EQ(document.file(), fs::canonical(file));
    EXPECT_FALSE(document.isDirty());
    document.setExposure(3.0F);
    EXPECT_TRUE(document.isDirty());
    ASSERT_TRUE(document.save().has_value());
    EXPECT_FALSE(document.isDirty());
    EXPECT_EQ(loadProject(file)->exposure, 3.0F);
    document.undoStack()->undo();
    EXPECT_TRUE(document.isDirty());
}

TEST_F(DocumentFilesTest, SavesInTheBackgroundWhatTheProjectWas) {
    JobRunner jobs;
    std::vector<Result<void>> results;
    const auto collect = [&](const Result<void>& result) { results.push_back(result); };
    document.setExposure(2.0F);
    document.saveInBackground(jobs, collect);
    EXPECT_TRUE(document.isDirty()) << "not before it is on the disk";
    ASSERT_TRUE(jobs.wait(60'000));
    EXPECT_FALSE(document.isDirty());
    EXPECT_EQ(loadProject(file)->exposure, 2.0F);

    document.setExposure(3.0F);
    document.saveInBackground(jobs, collect);
    document.setExposure(4.0F);
    ASSERT_TRUE(jobs.wait(60'000));
    EXPECT_TRUE(document.isDirty()) << "it was changed meanwhile";
    EXPECT_EQ(loadProject(file)->exposure, 3.0F);

    document.close();
    document.saveInBackground(jobs, collect);
    ASSERT_TRUE(jobs.wait(60'000));
    ASSERT_EQ(results.size(), 3U);
    EXPECT_TRUE(results[0].has_value());
    EXPECT_TRUE(results[1].has_value());
    ASSERT_FALSE(results[2].has_value());
    EXPECT_EQ(results[2].error().code, ErrorCode::Usage);
}

TEST_F(DocumentFilesTest, NeverLetsAnOlderSaveOverwriteANewerOne) {
    JobRunner jobs;
    for (int round = 0; round < 20; ++round) {
        document.setExposure(2.0F + float(round));
        document.saveInBackground(jobs, {});
        document.setExposure(100.0F + float(round));
        ASSERT_TRUE(document.save().has_value());
        ASSERT_TRUE(jobs.wait(60'000));
        ASSERT_EQ(loadProject(file)->exposure, 100.0F + float(round));
        ASSERT_FALSE(document.isDirty());
    }
}

TEST_F(DocumentFilesTest, KeepsTheKeysThatItDoesNotKnow) {
    document.addProbe({1, 1, 1});
    ASSERT_TRUE(document.save().has_value());
    const auto json = nlohmann::json::parse(test::bytesOf(file));
    EXPECT_EQ(json["note"], "by hand");
    EXPECT_EQ(json["models"][0]["licence"], "CC0");
    EXPECT_EQ(json["routes"][0]["operator"], "GVB");
}

TEST_F(DocumentFilesTest, KeepsTheTwoVersionsBeforeAsBackups) {
    const std::string first = test::bytesOf(file);
    document.setExposure(2.0F);
    ASSERT_TRUE(document.save().has_value());
    EXPECT_EQ(test::bytesOf(folder / "town.reflet.bak"), first);
    const std::string second = test::bytesOf(file);
    document.setExposure(3.0F);
    ASSERT_TRUE(document.save().has_value());
    EXPECT_EQ(test::bytesOf(folder / "town.reflet.bak"), second);
    EXPECT_EQ(test::bytesOf(folder / "town.reflet.bak2"), first);
    EXPECT_EQ(folder.entryCount(), 4U) << "project, lock, two backups";
}

TEST_F(DocumentFilesTest, AsksForANameBeforeTheFirstSave) {
    document.adopt(test::richProject());
    const auto saved = document.save();
    ASSERT_FALSE(saved.has_value());
    EXPECT_EQ(saved.error().code, ErrorCode::Usage);
    EXPECT_NE(saved.error().remedy.find("Save as"), std::string::npos);
}

TEST_F(DocumentFilesTest, RewritesPathsForTheFolderThatItIsSavedTo) {
    ASSERT_TRUE(document.rename({Kind::Probe, "p1"}, "first").has_value());
    document.remove({{Kind::Model, "roads/roads.city.json"}, {Kind::Vehicle, "bike"}});
    document.replaceProject(test::largeProject(false), QStringLiteral("all"));
    const fs::path there = folder / "plans" / "a";
    fs::create_directories(there);
    ASSERT_TRUE(document.saveAs(there / "copy.reflet").has_value());
    EXPECT_EQ(document.file(), fs::canonical(there / "copy.reflet"));
    EXPECT_FALSE(document.isDirty());

    document.undoStack()->undo();
    EXPECT_EQ(document.project().models.at(0).path, "../../city.city.json");
    document.undoStack()->undo();
    EXPECT_EQ(document.project().models.at(1).path, "../../roads/roads.city.json");
    EXPECT_EQ(document.project().vehicles.at(0).path, "../../bike.glb");
    document.undoStack()->undo();
    ASSERT_TRUE(document.save().has_value());
    const auto json = nlohmann::json::parse(test::bytesOf(there / "copy.reflet"));
    EXPECT_EQ(json["models"][0]["licence"], "CC0") << "unknown keys follow the new path";
    EXPECT_EQ(json["probes"][0]["id"], "p1");
    ASSERT_TRUE(document.saveAs(folder / "back.reflet").has_value());
    EXPECT_EQ(test::bytesOf(folder / "back.reflet"), test::bytesOf(file));
}

TEST_F(DocumentFilesTest, MakesAbsolutePathsOfAnUntitledProjectRelativeWhenItIsSaved) {
    Project project = test::richProject();
    project.models[0].path = (folder.path() / "cities" / "city.city.json").string();
    document.adopt(project);
    EXPECT_TRUE(document.folder().empty());
    ASSERT_TRUE(document.saveAs(folder / "new.reflet").has_value());
    EXPECT_EQ(document.project().models[0].path, "cities/city.city.json");
}

TEST_F(DocumentFilesTest, FindsDerivedDataAgainUnderTheNewName) {
    folder.write("town.cache/ab/abcd.exr", "a baked map");
    ASSERT_TRUE(document.saveAs(folder / "copy.reflet").has_value());
    const fs::path link = cacheFolder(document.dataFile()) / "ab" / "abcd.exr";
    EXPECT_EQ(test::bytesOf(link), "a baked map");
    EXPECT_EQ(fs::hard_link_count(link), 2U);
}

TEST_F(DocumentFilesTest, UsesTheFolderAndTheCacheOfTheOriginOfAnUntitledProject) {
    folder.write("town.cache/abcd.exr", "a baked map");
    document.adopt(test::richProject(), {}, ProjectDocument::Condition::Clean, file);
    EXPECT_TRUE(document.file().empty());
    EXPECT_EQ(document.dataFile(), fs::canonical(file));
    EXPECT_FALSE(document.isDirty());
    fs::create_directory(folder / "mine");
    ASSERT_TRUE(document.saveAs(folder / "mine" / "my.reflet").has_value());
    EXPECT_EQ(document.project().models[0].path, "../city.city.json");
    EXPECT_EQ(test::bytesOf(folder / "mine" / "my.cache" / "abcd.exr"), "a baked map");
    EXPECT_EQ(document.dataFile(), document.file());
}

// ---- bad input ----

TEST_F(DocumentFilesTest, LeavesTheOpenProjectAloneWhenAnotherCannotBeRead) {
    const std::string before = projectToJson(document.project());
    document.setExposure(2.0F);
    const std::string whole = projectToJson(test::richProject());
    const std::vector<std::pair<fs::path, ErrorCode>> cases{
        {folder / "absent.reflet", ErrorCode::Unreadable},
        {folder.write("cut.reflet", whole.substr(0, whole.size() / 2)), ErrorCode::Unreadable},
        {folder.write("empty.reflet", ""), ErrorCode::Unreadable},
        {folder.write("newer.reflet", R"({"schema": "reflet-project", "version": 99})"),
         ErrorCode::Refused},
        {folder.path(), ErrorCode::Unreadable}};
    for (const auto& [path, code] : cases) {
        const auto opened = document.open(path);
        ASSERT_FALSE(opened.has_value()) << path;
        EXPECT_EQ(opened.error().code, code) << path;
        EXPECT_FALSE(opened.error().remedy.empty());
        EXPECT_EQ(document.file(), fs::canonical(file));
        EXPECT_EQ(document.undoStack()->count(), 1);
        EXPECT_FALSE(fs::exists(fs::path(path) += ".lock")) << path;
    }
    document.undoStack()->undo();
    EXPECT_EQ(projectToJson(document.project()), before);
}

TEST_F(DocumentFilesTest, OpensAProjectWhoseModelsAreMissing) {
    EXPECT_FALSE(fs::exists(folder / "city.city.json"));
    EXPECT_EQ(document.project().models.size(), 2U);
}

TEST_F(DocumentFilesTest, StaysUnsavedWhenItsFolderIsNotWritable) {
    constexpr uid_t kNobody = 65'534;
    fs::permissions(folder.path(), fs::perms(0555));
    document.setExposure(2.0F);
    const test::Victim user([this](const auto& ready) {
        // Root may write everywhere: become somebody who may not.
        if (::geteuid() == 0 && ::setuid(kNobody) != 0)
            return;
        const auto saved = document.save();
        const bool right = !saved && saved.error().code == ErrorCode::WriteFailed &&
                           !saved.error().remedy.empty() && document.isDirty();
        if (right)
            ready();
    });
    fs::permissions(folder.path(), fs::perms::owner_all);
    EXPECT_TRUE(user.isReady());
    EXPECT_EQ(loadProject(file)->exposure, 1.0F);
}

TEST_F(DocumentFilesTest, StaysUnsavedWhenItsFolderIsGoneAndLosesNothing) {
    document.setExposure(2.0F);
    const fs::path moved = folder / "elsewhere.reflet";
    fs::create_directory(folder / "inner");
    ASSERT_TRUE(document.saveAs(folder / "inner" / "a.reflet").has_value());
    document.setExposure(4.0F);
    fs::remove_all(folder / "inner");
    const auto saved = document.save();
    ASSERT_FALSE(saved.has_value());
    EXPECT_EQ(saved.error().code, ErrorCode::WriteFailed);
    EXPECT_FALSE(saved.error().remedy.empty());
    EXPECT_TRUE(document.isDirty());
    ASSERT_TRUE(document.saveAs(moved).has_value());
    EXPECT_EQ(loadProject(moved)->exposure, 4.0F);
}

TEST_F(DocumentFilesTest, SaysThatTheDiskIsFullAndStaysUnsaved) {
    if (!fs::exists("/dev/full"))
        GTEST_SKIP() << "There is no /dev/full here.";
    document.setExposure(2.0F);
    const auto saved = document.saveAs("/dev/full");
    ASSERT_FALSE(saved.has_value());
    EXPECT_EQ(saved.error().code, ErrorCode::WriteFailed);
    EXPECT_TRUE(document.isDirty());
    EXPECT_EQ(document.file(), fs::canonical(file));
}

// ---- two windows ----

TEST_F(DocumentFilesTest, RefusesASecondWindowAndOffersToReadOnly) {
    ProjectDocument second;
    const auto opened = second.open(file);
    ASSERT_FALSE(opened.has_value());
    EXPECT_EQ(opened.error().code, ErrorCode::Refused);
    EXPECT_NE(opened.error().remedy.find("reading only"), std::string::npos);
    EXPECT_FALSE(second.open(file, ProjectDocument::Access::TakeOver).has_value())
        << "its owner lives";

    ASSERT_TRUE(second.open(file, ProjectDocument::Access::ReadOnly).has_value());
    EXPECT_TRUE(second.isReadOnly());
    second.setExposure(5.0F);
    const auto saved = second.save();
    ASSERT_FALSE(saved.has_value());
    EXPECT_EQ(saved.error().code, ErrorCode::Refused);
    EXPECT_FALSE(second.saveAs(file).has_value()) << "nor by a detour";
    ASSERT_TRUE(second.saveAs(folder / "mine.reflet").has_value());
    EXPECT_FALSE(second.isReadOnly());
}

TEST_F(DocumentFilesTest, GivesAFileFreeWhenItIsClosedOrAnotherIsOpened) {
    ProjectDocument second;
    document.close();
    EXPECT_TRUE(document.file().empty());
    ASSERT_TRUE(second.open(file).has_value());
    const fs::path other = folder.write("other.reflet", projectToJson(Project{}));
    ASSERT_TRUE(second.open(other).has_value());
    EXPECT_TRUE(document.open(file).has_value());
}

TEST_F(DocumentFilesTest, OpensItsOwnFileAgainToGiveUpChanges) {
    document.setExposure(2.0F);
    ASSERT_TRUE(document.open(file).has_value());
    EXPECT_FALSE(document.isReadOnly());
    EXPECT_FALSE(document.isDirty());
    EXPECT_EQ(document.project().exposure, 1.0F);
}

TEST_F(DocumentFilesTest, TellsALinkToTheFileFromAnotherFile) {
    fs::create_symlink(file, folder / "link.reflet");
    ProjectDocument second;
    EXPECT_FALSE(second.open(folder / "link.reflet").has_value());
}

TEST_F(DocumentFilesTest, TakesAFileOverWhoseWindowCrashed) {
    document.close();
    {
        const test::Victim victim([this](const auto& ready) { saveForEver(file, ready); });
        ASSERT_TRUE(victim.isReady());
        const auto refused = document.open(file);
        ASSERT_FALSE(refused.has_value());
        EXPECT_NE(refused.error().what.find(std::to_string(victim.process())), std::string::npos);
    }
    EXPECT_TRUE(fs::exists(folder / "town.reflet.lock")) << "the dead could not clean up";
    EXPECT_TRUE(document.open(file).has_value());
}

TEST_F(DocumentFilesTest, TakesOverTheLockOfAnotherComputerOnlyWhenTold) {
    document.close();
    folder.write("town.reflet.lock", "4711\nreflet\nfar-away\n0123\n4567\n");
    const auto refused = document.open(file);
    ASSERT_FALSE(refused.has_value());
    EXPECT_NE(refused.error().what.find("far-away"), std::string::npos) << refused.error().what;
    EXPECT_NE(refused.error().remedy.find("take it over"), std::string::npos);
    EXPECT_TRUE(document.open(file, ProjectDocument::Access::TakeOver).has_value());
}

// ---- crashes while saving ----

TEST_F(DocumentFilesTest, ClearsAwayWhatSavesLeftThatWereKilledLongAgo) {
    const fs::path old = folder.write(".reflet-aBcDeF/town.reflet", "{").parent_path();
    const fs::path fresh = folder.write(".reflet-gHiJkL/town.reflet", "{").parent_path();
    const fs::path foreign = folder.write(".reflet-mNoPqR/other.reflet", "{").parent_path();
    for (const fs::path& path : {old, foreign})
        fs::last_write_time(path, fs::last_write_time(path) - std::chrono::minutes(5));
    ASSERT_TRUE(document.open(file).has_value());
    EXPECT_FALSE(fs::exists(old));
    EXPECT_TRUE(fs::exists(fresh)) << "another program may be writing it";
    EXPECT_TRUE(fs::exists(foreign));
}

TEST_F(DocumentFilesTest, HasOneOfTheWholeVersionsAfterEachOfTwoHundredKillsDuringSaves) {
    constexpr int kKills = 200;
    constexpr int kTrialSaves = 4;
    const auto start = std::chrono::steady_clock::now();
    for (int save = 0; save < kTrialSaves; ++save) {
        document.replaceProject(test::largeProject(save % 2 == 0), QStringLiteral("trial"));
        ASSERT_TRUE(document.save().has_value());
    }
    const auto trial = std::chrono::duration_cast<std::chrono::microseconds>(
        std::chrono::steady_clock::now() - start);
    document.close();
    const std::string even = projectToJson(test::largeProject(false));
    const std::string odd = projectToJson(test::largeProject(true));
    folder.write("town.reflet", even);
    std::mt19937 random(9);
    // Within some three saves, however fast the disk is.
    std::uniform_int_distribution<long> moment(0, 3 * trial.count() / kTrialSaves);
    int evens = 0;
    for (int kill = 0; kill < kKills; ++kill) {
        {
            const test::Victim victim([this](const auto& ready) { saveForEver(file, ready); });
            ASSERT_TRUE(victim.isReady()) << "cannot be opened after kill " << kill;
            std::this_thread::sleep_for(std::chrono::microseconds(moment(random)));
        }
        const std::string bytes = test::bytesOf(file);
        ASSERT_TRUE(bytes == even || bytes == odd)
            << "after kill " << kill << ": " << bytes.size() << " bytes";
        evens += bytes == even ? 1 : 0;
        for (const char* ending : {".bak", ".bak2"}) {
            const std::string backup = test::bytesOf(fs::path(file) += ending);
            ASSERT_TRUE(backup.empty() || backup == even || backup == odd) << "after kill " << kill;
        }
    }
    // The kills must have come during saves, or this has shown nothing.
    EXPECT_GT(evens, 0);
    EXPECT_LT(evens, kKills);
    const auto entries = fs::directory_iterator(folder.path());
    EXPECT_TRUE(std::any_of(begin(entries), end(entries), [](const fs::directory_entry& entry) {
        return entry.path().filename().string().starts_with(".reflet-");
    })) << "no save was interrupted";
}

}  // namespace
}  // namespace reflet
