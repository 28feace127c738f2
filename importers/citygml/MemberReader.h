// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "importers/citygml/Utf8Reader.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace reflet::citygml {

/// Walks through an XML file and hands out the children of its root, one at a time, as text: a city
/// is never in memory as a whole. Lists of members (gml:featureMembers) are looked into. Comments,
/// CDATA and instructions are understood; entities of a DOCTYPE are never expanded.
class MemberReader {
public:
    MemberReader(importers::ByteSource& source, std::string subject)
        : m_reader(source), m_subject(std::move(subject)) {}

    /// Reads up to the start of the root. Unreadable when there is none.
    [[nodiscard]] Result<void> readRoot();
    /// The start tag of the root: "<core:CityModel xmlns:...>".
    [[nodiscard]] const std::string& root() const { return m_root; }

    /// The next member: the text of one element. False after the root's end. Unreadable, with the
    /// line, where the text turns out not to be XML or ends too early; ResourceLimit for members
    /// beyond 1 GiB or nested deeper than 200 levels.
    [[nodiscard]] Result<bool> next(std::string& member);
    /// Line of the file in which the last member begins, counted from 1.
    [[nodiscard]] std::size_t line() const { return m_memberLine; }
    [[nodiscard]] std::size_t position() const { return m_reader.position(); }

private:
    enum class Token { Start, Empty, End, Other };
    /// Finds the next tag (or comment, ...) from m_at on: [m_tokenBegin, m_tokenEnd).
    [[nodiscard]] Result<bool> nextToken(Token& token);
    [[nodiscard]] Result<bool> tokenEnd(std::size_t begin, std::size_t& end, Token& token);
    [[nodiscard]] Result<bool> need(std::size_t size);
    [[nodiscard]] Result<bool> more();
    /// Position behind `mark`, reading on as needed; npos at the end of the file.
    [[nodiscard]] Result<std::size_t> behind(std::string_view mark, std::size_t from);
    [[nodiscard]] Result<std::size_t> markEnd(std::size_t from, bool isTag);
    [[nodiscard]] Result<void> readMember(Token token, std::string& member);
    [[nodiscard]] std::string_view tokenText() const {
        return std::string_view(m_text).substr(m_tokenBegin, m_tokenEnd - m_tokenBegin);
    }
    void drop();
    [[nodiscard]] tl::unexpected<Error> broken(std::string what, std::size_t at) const;
    [[nodiscard]] std::size_t lineOf(std::size_t at) const;

    Utf8Reader m_reader;
    std::string m_subject;
    std::string m_text;         ///< what is read and not done with
    std::size_t m_at = 0;       ///< up to where it is understood
    std::size_t m_counted = 0;  ///< up to where lines are counted
    std::size_t m_lines = 1;    ///< the line there
    std::size_t m_tokenBegin = 0;
    std::size_t m_tokenEnd = 0;
    std::string m_root;
    std::vector<std::string> m_open;  ///< root and lists of members that are open
    std::size_t m_memberLine = 1;
};

/// "CityModel" of "<core:CityModel xmlns=...>" or "</core:CityModel>".
[[nodiscard]] std::string_view localNameOfTag(std::string_view tag);

}  // namespace reflet::citygml
