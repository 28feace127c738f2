// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/city/CityModel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

// A ground for a city that has none. Nodes of a regular grid under a building stand at the lowest
// base around, so that every wall meets the ground and none hangs in the air by more than the slope
// of one cell. The open nodes between are interpolated by inverse distances from the nearest of
// those (Franke and Little's weights, as in Renka 1988, which fade to zero at the edge of the
// neighbourhood and so leave no steps). Last, no slope is left steeper than 45 degrees.

namespace reflet {

namespace {

constexpr double kNone64 = std::numeric_limits<double>::infinity();
constexpr double kSmallestCell = 5.0;       // metres
constexpr std::size_t kMostCells = 20'000;  // two triangles each
constexpr double kSteepest = 1.0;
constexpr double kBelowBases = 0.05;  // metres: floors at the base must not flicker through

struct GroundGrid {
    double x0 = 0.0, y0 = 0.0;
    double dx = 1.0, dy = 1.0;
    int columns = 1, rows = 1;  ///< cells; there is one more node than cells each way

    [[nodiscard]] int nodesX() const { return columns + 1; }
    [[nodiscard]] std::size_t nodes() const {
        return std::size_t(columns + 1) * std::size_t(rows + 1);
    }
    [[nodiscard]] std::size_t node(int i, int j) const {
        return std::size_t(j) * std::size_t(nodesX()) + std::size_t(i);
    }
    [[nodiscard]] std::size_t cell(int i, int j) const {
        return std::size_t(j) * std::size_t(columns) + std::size_t(i);
    }
    [[nodiscard]] int column(double x) const {
        return std::clamp(int(std::floor((x - x0) / dx)), 0, columns - 1);
    }
    [[nodiscard]] int row(double y) const {
        return std::clamp(int(std::floor((y - y0) / dy)), 0, rows - 1);
    }
};

GroundGrid gridOver(const Box& bounds, double margin) {
    const double width = std::max(bounds.size().x + 2.0 * margin, 1.0);
    const double height = std::max(bounds.size().y + 2.0 * margin, 1.0);
    double cell = std::max(kSmallestCell, std::sqrt(width * height / double(kMostCells)));
    while (std::ceil(width / cell) * std::ceil(height / cell) > double(kMostCells))
        cell *= 1.02;
    GroundGrid grid;
    grid.columns = int(std::ceil(width / cell));
    grid.rows = int(std::ceil(height / cell));
    grid.x0 = bounds.center().x - 0.5 * width;
    grid.y0 = bounds.center().y - 0.5 * height;
    grid.dx = width / grid.columns;
    grid.dy = height / grid.rows;
    return grid;
}

/// What an object tells about the ground.
struct Base {
    double z = kNone64;  ///< of its lowest vertex; infinite when it tells nothing
    double x = 0.0, y = 0.0;
};

/// How well the foot of such an object tells where the ground is: 2 well, 1 for want of better,
/// 0 hardly (a bridge's deck hangs above the ground, a tunnel lies below it).
int trust(CityObjectType type) {
    switch (type) {
        case CityObjectType::Building:
        case CityObjectType::BuildingPart:
            return 2;
        case CityObjectType::BuildingInstallation:
        case CityObjectType::Bridge:
        case CityObjectType::BridgePart:
        case CityObjectType::Tunnel:
            return 0;
        default:
            return 1;
    }
}

std::vector<Base> collectBases(const CityModel& model) {
    std::vector<Base> bases(model.objects.size());
    int best = 0;
    for (const CityTriangle& triangle : model.triangles) {
        const std::uint32_t object = model.surfaces[triangle.surface].object;
        best = std::max(best, trust(model.objects[object].type));
        for (const std::uint32_t v : triangle.vertex) {
            const glm::vec3& p = model.vertices[v];
            if (double(p.z) < bases[object].z)
                bases[object] = {p.z, p.x, p.y};
        }
    }
    for (std::size_t i = 0; i < bases.size(); ++i)
        if (trust(model.objects[i].type) < best)
            bases[i].z = kNone64;
    return bases;
}

double medianOf(std::vector<double> values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Forgets bases far off the median of their neighbourhood: one object left at height zero in a
/// city on a plateau must not dig a crater.
void dropOutliers(std::vector<Base>& bases, const GroundGrid& grid) {
    const auto known = [](const Base& base) { return base.z < kNone64; };
    const auto count = std::size_t(std::count_if(bases.begin(), bases.end(), known));
    if (count < 5)
        return;
    const int side = std::clamp(int(std::sqrt(double(count) / 8.0)), 1, 64);
    const double binX = grid.columns * grid.dx / side;
    const double binY = grid.rows * grid.dy / side;
    const auto binOf = [&](const Base& base) {
        return std::pair(std::clamp(int((base.x - grid.x0) / binX), 0, side - 1),
                         std::clamp(int((base.y - grid.y0) / binY), 0, side - 1));
    };
    std::vector<std::vector<double>> bins(std::size_t(side) * std::size_t(side));
    std::vector<double> all;
    for (const Base& base : bases) {
        if (!known(base))
            continue;
        const auto [i, j] = binOf(base);
        bins[std::size_t(j * side + i)].push_back(base.z);
        all.push_back(base.z);
    }
    const double overall = medianOf(std::move(all));
    std::vector<double> local(bins.size(), overall);
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
            std::vector<double> near;
            for (int b = std::max(j - 1, 0); b <= std::min(j + 1, side - 1); ++b)
                for (int a = std::max(i - 1, 0); a <= std::min(i + 1, side - 1); ++a) {
                    const auto& bin = bins[std::size_t(b * side + a)];
                    near.insert(near.end(), bin.begin(), bin.end());
                }
            if (near.size() >= 5)
                local[std::size_t(j * side + i)] = medianOf(std::move(near));
        }
    // A hill of half that slope is plausible, a step of 300 m nowhere.
    const double tolerance = std::min(20.0 + 0.75 * std::hypot(binX, binY), 300.0);
    for (Base& base : bases) {
        if (!known(base))
            continue;
        const auto [i, j] = binOf(base);
        if (std::abs(base.z - local[std::size_t(j * side + i)]) > tolerance)
            base.z = kNone64;
    }
}

/// The triangles of the objects that tell of the ground, those of low bases first.
std::vector<std::uint32_t> lowestFirst(const CityModel& model, const std::vector<Base>& bases) {
    std::vector<std::uint32_t> objects(bases.size());
    std::iota(objects.begin(), objects.end(), 0U);
    std::erase_if(objects, [&](std::uint32_t object) { return !(bases[object].z < kNone64); });
    std::sort(objects.begin(), objects.end(),
              [&](std::uint32_t a, std::uint32_t b) { return bases[a].z < bases[b].z; });
    std::vector<std::size_t> next(bases.size() + 1, 0);
    const auto objectOf = [&](const CityTriangle& t) { return model.surfaces[t.surface].object; };
    for (const CityTriangle& triangle : model.triangles)
        ++next[objectOf(triangle)];
    std::size_t count = 0;
    for (const std::uint32_t object : objects)
        count += std::exchange(next[object], count);
    std::vector<std::uint32_t> order(count);
    for (std::uint32_t t = 0; t < model.triangles.size(); ++t) {
        const std::uint32_t object = objectOf(model.triangles[t]);
        if (bases[object].z < kNone64)
            order[next[object]++] = t;
    }
    return order;
}

/// For each cell the lowest base of the objects whose triangles' boxes touch it. Lowest first, so
/// that each cell is written once: `next` leads over the written cells of a row.
std::vector<double> lowestBases(const CityModel& model, const std::vector<Base>& bases,
                                const GroundGrid& grid) {
    const std::vector<std::uint32_t> order = lowestFirst(model, bases);
    const auto baseOf = [&](std::uint32_t t) {
        return bases[model.surfaces[model.triangles[t].surface].object].z;
    };

    const std::size_t stride = std::size_t(grid.columns) + 1;
    std::vector<double> lowest(grid.cell(0, grid.rows), kNone64);
    std::vector<int> next(stride * std::size_t(grid.rows));
    for (std::size_t k = 0; k < next.size(); ++k)
        next[k] = int(k % stride);
    for (const std::uint32_t t : order) {
        Box box;
        for (const std::uint32_t v : model.triangles[t].vertex)
            box.add(glm::dvec3(model.vertices[v]));
        const int last = grid.column(box.max.x);
        for (int j = grid.row(box.min.y); j <= grid.row(box.max.y); ++j) {
            int* const row = &next[std::size_t(j) * stride];
            const auto free = [row](int i) {
                while (row[i] != i)
                    i = row[i] = row[row[i]];
                return i;
            };
            for (int i = free(grid.column(box.min.x)); i <= last; i = free(i)) {
                lowest[grid.cell(i, j)] = baseOf(t);
                row[i] = i + 1;
            }
        }
    }
    return lowest;
}

/// A node stands as low as the lowest cell around it.
std::vector<double> nodeHeights(const std::vector<double>& cells, const GroundGrid& grid) {
    std::vector<double> nodes(grid.nodes(), kNone64);
    for (int j = 0; j < grid.rows; ++j)
        for (int i = 0; i < grid.columns; ++i)
            for (int b = 0; b < 2; ++b)
                for (int a = 0; a < 2; ++a) {
                    double& node = nodes[grid.node(i + a, j + b)];
                    node = std::min(node, cells[grid.cell(i, j)]);
                }
    return nodes;
}

struct Neighbour {
    double distance2 = 0.0;  ///< in cells, squared
    double z = 0.0;
    friend bool operator<(const Neighbour& a, const Neighbour& b) {
        return std::pair(a.distance2, a.z) < std::pair(b.distance2, b.z);
    }
};

/// Inverse distances over all but the farthest, which only sets the radius. Franke and Little:
/// w = ((R - d) / (R d))²; with few neighbours or all equally far, w = 1 / d².
double interpolated(const std::vector<Neighbour>& near, bool fading) {
    double sum = 0.0;
    double weights = 0.0;
    const double radius = std::sqrt(near.back().distance2);
    for (const Neighbour& n : near) {
        const double d = std::sqrt(n.distance2);
        const double w = fading ? (radius - d) / (radius * d) : 1.0 / d;
        sum += w * w * n.z;
        weights += w * w;
    }
    return weights > 0.0 ? sum / weights : interpolated(near, false);
}

/// Looks up the nearest known nodes of a node.
class KnownNodes {
public:
    KnownNodes(const std::vector<double>& known, const GroundGrid& grid)
        : m_known(known), m_grid(grid) {
        for (int j = 0; j <= grid.rows; ++j)
            for (int i = 0; i <= grid.columns; ++i)
                if (known[grid.node(i, j)] < kNone64)
                    m_list.emplace_back(i, j);
    }
    [[nodiscard]] std::size_t count() const { return m_list.size(); }

