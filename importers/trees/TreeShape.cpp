// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/trees/TreeShape.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet::trees {

namespace {

using namespace importers;

enum Template : std::uint32_t { kTrunk, kLeaves, kNeedles, kTemplates };

constexpr std::uint32_t kBark = 0;  // material; the crown has the look of foliage
constexpr int kTrunkSides = 6;
constexpr int kCrownSides = 8;
constexpr int kCrownBands = 5;

/// A closed body of revolution about the z axis as a template: rings of points between two poles.
class Lathe {
public:
    Lathe(CityPiece& piece, Template owner, std::uint32_t material)
        : m_piece(piece), m_owner(owner), m_material(material) {}

    /// `profile`: radius and height of the rings from below; the first and the last are poles or
    /// ends that are closed by a polygon.
    void add(const std::vector<glm::dvec2>& profile, int sides) {
        std::vector<std::vector<std::uint32_t>> rings;
        for (const glm::dvec2& p : profile)
            rings.push_back(ring(p, sides));
        if (rings.front().size() > 1)
            face({rings.front().rbegin(), rings.front().rend()});
        for (std::size_t i = 0; i + 1 < rings.size(); ++i)
            band(rings[i], rings[i + 1], sides);
        if (rings.back().size() > 1)
            face(rings.back());
    }

private:
    std::vector<std::uint32_t> ring(const glm::dvec2& p, int sides) {
        std::vector<std::uint32_t> points;
        for (int k = 0; k < (p.x > 0.0 ? sides : 1); ++k) {
            const double a = 2.0 * kPi * k / sides;
            points.push_back(std::uint32_t(m_piece.file.templateVertices.size()));
            m_piece.file.templateVertices.emplace_back(p.x * std::cos(a), p.x * std::sin(a), p.y);
        }
        return points;
    }
    void band(const std::vector<std::uint32_t>& low, const std::vector<std::uint32_t>& high,
              int sides) {
        const auto at = [](const std::vector<std::uint32_t>& ring, int k) {
            return ring[std::size_t(k) % ring.size()];
        };
        for (int k = 0; k < sides; ++k) {
            if (low.size() > 1)
                face({at(low, k), at(low, k + 1), at(high, k)});
            if (high.size() > 1)
                face({at(low, k + 1), at(high, k + 1), at(high, k)});
        }
    }
    void face(const std::vector<std::uint32_t>& ring) {
        SurfaceSoup& soup = m_piece.geometry.templates;
        SurfaceSoup::Surface surface;
        surface.owner = m_owner;
        surface.material = m_material;
        surface.firstRing = std::uint32_t(soup.ringEnds.size());
        surface.ringCount = 1;
        soup.points.insert(soup.points.end(), ring.begin(), ring.end());
        soup.ringEnds.push_back(std::uint32_t(soup.points.size()));
        soup.surfaces.push_back(surface);
    }

