// SPDX-License-Identifier: GPL-3.0-or-later
// A long flat mirror of two bodies in a room whose every reflection is known in closed form: what
// the local maps of the bodies' centres show from the nose to the tail, and where they meet.
#include "core/environment/CubeDirection.h"
#include "core/rendering/CameraRays.h"
#include "core/rendering/ViewRenderer.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace reflet {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 48;
constexpr double kHalf = 8.0;  // metres, of the mirror's length

/// A street as a room: houses to the south, the ground, something far along either way.
struct Hit {
    double distance;
    glm::vec3 radiance;
};
Hit hitFrom(const glm::dvec3& origin, const glm::dvec3& direction) {
    const glm::dvec3 low(-60.0, -7.0, 0.0), high(60.0, 7.0, 25.0);
    double t = std::numeric_limits<double>::max();
    for (int k = 0; k < 3; ++k) {
        if (direction[k] != 0.0)
            t = std::min(t, ((direction[k] > 0.0 ? high : low)[k] - origin[k]) / direction[k]);
    }
    const glm::dvec3 p = origin + t * direction;
    return {t, 0.5F + 0.5F * glm::vec3(glm::sin(p * glm::dvec3(2.7, 3.0, 2.3)))};
}

LocalEnvironmentMap mapAt(const glm::dvec3& center) {
    constexpr int kResolution = 64;
    LocalEnvironmentMap map;
    map.center = center;
    map.radiance = CubeMap<glm::vec3>(kResolution);
    map.distance = CubeMap<float>(kResolution);
    for (int face = 0; face < 6; ++face) {
        for (int row = 0; row < kResolution; ++row) {
            for (int column = 0; column < kResolution; ++column) {
                const Hit hit =
                    hitFrom(center, glm::normalize(texelDirection(kResolution, face, column, row)));
                map.radiance.at(face, column, row) = hit.radiance;
                map.distance.at(face, column, row) = float(hit.distance);
            }
        }
    }
    return map;
}

/// A wall of mirror along x that faces south, cut into two bodies: rigid, or with a joint.
Vehicle mirrorOfTwo(bool rigid) {
    Vehicle vehicle;
    VehicleMaterial mirror;
    mirror.baseColor = glm::vec3(1.0F);
    mirror.metallic = 1.0F;
    vehicle.materials.push_back(mirror);
    for (const double side : {1.0, -1.0}) {
        VehicleBody body;
        body.vertices = {{-4, 0, 0.5}, {4, 0, 0.5}, {4, 0, 3.5}, {-4, 0, 3.5}};
        body.normals.assign(4, {0, -1, 0});
        body.triangles = {{0, 1, 2}, {0, 2, 3}};
        body.triangleMaterial = {0, 0};
        body.center = {0, 0, 2};
        body.offset = 4.0 * side;
        body.pivotMiddle = rigid ? -4.0 * side : 0.0;
        body.pivotSpan = 6.0;
        vehicle.bodies.push_back(body);
    }
    return vehicle;
}

struct Row {
    std::array<glm::vec3, kWidth> shown;
    std::array<glm::vec3, kWidth> truth;
    std::array<bool, kWidth> mirror;
};

