// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/citygml/MemberReader.h"

#include <fmt/core.h>

#include <algorithm>

namespace reflet::citygml {

namespace {

constexpr std::size_t kNowhere = std::string::npos;
constexpr std::size_t kLargestMember = std::size_t(1) << 30;
constexpr std::size_t kDeepest = 200;

std::string_view qualifiedNameOfTag(std::string_view tag) {
    tag.remove_prefix(tag.starts_with("</") ? 2 : 1);
    return tag.substr(0, tag.find_first_of(" \t\r\n/>"));
}

bool isList(std::string_view name) {
    return name == "featureMembers" || name == "cityObjectMembers" || name == "members";
}

}  // namespace

std::string_view localNameOfTag(std::string_view tag) {
    const std::string_view name = qualifiedNameOfTag(tag);
    const std::size_t colon = name.find(':');
    return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

std::size_t MemberReader::lineOf(std::size_t at) const {
    const auto place = [&](std::size_t i) {
        return m_text.begin() + static_cast<std::ptrdiff_t>(std::min(i, m_text.size()));
    };
    return m_lines + static_cast<std::size_t>(std::count(place(m_counted), place(at), '\n'));
}

tl::unexpected<Error> MemberReader::broken(std::string what, std::size_t at) const {
    return fail(ErrorCode::Unreadable,
                fmt::format("is no valid XML at line {}: {}", lineOf(at), what), m_subject,
                "Get the file again, or check it with an XML validator.");
}

/// Forgets what is understood, now and then in one go.
void MemberReader::drop() {
    constexpr std::size_t kEnough = std::size_t(1) << 20;
    m_lines = lineOf(m_at);
    m_counted = m_at;
    if (m_at < kEnough)
        return;
    m_text.erase(0, m_at);
    m_at = 0;
    m_counted = 0;
}

Result<bool> MemberReader::more() {
    auto any = m_reader.appendTo(m_text);
    if (!any) {
        Error error = any.error();
        error.subject = m_subject;
        return tl::unexpected<Error>(std::move(error));
    }
    return any;
}

Result<bool> MemberReader::need(std::size_t size) {
    while (m_text.size() < size) {
        const auto any = more();
        if (!any || !*any)
            return any;
    }
    return true;
}

Result<std::size_t> MemberReader::behind(std::string_view mark, std::size_t from) {
    std::size_t search = from;
    for (;;) {
        const std::size_t found = m_text.find(mark, search);
        if (found != kNowhere)
            return found + mark.size();
        search = std::max(from, m_text.size() - std::min(m_text.size(), mark.size()));
        const auto any = more();
        if (!any)
            return tl::unexpected<Error>(any.error());
        if (!*any)
            return kNowhere;
    }
}

/// Behind the ">" that ends a tag, or a DOCTYPE: in no quotes and in no brackets of declarations.
Result<std::size_t> MemberReader::markEnd(std::size_t from, bool isTag) {
    int brackets = 0;
    char quote = 0;
    for (std::size_t at = from;; ++at) {
        if (at == m_text.size()) {
            const auto any = need(at + 1);
            if (!any)
                return tl::unexpected<Error>(any.error());
            if (!*any)
                return kNowhere;
        }
        const char c = m_text[at];
        if (quote != 0)
            quote = c == quote ? 0 : quote;
        else if (c == '"' || c == '\'')
            quote = c;
        else if (c == '>' && brackets <= 0)
            return at + 1;
        else if (isTag && c == '<')
            return broken("a tag is not closed", from);
        else if (!isTag)
            brackets += c == '[' ? 1 : (c == ']' ? -1 : 0);
    }
}

Result<bool> MemberReader::tokenEnd(std::size_t begin, std::size_t& end, Token& token) {
    if (const auto any = need(begin + 9); !any)  // the longest mark, or the end of the file
        return any;
    const std::string_view rest = std::string_view(m_text).substr(begin);
    token = Token::Other;
    Result<std::size_t> found = kNowhere;
    if (rest.starts_with("<!--")) {
        found = behind("-->", begin + 4);
    } else if (rest.starts_with("<![CDATA[")) {
        found = behind("]]>", begin + 9);
    } else if (rest.starts_with("<?")) {
        found = behind("?>", begin + 2);
    } else if (rest.starts_with("<!")) {
        found = markEnd(begin + 2, false);
    } else {
        const bool closes = rest.starts_with("</");
        found = markEnd(begin + 1, true);
        if (found && *found != kNowhere)
            token = closes ? Token::End : m_text[*found - 2] == '/' ? Token::Empty : Token::Start;
    }
    if (!found)
        return tl::unexpected<Error>(found.error());
    if (*found == kNowhere)
        return broken("it ends within a tag; the file is cut off", m_text.size());
    end = *found;
    return true;
}

Result<bool> MemberReader::nextToken(Token& token) {
    const auto found = behind("<", m_at);
    if (!found)
        return tl::unexpected<Error>(found.error());
    if (*found == kNowhere)
        return false;
    m_tokenBegin = *found - 1;
    auto whole = tokenEnd(m_tokenBegin, m_tokenEnd, token);
    if (whole)
        m_at = m_tokenEnd;
    return whole;
}

Result<void> MemberReader::readRoot() {
    for (;;) {
        Token token{};
        const auto any = nextToken(token);
        if (!any)
            return tl::unexpected<Error>(any.error());
        if (!*any && m_text.find_first_not_of(" \t\r\n") == kNowhere)
            return fail(ErrorCode::Unreadable, "is empty", m_subject, "Check the name.");
        if (!*any || token == Token::End)
            return broken("it has no root element", m_at);
        if (token == Token::Other) {
            drop();
            continue;
        }
        m_root = tokenText();
        if (token == Token::Start)
            m_open.emplace_back(qualifiedNameOfTag(m_root));
        drop();
        return {};
    }
}

/// Reads on to the end of the element whose start tag has just been met.
Result<void> MemberReader::readMember(Token token, std::string& member) {
    const std::size_t begin = m_tokenBegin;
    m_memberLine = lineOf(begin);
    std::size_t depth = token == Token::Start ? 1 : 0;
    while (depth > 0) {
        const auto any = nextToken(token);
        if (!any)
            return tl::unexpected<Error>(any.error());
        if (!*any)
            return broken("it ends within an element; the file is cut off", m_text.size());
        depth += token == Token::Start ? 1 : 0;
        depth -= token == Token::End ? 1 : 0;
        if (depth > kDeepest || m_at - begin > kLargestMember) {
            return fail(ErrorCode::ResourceLimit,
                        fmt::format("has an object in line {} that is {}", m_memberLine,
                                    depth > kDeepest ? "nested too deeply" : "larger than 1 GiB"),
                        m_subject, "Check the file, or split it.");
        }
    }
    member.assign(m_text, begin, m_at - begin);
    drop();
    return {};
}

Result<bool> MemberReader::next(std::string& member) {
    while (!m_open.empty()) {
        Token token{};
        const auto any = nextToken(token);
        if (!any)
            return tl::unexpected<Error>(any.error());
        if (!*any)
            return broken("it ends before its root does; the file is cut off", m_text.size());
        if (token == Token::End) {
            if (qualifiedNameOfTag(tokenText()) != m_open.back())
                return broken(
                    fmt::format("<{:.60}> is closed by {:.60}", m_open.back(), tokenText()),
                    m_tokenBegin);
            m_open.pop_back();
            drop();
        } else if (token == Token::Start && isList(localNameOfTag(tokenText()))) {
            m_open.emplace_back(qualifiedNameOfTag(tokenText()));
            drop();
        } else if (token != Token::Other) {
            if (auto read = readMember(token, member); !read)
                return tl::unexpected<Error>(read.error());
            return true;
        }
    }
    return false;
}

}  // namespace reflet::citygml
