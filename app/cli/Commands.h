// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/cli/Arguments.h"
#include "app/cli/Console.h"

namespace reflet::cli {

/// Each runs one subcommand and returns the exit code.
[[nodiscard]] int run(const SampleArguments& arguments, const Console& console);
[[nodiscard]] int run(const InfoArguments& arguments, const Console& console);
[[nodiscard]] int run(const ImportArguments& arguments, const Console& console);
[[nodiscard]] int run(const EditArguments& arguments, const Console& console);
[[nodiscard]] int run(const ProbesArguments& arguments, const Console& console);
[[nodiscard]] int run(const CoverageArguments& arguments, const Console& console);
[[nodiscard]] int run(const SuggestArguments& arguments, const Console& console);
[[nodiscard]] int run(const UpdateArguments& arguments, const Console& console);
[[nodiscard]] int run(const ValidateArguments& arguments, const Console& console);
[[nodiscard]] int run(const HeightfieldArguments& arguments, const Console& console);
[[nodiscard]] int run(const BakeArguments& arguments, const Console& console);
[[nodiscard]] int run(const ReconstructArguments& arguments, const Console& console);
[[nodiscard]] int run(const CompareArguments& arguments, const Console& console);
[[nodiscard]] int run(const FiguresArguments& arguments, const Console& console);
[[nodiscard]] int run(const RenderArguments& arguments, const Console& console);
/// render --film
[[nodiscard]] int runFilm(const RenderArguments& arguments, const Console& console);
[[nodiscard]] int run(const BenchArguments& arguments, const Console& console);
[[nodiscard]] int run(const DoctorArguments& arguments, const Console& console);

}  // namespace reflet::cli
