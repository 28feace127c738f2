// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/Files.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

namespace reflet {

namespace fs = std::filesystem;

namespace {

std::string systemReason(int error) {
    return std::generic_category().message(error);
}

/// A POSIX file descriptor that closes itself.
class Descriptor {
public:
    explicit Descriptor(int number) : m_number(number) {}
    ~Descriptor() {
        if (m_number >= 0)
            ::close(m_number);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    [[nodiscard]] bool open() const { return m_number >= 0; }
    [[nodiscard]] int number() const { return m_number; }
    /// Closes now and tells whether that went well: network file systems report late.
    [[nodiscard]] bool close() { return ::close(std::exchange(m_number, -1)) == 0; }

private:
    int m_number;
};

// ---- reading ----

tl::unexpected<Error> unreadable(const fs::path& path, std::string reason) {
    return fail(ErrorCode::Unreadable, "cannot be read: " + std::move(reason), path.string(),
                "Check the name and the permissions.");
}

tl::unexpected<Error> tooLarge(const fs::path& path, std::size_t limit) {
    return fail(ErrorCode::ResourceLimit,
                "is larger than the limit of " + std::to_string(limit) + " bytes", path.string(),
                "Split it, or keep only the part that is needed.");
}

/// Reads to the end; the size that the system told may be stale, or zero for a pipe.
Result<std::string> readToEnd(const Descriptor& file, const fs::path& path, std::size_t expected,
                              std::size_t limit) {
    std::string bytes;
    bytes.reserve(expected);
    std::vector<char> piece(std::size_t{1} << 18);
    for (;;) {
        const ssize_t count = ::read(file.number(), piece.data(), piece.size());
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            return unreadable(path, systemReason(errno));
        if (count == 0)
            return bytes;
        if (static_cast<std::size_t>(count) > limit - bytes.size())
            return tooLarge(path, limit);
        bytes.append(piece.data(), static_cast<std::size_t>(count));
    }
}

// ---- writing ----

Error writeFailed(const fs::path& path, std::string reason) {
    return {ErrorCode::WriteFailed,
            "cannot be written: " + std::move(reason),
            path.string(),
            "Check the free space and the permissions of its folder, or choose another place.",
            {}};
}

/// A folder of its own beside the file to be written, removed with what is in it at the end. It
/// lies on the same file system, so that the finished file can be renamed to its place; writers
/// see the file's real name, whose ending some of them need; and what they leave beside it goes.
class StagingFolder {
public:
    explicit StagingFolder(const fs::path& parent) {
        std::string name = (parent / ".reflet-XXXXXX").string();
        if (::mkdtemp(name.data()) != nullptr) {
            m_path = name;
        } else {
            m_error = errno;
        }
    }
    ~StagingFolder() {
        std::error_code ignored;
        if (!m_path.empty())
            fs::remove_all(m_path, ignored);
    }
    StagingFolder(const StagingFolder&) = delete;
    StagingFolder& operator=(const StagingFolder&) = delete;