    /// The `wanted` (at most count()) nearest, nearest first.
    [[nodiscard]] const std::vector<Neighbour>& nearest(int i, int j, std::size_t wanted) {
        constexpr std::size_t kFew = 256;  // quicker one by one than by rings over empty land
        m_near.clear();
        if (m_list.size() <= kFew)
            for (const auto& [a, b] : m_list)
                look(i, j, a, b);
        else
            lookInRings(i, j, wanted);
        std::sort(m_near.begin(), m_near.end());
        m_near.resize(wanted);
        return m_near;
    }

private:
    void look(int i, int j, int a, int b) {
        const double z = m_known[m_grid.node(a, b)];
        const double da = a - i;
        const double db = b - j;
        if (z < kNone64)
            m_near.push_back({da * da + db * db, z});
    }
    /// A square ring of r holds all within r, so the nearest are certain at r √2.
    void lookInRings(int i, int j, std::size_t wanted) {
        int last = std::max(m_grid.columns, m_grid.rows);
        for (int r = 1; r <= last; ++r) {
            const int west = std::max(i - r, 0);
            const int east = std::min(i + r, m_grid.columns);
            for (int a = west; j - r >= 0 && a <= east; ++a)
                look(i, j, a, j - r);
            for (int a = west; j + r <= m_grid.rows && a <= east; ++a)
                look(i, j, a, j + r);
            const int south = std::max(j - r + 1, 0);
            const int north = std::min(j + r - 1, m_grid.rows);
            for (int b = south; i - r >= 0 && b <= north; ++b)
                look(i, j, i - r, b);
            for (int b = south; i + r <= m_grid.columns && b <= north; ++b)
                look(i, j, i + r, b);
            if (m_near.size() >= wanted)
                last = std::min(last, int(std::ceil(r * 1.4143)));
        }
    }

