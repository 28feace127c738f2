// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/project/Project.h"

#include <cstdint>
#include <cstdlib>
#include <string>

/// Any bytes are refused or read; what is read can be written and read again to the same text.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    const auto project = reflet::projectFromJson(text, "fuzz");
    if (!project)
        return 0;
    const std::string once = reflet::projectToJson(*project);
    const auto again = reflet::projectFromJson(once, "fuzz");
    if (!again || reflet::projectToJson(*again) != once)
        std::abort();
    return 0;
}