    [[nodiscard]] const fs::path& path() const { return m_path; }
    /// The errno of a folder that could not be made; 0 otherwise.
    [[nodiscard]] int error() const { return m_error; }

private:
    fs::path m_path;
    int m_error = 0;
};

/// Lets an error speak of the file that the caller named, not of the temporary one.
Error renamedError(Error error, const fs::path& staged, const fs::path& path) {
    for (std::string* text : {&error.what, &error.subject, &error.remedy}) {
        const std::string from = staged.string();
        const std::string to = path.string();
        for (auto at = text->find(from); at != std::string::npos; at = text->find(from, at)) {
            text->replace(at, from.size(), to);
            at += to.size();
        }
    }
    return error;
}

/// Flushes a file or folder to the disk; the errno, or 0. Folders may refuse: not an error.
int flushToDisk(const fs::path& path) {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (!file.open())
        return errno;
    return ::fsync(file.number()) == 0 ? 0 : errno;
}

/// What stands at the target now, links followed.
struct Target {
    fs::path path;  ///< where the bytes go: the end of a symbolic link
    bool exists = false;
    bool device = false;  ///< a device or a pipe: written to, never replaced
    mode_t mode = 0;
};

Result<Target> inspectTarget(const fs::path& path) {
    Target target{path};
    std::error_code error;
    if (fs::is_symlink(path, error)) {
        target.path = fs::weakly_canonical(path, error);
        if (error)
            return tl::unexpected(writeFailed(path, error.message()));
    }
    struct stat status {};
    if (::stat(target.path.c_str(), &status) != 0) {
        if (errno == ENOENT)
            return target;
        return tl::unexpected(writeFailed(path, systemReason(errno)));
    }
    if (S_ISDIR(status.st_mode))
        return tl::unexpected(writeFailed(path, systemReason(EISDIR)));
    // A rename would replace a file that its owner has made read-only.
    if (::faccessat(AT_FDCWD, target.path.c_str(), W_OK, AT_EACCESS) != 0)
        return tl::unexpected(writeFailed(path, systemReason(errno)));
    target.exists = true;
    target.device = !S_ISREG(status.st_mode);
    target.mode = status.st_mode & 07777;
    return target;
}

/// Puts the finished file in its place, after its bytes are safe: a crash leaves old or new.
Result<void> moveIntoPlace(const fs::path& staged, const Target& target, const fs::path& path) {
    if (target.exists && ::chmod(staged.c_str(), target.mode) != 0)
        return tl::unexpected(writeFailed(path, systemReason(errno)));
    if (const int error = flushToDisk(staged))
        return tl::unexpected(writeFailed(path, systemReason(error)));
    if (::rename(staged.c_str(), target.path.c_str()) != 0)
        return tl::unexpected(writeFailed(path, systemReason(errno)));
    return {};
}

Result<void> writeBytes(const fs::path& path, std::string_view bytes) {
    Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    if (!file.open())
        return tl::unexpected(writeFailed(path, systemReason(errno)));
    while (!bytes.empty()) {
        const ssize_t count = ::write(file.number(), bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            return tl::unexpected(writeFailed(path, systemReason(errno)));
        bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    if (!file.close())
        return tl::unexpected(writeFailed(path, systemReason(errno)));
    return {};
}

}  // namespace

Result<std::string> readFile(const fs::path& path, std::size_t limit) {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (!file.open())
        return unreadable(path, systemReason(errno));
    struct stat status {};
    if (::fstat(file.number(), &status) != 0)
        return unreadable(path, systemReason(errno));
    if (S_ISDIR(status.st_mode))
        return unreadable(path, systemReason(EISDIR));
    const auto size = static_cast<std::size_t>(std::max<off_t>(0, status.st_size));
    if (size > limit)
        return tooLarge(path, limit);
    return readToEnd(file, path, size, limit);
}

Result<void> writeAtomically(const fs::path& path,
                             const std::function<Result<void>(const fs::path&)>& write) {
    const auto target = inspectTarget(path);
    if (!target)
        return tl::unexpected(target.error());
    if (target->device)
        return write(target->path);
    const fs::path folder = target->path.has_parent_path() ? target->path.parent_path() : ".";
    const StagingFolder staging(folder);
    if (staging.error() == ENOENT)
        return tl::unexpected(writeFailed(path, "the folder " + folder.string() + " is absent"));
    if (staging.error() != 0)
        return tl::unexpected(writeFailed(path, systemReason(staging.error())));
    const fs::path staged = staging.path() / target->path.filename();
    if (auto written = write(staged); !written)
        return tl::unexpected(renamedError(std::move(written.error()), staged, path));
    if (auto moved = moveIntoPlace(staged, *target, path); !moved)
        return moved;
    // The file is whole and in place by now: a folder that cannot be flushed is no failure.
    static_cast<void>(flushToDisk(folder));
    return {};
}

Result<void> writeFileAtomically(const fs::path& path, std::string_view bytes) {
    return writeAtomically(path,
                           [bytes](const fs::path& staged) { return writeBytes(staged, bytes); });
}

Result<void> makeFolder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) {
        return fail(ErrorCode::WriteFailed, "the folder cannot be made: " + error.message(),
                    folder.string(), "Choose a folder that you may write to.");
    }
    return {};
}

}  // namespace reflet