class LongMirror : public testing::TestWithParam<bool> {
protected:
    /// The middle row of a picture of the whole mirror.
    Row draw(bool atInfinity) {
        CityModel city;
        city.materials.emplace_back();
        city.vertices = {{-90, -90, -9}, {90, -90, -9}, {0, 90, -9}};
        city.objects.emplace_back();
        city.surfaces.emplace_back();
        city.surfaces[0].material = 0;
        city.triangles.push_back({{0, 1, 2}, 0});
        const Vehicle vehicle = mirrorOfTwo(GetParam());
        std::array<LocalEnvironmentMap, 2> maps{mapAt({4, 0, 2}), mapAt({-4, 0, 2})};
        std::vector<PlacedBody> bodies(2);
        std::vector<std::vector<glm::vec3>> vertices;
        for (std::size_t i = 0; i < 2; ++i) {
            maps[i].atInfinity = atInfinity;
            bodies[i].vehicle = &vehicle;
            bodies[i].body = i;
            bodies[i].project_from_body.translation = {i == 0 ? 4.0 : -4.0, 0.0, 0.0};
            bodies[i].map = &maps[i];
            vertices.push_back(projectVertices(bodies[i]));
        }
        std::vector<Occluder> occluders;
        for (std::size_t i = 0; i < 2; ++i)
            occluders.push_back({vertices[i], vehicle.bodies[i].triangles});
        Lighting night;
        night.sunDirection = glm::normalize(glm::dvec3(0.2, 0.1, -0.9));
        const auto scene = RadianceScene::create(city, {}, night, occluders, {});
        EXPECT_TRUE(scene);
        Camera camera;
        // From afar, so that nose and tail are seen under the same angles as the middle.
        camera.position = {10.0, -60.0, 1.7};
        camera.target = {0.0, 0.0, 2.0};
        camera.verticalFov = 2.0 * std::atan(0.14 * kHeight / kWidth);
        const auto view = renderView(**scene, bodies, camera, {kWidth, kHeight, 1}, {});
        EXPECT_TRUE(view);
        Row row{};
        const CameraRays rays(camera, kWidth, kHeight);
        const int y = kHeight / 2;
        for (int x = 0; x < kWidth; ++x) {
            const auto at = std::size_t(x);
            row.shown[at] = view->radiance[std::size_t(y * kWidth + x)];
            const glm::dvec3 d = rays.through(x + 0.5, y + 0.5);
            const glm::dvec3 p = rays.position() - rays.position().y / d.y * d;
            row.mirror[at] = d.y > 0.0 && std::abs(p.x) < kHalf - 0.1;
            row.truth[at] = hitFrom(p - glm::dvec3(0, 1e-6, 0), {d.x, -d.y, d.z}).radiance;
            m_station[at] = p.x;
        }
        return row;
    }
    /// Decibels over the columns whose station lies in [from, to), metres from the middle.
    [[nodiscard]] double decibels(const Row& row, double from, double to) const {
        double sum = 0.0;
        std::size_t count = 0;
        for (std::size_t x = 0; x < kWidth; ++x) {
            const double place = std::abs(m_station[x]);
            if (!row.mirror[x] || place < from || place >= to)
                continue;
            const glm::vec3 d = row.shown[x] - row.truth[x];
            sum += double(glm::dot(d, d)) / 3.0;
            ++count;
        }
        EXPECT_GT(count, 20U);
        return -10.0 * std::log10(sum / double(count));
    }
    /// The largest change of what is shown that is not in the truth, from one column to the next:
    /// where the bodies meet, and elsewhere.
    struct Steps {
        float joint = 0.0F;
        float elsewhere = 0.0F;
    };
    [[nodiscard]] Steps steps(const Row& row) const {
        Steps out;
        for (std::size_t x = 1; x < kWidth; ++x) {
            if (!row.mirror[x] || !row.mirror[x - 1])
                continue;
            const float step =
                glm::length((row.shown[x] - row.truth[x]) - (row.shown[x - 1] - row.truth[x - 1]));
            float& largest = std::abs(m_station[x]) < 0.6 || m_station[x] * m_station[x - 1] < 0.0
                                 ? out.joint
                                 : out.elsewhere;
            largest = std::max(largest, step);
        }
        return out;
    }

    std::array<double, kWidth> m_station{};
};

TEST_P(LongMirror, ShowsTheStreetAtNoseAndTailAsWellAsInTheMiddleOfABody) {
    const Row row = draw(false);
    const double ends = decibels(row, 6.0, kHalf);
    const double middles = decibels(row, 2.5, 5.5);
    EXPECT_GT(middles, 35.0);
    EXPECT_GT(ends, middles - 3.0);
    // Looked up as if at infinity it shows the middle's view everywhere.
    const Row far = draw(true);
    EXPECT_LT(decibels(far, 6.0, kHalf), 15.0);
}

TEST_P(LongMirror, ShowsNoSeamWhereItsBodiesMeet) {
    const Row row = draw(false);
    const double joint = decibels(row, 0.0, 1.0);
    EXPECT_GT(joint, decibels(row, 2.5, 5.5) - 3.0);
    const Steps found = steps(row);
    EXPECT_LE(found.joint, found.elsewhere);
    const Steps far = steps(draw(true));
    if (!GetParam()) {
        EXPECT_GT(far.joint, 2.0F * far.elsewhere)
            << "the case should show a seam without parallax";
    }
}

INSTANTIATE_TEST_SUITE_P(RigidAndJointed, LongMirror, testing::Bool());

}  // namespace
}  // namespace reflet
