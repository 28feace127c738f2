// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes must give a model that holds together, or an error with a text: never a crash, a hang
// or a memory beyond a multiple of the input.
#include "importers/footprints/FootprintImporter.h"
#include "tests/fuzz/CityChecks.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    reflet::ImportOptions options;
    // The length chooses among ways to import, so that the corpus stays plain files.
    if (size % 3 == 1)
        options.crs = "local";
    if (size % 3 == 2)
        options.frame = reflet::ProjectFrame{"EPSG:28992", {}, {85000.0, 446000.0, 0.0}};
    reflet::fuzz::check(reflet::importFootprintBytes(bytes, "fuzz.geojson", options, {}));
    return 0;
}
