// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/Files.h"
#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <optional>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace reflet {
namespace {

namespace fs = std::filesystem;
using test::bytesOf;
using test::TemporaryFolder;

constexpr std::size_t kNoLimit = std::size_t{1} << 40;

/// Drops the superuser's rights for a while: permissions bind nobody else.
class OrdinaryUser {
public:
    explicit OrdinaryUser(const fs::path& home) {
        if (::geteuid() != 0)
            return;
        m_dropped = ::chown(home.c_str(), kNobody, kNobody) == 0 && ::seteuid(kNobody) == 0;
    }
    ~OrdinaryUser() {
        if (m_dropped && ::seteuid(0) != 0)
            std::abort();
    }
    OrdinaryUser(const OrdinaryUser&) = delete;
    OrdinaryUser& operator=(const OrdinaryUser&) = delete;

    [[nodiscard]] bool active() const { return ::geteuid() != 0; }

private:
    static constexpr uid_t kNobody = 65534;
    bool m_dropped = false;
};

/// Caps the size of written files, which fails as a full disk does: in the middle of a write.
class SizeLimit {
public:
    explicit SizeLimit(rlim_t bytes) {
        m_oldHandler = std::signal(SIGXFSZ, SIG_IGN);
        ::getrlimit(RLIMIT_FSIZE, &m_old);
        rlimit limit = m_old;
        limit.rlim_cur = bytes;
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~SizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &m_old);
        std::signal(SIGXFSZ, m_oldHandler);
    }
    SizeLimit(const SizeLimit&) = delete;
    SizeLimit& operator=(const SizeLimit&) = delete;

private:
    rlimit m_old{};
    void (*m_oldHandler)(int) = SIG_DFL;
};

// ---- readFile ----

TEST(ReadFile, ReturnsAllBytesZerosIncluded) {
    const TemporaryFolder folder;
    const std::string bytes("a\0b\r\n\xff", 6);
    EXPECT_EQ(readFile(folder.write("data.bin", bytes), 6).value(), bytes);
    EXPECT_EQ(readFile(folder.write("empty", ""), 0).value(), "");
}

TEST(ReadFile, ReadsAFileThatIsLargerThanItsPieces) {
    const TemporaryFolder folder;
    std::string bytes(3'000'001, '\0');
    for (std::size_t i = 0; i < bytes.size(); ++i)
        bytes[i] = static_cast<char>(i * 2654435761U >> 24);
    EXPECT_TRUE(readFile(folder.write("large.bin", bytes), kNoLimit).value() == bytes);
}

TEST(ReadFile, RefusesAFileAboveTheLimitAndTakesOneThatMeetsIt) {
    const TemporaryFolder folder;
    const fs::path path = folder.write("ten", "0123456789");
    EXPECT_EQ(readFile(path, 10).value(), "0123456789");
    const auto refused = readFile(path, 9);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::ResourceLimit);
    EXPECT_EQ(refused.error().message(),
              path.string() +
                  ": is larger than the limit of 9 bytes. Split it, or keep only the "
                  "part that is needed.");
}

TEST(ReadFile, RefusesAHugeFileWithoutReadingIt) {
    const TemporaryFolder folder;
    const fs::path path = folder.write("sparse", "");
    fs::resize_file(path, std::uintmax_t{1} << 40);
    EXPECT_EQ(readFile(path, 1 << 20).error().code, ErrorCode::ResourceLimit);
}

TEST(ReadFile, StopsAtTheLimitWhereTheSystemKnowsNoSize) {
    EXPECT_EQ(readFile("/dev/zero", 1 << 20).error().code, ErrorCode::ResourceLimit);
}

