// SPDX-License-Identifier: GPL-3.0-or-later
// The files of both samples: valid CityJSON 2.0, planar and simple polygons, deterministic.
#include "SampleUnderTest.h"
#include "core/samples/paper/Paper.h"
#include "core/samples/square/Square.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace reflet::test {
namespace {

using nlohmann::json;

class SampleFile : public ::testing::TestWithParam<std::string> {};

std::vector<std::size_t> indicesOf(const json& geometry) {
    std::vector<std::size_t> indices;
    for (const json& surface : geometry.at("boundaries")) {
        for (const json& ring : surface) {
            for (const json& index : ring) {
                indices.push_back(index.get<std::size_t>());
            }
        }
    }
    return indices;
}

TEST_P(SampleFile, IsTheSameForTheSameSeedAndAnotherForAnother) {
    const Sample first = makeSample(GetParam(), 1).value();
    const Sample again = makeSample(GetParam(), 1).value();
    const Sample other = makeSample(GetParam(), 2).value();
    EXPECT_TRUE(first.modelJson == again.modelJson);
    EXPECT_TRUE(first.modelJson != other.modelJson);
    EXPECT_EQ(first.modelFileName, GetParam() + ".city.json");
}

TEST_P(SampleFile, SaysItsVersionItsScaleAndItsExtent) {
    const json& model = parsedModel(GetParam());
    EXPECT_EQ(model.at("type"), "CityJSON");
    EXPECT_EQ(model.at("version"), "2.0");
    EXPECT_EQ(model.at("transform").at("scale"), (json{0.001, 0.001, 0.001}));
    glm::ivec3 low(1 << 30), high(-(1 << 30));
    for (const json& v : model.at("vertices")) {
        const glm::ivec3 p(v[0].get<int>(), v[1].get<int>(), v[2].get<int>());
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const auto extent = model.at("metadata").at("geographicalExtent").get<std::vector<double>>();
    const glm::dvec3 t = sampleUnderTest(GetParam()).translation;
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(extent[std::size_t(axis)], t[axis] + 0.001 * low[axis], 1e-6);
        EXPECT_NEAR(extent[std::size_t(axis) + 3], t[axis] + 0.001 * high[axis], 1e-6);
    }
}

TEST_P(SampleFile, RefersOnlyToVerticesTemplatesMaterialsAndSemanticsThatExist) {
    const json& model = parsedModel(GetParam());
    const std::size_t vertices = model.at("vertices").size();
    const std::size_t templates = model.at("geometry-templates").at("templates").size();
    const std::size_t templateVertices =
        model.at("geometry-templates").at("vertices-templates").size();
    const std::size_t materials = model.at("appearance").at("materials").size();
    std::size_t checked = 0;
    const auto check = [&](const json& geometry, std::size_t limit) {
        for (const std::size_t index : indicesOf(geometry)) {
            ASSERT_LT(index, limit);
            ++checked;
        }
        const std::size_t faces = geometry.at("boundaries").size();
        const json& paints = geometry.at("material").at("reflet").at("values");
        ASSERT_EQ(paints.size(), faces);
        for (const json& paint : paints) {
            ASSERT_TRUE(paint.is_null() || paint.get<std::size_t>() < materials);
        }
        if (geometry.contains("semantics")) {
            const json& semantics = geometry.at("semantics");
            ASSERT_EQ(semantics.at("values").size(), faces);
            for (const json& value : semantics.at("values")) {
                ASSERT_TRUE(value.is_null() ||
                            value.get<std::size_t>() < semantics.at("surfaces").size());
            }
        }
    };
    for (const auto& [id, object] : model.at("CityObjects").items()) {
        ASSERT_FALSE(object.at("geometry").empty()) << id;
        for (const json& geometry : object.at("geometry")) {
            if (geometry.at("type") == "GeometryInstance") {
                ASSERT_LT(geometry.at("template").get<std::size_t>(), templates);
                ASSERT_LT(geometry.at("boundaries").at(0).get<std::size_t>(), vertices);
                ASSERT_EQ(geometry.at("transformationMatrix").size(), 16U);
            } else {
                check(geometry, vertices);
            }
        }
    }
    for (const json& geometry : model.at("geometry-templates").at("templates")) {
        check(geometry, templateVertices);
    }
    EXPECT_GT(checked, 100'000U);
}

/// Which semantic surfaces CityJSON 2.0 allows on which objects.
TEST_P(SampleFile, GivesSurfacesTheSemanticsThatTheirObjectsMayHave) {
    const std::set<std::string> building{"WallSurface",  "RoofSurface",         "Window",
                                         "Door",         "OuterCeilingSurface", "OuterFloorSurface",
                                         "GroundSurface"};
    const std::set<std::string> traffic{"TrafficArea", "AuxiliaryTrafficArea"};
    for (const auto& [id, object] : parsedModel(GetParam()).at("CityObjects").items()) {
        const auto type = object.at("type").get<std::string>();
        for (const json& geometry : object.at("geometry")) {
            if (!geometry.contains("semantics")) {
                continue;
            }
            for (const json& surface : geometry.at("semantics").at("surfaces")) {
                const auto name = surface.at("type").get<std::string>();
                const bool isTraffic =
                    type == "Road" || type == "Railway" || type == "TransportSquare";
                EXPECT_TRUE(type == "Building" ? building.contains(name)
                                               : isTraffic && traffic.contains(name))
                    << id << " " << name;
            }
        }
    }
}

TEST_P(SampleFile, NamesEachObjectOnce) {
    const kit::SampleCity city = GetParam() == "square" ? square::makeCity(1) : paper::makeCity(1);
    std::set<std::string> ids;
    for (const kit::SampleObject& object : city.objects) {
        EXPECT_TRUE(ids.insert(object.id).second) << object.id;
    }
    EXPECT_EQ(ids.size(), parsedModel(GetParam()).at("CityObjects").size());
    EXPECT_GT(ids.size(), 250U);
}

/// Greatest distance of a point from the plane through the polygon's middle along its area vector.
double deviation(const std::vector<glm::ivec3>& ring) {
    glm::dvec3 normal(0.0), middle(0.0);
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const glm::dvec3 a(ring[i] - ring[0]), b(ring[(i + 1) % ring.size()] - ring[0]);
        normal += glm::cross(a, b);
        middle += a;
    }
    normal = glm::normalize(normal);
    middle /= double(ring.size());
    double worst = 0.0;
    for (const glm::ivec3& p : ring) {
        worst = std::max(worst, std::abs(glm::dot(glm::dvec3(p - ring[0]) - middle, normal)));
    }
    return worst;
}

TEST_P(SampleFile, HasOnlyPolygonsThatArePlanarWithinAMillimetre) {
    const SampleUnderTest& city = sampleUnderTest(GetParam());
    ASSERT_GT(city.polygons.size(), 100'000U);
    for (const FilePolygon& polygon : city.polygons) {
        if (!polygon.instance) {  // those of instances are rounded again here, and checked as
                                  // templates
            ASSERT_LE(deviation(polygon.ring), 1.0) << polygon.object;
        }
    }
}

using Flat = std::array<std::int64_t, 2>;

std::int64_t side(const Flat& a, const Flat& b, const Flat& c) {
    const std::int64_t value = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    return value > 0 ? 1 : value < 0 ? -1 : 0;
}

bool onSegment(const Flat& a, const Flat& b, const Flat& p) {
    return side(a, b, p) == 0 && std::min(a[0], b[0]) <= p[0] && p[0] <= std::max(a[0], b[0]) &&
           std::min(a[1], b[1]) <= p[1] && p[1] <= std::max(a[1], b[1]);
}

bool meet(const Flat& a, const Flat& b, const Flat& c, const Flat& d) {
    const bool cross = side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
    return cross || onSegment(a, b, c) || onSegment(a, b, d) || onSegment(c, d, a) ||
           onSegment(c, d, b);
}

/// Exact in integers: no two edges that are not neighbours touch, in the polygon's main plane.
bool isSimple(const std::vector<glm::ivec3>& ring) {
    glm::dvec3 normal(0.0);
    for (std::size_t i = 0; i < ring.size(); ++i) {
        normal += glm::cross(glm::dvec3(ring[i] - ring[0]),
                             glm::dvec3(ring[(i + 1) % ring.size()] - ring[0]));
    }
    const glm::dvec3 size = glm::abs(normal);
    const int drop = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::vector<Flat> flat;
    for (const glm::ivec3& p : ring) {
        flat.push_back({p[(drop + 1) % 3], p[(drop + 2) % 3]});
    }
    const std::size_t n = flat.size();
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = i + 2; k < n; ++k) {
            if ((k + 1) % n != i && meet(flat[i], flat[(i + 1) % n], flat[k], flat[(k + 1) % n])) {
                return false;
            }
        }
    }
    return true;
}

