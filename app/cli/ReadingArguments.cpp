// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/ReadingArguments.h"

#include "app/cli/Console.h"

namespace reflet::cli {

Result<void> addReading(ReadingOptions& reading, const FootprintArguments& footprints,
                        const AxesArguments& axes) {
    reading.heightField = footprints.heightField;
    reading.baseField = footprints.baseField;
    reading.crownField = footprints.crownField;
    reading.defaultHeight = footprints.defaultHeight;
    reading.upAxis = axes.up;
    reading.axisOrder = axes.order;
    reading.geometricError = axes.geometricError;
    const auto unit = parseUnit(axes.unit);
    if (!unit)
        return tl::unexpected(unit.error());
    reading.unit = *unit;
    return {};
}

}  // namespace reflet::cli
