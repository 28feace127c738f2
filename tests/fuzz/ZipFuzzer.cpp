// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes must give a list of files that stay in their folder and no more bytes than were
// promised, or an error with a text.
#include "importers/archive/ZipArchive.h"
#include "tests/fuzz/CityChecks.h"

#include <cstddef>
#include <cstdint>
#include <set>
#include <string_view>

namespace {

using reflet::fuzz::require;
using namespace reflet::importers;

void checkPath(const std::string& path) {
    require(!path.empty() && path.front() != '/', "a path is relative");
    for (std::size_t begin = 0; begin <= path.size();) {
        const std::size_t end = std::min(path.find('/', begin), path.size());
        const std::string_view part = std::string_view(path).substr(begin, end - begin);
        require(!part.empty() && part != "." && part != "..", "a path stays in its folder");
        begin = end + 1;
    }
}

void checkArchive(const ZipArchive& archive, const ArchiveLimits& limits) {
    std::set<std::string> paths;
    std::size_t total = 0;
    for (const ArchiveEntry& entry : archive.entries()) {
        checkPath(entry.path);
        require(paths.insert(entry.path).second, "no two paths are alike");
        total += entry.bytes;
        std::size_t bytes = 0;
        const auto read = archive.read(entry,
                                       [&](std::span<const char> piece) -> reflet::Result<void> {
                                           bytes += piece.size();
                                           return {};
                                       },
                                       {});
        require(bytes <= entry.bytes, "no more comes than was promised");
        require(!read || bytes == entry.bytes, "no less comes than was promised");
        require(read || !read.error().remedy.empty(), "an error has a remedy");
    }
    require(total <= limits.maxBytes && paths.size() <= limits.maxEntries, "limits hold");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    ArchiveLimits limits;
    limits.maxEntries = 100;
    limits.maxEntryBytes = std::size_t(1) << 20;
    limits.maxBytes = std::size_t(4) << 20;
    limits.freelyBytes = std::size_t(1) << 16;
    const auto archive = ZipArchive::openBytes(bytes, "/nonexistent/fuzz.zip", limits);
    if (archive)
        checkArchive(*archive, limits);
    else
        require(!archive.error().what.empty() && !archive.error().remedy.empty(),
                "an error has a text and a remedy");
    return 0;
}