TEST_P(SampleFile, HasOnlySimplePolygons) {
    for (const FilePolygon& polygon : sampleUnderTest(GetParam()).polygons) {
        if (!polygon.instance) {
            ASSERT_TRUE(isSimple(polygon.ring)) << polygon.object;
        }
    }
}

TEST_P(SampleFile, HasTemplatesOfPlanarSimplePolygons) {
    const json& templates = parsedModel(GetParam()).at("geometry-templates");
    std::size_t checked = 0;
    for (const json& shape : templates.at("templates")) {
        for (const json& surface : shape.at("boundaries")) {
            std::vector<glm::ivec3> ring;
            for (const json& index : surface.at(0)) {
                const json& v = templates.at("vertices-templates").at(index.get<std::size_t>());
                ring.emplace_back(std::lround(1000.0 * v[0].get<double>()),
                                  std::lround(1000.0 * v[1].get<double>()),
                                  std::lround(1000.0 * v[2].get<double>()));
            }
            ASSERT_LE(deviation(ring), 1.0);
            ASSERT_TRUE(isSimple(ring));
            ++checked;
        }
    }
    EXPECT_GT(checked, 10'000U);
}

INSTANTIATE_TEST_SUITE_P(Both, SampleFile, ::testing::ValuesIn(sampleNames()),
                         [](const auto& which) { return which.param; });

TEST(Samples, RefusesANameThatIsNoSample) {
    const Result<Sample> none = makeSample("village", 1);
    ASSERT_FALSE(none.has_value());
    EXPECT_EQ(none.error().code, ErrorCode::Usage);
    EXPECT_EQ(none.error().subject, "village");
    EXPECT_NE(none.error().remedy.find("square"), std::string::npos);
}

}  // namespace
}  // namespace reflet::test
