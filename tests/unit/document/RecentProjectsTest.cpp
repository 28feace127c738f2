// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/document/RecentProjects.h"
#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <QSettings>

namespace reflet {
namespace {

class RecentProjectsTest : public testing::Test {
protected:
    test::TemporaryFolder folder;
    QSettings settings{QString::fromStdString((folder / "settings.ini").string()),
                       QSettings::IniFormat};
    RecentProjects recent{settings};
};

TEST_F(RecentProjectsTest, PutsTheNewestFirstAndEachOnce) {
    int told = 0;
    QObject::connect(&recent, &RecentProjects::changed, [&] { ++told; });
    const auto a = folder.write("a.reflet", "");
    const auto b = folder.write("b.reflet", "");
    recent.add(a);
    recent.add(b);
    recent.add(folder.path() / "x" / ".." / "a.reflet");
    recent.add({});
    const auto entries = recent.entries();
    ASSERT_EQ(entries.size(), 2U);
    EXPECT_EQ(entries[0].file, a);
    EXPECT_EQ(entries[1].file, b);
    EXPECT_EQ(told, 3);
}

TEST_F(RecentProjectsTest, MarksWhatIsMissingAndKeepsIt) {
    recent.add(folder.write("there.reflet", ""));
    recent.add(folder / "gone.reflet");
    const auto entries = recent.entries();
    ASSERT_EQ(entries.size(), 2U);
    EXPECT_TRUE(entries[0].missing);
    EXPECT_FALSE(entries[1].missing);
}

TEST_F(RecentProjectsTest, KeepsTwelveAcrossStarts) {
    for (int i = 0; i < 20; ++i)
        recent.add(folder / ("p" + std::to_string(i)));
    settings.sync();
    QSettings again{settings.fileName(), QSettings::IniFormat};
    const RecentProjects later(again);
    const auto entries = later.entries();
    ASSERT_EQ(entries.size(), std::size_t(RecentProjects::kMost));
    EXPECT_EQ(entries.front().file, folder / "p19");
    EXPECT_EQ(entries.back().file, folder / "p8");
}

TEST_F(RecentProjectsTest, ForgetsOneOrAll) {
    recent.add(folder / "a");
    recent.add(folder / "b");
    recent.remove(folder / "a");
    EXPECT_EQ(recent.entries().size(), 1U);
    recent.clear();
    EXPECT_TRUE(recent.entries().empty());
}

}  // namespace
}  // namespace reflet