TEST(ReadFile, SaysWhyAFileCannotBeRead) {
    const TemporaryFolder folder;
    const auto absent = readFile(folder / "absent", kNoLimit);
    ASSERT_FALSE(absent);
    EXPECT_EQ(absent.error().code, ErrorCode::Unreadable);
    EXPECT_EQ(absent.error().message(), (folder / "absent").string() +
                                            ": cannot be read: No such file or directory. Check "
                                            "the name and the permissions.");
    const auto directory = readFile(folder.path(), kNoLimit);
    ASSERT_FALSE(directory);
    EXPECT_EQ(directory.error().code, ErrorCode::Unreadable);
    EXPECT_NE(directory.error().what.find("Is a directory"), std::string::npos);
}

TEST(ReadFile, RefusesAFileWithoutPermission) {
    const TemporaryFolder folder;
    const fs::path path = folder.write("closed", "secret");
    fs::permissions(path, fs::perms::none);
    const OrdinaryUser user(folder.path());
    ASSERT_TRUE(user.active());
    EXPECT_EQ(readFile(path, kNoLimit).error().code, ErrorCode::Unreadable);
}

// ---- writeAtomically ----

TEST(WriteAtomically, MakesANewFileAndLeavesNothingElse) {
    const TemporaryFolder folder;
    ASSERT_TRUE(writeFileAtomically(folder / "new.txt", std::string_view("a\0b", 3)));
    EXPECT_EQ(bytesOf(folder / "new.txt"), std::string("a\0b", 3));
    EXPECT_EQ(folder.entryCount(), 1U);
}

TEST(WriteAtomically, ReplacesAFileAndKeepsItsPermissions) {
    const TemporaryFolder folder;
    const fs::path path = folder.write("old.txt", "a long old text");
    fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
    ASSERT_TRUE(writeFileAtomically(path, "new"));
    EXPECT_EQ(bytesOf(path), "new");
    EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write);
    EXPECT_EQ(folder.entryCount(), 1U);
}

TEST(WriteAtomically, GivesANewFileThePermissionsThatTheUserAsksFor) {
    const TemporaryFolder folder;
    const mode_t before = ::umask(027);
    const auto written = writeFileAtomically(folder / "new", "x");
    ::umask(before);
    ASSERT_TRUE(written);
    EXPECT_EQ(static_cast<unsigned>(fs::status(folder / "new").permissions()), 0640U);
}

TEST(WriteAtomically, ShowsTheWriterTheFilesRealNameInTheSameFolder) {
    const TemporaryFolder folder;
    fs::path staged;
    const auto written = writeAtomically(folder / "map.exr", [&](const fs::path& path) {
        staged = path;
        return writeFileAtomically(path, "pixels");
    });
    ASSERT_TRUE(written);
    EXPECT_EQ(staged.filename(), "map.exr");
    EXPECT_EQ(staged.parent_path().parent_path(), folder.path());
    EXPECT_EQ(bytesOf(folder / "map.exr"), "pixels");
    EXPECT_EQ(folder.entryCount(), 1U);
}

TEST(WriteAtomically, ShowsTheOldFileUntilTheNewOneIsWhole) {
    const TemporaryFolder folder;
    const fs::path path = folder.write("city.reflet", "old");
    std::string duringTheWrite;
    ASSERT_TRUE(writeAtomically(path, [&](const fs::path& staged) -> Result<void> {
        std::ofstream(staged) << "half";
        duringTheWrite = bytesOf(path);
        std::ofstream(staged) << "whole";
        return {};
    }));
    EXPECT_EQ(duringTheWrite, "old");
    EXPECT_EQ(bytesOf(path), "whole");
}

TEST(WriteAtomically, KeepsTheOldFileWhenTheWriterFails) {
    const TemporaryFolder folder;
    const fs::path path = folder.write("city.reflet", "old");
    const auto written = writeAtomically(path, [](const fs::path& staged) -> Result<void> {
        std::ofstream(staged) << "half of it";
        std::ofstream(staged.string() + ".aux.xml") << "what some libraries leave beside it";
        return fail(ErrorCode::WriteFailed, "no room for " + staged.string(), staged.string());
    });
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().subject, path.string())
        << "the temporary name means nothing to users";
    EXPECT_EQ(written.error().what, "no room for " + path.string());
    EXPECT_EQ(bytesOf(path), "old");
    EXPECT_EQ(folder.entryCount(), 1U);
}

