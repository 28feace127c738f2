// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/cli/Arguments.h"
#include "app/cli/Console.h"

namespace reflet::cli {

// What `bench NAME` does, a function for each name.
[[nodiscard]] int runBake(const BenchArguments& arguments, const Console& console);
[[nodiscard]] int runTable1(const BenchArguments& arguments, const Console& console);
[[nodiscard]] int runFrames(const BenchArguments& arguments, const Console& console);
[[nodiscard]] int runImport(const BenchArguments& arguments, const Console& console);
[[nodiscard]] int runMemory(const BenchArguments& arguments, const Console& console);
[[nodiscard]] int runReconstruct(const BenchArguments& arguments, const Console& console);
[[nodiscard]] int runSuggest(const BenchArguments& arguments, const Console& console);
[[nodiscard]] int runTrace(const BenchArguments& arguments, const Console& console);
[[nodiscard]] int runHeightfield(const BenchArguments& arguments, const Console& console);

}  // namespace reflet::cli
