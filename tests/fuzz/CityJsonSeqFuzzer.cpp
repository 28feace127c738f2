// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes must give a model that holds together, or an error with a text: never a crash, a hang
// or a memory beyond a multiple of the input.
#include "importers/cityjsonseq/CityJsonSeqImporter.h"
#include "tests/fuzz/CityChecks.h"

#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    reflet::fuzz::check(reflet::importCityJsonSeqText(text, "/nonexistent/fuzz.city.jsonl",
                                                      reflet::fuzz::optionsFor(size), {}));
    return 0;
}