    CityPiece& m_piece;
    Template m_owner;
    std::uint32_t m_material;
};

/// The templates: of radius 1 and from 0 to 1 high.
void addTemplates(CityPiece& piece) {
    auto& begin = piece.geometry.templateBegin;
    const auto start = [&] {
        begin.push_back(std::uint32_t(piece.geometry.templates.surfaces.size()));
    };
    start();
    Lathe(piece, kTrunk, kBark).add({{1.0, 0.0}, {0.6, 1.0}}, kTrunkSides);
    start();
    std::vector<glm::dvec2> round;
    for (int i = 0; i <= kCrownBands; ++i) {
        const double a = kPi * i / kCrownBands;
        const bool pole = i == 0 || i == kCrownBands;
        round.emplace_back(pole ? 0.0 : std::sin(a), 0.5 - 0.5 * std::cos(a));
    }
    Lathe(piece, kLeaves, kNone).add(round, kCrownSides);
    start();
    Lathe(piece, kNeedles, kNone)
        .add({{0.0, 0.0}, {1.0, 0.06}, {0.5, 0.55}, {0.0, 1.0}}, kCrownSides);
    start();
}

SourceCity outlinesOf(std::vector<Tree>& trees) {
    SourceCity file;
    file.lodNames = {"2"};
    file.materials = {{"bark", {0.12F, 0.085F, 0.06F}}};
    const GeometryOutline form{GeometryType::MultiSurface, {}, 0, kNone, false};
    file.templates.assign(kTemplates, form);
    for (Tree& tree : trees) {
        ObjectOutline& outline = tree.outline;
        outline.type = CityObjectType::SolitaryVegetation;
        outline.typeName = toString(outline.type);
        outline.aboveGround = true;
        outline.firstGeometry = std::uint32_t(file.geometries.size());
        outline.geometryCount = tree.place ? 2 : 0;
        outline.explained = !tree.place;
        for (std::uint32_t i = 0; i < outline.geometryCount; ++i)
            file.geometries.push_back({GeometryType::Instance,
                                       {},
                                       0,
                                       i == 0         ? kTrunk
                                       : tree.needles ? kNeedles
                                                      : kLeaves});
        file.objects.push_back(std::move(outline));
    }
    return file;
}

/// Scales a template to a body of this radius, between two heights; in the source CRS's units.
std::array<double, 16> stretched(double radius, double from, double to, const glm::dvec3& metres) {
    return {radius / metres.x, 0, 0, 0, 0, radius / metres.y, 0, 0, 0, 0, (to - from) / metres.z,
            from / metres.z,   0, 0, 0, 1};
}

}  // namespace

TreeSize sizeOf(const Tree& tree, double defaultHeight) {
    constexpr double kHeightOfCrown = 1.6, kCrownOfLeaves = 0.6, kCrownOfNeedles = 0.4;
    constexpr double kLeavesBegin = 1.0 / 3.0, kNeedlesBegin = 0.1, kThickness = 1.0 / 40.0;
    constexpr double kThinnest = 0.04, kThickest = 1.0;  // radius
    TreeSize size;
    const double guessed = tree.crown ? kHeightOfCrown * *tree.crown : defaultHeight;
    size.height = tree.height.value_or(guessed);
    size.crown =
        tree.crown.value_or(size.height * (tree.needles ? kCrownOfNeedles : kCrownOfLeaves));
    size.crownBase = size.height * (tree.needles ? kNeedlesBegin : kLeavesBegin);
    size.trunkRadius =
        std::clamp(tree.trunkRadius.value_or(0.5 * kThickness * size.height), kThinnest, kThickest);
    // No trunk is wider than what it carries.
    size.trunkRadius = std::min(size.trunkRadius, 0.25 * size.crown);
    return size;
}

CityPiece pieceOf(CityBuilder& builder, std::vector<Tree> trees, double defaultHeight,
                  const extrusion::MetricScale& metres) {
    CityPiece piece = builder.begin(outlinesOf(trees));
    addTemplates(piece);
    for (std::uint32_t i = 0; i < trees.size(); ++i) {
        const Tree& tree = trees[i];
        for (const auto& [issue, detail] : tree.notes)
            piece.report.note(i, issue, detail);
        const ObjectOutline& outline = piece.file.objects[i];
        if (!tree.place || !piece.chosen[outline.firstGeometry])
            continue;
        const auto anchor = std::uint32_t(piece.file.vertices.size());
        piece.file.vertices.emplace_back(*tree.place, 0.0);
        // What is placed in degrees is measured in metres.
        const bool degrees = builder.crs() && builder.crs()->isGeographic();
        const glm::dvec3 unit(degrees ? glm::dvec2(1.0) : metres.at(*tree.place),
                              metres.heightUnit());
        const TreeSize size = sizeOf(tree, defaultHeight);
        // The trunk ends inside the crown.
        const double trunkTop = size.crownBase + 0.2 * (size.height - size.crownBase);
        piece.geometry.instances.push_back(
            {i, kTrunk, anchor, stretched(size.trunkRadius, 0.0, trunkTop, unit)});
        piece.geometry.instances.push_back(
            {i, tree.needles ? kNeedles : kLeaves, anchor,
             stretched(0.5 * size.crown, size.crownBase, size.height, unit)});
    }
    piece.geometry.usedBySurface.assign(piece.file.vertices.size(), true);
    return piece;
}

}  // namespace reflet::trees
