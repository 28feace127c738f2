// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/cli/Arguments.h"
#include "core/base/Error.h"
#include "core/city/ReadingOptions.h"

namespace reflet::cli {

/// How files are read, as told by the options that `info` and `import` share. Usage for a unit that
/// is none.
[[nodiscard]] Result<void> addReading(ReadingOptions& reading, const FootprintArguments& footprints,
                                      const AxesArguments& axes);

}  // namespace reflet::cli
