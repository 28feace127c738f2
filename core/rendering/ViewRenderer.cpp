// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/rendering/ViewRenderer.h"

#include "core/base/ParallelFor.h"
#include "core/rendering/BodyShading.h"
#include "core/rendering/CameraRays.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace reflet {
namespace {

constexpr int kTile = 16;  // pixels
constexpr std::size_t kPixelLimit = std::size_t(1) << 26U;
constexpr int kSamplesLimit = 16;  // per edge

/// Quantile function of the tent on [-1, 1]: places samples as the filter weighs them.
double tentQuantile(double u) {
    return u < 0.5 ? std::sqrt(2.0 * u) - 1.0 : 1.0 - std::sqrt(2.0 - 2.0 * u);
}

/// Offsets from the pixel's centre. A rank-1 (golden ratio) lattice has as many distinct columns
/// and rows as samples, so that edges near the axes get as many grey levels.
std::vector<glm::dvec2> samplePattern(int samplesPerEdge) {
    const int count = samplesPerEdge * samplesPerEdge;
    if (count == 1) {
        return {glm::dvec2(0.0)};
    }
    std::vector<glm::dvec2> pattern;
    for (int i = 0; i < count; ++i) {
        const double u = (i + 0.5) / count;
        const double golden = (i + 0.5) * 0.6180339887498949;
        pattern.emplace_back(tentQuantile(u), tentQuantile(golden - std::floor(golden)));
    }
    return pattern;
}

float luminance(const glm::vec3& c) {
    return glm::dot(c, glm::vec3(0.2126F, 0.7152F, 0.0722F));
}

/// The samples of one row of a tile, traced together.
class RowTracer {
public:
    RowTracer(const RadianceScene& scene, const BodyShading& shading, const CameraRays& rays,
              const std::vector<glm::dvec2>& pattern)
        : m_scene(scene), m_shading(shading), m_rays(rays), m_pattern(pattern) {}

    void trace(RenderedView& view, int row, int first, int last) {
        const glm::vec3 origin(m_rays.position());
        m_directions.clear();
        for (int column = first; column < last; ++column) {
            for (const glm::dvec2& offset : m_pattern) {
                m_directions.emplace_back(
                    m_rays.through(column + 0.5 + offset.x, row + 0.5 + offset.y));
            }
        }
        m_origins.assign(m_directions.size(), origin);
        m_hits.assign(m_directions.size(), SceneHit{});
        m_scene.intersect(m_origins, m_directions, m_hits);
        for (int column = first; column < last; ++column) {
            resolve(view, row, column, std::size_t(column - first) * m_pattern.size());
        }
    }

private:
    void resolve(RenderedView& view, int row, int column, std::size_t at) const {
        glm::vec3 sum(0.0F);
        float weights = 0.0F;
        unsigned char reflector = 0;
        for (std::size_t k = at; k < at + m_pattern.size(); ++k) {
            const BodyShading::Seen seen =
                m_shading.along(m_origins[k], m_directions[k], m_hits[k]);
            const float weight = 1.0F / (1.0F + luminance(seen.radiance));
            sum += seen.radiance * weight;
            weights += weight;
            reflector |= seen.reflector ? 1U : 0U;
        }
        const auto pixel = std::size_t(row) * std::size_t(view.width) + std::size_t(column);
        view.radiance[pixel] = sum / weights;
        view.reflector[pixel] = reflector;
    }

    const RadianceScene& m_scene;
    const BodyShading& m_shading;
    const CameraRays& m_rays;
    const std::vector<glm::dvec2>& m_pattern;
    std::vector<glm::vec3> m_origins;
    std::vector<glm::vec3> m_directions;
    std::vector<SceneHit> m_hits;
};

bool finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

Result<void> check(const Camera& camera, const ViewSettings& settings) {
    if (settings.width < 1 || settings.height < 1) {
        return fail(ErrorCode::Usage, "a view needs a width and a height of at least one pixel");
    }
    if (std::size_t(settings.width) * std::size_t(settings.height) > kPixelLimit) {
        return fail(ErrorCode::ResourceLimit, "a view may have at most 67 million pixels", {},
                    "choose a smaller size");
    }
    if (settings.samplesPerEdge < 1 || settings.samplesPerEdge > kSamplesLimit) {
        return fail(ErrorCode::Usage, "samples along a pixel's edge must be between 1 and 16");
    }
    if (!finite(camera.position) || !finite(camera.target) ||
        glm::distance(camera.position, camera.target) < 1e-9) {
        return fail(ErrorCode::Usage, "a camera must look from one place to another");
    }
    if (!(camera.verticalFov > 0.0 && camera.verticalFov < 3.14)) {
        return fail(ErrorCode::Usage,
                    "a camera's field of view must lie between 0 and 180 degrees");
    }
    return {};
}

}  // namespace

std::vector<glm::vec3> projectVertices(const PlacedBody& body) {
    const std::vector<glm::vec3>& vertices = body.vehicle->bodies[body.body].vertices;
    std::vector<glm::vec3> result;
    result.reserve(vertices.size());
    for (const glm::vec3& v : vertices) {
        result.emplace_back(body.project_from_body * glm::dvec3(v));
    }
    return result;
}

Result<RenderedView> renderView(const RadianceScene& scene, std::span<const PlacedBody> bodies,
                                const Camera& camera, const ViewSettings& settings,
                                const JobContext& job) {
    if (const Result<void> checked = check(camera, settings); !checked) {
        return tl::unexpected<Error>(checked.error());
    }
    RenderedView view;
    view.width = settings.width;
    view.height = settings.height;
    const auto pixels = std::size_t(view.width) * std::size_t(view.height);
    view.radiance.resize(pixels);
    view.reflector.resize(pixels);
    const BodyShading shading(scene, bodies);
    const CameraRays rays(camera, view.width, view.height);
    const std::vector<glm::dvec2> pattern = samplePattern(settings.samplesPerEdge);
    const int tilesAcross = (view.width + kTile - 1) / kTile;
    const int tilesDown = (view.height + kTile - 1) / kTile;
    const auto tiles = std::size_t(tilesAcross) * std::size_t(tilesDown);
    std::atomic<std::size_t> done{0};
    parallelFor(0, tiles, 1, [&](std::size_t first, std::size_t last) {
        RowTracer tracer(scene, shading, rays, pattern);
        for (std::size_t tile = first; tile < last; ++tile) {
            const int x = int(tile) % tilesAcross * kTile;
            const int y = int(tile) / tilesAcross * kTile;
            for (int row = y; row < std::min(y + kTile, view.height); ++row) {
                if (job.cancelled()) {
                    return;
                }
                tracer.trace(view, row, x, std::min(x + kTile, view.width));
            }
            job.progress(double(++done) / double(tiles));
        }
    });
    if (job.cancelled()) {
        return tl::unexpected<Error>(JobContext::cancelledError());
    }
    return view;
}

}  // namespace reflet
