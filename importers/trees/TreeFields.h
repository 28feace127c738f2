// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/io/VectorFile.h"
#include "importers/ImportTypes.h"
#include "importers/trees/TreeShape.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace reflet::trees {

/// Which attributes of a register tell of its trees; indices of fields.
struct TreeFields {
    std::optional<std::size_t> id, height, crown, species, girth, breadth;
    bool girthInches = false;                ///< breadth is in inches, else centimetres
    std::optional<std::size_t> east, north;  ///< of a table without geometry
    std::optional<std::size_t> both;         ///< "48.85, 2.35" or "POINT (2.35 48.85)"
    bool degrees = false;                    ///< east and north are longitude and latitude

    std::string described;  ///< "height from baumhoehe, crown from kronedurch"
};

/// The user's choice (ImportOptions::heightField, crownField), else the names that the registers of
/// cities use: Berlin, Hamburg, Vienna, Zurich, Paris, Amsterdam, London, New York and others; the
/// manual lists them. Usage error, with the fields that there are, for a field that is not there.
[[nodiscard]] Result<TreeFields> chooseFields(const std::vector<std::string>& fields,
                                              const ImportOptions& options,
                                              const std::string& subject);

/// A length of a register: "12", "12,5 m", "6-10 m" or "e. 15 tot 18 m" (the middle), ">35".
/// Metres; nullopt for nothing, for what is no length, and for 0, which stands for "not measured".
[[nodiscard]] std::optional<double> parseSize(std::string_view text);

/// Whether a botanical or common name is that of a conifer with needles or scales.
[[nodiscard]] bool hasNeedles(std::string_view species);

/// "52,5" or "52.5"; nullopt for anything else.
[[nodiscard]] std::optional<double> parseCoordinate(std::string_view text);
/// "48.85, 2.35" (latitude first) or "POINT (2.35 48.85)"; east, north.
[[nodiscard]] std::optional<glm::dvec2> parsePlace(std::string_view text);

/// How many trees told their size.
struct TreeTally {
    std::size_t trees = 0;
    std::size_t heightAssumed = 0, crownAssumed = 0;
    std::size_t unreadable = 0;
    std::string example;  ///< of what could not be read
};

/// Reads the trees of one layer.
class TreeReader {
public:
    explicit TreeReader(TreeFields fields);

    /// The fields to be read, in the order in which values are expected.
    [[nodiscard]] const std::vector<std::size_t>& fields() const { return m_columns; }
    [[nodiscard]] const TreeFields& choice() const { return m_fields; }
    [[nodiscard]] std::string_view id(const PointFeature& feature) const;
    /// Where it stands: the geometry's first point, else by its columns.
    [[nodiscard]] std::optional<glm::dvec2> place(const PointFeature& feature) const;
    /// Sets the sizes and the kind.
    void read(const PointFeature& feature, Tree& tree);
    [[nodiscard]] const TreeTally& tally() const { return m_tally; }

private:
    [[nodiscard]] std::string_view value(const PointFeature& feature,
                                         std::optional<std::size_t> field) const;
    [[nodiscard]] std::optional<double> size(const PointFeature& feature,
                                             std::optional<std::size_t> field, double most);

    TreeFields m_fields;
    std::vector<std::size_t> m_columns;
    TreeTally m_tally;
};

}  // namespace reflet::trees
