// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"

#include <string>
#include <string_view>

namespace reflet {

/// The spelling of a CRS that PROJ understands, for the spellings that are met in city models:
/// authority codes and compounds of them ("EPSG:25832+7837", also as a comma list), OGC URLs and
/// URNs, the urn:adv names of German state data, "epsg.xml#n" of early GML, WKT. Refused, with the
/// spelling that would work, for everything else: PROJ itself would also take names, by fuzzy
/// search, and that is no way to place a city.
[[nodiscard]] Result<std::string> projSpelling(std::string_view text);

}  // namespace reflet
