// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <unordered_map>

namespace reflet {

/// A hash of the attributes of each city object that has some, by its id: the same whatever the
/// order of the attributes. For telling deliveries of one city apart; the model holds no
/// attributes.
using AttributeHashes = std::unordered_map<std::string, std::uint64_t>;

/// Of a CityJSON file, or, `lineByLine`, of a CityJSON text sequence; either may be packed with
/// gzip. What cannot be read has no attributes. Unreadable, ResourceLimit as by the importers.
[[nodiscard]] Result<AttributeHashes> cityJsonAttributes(const std::filesystem::path& path,
                                                         bool lineByLine, std::size_t limit);

}  // namespace reflet
