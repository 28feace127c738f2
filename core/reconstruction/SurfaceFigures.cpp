// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/reconstruction/SurfaceFigures.h"

#include "core/base/ParallelFor.h"
#include "core/environment/CubeDirection.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <mutex>

namespace reflet {

namespace {

constexpr double kNear = 0.5;  ///< metres
constexpr double kNearTexels = 2.0;
constexpr double kSamePlane = 0.1;  ///< metres
const double kSameNormal = std::cos(5.0 * kPi / 180.0);
constexpr double kLift = 0.02;  ///< metres by which rays end before a surface

/// What a ray met; no triangle and an infinite distance for sky.
struct Met {
    bool sky = true;
    glm::dvec3 point{0.0};
    std::uint32_t triangle = kNone;  ///< of the city; none in the heightfield
    bool top = false;                ///< a flat top of the heightfield
};

/// The maps, the scene and what is asked of one texel after the other.
class Examiner {
public:
    Examiner(const RadianceScene& scene, const HeightfieldTracer& field, const RemSet& rems,
             const TexelSources& sources, const glm::dvec3& position)
        : m_scene(scene),
          m_field(field),
          m_rems(rems),
          m_sources(sources),
          m_position(position),
          m_texelAngle(0.5 * kPi / double(sources.resolution())),
          m_cell(std::sqrt(2.0) * field.grid().cellSize) {
        std::vector<bool> used(rems.size(), false);
        for (const auto& pair : sources.texels()) {
            for (const TexelSource& source : pair) {
                if (source.rem >= 0 && source.weight > 0.0F)
                    used[std::size_t(source.rem)] = true;
            }
        }
        for (std::size_t i = 0; i < used.size(); ++i) {
            if (used[i])
                m_used.push_back(i);
        }
    }

    void examine(int face, int column, int row, SurfaceTally::Counts& counts) const {
        const glm::dvec3 direction =
            glm::normalize(texelDirection(m_sources.resolution(), face, column, row));
        const TexelSource& source = m_sources.at(face, column, row)[0];
        const Met truth = inCity(m_position, direction);
        const Met fieldTruth = inField(m_position, direction);
        const bool seen = seenByAny(truth, direction, source.rem);
        ++counts.texels;
        counts.seen += seen ? 1 : 0;
        counts.modelWrong += sameModel(truth, fieldTruth) ? 0 : 1;
        bool right = false;
        bool rightInField = false;
        if (source.rem >= 0 && source.lookup != glm::vec3(0.0F)) {
            const glm::dvec3 lookup = glm::normalize(glm::dvec3(source.lookup));
            const glm::dvec3& center = m_rems[std::size_t(source.rem)].center;
            const Met shown = inCity(center, lookup);
            right = sameInCity(truth, shown);
            addError(truth, shown, direction, lookup, counts.errors);
            const Met fieldShown = inField(center, lookup);
            rightInField = sameInField(fieldTruth, fieldShown);
            addError(fieldTruth, fieldShown, direction, lookup, counts.algorithmErrors);
        }
        counts.wrong += right ? 0 : 1;
        counts.wrongSeen += seen && !right ? 1 : 0;
        counts.algorithmWrong += rightInField ? 0 : 1;
    }

private:
    [[nodiscard]] Met inCity(const glm::dvec3& origin, const glm::dvec3& direction) const {
        const SceneHit hit = m_scene.intersect(glm::vec3(origin), glm::vec3(direction));
        if (std::isinf(hit.distance))
            return {};
        return {false, origin + double(hit.distance) * direction, hit.triangle, false};
    }

    [[nodiscard]] Met inField(const glm::dvec3& origin, const glm::dvec3& direction) const {
        const HeightfieldHit hit = m_field.trace({origin, direction});
        if (!hit.hit)
            return {};
        const glm::dvec3 point = origin + hit.t * direction;
        const double height = double(m_field.layer()[m_field.grid().index(hit.i, hit.j)]);
        return {false, point, kNone, std::abs(point.z - height) < 1e-6 * (1.0 + std::abs(height))};
    }

    /// Nothing of the city between the point (or the sky) and the centre of a REM in use.
    [[nodiscard]] bool seenByAny(const Met& truth, const glm::dvec3& direction,
                                 std::int32_t first) const {
        if (first >= 0 && seenBy(std::size_t(first), truth, direction))
            return true;
        return std::any_of(m_used.begin(), m_used.end(), [&](std::size_t rem) {
            return std::int32_t(rem) != first && seenBy(rem, truth, direction);
        });
    }
    [[nodiscard]] bool seenBy(std::size_t rem, const Met& truth, const glm::dvec3& skyward) const {
        const glm::dvec3& center = m_rems[rem].center;
        if (truth.sky)
            return !m_scene.occluded(glm::vec3(center), glm::vec3(skyward), kInfinity);
        const glm::dvec3 way = truth.point - center;
        const double distance = glm::length(way);
        if (!(distance > kLift))
            return true;
        const double lifted = distance - std::max(kLift, 1e-4 * distance);
        return !m_scene.occluded(glm::vec3(center), glm::vec3(way / distance), float(lifted));
    }

    [[nodiscard]] bool near(const glm::dvec3& a, const glm::dvec3& truth, double least) const {
        const double texels = kNearTexels * m_texelAngle * glm::distance(truth, m_position);
        return glm::distance(a, truth) <= std::max({kNear, least, texels});
    }

