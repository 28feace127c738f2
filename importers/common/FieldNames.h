// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace reflet::importers {

/// The attributes of a layer, and names that some of them may have, the surest first and written as
/// plainName() writes them.
using Fields = std::vector<std::string>;
using Names = std::span<const std::string_view>;

/// In lower case and without what separates words: building:levels is building_levels is
/// buildingLevels. Letters beyond ASCII stay as they are.
[[nodiscard]] std::string plainName(std::string_view name);

/// The field with the first of the names that is there.
[[nodiscard]] std::optional<std::size_t> firstField(const Fields& fields, Names names);

/// The field that the user names with `option`, nullopt for an empty name. Usage error, with the
/// fields that there are, when there is none.
[[nodiscard]] Result<std::optional<std::size_t>> namedField(const Fields& fields,
                                                            const std::string& name,
                                                            const char* option,
                                                            const std::string& subject);

}  // namespace reflet::importers