TEST(WriteAtomically, FailsWhenTheWriterMadeNoFile) {
    const TemporaryFolder folder;
    const auto written =
        writeAtomically(folder / "map.exr", [](const fs::path&) -> Result<void> { return {}; });
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, ErrorCode::WriteFailed);
    EXPECT_EQ(folder.entryCount(), 0U);
}

TEST(WriteAtomically, NamesAFolderThatIsAbsent) {
    const TemporaryFolder folder;
    const fs::path path = folder / "absent" / "city.reflet";
    const auto written = writeFileAtomically(path, "new");
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, ErrorCode::WriteFailed);
    EXPECT_EQ(written.error().subject, path.string());
    EXPECT_NE(written.error().what.find((folder / "absent").string() + " is absent"),
              std::string::npos)
        << written.error().what;
    EXPECT_EQ(folder.entryCount(), 0U);
}

TEST(WriteAtomically, RefusesAFolderAsTarget) {
    const TemporaryFolder folder;
    folder.write("inner/kept.txt", "kept");
    const auto written = writeFileAtomically(folder / "inner", "new");
    ASSERT_FALSE(written);
    EXPECT_NE(written.error().what.find("Is a directory"), std::string::npos);
    EXPECT_EQ(bytesOf(folder / "inner/kept.txt"), "kept");
    EXPECT_EQ(folder.entryCount(), 2U);
}

TEST(WriteAtomically, FailsInAReadOnlyFolderAndKeepsTheOldFile) {
    const TemporaryFolder folder;
    const fs::path path = folder.write("city.reflet", "old");
    fs::permissions(path, fs::perms::all);
    const OrdinaryUser user(folder.path());
    ASSERT_TRUE(user.active());
    fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
    const auto written = writeFileAtomically(path, "new");
    fs::permissions(folder.path(), fs::perms::owner_all);
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, ErrorCode::WriteFailed);
    EXPECT_NE(written.error().what.find("Permission denied"), std::string::npos);
    EXPECT_EQ(bytesOf(path), "old");
    EXPECT_EQ(folder.entryCount(), 1U);
}

TEST(WriteAtomically, RefusesToReplaceAFileThatItsOwnerMadeReadOnly) {
    const TemporaryFolder folder;
    const fs::path path = folder.write("city.reflet", "old");
    fs::permissions(path, static_cast<fs::perms>(0444));
    const OrdinaryUser user(folder.path());
    ASSERT_TRUE(user.active());
    EXPECT_EQ(writeFileAtomically(path, "new").error().code, ErrorCode::WriteFailed);
    EXPECT_EQ(bytesOf(path), "old");
}

TEST(WriteAtomically, KeepsTheOldFileWhenTheDiskTakesNoMoreBytes) {
    const TemporaryFolder folder;
    const fs::path path = folder.write("city.reflet", "old");
    const std::string large(1 << 20, 'x');
    std::optional<Result<void>> written;
    {
        const SizeLimit limit(4096);
        written = writeFileAtomically(path, large);
    }
    ASSERT_FALSE(*written);
    EXPECT_EQ(written->error().code, ErrorCode::WriteFailed);
    EXPECT_EQ(written->error().subject, path.string());
    EXPECT_EQ(bytesOf(path), "old");
    EXPECT_EQ(folder.entryCount(), 1U);
}

TEST(WriteAtomically, ReportsADeviceWithoutSpaceAndNeverReplacesADevice) {
    const auto written = writeFileAtomically("/dev/full", "new");
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, ErrorCode::WriteFailed);
    EXPECT_EQ(written.error().message(),
              "/dev/full: cannot be written: No space left on device. Check the free space and the "
              "permissions of its folder, or choose another place.");
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
    EXPECT_TRUE(writeFileAtomically("/dev/null", "new"));
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

