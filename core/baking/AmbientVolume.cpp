// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/AmbientVolume.h"

#include "core/base/ParallelFor.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>

namespace reflet {

namespace {

constexpr double kFinestSpacing = 2.0;  ///< metres; finer shows nothing that light so soft has
constexpr double kFlatness = 0.75;      ///< vertical spacing to horizontal: light changes upwards
constexpr double kAbove = 12.0;         ///< metres of lattice above the highest roof
constexpr double kBeside = 6.0;         ///< and around the city
constexpr float kUpwards = 1000.0F;

/// Bounds of all finite vertices that triangles use.
Box drawnBounds(const CityModel& city) {
    Box box;
    for (const CityTriangle& t : city.triangles) {
        for (const std::uint32_t v : t.vertex) {
            if (v < city.vertices.size() && std::isfinite(glm::length(city.vertices[v]))) {
                box.add(glm::dvec3(city.vertices[v]));
            }
        }
    }
    return box;
}

/// The finest lattice over the box that keeps to the number of nodes.
AmbientVolume layOut(const Box& box, std::size_t maxNodes) {
    AmbientVolume volume;
    const glm::dvec3 low = box.min - glm::dvec3(kBeside, kBeside, 0.0);
    const glm::dvec3 size = box.max + glm::dvec3(kBeside, kBeside, kAbove) - low;
    const auto nodes = [&](double length, double spacing) {
        return std::max(2.0, std::ceil(length / spacing) + 1.0);
    };
    double spacing = kFinestSpacing;
    const auto limit = double(std::max<std::size_t>(maxNodes, 8));
    const auto count = [&] {
        return nodes(size.x, spacing) * nodes(size.y, spacing) * nodes(size.z, kFlatness * spacing);
    };
    while (count() > limit) {
        spacing *= 1.05;
    }
    volume.columns = int(nodes(size.x, spacing));
    volume.rows = int(nodes(size.y, spacing));
    volume.layers = int(nodes(size.z, kFlatness * spacing));
    volume.spacing = {spacing, spacing, kFlatness * spacing};
    volume.origin = low + glm::dvec3(0.0, 0.0, 0.25 * volume.spacing.z);
    volume.light.assign(
        6 * std::size_t(volume.columns) * std::size_t(volume.rows) * std::size_t(volume.layers),
        glm::vec3(0.0F));
    return volume;
}

/// Whether a node's light says nothing about the air: it is in a solid or in the ground.
bool isBuried(const RadianceScene& scene, const glm::vec3& point) {
    const CityModel& city = scene.city();
    const SceneHit hit = scene.intersect(point, glm::vec3(0.0F, 0.0F, 1.0F));
    if (hit.triangle == kNone || hit.distance > kUpwards) {
        return false;
    }
    const std::uint32_t surface = city.triangles[hit.triangle].surface;
    const bool ground = surface < city.surfaces.size() &&
                        city.surfaces[surface].object < city.objects.size() &&
                        isTerrain(city.objects[city.surfaces[surface].object].type);
    return ground || scene.insideSolid(point);
}

/// Gives buried nodes the mean of their open neighbours, in rings from the open air inwards.
class Dilation {
public:
    explicit Dilation(AmbientVolume& volume, std::vector<unsigned char>& open)
        : m_volume(volume), m_open(open) {}

