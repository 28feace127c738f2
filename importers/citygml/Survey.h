// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/JobContext.h"
#include "importers/citygml/SurfaceReader.h"
#include "importers/common/ByteSource.h"
#include "importers/common/Extent.h"

#include <optional>
#include <set>
#include <string>

namespace reflet::citygml {

/// What must be known of a whole file before its members can be read one at a time.
struct Survey {
    std::string root;                    ///< start tag
    std::optional<std::string> srsName;  ///< of the file's envelope, else of the first geometry
    std::set<std::string> srsNames;      ///< all that are written in it, the first thousand
    Appearances appearances;             ///< those beside the members
    Definitions definitions;             ///< geometries that other members name
    importers::Extent extent;
    std::size_t members = 0;
};

/// Walks through the file once, and once more if members name geometries of others. With
/// `wholeExtent`, all coordinates are read; else those of some members at its start. Errors are
/// those of MemberReader; Unreadable for XML that is no CityGML.
[[nodiscard]] Result<Survey> surveyFile(const importers::ByteSource& source,
                                        const std::string& subject, bool wholeExtent,
                                        const JobContext& job);

/// Parses the text of one member. Unreadable, with the line, when it is no XML.
[[nodiscard]] Result<void> parseMember(std::string& text, std::size_t line,
                                       const std::string& subject, pugi::xml_document& into);

/// Whether a text has `name="` as an attribute, with any prefix.
[[nodiscard]] bool hasAttribute(std::string_view text, std::string_view name);

}  // namespace reflet::citygml
