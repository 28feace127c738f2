// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/Files.h"
#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>

namespace reflet {
namespace {

namespace fs = std::filesystem;

class ConfinedPath : public testing::Test {
protected:
    ConfinedPath() {
        m_files.write("city/textures/Wall.png", "wall");
        m_files.write("secret.txt", "secret");
    }

    /// Where `reference` leads as seen from the folder "city": relative to it, or "refused".
    [[nodiscard]] std::string lookUp(std::string_view reference) const {
        const auto path = confinedPath(city(), reference);
        return path ? fs::relative(*path, city()).generic_string() : "refused";
    }
    [[nodiscard]] fs::path city() const { return m_files / "city"; }

    test::TemporaryFolder m_files;
};

TEST_F(ConfinedPath, ResolvesAFileBelowTheFolder) {
    EXPECT_EQ(lookUp("textures/Wall.png"), "textures/Wall.png");
    EXPECT_EQ(lookUp("./textures//Wall.png"), "textures/Wall.png");
    EXPECT_EQ(test::bytesOf(*confinedPath(city(), "textures/Wall.png")), "wall");
}

TEST_F(ConfinedPath, KeepsTheNameOfAFileThatDoesNotExist) {
    EXPECT_EQ(lookUp("textures/absent.png"), "textures/absent.png");
    EXPECT_EQ(lookUp("nowhere/at/all.png"), "nowhere/at/all.png");
}

TEST_F(ConfinedPath, RefusesToClimbOutOfTheFolder) {
    for (const char* reference :
         {"..", "../secret.txt", "textures/../../secret.txt", "..\\secret.txt",
          "textures\\..\\..\\secret.txt", "../city/textures/Wall.png", "./../secret.txt"}) {
        EXPECT_EQ(lookUp(reference), "refused") << reference;
    }
}

TEST_F(ConfinedPath, AllowsToClimbWithinTheFolder) {
    EXPECT_EQ(lookUp("textures/../textures/Wall.png"), "textures/Wall.png");
}

TEST_F(ConfinedPath, RefusesAbsolutePathsEvenOfFilesInTheFolder) {
    const std::string inside = (city() / "textures" / "Wall.png").string();
    for (const std::string& reference :
         {inside, std::string("/etc/passwd"), std::string("\\\\server\\share\\a.png"),
          std::string("//server/share/a.png"), std::string("C:\\a.png"), std::string("c:/a.png")}) {
        EXPECT_EQ(lookUp(reference), "refused") << reference;
    }
}

TEST_F(ConfinedPath, RefusesAddressesOfTheWeb) {
    for (const char* reference : {"http://example.org/a.png", "HTTPS://example.org/a.png",
                                  "file:///etc/passwd", "file:a.png", "data:image/png;base64,AA"}) {
        EXPECT_EQ(lookUp(reference), "refused") << reference;
    }
}

TEST_F(ConfinedPath, AllowsAColonBehindACharacterThatNoSchemeHas) {
    EXPECT_EQ(lookUp("scan 12:30.png"), "scan 12:30.png");
}

TEST_F(ConfinedPath, RefusesEmptyNamesAndNamesWithZeroBytes) {
    EXPECT_EQ(lookUp(""), "refused");
    EXPECT_EQ(lookUp(std::string_view("a.png\0.txt", 10)), "refused");
}

TEST_F(ConfinedPath, RefusesASymbolicLinkThatLeadsOutOfTheFolder) {
    fs::create_symlink(m_files / "secret.txt", city() / "link.txt");
    fs::create_directory_symlink(m_files.path(), city() / "up");
    EXPECT_EQ(lookUp("link.txt"), "refused");
    EXPECT_EQ(lookUp("up/secret.txt"), "refused");
    EXPECT_EQ(lookUp("up/absent.txt"), "refused");
}

TEST_F(ConfinedPath, FollowsASymbolicLinkThatStaysInTheFolder) {
    fs::create_symlink("textures/Wall.png", city() / "wall-link.png");
    const auto path = confinedPath(city(), "wall-link.png");
    ASSERT_TRUE(path);
    EXPECT_EQ(test::bytesOf(*path), "wall");
}

TEST_F(ConfinedPath, RefusesASymbolicLinkThatGoesInCircles) {
    fs::create_symlink("round.png", city() / "round.png");
    EXPECT_EQ(lookUp("round.png"), "refused");
}

TEST_F(ConfinedPath, WorksWhenTheFolderItselfIsReachedThroughALink) {
    fs::create_directory_symlink(city(), m_files / "alias");
    EXPECT_TRUE(confinedPath(m_files / "alias", "textures/Wall.png"));
    EXPECT_FALSE(confinedPath(m_files / "alias", "../secret.txt"));
}

TEST_F(ConfinedPath, AFolderNameMayEndWithASlash) {
    EXPECT_TRUE(confinedPath(city().string() + "/", "textures/Wall.png"));
    EXPECT_FALSE(confinedPath(city().string() + "/", "../secret.txt"));
}

TEST_F(ConfinedPath, AFolderWhoseNameBeginsAlikeIsAnotherFolder) {
    m_files.write("city-two/plan.png", "plan");
    fs::create_symlink(m_files / "city-two/plan.png", city() / "plan.png");
    EXPECT_EQ(lookUp("plan.png"), "refused");
}

TEST_F(ConfinedPath, CountsBackslashesAsSlashes) {
    EXPECT_EQ(lookUp("textures\\Wall.png"), "textures/Wall.png");
}

TEST_F(ConfinedPath, TakesANameThatDiffersInCaseOnly) {
    EXPECT_EQ(lookUp("Textures/wall.PNG"), "textures/Wall.png");
}

TEST_F(ConfinedPath, PrefersTheNameAsWrittenOverOneThatDiffersInCase) {
    m_files.write("city/textures/wall.png", "lower");
    EXPECT_EQ(lookUp("textures/wall.png"), "textures/wall.png");
    EXPECT_EQ(lookUp("textures/Wall.png"), "textures/Wall.png");
    EXPECT_EQ(lookUp("textures/WALL.png"), "textures/Wall.png") << "the first in byte order";
}

TEST_F(ConfinedPath, AnEmptyFolderMeansTheCurrentOne) {
    const auto path = confinedPath("", "some-file.png");
    ASSERT_TRUE(path);
    EXPECT_EQ(fs::absolute(*path).lexically_normal(), fs::current_path() / "some-file.png");
    EXPECT_FALSE(confinedPath("", "../some-file.png"));
}

}  // namespace
}  // namespace reflet
