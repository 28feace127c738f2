// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/GroundModels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr double kCell = 20.0;  ///< metres, of the table that triangles are looked up in
constexpr std::size_t kMostCells = 4'000'000;

bool isTin(const CityModel& city, const CityTriangle& triangle) {
    const CityObject& object = city.objects[city.surfaces[triangle.surface].object];
    return object.type == CityObjectType::TinRelief && object.id != "reflet-generated-ground";
}

/// Triangles of the terrain by the cells that their boxes touch.
class TerrainTable {
public:
    explicit TerrainTable(const CityModel& city) : m_city(city) {
        for (std::uint32_t t = 0; t < city.triangles.size(); ++t) {
            if (!isTin(city, city.triangles[t]))
                continue;
            m_triangles.push_back(t);
            for (const std::uint32_t v : city.triangles[t].vertex)
                m_bounds.add(glm::dvec3(city.vertices[v]));
        }
        if (m_triangles.empty())
            return;
        const glm::dvec3 size = m_bounds.size();
        m_cell = std::max(kCell, std::sqrt(size.x * size.y / double(kMostCells)));
        m_columns = int(size.x / m_cell) + 1;
        m_rows = int(size.y / m_cell) + 1;
        m_cells.resize(std::size_t(m_columns) * std::size_t(m_rows));
        for (const std::uint32_t t : m_triangles)
            enter(t);
    }

    [[nodiscard]] bool empty() const { return m_triangles.empty(); }

    /// The highest terrain over a place.
    [[nodiscard]] std::optional<double> heightAt(double x, double y) const {
        std::optional<double> highest;
        if (x < m_bounds.min.x || x > m_bounds.max.x || y < m_bounds.min.y || y > m_bounds.max.y)
            return highest;
        for (const std::uint32_t t : m_cells[index(column(x), row(y))])
            if (const auto z = heightOn(t, x, y); z && (!highest || *z > *highest))
                highest = z;
        return highest;
    }

private:
    [[nodiscard]] int column(double x) const {
        return std::clamp(int((x - m_bounds.min.x) / m_cell), 0, m_columns - 1);
    }
    [[nodiscard]] int row(double y) const {
        return std::clamp(int((y - m_bounds.min.y) / m_cell), 0, m_rows - 1);
    }
    [[nodiscard]] std::size_t index(int i, int j) const {
        return std::size_t(j) * std::size_t(m_columns) + std::size_t(i);
    }
    void enter(std::uint32_t t) {
        Box box;
        for (const std::uint32_t v : m_city.triangles[t].vertex)
            box.add(glm::dvec3(m_city.vertices[v]));
        for (int j = row(box.min.y); j <= row(box.max.y); ++j)
            for (int i = column(box.min.x); i <= column(box.max.x); ++i)
                m_cells[index(i, j)].push_back(t);
    }
    [[nodiscard]] std::optional<double> heightOn(std::uint32_t t, double x, double y) const {
        const auto& corner = m_city.triangles[t].vertex;
        const glm::dvec3 a(m_city.vertices[corner[0]]);
        const glm::dvec3 b = glm::dvec3(m_city.vertices[corner[1]]) - a;
        const glm::dvec3 c = glm::dvec3(m_city.vertices[corner[2]]) - a;
        const double whole = b.x * c.y - b.y * c.x;
        if (whole == 0.0)
            return std::nullopt;
        const double r = ((x - a.x) * c.y - (y - a.y) * c.x) / whole;
        const double s = (b.x * (y - a.y) - b.y * (x - a.x)) / whole;
        if (r < 0.0 || s < 0.0 || r + s > 1.0)
            return std::nullopt;
        return a.z + r * b.z + s * c.z;
    }

    const CityModel& m_city;
    std::vector<std::uint32_t> m_triangles;
    std::vector<std::vector<std::uint32_t>> m_cells;
    Box m_bounds;
    double m_cell = kCell;
    int m_columns = 1, m_rows = 1;
};

/// The lowest vertex of each building, parts for themselves.
std::vector<std::optional<glm::vec3>> basesOf(const CityModel& city) {
    std::vector<std::optional<glm::vec3>> bases(city.objects.size());
    for (const CityTriangle& triangle : city.triangles) {
        const std::uint32_t object = city.surfaces[triangle.surface].object;
        const CityObjectType type = city.objects[object].type;
        if (type != CityObjectType::Building && type != CityObjectType::BuildingPart)
            continue;
        for (const std::uint32_t v : triangle.vertex)
            if (!bases[object] || city.vertices[v].z < bases[object]->z)
                bases[object] = city.vertices[v];
    }
    return bases;
}

}  // namespace

std::optional<GroundFit> groundFit(const CityModel& city) {
    const TerrainTable terrain(city);
    if (terrain.empty())
        return std::nullopt;
    std::vector<double> above;
    for (const auto& base : basesOf(city)) {
        if (!base)
            continue;
        if (const auto ground = terrain.heightAt(double(base->x), double(base->y)))
            above.push_back(double(base->z) - *ground);
    }
    constexpr std::size_t kFewest = 3;
    if (above.size() < kFewest)
        return std::nullopt;
    const auto middle = above.begin() + std::ptrdiff_t(above.size() / 2);
    std::nth_element(above.begin(), middle, above.end());
    return GroundFit{*middle, above.size()};
}

std::optional<Diagnostic> groundFitRemark(const GroundFit& fit) {
    constexpr double kTolerable = 2.0;
    constexpr double kLeastGeoid = 20.0;
    constexpr double kMostGeoid = 60.0;
    const double off = std::abs(fit.median);
    if (off < kTolerable)
        return std::nullopt;
    const std::string where = fit.median > 0.0 ? "above" : "below";
    std::string text = fmt::format("The buildings stand {:.1f} m {} the terrain (median of {}).",
                                   off, where, fit.buildings);
    std::string remedy = fmt::format(
        "Move the terrain with `reflet-cli edit PROJECT --place TERRAIN=offset:0,0,{:.2f}`.",
        fit.median);
    if (off >= kLeastGeoid && off <= kMostGeoid)
        text +=
            " That is the distance between heights above the ellipsoid and above the sea: one "
            "of both files has the former.";
    return Diagnostic{Severity::Warning, "ground-fit", "", std::move(text), std::move(remedy)};
}

void judgeGroundFit(LoadedCity& loaded) {
    loaded.groundFit = groundFit(loaded.city);
    if (!loaded.groundFit)
        return;
    if (auto remark = groundFitRemark(*loaded.groundFit))
        loaded.remarks.push_back(std::move(*remark));
}

}  // namespace reflet
