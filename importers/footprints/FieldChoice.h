// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"
#include "importers/ImportTypes.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace reflet::footprints {

/// Which attributes of a layer say how high its buildings are; indices of fields.
struct FieldChoice {
    std::optional<std::size_t> id;
    std::optional<std::size_t> height;  ///< from the ground to the top
    std::optional<std::size_t> top;     ///< elevation of the top, in the heights' datum
    std::optional<std::size_t> base;    ///< elevation of the ground at the building
    std::optional<std::size_t> storeys;
    std::optional<std::size_t> lifted;  ///< from the ground to the underside
    std::optional<std::size_t> roofShape;
    std::optional<std::size_t> roofHeight;

    /// "height", or "height, else number_of_stories"; empty when none is known.
    std::string described;
};

/// The user's choice (ImportOptions::heightField, baseField), else the names that are in use:
/// OpenStreetMap and Overture, 3DBAG, BD TOPO, OS MasterMap, German and Dutch cadastres, and plain
/// English. Usage error, with the fields that there are, for a field that the layer has not.
[[nodiscard]] Result<FieldChoice> chooseFields(const std::vector<std::string>& fields,
                                               const ImportOptions& options,
                                               const std::string& subject);

}  // namespace reflet::footprints
