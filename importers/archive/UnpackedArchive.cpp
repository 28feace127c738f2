// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/archive/UnpackedArchive.h"

#include "core/base/FileHash.h"
#include "core/base/Files.h"

#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <system_error>

namespace reflet::importers {

namespace fs = std::filesystem;

namespace {

tl::unexpected<Error> cannotWrite(const fs::path& path, const std::string& reason) {
    return fail(ErrorCode::WriteFailed, "cannot be unpacked here: " + reason, path.string(),
                "Make room, or set XDG_CACHE_HOME to a folder on a larger disk.");
}

/// A folder that goes away unless it is kept.
class Workspace {
public:
    explicit Workspace(fs::path folder) : m_folder(std::move(folder)) {}
    ~Workspace() {
        std::error_code ignored;
        if (!m_folder.empty())
            fs::remove_all(m_folder, ignored);
    }
    Workspace(const Workspace&) = delete;
    Workspace& operator=(const Workspace&) = delete;
    [[nodiscard]] const fs::path& folder() const { return m_folder; }
    /// Under its final name; another program may have been faster.
    [[nodiscard]] Result<void> keepAs(const fs::path& name) {
        std::error_code error;
        fs::rename(m_folder, name, error);
        if (!error) {
            m_folder.clear();
            return {};
        }
        std::error_code ignored;
        if (fs::is_directory(name, ignored))
            return {};
        return cannotWrite(name, error.message());
    }

private:
    fs::path m_folder;
};

bool isComplete(const fs::path& folder, const ZipArchive& archive) {
    for (const ArchiveEntry& entry : archive.entries()) {
        std::error_code error;
        if (fs::file_size(folder / entry.path, error) != entry.bytes || error)
            return false;
    }
    return true;
}

void forgetUnused(const fs::path& base) {
    constexpr auto kUnused = std::chrono::hours(24 * 30);
    std::error_code error;
    std::vector<fs::path> unused;
    for (fs::directory_iterator entry(base, error), end; !error && entry != end;
         entry.increment(error)) {
        std::error_code ignored;
        const auto used = fs::last_write_time(entry->path(), ignored);
        if (!ignored && fs::file_time_type::clock::now() - used > kUnused)
            unused.push_back(entry->path());
    }
    for (const fs::path& folder : unused)
        fs::remove_all(folder, error);
}

Result<void> checkRoom(const ZipArchive& archive, const fs::path& base) {
    std::size_t bytes = 0;
    for (const ArchiveEntry& entry : archive.entries())
        bytes += entry.bytes;
    std::error_code error;
    const auto space = fs::space(base, error);
    if (!error && space.available < bytes)
        return cannotWrite(base, fmt::format("{:.1f} GB are needed and {:.1f} GB are free",
                                             double(bytes) / 1e9, double(space.available) / 1e9));
    return {};
}

Result<void> writeEntry(const ZipArchive& archive, const ArchiveEntry& entry, const fs::path& file,
                        const JobContext& job) {
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    std::ofstream out(file, std::ios::binary);
    if (error || !out)
        return cannotWrite(file, error ? error.message() : std::strerror(errno));
    auto read = archive.read(
        entry,
        [&](std::span<const char> piece) -> Result<void> {
            if (!out.write(piece.data(), std::streamsize(piece.size())))
                return cannotWrite(file, std::strerror(errno));
            return {};
        },
        job);
    if (read && !out.flush())
        return cannotWrite(file, std::strerror(errno));
    return read;
}

/// All of it; what is damaged alone is left out.
Result<void> unpackInto(const fs::path& folder, const ZipArchive& archive, UnpackedArchive& out,
                        const JobContext& job) {
    const auto count = double(archive.entries().size());
    double done = 0.0;
    for (const ArchiveEntry& entry : archive.entries()) {
        job.progress(done++ / count);
        const fs::path file = folder / entry.path;
        const auto written = writeEntry(archive, entry, file, job);
        if (written)
            continue;
        if (written.error().code != ErrorCode::Unreadable)
            return written;
        std::error_code ignored;
        fs::remove(file, ignored);
        out.remarks.push_back({Severity::Error, "archive-damaged", entry.path,
                               written.error().what + "; it was left out", written.error().remedy});
    }
    return {};
}

}  // namespace

Result<fs::path> unpackFolder() {
    const auto variable = [](const char* name) {
        const char* value = std::getenv(name);
        return fs::path(value == nullptr ? "" : value);
    };
    fs::path cache = variable("XDG_CACHE_HOME");
    if (!cache.is_absolute() && variable("HOME").is_absolute())
        cache = variable("HOME") / ".cache";
    if (!cache.is_absolute())
        return fail(ErrorCode::WriteFailed, "there is no folder to unpack archives in",
                    "XDG_CACHE_HOME", "Set XDG_CACHE_HOME or HOME to a folder.");
    return cache / "reflet" / "unpacked";
}

Result<UnpackedArchive> unpackArchive(const fs::path& path, const ArchiveLimits& limits,
                                      const JobContext& job) {
    const auto archive = ZipArchive::open(path, limits);
    if (!archive)
        return tl::unexpected(archive.error());
    const auto base = unpackFolder();
    if (!base)
        return tl::unexpected(base.error());
    ContentHash hash;
    if (auto added = addFileBytes(hash, path); !added)
        return tl::unexpected(added.error());
    UnpackedArchive out{*base / hash.hex(), archive->remarks()};
    std::error_code error;
    if (fs::is_directory(out.folder, error) && isComplete(out.folder, *archive)) {
        fs::last_write_time(out.folder, fs::file_time_type::clock::now(), error);
        return out;
    }
    fs::remove_all(out.folder, error);
    if (auto made = makeFolder(*base); !made)
        return tl::unexpected(made.error());
    forgetUnused(*base);
    if (auto room = checkRoom(*archive, *base); !room)
        return tl::unexpected(room.error());
    std::string name = (*base / (hash.hex() + ".part-XXXXXX")).string();
    if (::mkdtemp(name.data()) == nullptr)
        return cannotWrite(*base, std::strerror(errno));
    Workspace workspace{fs::path(name)};
    if (auto done = unpackInto(workspace.folder(), *archive, out, job.phase("unpacking", 0.0, 1.0));
        !done)
        return tl::unexpected(done.error());
    if (auto kept = workspace.keepAs(out.folder); !kept)
        return tl::unexpected(kept.error());
    return out;
}

}  // namespace reflet::importers
