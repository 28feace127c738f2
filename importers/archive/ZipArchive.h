// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Diagnostic.h"
#include "core/base/Error.h"
#include "core/base/JobContext.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace reflet::importers {

/// What an archive may become. Cities shrink to a tenth or a thirtieth of their size; files that
/// were made to fill a disk shrink to a thousandth.
struct ArchiveLimits {
    std::size_t maxEntries = 200'000;
    std::size_t maxEntryBytes = std::size_t(4) << 30;
    std::size_t maxBytes = std::size_t(32) << 30;     ///< of all that is in it, unpacked
    std::size_t freelyBytes = std::size_t(64) << 20;  ///< may be unpacked whatever the ratio
    double maxRatio = 200.0;                          ///< unpacked to packed, beyond freelyBytes
};

/// A file in an archive that may be unpacked.
struct ArchiveEntry {
    std::uint64_t index = 0;  ///< in the archive
    std::string path;         ///< relative, with slashes, without ".."; no two are alike
    std::size_t bytes = 0;    ///< unpacked, as the archive says; read() sees to it
};

/// A .zip file (libzip). What it says of itself is taken for true only where it is checked.
class ZipArchive {
public:
    using Sink = std::function<Result<void>(std::span<const char> piece)>;

    /// Unreadable for what is no archive or damaged, ResourceLimit beyond the limits by what the
    /// archive says of itself.
    [[nodiscard]] static Result<ZipArchive> open(const std::filesystem::path& path,
                                                 const ArchiveLimits& limits);
    /// The same of bytes, which outlive the archive; `path` names them.
    [[nodiscard]] static Result<ZipArchive> openBytes(std::string_view bytes,
                                                      const std::filesystem::path& path,
                                                      const ArchiveLimits& limits);

    /// The files in it, by their paths in ascending order.
    [[nodiscard]] const std::vector<ArchiveEntry>& entries() const { return m_entries; }
    /// What is left out: paths that lead out of the archive, links, encrypted files.
    [[nodiscard]] const std::vector<Diagnostic>& remarks() const { return m_remarks; }
    /// Hands over an entry piece by piece. Unreadable where it is damaged or packed in a way that
    /// libzip does not know, ResourceLimit where more comes than the archive says; Cancelled; or
    /// the error of the sink.
    [[nodiscard]] Result<void> read(const ArchiveEntry& entry, const Sink& sink,
                                    const JobContext& job) const;

private:
    struct Handle;
    explicit ZipArchive(std::shared_ptr<Handle> handle) : m_handle(std::move(handle)) {}
    [[nodiscard]] Result<void> list(std::size_t packedBytes, const ArchiveLimits& limits);

    std::shared_ptr<Handle> m_handle;
    std::vector<ArchiveEntry> m_entries;
    std::vector<Diagnostic> m_remarks;
};

/// The path of an entry as it may be unpacked: relative, with slashes. Empty for one that is
/// absolute, leads out of the folder, or is no name of a file.
[[nodiscard]] std::string confinedName(std::string_view name);

}  // namespace reflet::importers
