// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/WriteSample.h"

#include "core/base/ContentHash.h"
#include "core/base/Files.h"
#include "core/project/ProjectFile.h"
#include "core/samples/Samples.h"

namespace reflet {

Result<std::filesystem::path> writeSample(const std::string& name, std::uint64_t seed,
                                          const std::filesystem::path& folder) {
    auto sample = makeSample(name, seed);
    if (!sample)
        return tl::unexpected(sample.error());
    if (auto made = makeFolder(folder); !made)
        return tl::unexpected(made.error());
    if (auto written = writeFileAtomically(folder / sample->modelFileName, sample->modelJson);
        !written) {
        return tl::unexpected(written.error());
    }
    sample->project.models.front().hash = ContentHash().add(sample->modelJson).hex();
    const std::filesystem::path path = folder / (name + ".reflet");
    if (auto saved = saveProject(sample->project, path); !saved)
        return tl::unexpected(saved.error());
    return path;
}

}  // namespace reflet
