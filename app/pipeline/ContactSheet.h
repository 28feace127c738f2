// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/Compare.h"

#include <string>

namespace reflet {

/// A page of HTML that shows a comparison to people: the figures of all methods, then for each pose
/// the reference and each method beside one another, the differences that are seen below. Pictures
/// are referred to by their file names: the page belongs into their folder. title: of the project.
[[nodiscard]] std::string contactSheet(const CompareReport& report, const std::string& title);

}  // namespace reflet
