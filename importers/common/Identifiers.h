// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace reflet::importers {

/// Which of the names of attributes is that of an object's identifier: "id", "gml:id", "GUID",
/// "identificatie" and the like, in whatever case; empty: none of them.
[[nodiscard]] std::string bestIdentifier(const std::vector<std::string>& names);

}  // namespace reflet::importers