    const std::vector<double>& m_known;
    const GroundGrid& m_grid;
    std::vector<std::pair<int, int>> m_list;
    std::vector<Neighbour> m_near;
};

/// Fills the open nodes from the known ones.
std::vector<double> filled(const std::vector<double>& known, const GroundGrid& grid) {
    constexpr std::size_t kNeighbours = 13;
    KnownNodes nodes(known, grid);
    const std::size_t wanted = std::min(kNeighbours, nodes.count());
    std::vector<double> heights = known;
    if (wanted == 0)
        return heights;
    for (int j = 0; j <= grid.rows; ++j)
        for (int i = 0; i <= grid.columns; ++i)
            if (!(known[grid.node(i, j)] < kNone64))
                heights[grid.node(i, j)] =
                    interpolated(nodes.nearest(i, j, wanted), wanted == kNeighbours);
    return heights;
}

/// Lowers what rises more steeply than kSteepest from its neighbour: the two passes of a chamfer
/// distance transform, which are exact for the distance along steps to the eight neighbours.
void limitSlope(std::vector<double>& heights, const GroundGrid& grid) {
    const double diagonal = std::hypot(grid.dx, grid.dy);
    const auto lower = [&](int i, int j, int a, int b) {
        if (a < 0 || b < 0 || a > grid.columns || b > grid.rows)
            return;
        const double step = a == i ? grid.dy : (b == j ? grid.dx : diagonal);
        double& z = heights[grid.node(i, j)];
        z = std::min(z, heights[grid.node(a, b)] + kSteepest * step);
    };
    for (int j = 0; j <= grid.rows; ++j)
        for (int i = 0; i <= grid.columns; ++i) {
            lower(i, j, i - 1, j);
            for (int a = i - 1; a <= i + 1; ++a)
                lower(i, j, a, j - 1);
        }
    for (int j = grid.rows; j >= 0; --j)
        for (int i = grid.columns; i >= 0; --i) {
            lower(i, j, i + 1, j);
            for (int a = i - 1; a <= i + 1; ++a)
                lower(i, j, a, j + 1);
        }
}

void addTin(CityModel& model, const GroundGrid& grid, const std::vector<double>& heights) {
    const auto firstVertex = std::uint32_t(model.vertices.size());
    const auto surface = std::uint32_t(model.surfaces.size());
    CityObject object;
    object.id = "reflet-generated-ground";
    object.type = CityObjectType::TinRelief;
    object.typeName = toString(object.type);
    CitySurface ground;  // without a material: it looks as ground of that id does
    ground.object = std::uint32_t(model.objects.size());
    model.objects.push_back(std::move(object));
    model.surfaces.push_back(ground);

    for (int j = 0; j <= grid.rows; ++j)
        for (int i = 0; i <= grid.columns; ++i)
            model.vertices.emplace_back(grid.x0 + i * grid.dx, grid.y0 + j * grid.dy,
                                        heights[grid.node(i, j)] - kBelowBases);
    for (int j = 0; j < grid.rows; ++j)
        for (int i = 0; i < grid.columns; ++i) {
            const auto a = firstVertex + std::uint32_t(grid.node(i, j));
            const auto b = firstVertex + std::uint32_t(grid.node(i + 1, j));
            const auto c = firstVertex + std::uint32_t(grid.node(i + 1, j + 1));
            const auto d = firstVertex + std::uint32_t(grid.node(i, j + 1));
            model.triangles.push_back({{a, b, c}, surface});
            model.triangles.push_back({{a, c, d}, surface});
        }
    if (!model.uv.empty())
        model.uv.resize(model.triangles.size());
}

}  // namespace

bool addGeneratedGround(CityModel& model, double margin) {
    const Box bounds = model.bounds();
    if (bounds.empty())
        return false;
    for (const CityTriangle& triangle : model.triangles)
        if (isTerrain(model.objects[model.surfaces[triangle.surface].object].type))
            return false;

    const GroundGrid grid = gridOver(bounds, margin);
    std::vector<Base> bases = collectBases(model);
    dropOutliers(bases, grid);
    std::vector<double> heights = filled(nodeHeights(lowestBases(model, bases, grid), grid), grid);
    limitSlope(heights, grid);
    addTin(model, grid, heights);
    return true;
}

}  // namespace reflet
