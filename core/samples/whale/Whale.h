// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/samples/Samples.h"

/// Figure 10 of Meyer and Loscos 2003: the city of the sample "paper", invaded by a flying whale,
/// mirror trees and people.
namespace reflet::whale {

[[nodiscard]] Project makeProject(const std::string& modelFileName);
[[nodiscard]] Sample makeWhaleCity(std::uint64_t seed);

}  // namespace reflet::whale
