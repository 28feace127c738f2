// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/FormatRegistry.h"

#include <string_view>

namespace reflet {

/// A format of designers and surveyors that Reflet does not read.
struct ForeignFormat {
    std::string_view name;      ///< "SketchUp"
    std::string_view suffixes;  ///< ".skp", several with spaces between
    std::string_view magic;     ///< first bytes of its files; empty = known by the suffix alone
    std::string_view remedy;    ///< the way to a format that Reflet reads
};

/// By the first bytes; nullptr when none matches.
[[nodiscard]] const ForeignFormat* foreignFormatByContent(const FileHead& head);
/// By the suffix; nullptr when none matches.
[[nodiscard]] const ForeignFormat* foreignFormatByName(std::string_view lowerCaseName);

}  // namespace reflet
