// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/common/Identifiers.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace reflet::importers {

std::string bestIdentifier(const std::vector<std::string>& names) {
    constexpr std::array<std::string_view, 14> kKnown{
        "gml:id",   "gmlid", "gml_id",   "id",          "identificatie", "identifier", "guid",
        "globalid", "uuid",  "objectid", "building_id", "fid",           "osm_id",     "name"};
    for (const std::string_view known : kKnown) {
        const auto found = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
            return std::equal(name.begin(), name.end(), known.begin(), known.end(),
                              [](unsigned char a, char b) { return std::tolower(a) == b; });
        });
        if (found != names.end())
            return *found;
    }
    return {};
}

}  // namespace reflet::importers
