// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace reflet {

/// Version of the Embree library that is loaded, e.g. "3.13.5".
[[nodiscard]] std::string embreeVersion();

}  // namespace reflet
