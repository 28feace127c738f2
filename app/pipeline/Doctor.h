// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace reflet {

/// One line of the self-check.
struct DoctorItem {
    std::string name;  ///< "PROJ", "OpenGL" ...
    bool ok = false;
    std::string found;   ///< version or what was found
    std::string remedy;  ///< how to get it; empty when ok
};

struct DoctorReport {
    std::string version;  ///< Reflet's own
    std::vector<DoctorItem> items;
    [[nodiscard]] bool healthy() const;
};

/// Looks at what Reflet stands on: libraries, the PROJ database (resolves EPSG:25832), a headless
/// OpenGL 4.5 context, ffmpeg, threads. Never fails: what is missing is an item.
[[nodiscard]] DoctorReport runDoctor();

}  // namespace reflet
