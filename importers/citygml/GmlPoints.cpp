// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/citygml/GmlPoints.h"

#include "importers/citygml/GmlNames.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>
#include <system_error>

namespace reflet::citygml {

namespace {

bool isBlank(char c) {
    return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}

/// One reading of points, through lists and lists of lists.
class PointReader {
public:
    explicit PointReader(std::vector<glm::dvec3>& into) : m_into(into) {}

    void read(pugi::xml_node node, int dimension, int depth) {
        constexpr int kDeepest = 8;
        for (const pugi::xml_node child : node.children()) {
            if (!m_problem.empty() || child.type() != pugi::node_element)
                continue;
            const std::string_view name = localNameOf(child);
            const int own = dimensionOf(child, dimension);
            if (name == "posList" || name == "pos")
                readList(child, name == "pos" ? 0 : own, own);
            else if (name == "coordinates")
                readCoordinates(child);
            else if (name == "coord")
                readCoord(child);
            else if (depth < kDeepest)
                read(child, own, depth + 1);
        }
    }

    std::string m_problem;

private:
    void readList(pugi::xml_node node, int size, int otherwise) {
        m_numbers.clear();
        for (const pugi::xml_node text : node.children()) {  // comments part them
            const bool isText = text.type() == pugi::node_pcdata || text.type() == pugi::node_cdata;
            if (isText && !readNumbers(text.value(), m_numbers)) {
                m_problem = fmt::format("number {} is none", m_numbers.size() + 1);
                return;
            }
        }
        // A position says its dimension by its length.
        if (size == 0)
            size = m_numbers.size() == 2 || m_numbers.size() == 3
                       ? static_cast<int>(m_numbers.size())
                       : otherwise;
        add(static_cast<std::size_t>(size));
    }

    /// "x,y,z x,y,z", as in GML 2.
    void readCoordinates(pugi::xml_node node) {
        std::string text = node.child_value();
        const std::string_view between = attributeOf(node, "cs");
        const std::string_view tuples = attributeOf(node, "ts");
        const char comma = between.empty() ? ',' : between.front();
        const char gap = tuples.empty() ? ' ' : tuples.front();
        m_numbers.clear();
        std::size_t size = 0;
        for (std::size_t begin = 0; begin < text.size();) {
            while (begin < text.size() && (isBlank(text[begin]) || text[begin] == gap))
                ++begin;
            std::size_t end = begin;
            while (end < text.size() && !isBlank(text[end]) && text[end] != gap)
                ++end;
            if (begin == end)
                break;
            std::string tuple = text.substr(begin, end - begin);
            std::replace(tuple.begin(), tuple.end(), comma, ' ');
            const std::size_t before = m_numbers.size();
            if (!readNumbers(tuple.c_str(), m_numbers)) {
                m_problem = fmt::format("number {} is none", m_numbers.size() + 1);
                return;
            }
            size = std::max(size, m_numbers.size() - before);
            begin = end;
        }
        add(size);
    }

    void readCoord(pugi::xml_node node) {
        m_numbers.clear();
        for (const char* axis : {"X", "Y", "Z"}) {
            const pugi::xml_node child = childOf(node, axis);
            if (child && !readNumbers(child.child_value(), m_numbers))
                m_problem = "a coordinate is no number";
        }
        if (m_problem.empty())
            add(m_numbers.size());
    }

    void add(std::size_t size) {
        if (m_numbers.empty())
            return;
        if (size < 2 || size > 3 || m_numbers.size() % size != 0) {
            m_problem = fmt::format("{} numbers make no points of {}", m_numbers.size(), size);
            return;
        }
        for (std::size_t i = 0; i < m_numbers.size(); i += size)
            m_into.emplace_back(m_numbers[i], m_numbers[i + 1], size == 3 ? m_numbers[i + 2] : 0.0);
    }

    std::vector<glm::dvec3>& m_into;
    std::vector<double> m_numbers;
};

}  // namespace

bool readNumbers(const char* text, std::vector<double>& into) {
    const char* end = text + std::strlen(text);
    for (;;) {
        while (text != end && isBlank(*text))
            ++text;
        if (text == end)
            return true;
        double value = 0.0;
        if (*text == '+')
            ++text;
        const auto [at, error] = std::from_chars(text, end, value);
        if (error != std::errc() || (at != end && !isBlank(*at)) || !std::isfinite(value))
            return false;
        into.push_back(value);
        text = at;
    }
}

int dimensionOf(pugi::xml_node node, int otherwise) {
    const std::string_view text = attributeOf(node, "srsDimension");
    return text == "2" ? 2 : text == "3" ? 3 : otherwise;
}

std::string readPoints(pugi::xml_node node, int dimension, std::vector<glm::dvec3>& into) {
    PointReader reader(into);
    reader.read(node, dimensionOf(node, dimension), 0);
    return reader.m_problem;
}

}  // namespace reflet::citygml
