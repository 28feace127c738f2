// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/common/ImportReport.h"
#include "importers/common/SourceCity.h"

#include <cstdint>
#include <string>
#include <vector>

namespace reflet::importers {

/// Who is part of whom, as indices into SourceCity::objects. Free of cycles.
struct ObjectTree {
    std::vector<std::uint32_t> parent;         ///< kNone for roots
    std::vector<std::uint32_t> childrenFirst;  ///< all objects, each after all that are below it
};

/// Resolves the parents that objects name; the first that exists counts. Reports what is missing
/// or runs in a circle.
[[nodiscard]] ObjectTree makeObjectTree(const std::vector<ObjectOutline>& objects,
                                        ImportReport& report);

/// Objects whose own type, or that of an ancestor, is among `types`; all when that is empty.
[[nodiscard]] std::vector<bool> objectsOfTypes(const std::vector<ObjectOutline>& objects,
                                               const ObjectTree& tree,
                                               const std::vector<std::string>& types);

}  // namespace reflet::importers
