// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/project/ProjectFile.h"
#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>

namespace reflet {
namespace {

TEST(ProjectFile, LoadsWhatItSaved) {
    const test::TemporaryFolder folder;
    Project project;
    project.name = "Zürich, été";
    project.probes.push_back({"p1", {2'683'141.123456, 1'247'000.5, 408.25}, std::nullopt, false});
    ASSERT_TRUE(saveProject(project, folder / "a.reflet").has_value());
    const auto loaded = loadProject(folder / "a.reflet");
    ASSERT_TRUE(loaded.has_value()) << loaded.error().message();
    EXPECT_EQ(loaded->name, project.name);
    EXPECT_EQ(loaded->probes, project.probes);
    EXPECT_EQ(folder.entryCount(), 1U);
}

TEST(ProjectFile, NamesAFileThatIsNotThere) {
    const test::TemporaryFolder folder;
    const auto loaded = loadProject(folder / "absent.reflet");
    ASSERT_FALSE(loaded.has_value());
    EXPECT_EQ(loaded.error().code, ErrorCode::Unreadable);
    EXPECT_NE(loaded.error().subject.find("absent.reflet"), std::string::npos);
}

TEST(ProjectFile, LeavesTheOldProjectWhenTheNewOneCannotBeWritten) {
    const test::TemporaryFolder folder;
    const auto saved = saveProject(Project{}, folder / "no-such-folder" / "a.reflet");
    ASSERT_FALSE(saved.has_value());
    EXPECT_EQ(saved.error().code, ErrorCode::WriteFailed);
    EXPECT_EQ(folder.entryCount(), 0U);
}

}  // namespace
}  // namespace reflet