    [[nodiscard]] glm::dvec3 normalOf(std::uint32_t triangle) const {
        const CityModel& city = m_scene.city();
        const auto& corners = city.triangles[triangle].vertex;
        const glm::dvec3 a(city.vertices[corners[0]]);
        const glm::dvec3 n = glm::cross(glm::dvec3(city.vertices[corners[1]]) - a,
                                        glm::dvec3(city.vertices[corners[2]]) - a);
        const double length = glm::length(n);
        return length > 0.0 ? n / length : glm::dvec3(0.0);
    }

    [[nodiscard]] bool sameInCity(const Met& truth, const Met& shown) const {
        if (truth.sky || shown.sky)
            return truth.sky == shown.sky;
        if (near(shown.point, truth.point, 0.0))
            return true;
        if (truth.triangle == kNone || shown.triangle == kNone)
            return false;
        const CityModel& city = m_scene.city();
        const std::uint32_t a = city.triangles[truth.triangle].surface;
        const std::uint32_t b = city.triangles[shown.triangle].surface;
        if (a == b)
            return true;
        if (city.surfaces[a].object != city.surfaces[b].object)
            return false;
        const glm::dvec3 normal = normalOf(truth.triangle);
        return std::abs(glm::dot(normal, normalOf(shown.triangle))) >= kSameNormal &&
               std::abs(glm::dot(normal, shown.point - truth.point)) <= kSamePlane;
    }

    [[nodiscard]] bool sameInField(const Met& truth, const Met& shown) const {
        if (truth.sky || shown.sky)
            return truth.sky == shown.sky;
        const bool sameTop =
            truth.top && shown.top && std::abs(truth.point.z - shown.point.z) <= m_cell;
        return sameTop || near(shown.point, truth.point, m_cell);
    }

    [[nodiscard]] bool sameModel(const Met& truth, const Met& field) const {
        if (truth.sky || field.sky)
            return truth.sky == field.sky;
        if (near(field.point, truth.point, 0.0) || truth.triangle == kNone)
            return true;
        const glm::dvec3 off = field.point - truth.point;
        return std::abs(glm::dot(normalOf(truth.triangle), off)) <= m_cell;
    }

    void addError(const Met& truth, const Met& shown, const glm::dvec3& direction,
                  const glm::dvec3& lookup, std::vector<float>& errors) const {
        if (truth.sky != shown.sky)
            return;
        const glm::dvec3 towards = shown.sky ? lookup : shown.point - m_position;
        const double angle =
            std::atan2(glm::length(glm::cross(direction, towards)), glm::dot(direction, towards));
        errors.push_back(float(angle / m_texelAngle));
    }

    const RadianceScene& m_scene;
    const HeightfieldTracer& m_field;
    const RemSet& m_rems;
    const TexelSources& m_sources;
    glm::dvec3 m_position;
    double m_texelAngle;
    double m_cell;  ///< metres, a cell's diagonal
    std::vector<std::size_t> m_used;
};

std::optional<TexelError> statisticsOf(std::vector<float> errors) {
    if (errors.empty())
        return std::nullopt;
    std::sort(errors.begin(), errors.end());
    double sum = 0.0;
    for (const float error : errors)
        sum += double(error);
    const std::size_t last = errors.size() - 1;
    return TexelError{sum / double(errors.size()), double(errors[last / 2]),
                      double(errors[std::size_t(0.95 * double(last))])};
}

}  // namespace

void SurfaceTally::Counts::add(const Counts& other) {
    texels += other.texels;
    wrong += other.wrong;
    seen += other.seen;
    wrongSeen += other.wrongSeen;
    algorithmWrong += other.algorithmWrong;
    modelWrong += other.modelWrong;
    errors.insert(errors.end(), other.errors.begin(), other.errors.end());
    algorithmErrors.insert(algorithmErrors.end(), other.algorithmErrors.begin(),
                           other.algorithmErrors.end());
}

void SurfaceTally::add(const RemSet& rems, const TexelSources& sources,
                       const glm::dvec3& position) {
    const Examiner examiner(*m_scene, *m_field, rems, sources, position);
    const auto rows = std::size_t(sources.resolution());
    std::mutex mutex;
    parallelFor(0, 6 * rows, 16, [&](std::size_t first, std::size_t last) {
        Counts counts;
        for (std::size_t line = first; line < last; ++line) {
            for (std::size_t column = 0; column < rows; ++column)
                examiner.examine(int(line / rows), int(column), int(line % rows), counts);
        }
        const std::lock_guard lock(mutex);
        m_counts.add(counts);
    });
}

SurfaceFigures SurfaceTally::figures() const {
    SurfaceFigures out;
    const double texels = double(std::max<std::size_t>(1, m_counts.texels));
    out.wrong = double(m_counts.wrong) / texels;
    if (m_counts.seen > 0)
        out.wrongSeen = double(m_counts.wrongSeen) / double(m_counts.seen);
    out.texelError = statisticsOf(m_counts.errors);
    out.algorithmWrong = double(m_counts.algorithmWrong) / texels;
    out.algorithmTexelError = statisticsOf(m_counts.algorithmErrors);
    out.modelWrong = double(m_counts.modelWrong) / texels;
    return out;
}

}  // namespace reflet