/// Fills a file system of 64 KiB, in a child process that alone sees it. 0 when all went as it
/// should, 77 when the system lets us mount nothing, else the step that failed.
int writeOnAFullDisk(const fs::path& mountPoint) {
    if (::unshare(CLONE_NEWNS) != 0 ||
        ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        ::mount("tmpfs", mountPoint.c_str(), "tmpfs", 0, "size=64k") != 0)
        return 77;
    const fs::path path = mountPoint / "city.reflet";
    if (!writeFileAtomically(path, "old"))
        return 1;
    const auto written = writeFileAtomically(path, std::string(1 << 20, 'x'));
    if (written || written.error().code != ErrorCode::WriteFailed)
        return 2;
    if (written.error().what.find("No space left on device") == std::string::npos)
        return 3;
    if (bytesOf(path) != "old")
        return 4;
    return std::distance(fs::directory_iterator(mountPoint), fs::directory_iterator()) == 1 ? 0 : 5;
}

TEST(WriteAtomically, KeepsTheOldFileOnAFullDisk) {
    const TemporaryFolder folder;
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0)
        ::_exit(writeOnAFullDisk(folder.path()));
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status));
    if (WEXITSTATUS(status) == 77)
        GTEST_SKIP() << "Only the superuser can mount a small file system.";
    EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(WriteAtomically, WritesThroughASymbolicLink) {
    const TemporaryFolder folder;
    const fs::path real = folder.write("real/city.reflet", "old");
    fs::create_symlink("real/city.reflet", folder / "link.reflet");
    ASSERT_TRUE(writeFileAtomically(folder / "link.reflet", "new"));
    EXPECT_TRUE(fs::is_symlink(folder / "link.reflet"));
    EXPECT_EQ(bytesOf(real), "new");
    EXPECT_EQ(folder.entryCount(), 3U);
}

TEST(WriteAtomically, WritesANameWithoutAFolderIntoTheCurrentOne) {
    const TemporaryFolder folder;
    const fs::path before = fs::current_path();
    fs::current_path(folder.path());
    const auto written = writeFileAtomically("plain.txt", "x");
    fs::current_path(before);
    ASSERT_TRUE(written) << written.error().message();
    EXPECT_EQ(bytesOf(folder / "plain.txt"), "x");
}

TEST(WriteAtomically, TwoWritersLeaveOneWholeFile) {
    const TemporaryFolder folder;
    const fs::path path = folder / "map.exr";
    const auto writeMany = [&](char letter) {
        for (int i = 0; i < 50; ++i)
            ASSERT_TRUE(writeFileAtomically(path, std::string(100'000, letter)));
    };
    std::thread other(writeMany, 'a');
    writeMany('b');
    other.join();
    const std::string bytes = bytesOf(path);
    ASSERT_EQ(bytes.size(), 100'000U);
    EXPECT_EQ(bytes, std::string(100'000, bytes.front()));
    EXPECT_EQ(folder.entryCount(), 1U);
}

TEST(MakeFolder, MakesWhatIsMissingAndLeavesWhatIsThere) {
    const test::TemporaryFolder folder;
    folder.write("a/b/kept.txt", "kept");
    ASSERT_TRUE(makeFolder(folder / "a" / "b" / "c").has_value());
    ASSERT_TRUE(makeFolder(folder / "a" / "b").has_value());
    EXPECT_TRUE(std::filesystem::is_directory(folder / "a" / "b" / "c"));
    EXPECT_EQ(test::bytesOf(folder / "a" / "b" / "kept.txt"), "kept");
}

TEST(MakeFolder, NamesThePlaceWhereAFileIsInTheWay) {
    const test::TemporaryFolder folder;
    folder.write("a", "a file");
    const auto made = makeFolder(folder / "a" / "b");
    ASSERT_FALSE(made.has_value());
    EXPECT_EQ(made.error().code, ErrorCode::WriteFailed);
    EXPECT_EQ(made.error().subject, (folder / "a" / "b").string());
    EXPECT_FALSE(made.error().remedy.empty());
}

}  // namespace
}  // namespace reflet
