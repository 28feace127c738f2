// SPDX-License-Identifier: GPL-3.0-or-later
// The real and the malformed glTF files of the shared data: what exactly becomes of each of them.
#include "core/traffic/VehicleProposal.h"
#include "importers/gltf/GltfImporter.h"
#include "tests/support/TestData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace reflet {
namespace {

struct BadFile {
    const char* path;
    ErrorCode code;
    const char* what;
};

class BadGltf : public testing::TestWithParam<BadFile> {};

TEST_P(BadGltf, IsAnErrorThatSaysWhatIsWrong) {
    const auto path = test::sharedData(std::string("bad/gltf/") + GetParam().path);
    if (!path)
        GTEST_SKIP() << test::kNoSharedData;
    const auto result = importVehicle(*path, {}, {});
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().code, GetParam().code) << result.error().message();
    EXPECT_NE(result.error().message().find(GetParam().what), std::string::npos)
        << result.error().message();
    EXPECT_FALSE(result.error().remedy.empty());
}

constexpr ErrorCode kUnreadable = ErrorCode::Unreadable;
constexpr ErrorCode kRefused = ErrorCode::Refused;
INSTANTIATE_TEST_SUITE_P(
    Shared, BadGltf,
    testing::Values(
        BadFile{"glb-no-header.glb", kUnreadable, "does not begin with \"glTF\""},
        BadFile{"glb-only-header.glb", kUnreadable, "has no JSON in it"},
        BadFile{"glb-invalid-magic.glb", kUnreadable, "does not begin with \"glTF\""},
        BadFile{"glb-invalid-version.glb", kUnreadable, "is of glTF version 0, not 2"},
        BadFile{"glb-truncated-chunk-data.glb", kUnreadable, "is cut off: 47 of 48 bytes"},
        BadFile{"glb-length-mismatch.glb", kUnreadable, "is cut off: 48 of 49 bytes"},
        BadFile{"glb-chunk-too-big.glb", kUnreadable, "has no JSON in it"},
        BadFile{"glb-invalid-json-chunk.glb", kUnreadable, "is no valid JSON"},
        BadFile{"json-invalid-syntax.gltf", kUnreadable, "is no valid JSON"},
        BadFile{"node-node-loop.gltf", kRefused, "holds no triangle"},
        BadFile{"buffer-not-found.gltf", kUnreadable, ""},
        BadFile{"buffer-zero-bytelength.gltf", kUnreadable, "buffer 0 has no length"},
        BadFile{"node-unresolved-mesh.gltf", kRefused, "node 0: mesh"},
        BadFile{"image-not-found.gltf", kRefused, "holds no triangle"},
        BadFile{"accessor-data/out-of-range-elements-float.gltf", kRefused, "holds no triangle"},
        BadFile{"assimp-recursive-nodes.gltf", kRefused, "its own ancestor"},
        BadFile{"assimp-scene-wrong-type.gltf", kUnreadable, "BoxTextured0.bin"}),
    [](const auto& file) {
        std::string name = file.param.path;
        std::replace_if(
            name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
        return name;
    });

TEST(GltfSharedData, LeavesOutTheIndicesThatAreOutOfRange) {
    const auto path =
        test::sharedData("bad/gltf/assimp-index-out-of-range/index-out-of-range.gltf");
    if (!path)
        GTEST_SKIP() << test::kNoSharedData;
    const auto result = importVehicle(*path, {}, {});
    ASSERT_TRUE(result.has_value()) << result.error().message();
    EXPECT_EQ(result->counts.repaired, 1U);
    EXPECT_LT(result->value.triangles.size(), result->value.fileTriangles);
    EXPECT_TRUE(std::any_of(result->diagnostics.begin(), result->diagnostics.end(),
                            [](const Diagnostic& d) { return d.code == "index-out-of-range"; }));
}

struct GoodFile {
    const char* path;
    std::size_t triangles;
    VehicleKind kind;
    double shortest, longest;  ///< metres that are believed
    const char* front;         ///< "" = not told by the file
};

class GoodGltf : public testing::TestWithParam<GoodFile> {};

TEST_P(GoodGltf, HasTheTrianglesThatWereCountedAndABelievableProposal) {
    const auto path = test::sharedData(std::string("gltf/") + GetParam().path);
    if (!path)
        GTEST_SKIP() << test::kNoSharedData;
    const auto result = importVehicle(*path, {}, {});
    ASSERT_TRUE(result.has_value()) << result.error().message();
    EXPECT_EQ(result->value.fileTriangles, GetParam().triangles);
    EXPECT_EQ(result->counts.skipped, 0U);
    EXPECT_EQ(result->value.imagesRead > 0, result->value.images > 0);
    const VehicleProposal proposal = proposeFit(result->value);
    EXPECT_EQ(proposal.kind, GetParam().kind);
    EXPECT_GE(proposal.length, GetParam().shortest) << proposal.sizeReason;
    EXPECT_LE(proposal.length, GetParam().longest) << proposal.sizeReason;
    if (*GetParam().front != '\0') {
        EXPECT_TRUE(proposal.frontCertain);
        EXPECT_EQ(proposal.front, GetParam().front);
    }
    EXPECT_GT(proposal.reflectingAfter, 0.25);
    const Vehicle vehicle = makeVehicle(result->value, proposal.model);
    Box box;
    for (const VehicleBody& body : vehicle.bodies) {
        ASSERT_EQ(body.normals.size(), body.vertices.size());
        for (const glm::vec3& v : body.vertices) {
            box.add(glm::dvec3(v) + glm::dvec3(body.offset, 0.0, 0.0));
            ASSERT_LE(std::abs(v.x), 4.01F);
        }
        for (const glm::vec3& n : body.normals)
            ASSERT_NEAR(glm::length(n), 1.0F, 1e-3F);
    }
    EXPECT_NEAR(box.min.z, 0.0, 1e-3);
    EXPECT_NEAR(box.center().x, 0.0, 1e-3);
    EXPECT_NEAR(box.center().y, 0.0, 1e-3);
    EXPECT_NEAR(box.size().x, proposal.length, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(
    Shared, GoodGltf,
    testing::Values(GoodFile{"toy-car/toy-car.gltf", 108'936, VehicleKind::Car, 2.4, 7.0, ""},
                    GoodFile{"compact-car/compact-car.gltf", 10'690, VehicleKind::Car, 2.9, 3.2,
                             "-x"},
                    GoodFile{"bus/bus.gltf", 2'752, VehicleKind::Bus, 8.0, 13.0, ""}),
    [](const auto& file) {
        const std::string path = file.param.path;
        std::string name = path.substr(0, path.find('/'));
        std::replace(name.begin(), name.end(), '-', '_');
        return name;
    });

}  // namespace
}  // namespace reflet
