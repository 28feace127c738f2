// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/archive/ZipArchive.h"

namespace reflet::importers {

/// An archive as a folder of files.
struct UnpackedArchive {
    std::filesystem::path folder;
    std::vector<Diagnostic> remarks;  ///< what of it is not in the folder
};

/// The files of an archive, unpacked below the user's cache folder under a name made of the
/// archive's content: the same archive is unpacked once, textures stay where they were found, and
/// the folder may be deleted at any time, for it is made again when it is asked for. Folders that
/// were not asked for in a month are deleted. Several programs may do this at once. A damaged file
/// is left out with a remark. Errors as of ZipArchive; WriteFailed when there is no place for it.
[[nodiscard]] Result<UnpackedArchive> unpackArchive(const std::filesystem::path& path,
                                                    const ArchiveLimits& limits,
                                                    const JobContext& job);

/// Where archives are unpacked: "reflet/unpacked" in XDG_CACHE_HOME, else in ~/.cache.
[[nodiscard]] Result<std::filesystem::path> unpackFolder();

}  // namespace reflet::importers
