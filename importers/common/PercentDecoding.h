// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace reflet::importers {

/// The text of a URI with "%20" and the like decoded (RFC 3986); what is no such escape stays, and
/// so does "+".
[[nodiscard]] std::string percentDecoded(std::string_view uri);

}  // namespace reflet::importers
