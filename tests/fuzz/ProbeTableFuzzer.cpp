// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes are refused with a text, or give places whose numbers are numbers and whose rows are
// all accounted for.
#include "core/io/PlaceTable.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace {

void require(bool condition, const char* what) {
    if (condition)
        return;
    std::fprintf(stderr, "broken invariant: %s\n", what);
    std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace reflet;
    const auto table =
        readPlaceTable(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz.csv");
    if (!table) {
        require(!table.error().what.empty(), "errors have a text");
        return 0;
    }
    std::size_t line = 0;
    for (const TablePlace& place : table->places) {
        require(std::isfinite(place.place.x) && std::isfinite(place.place.y), "places are finite");
        require(!place.height || std::isfinite(*place.height), "heights are finite");
        require(place.line > line, "lines ascend");
        line = place.line;
    }
    require(table->remarks.size() <= PlaceTable::kMostTold + 1, "few remarks");
    require(table->skipped == 0 || !table->remarks.empty(), "what is left out is told");
    return 0;
}