    void run() {
        const int rings = std::max({m_volume.columns, m_volume.rows, m_volume.layers});
        for (int ring = 0; ring < rings; ++ring) {
            std::vector<std::size_t> reached;
            for (std::size_t node = 0; node < m_open.size(); ++node) {
                if (m_open[node] == 0 && fill(node)) {
                    reached.push_back(node);
                }
            }
            for (const std::size_t node : reached) {
                m_open[node] = 1;
            }
            if (reached.empty()) {
                return;
            }
        }
    }

private:
    bool fill(std::size_t node) {
        const auto columns = std::size_t(m_volume.columns);
        const auto rows = std::size_t(m_volume.rows);
        const int i = int(node % columns);
        const int j = int(node / columns % rows);
        const int k = int(node / columns / rows);
        std::array<glm::vec3, 6> sum{};
        float weight = 0.0F;
        for (int dk = -1; dk <= 1; ++dk) {
            for (int dj = -1; dj <= 1; ++dj) {
                for (int di = -1; di <= 1; ++di) {
                    const int x = i + di;
                    const int y = j + dj;
                    const int z = k + dk;
                    if (x < 0 || y < 0 || z < 0 || x >= m_volume.columns || y >= m_volume.rows ||
                        z >= m_volume.layers) {
                        continue;
                    }
                    const std::size_t other =
                        (std::size_t(z) * rows + std::size_t(y)) * columns + std::size_t(x);
                    if (m_open[other] == 0) {
                        continue;
                    }
                    const float w = 1.0F / float(di * di + dj * dj + dk * dk);
                    weight += w;
                    for (std::size_t side = 0; side < 6; ++side) {
                        sum[side] += w * m_volume.light[6 * other + side];
                    }
                }
            }
        }
        for (std::size_t side = 0; side < 6 && weight > 0.0F; ++side) {
            m_volume.light[6 * node + side] = sum[side] / weight;
        }
        return weight > 0.0F;
    }

    AmbientVolume& m_volume;
    std::vector<unsigned char>& m_open;
};

}  // namespace

glm::vec3 AmbientVolume::at(const glm::dvec3& point, const glm::vec3& normal) const {
    if (light.empty()) {
        return glm::vec3(0.0F);
    }
    const glm::ivec3 count(columns, rows, layers);
    glm::ivec3 cell;
    glm::vec3 fraction;
    for (int axis = 0; axis < 3; ++axis) {
        const double x =
            std::clamp((point[axis] - origin[axis]) / spacing[axis], 0.0, double(count[axis] - 1));
        cell[axis] = std::clamp(int(x), 0, std::max(count[axis] - 2, 0));
        fraction[axis] = float(x - cell[axis]);
    }
    glm::vec3 sum{0.0F};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 step(corner & 1, (corner >> 1) & 1, corner >> 2);
        const glm::ivec3 at = glm::min(cell + step, count - 1);
        const glm::vec3 share = glm::mix(1.0F - fraction, fraction, glm::vec3(step));
        const std::size_t node =
            (std::size_t(at.z) * std::size_t(rows) + std::size_t(at.y)) * std::size_t(columns) +
            std::size_t(at.x);
        for (int axis = 0; axis < 3; ++axis) {
            const std::size_t side = 2 * std::size_t(axis) + (normal[axis] < 0.0F ? 1U : 0U);
            sum +=
                share.x * share.y * share.z * normal[axis] * normal[axis] * light[6 * node + side];
        }
    }
    return sum;
}

Result<AmbientVolume> gatherAmbient(const RadianceScene& scene, std::size_t maxNodes,
                                    const JobContext& job) {
    Box box = drawnBounds(scene.city());
    if (box.empty()) {
        box.add(glm::dvec3(0.0));
    }
    AmbientVolume volume = layOut(box, maxNodes);
    const auto columns = std::size_t(volume.columns);
    const auto rows = std::size_t(volume.rows);
    const std::size_t lines = rows * std::size_t(volume.layers);
    std::vector<unsigned char> open(volume.light.size() / 6, 0);
    std::atomic<std::size_t> done{0};
    parallelFor(0, lines, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t line = first; line < last && !job.cancelled(); ++line) {
            for (std::size_t i = 0; i < columns; ++i) {
                const std::size_t node = line * columns + i;
                const glm::vec3 point(volume.origin +
                                      volume.spacing *
                                          glm::dvec3(i, line % rows, double(line / rows)));
                if (isBuried(scene, point)) {
                    continue;
                }
                open[node] = 1;
                const auto light = scene.ambientCube(point);
                std::copy(light.begin(), light.end(),
                          volume.light.begin() + std::ptrdiff_t(6 * node));
            }
            job.progress(double(++done) / double(lines));
        }
    });
    if (job.cancelled()) {
        return tl::unexpected(JobContext::cancelledError());
    }
    Dilation(volume, open).run();
    return volume;
}

}  // namespace reflet
