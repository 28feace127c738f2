// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes must give a model that holds together, or an error with a text: never a crash, a hang
// or a memory beyond a multiple of the input.
#include "importers/osm/OsmImporter.h"
#include "tests/fuzz/CityChecks.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    reflet::ImportOptions options;
    if (size % 2 == 1)
        options.frame = reflet::ProjectFrame{"EPSG:32632", {}, {565000.0, 5934000.0, 0.0}};
    reflet::fuzz::check(reflet::importOsmBytes(bytes, "/nonexistent/fuzz.osm", options, {}));
    return 0;
}
