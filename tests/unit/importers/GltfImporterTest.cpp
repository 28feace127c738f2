// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/TemporaryFolder.h"
#include "tests/unit/importers/GltfText.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace reflet {

using namespace test;

namespace {

std::string codes(const Imported<GltfModel>& imported) {
    std::string out;
    for (const Diagnostic& d : imported.diagnostics)
        out += (out.empty() ? "" : " ") + d.code;
    return out;
}

void expectError(const Result<Imported<GltfModel>>& result, ErrorCode code,
                 const std::string& part) {
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().code, code);
    EXPECT_NE(result.error().what.find(part), std::string::npos) << result.error().what;
    EXPECT_FALSE(result.error().remedy.empty());
}

TEST(GltfImporter, PlacesANodeByItsParentsInDoublePrecision) {
    GltfText file;
    file.box({0, 0, 0}, {1, 1, 1});
    file.root["nodes"] = {{{"children", {1}}, {"translation", {0, 0, 5}}, {"scale", {2, 2, 2}}},
                          {{"mesh", 0}, {"rotation", {0, std::sqrt(0.5), 0, std::sqrt(0.5)}}}};
    const auto model = file.import();
    ASSERT_TRUE(model.has_value()) << model.error().message();
    // A quarter turn about y takes x to -z and z to x.
    EXPECT_NEAR(model->value.bounds.min.z, 3.0, 1e-5);
    EXPECT_NEAR(model->value.bounds.max.z, 5.0, 1e-5);
    EXPECT_NEAR(model->value.bounds.max.x, 2.0, 1e-5);
    EXPECT_EQ(model->value.triangles.size(), 12U);
    EXPECT_EQ(model->value.fileTriangles, 12U);
}

TEST(GltfImporter, MakesNormalsWhereAFileHasNoneAndKeepsEdgesSharp) {
    GltfText file;
    file.box({-1, -1, -1}, {1, 1, 1});
    const auto model = file.import();
    ASSERT_TRUE(model.has_value()) << model.error().message();
    const GltfModel& m = model->value;
    ASSERT_EQ(m.normals.size(), m.positions.size());
    EXPECT_EQ(m.positions.size(), 24U);  // three normals at each corner
    for (std::size_t i = 0; i < m.normals.size(); ++i) {
        EXPECT_NEAR(glm::length(m.normals[i]), 1.0F, 1e-5F);
        EXPECT_NEAR(glm::dot(m.normals[i], m.positions[i]), 1.0F, 1e-5F);
    }
}

TEST(GltfImporter, ReadsStripsAndFansAsTheTrianglesThatTheyAre) {
    const std::vector<float> square{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    for (const int mode : {5, 6}) {
        GltfText file;
        file.mesh(square, {})["mode"] = mode;
        const auto model = file.import();
        ASSERT_TRUE(model.has_value()) << model.error().message();
        EXPECT_EQ(model->value.triangles.size(), 2U);
    }
}

TEST(GltfImporter, TurnsTrianglesOverInAMirroredNode) {
    GltfText file;
    file.box({0, 0, 0}, {1, 1, 1});
    file.root["nodes"][0]["scale"] = {-1, 1, 1};
    const auto model = file.import();
    ASSERT_TRUE(model.has_value());
    double volume = 0.0;
    for (const glm::uvec3& t : model->value.triangles) {
        const auto& p = model->value.positions;
        volume += double(glm::dot(p[t.x], glm::cross(p[t.y], p[t.z]))) / 6.0;
    }
    EXPECT_NEAR(volume, 1.0, 1e-5);
}

TEST(GltfImporter, AppliesSparseAccessors) {
    GltfText file;
    file.mesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2});
    const std::size_t place = file.accessor(std::vector<std::uint16_t>{1}, 5123, "SCALAR", 1);
    const std::size_t value = file.accessor(std::vector<float>{7, 0, 0}, 5126, "VEC3", 3);
    const auto view = [&](std::size_t a) { return file.root["accessors"][a]["bufferView"]; };
    file.root["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", view(place)}, {"componentType", 5123}}},
        {"values", {{"bufferView", view(value)}}}};
    const auto model = file.import();
    ASSERT_TRUE(model.has_value()) << model.error().message();
    EXPECT_EQ(model->value.bounds.max.x, 7.0);
}

TEST(GltfImporter, ReadsInterleavedVerticesAndNormalizedIntegers) {
    GltfText file;
    json& primitive = file.mesh({0, 0, 0, 9, 9, 9, 1, 0, 0, 9, 9, 9, 0, 1, 0, 9, 9, 9}, {0, 1, 2});
    file.root["accessors"][0]["count"] = 3;
    file.root["bufferViews"][0]["byteStride"] = 24;
    primitive["attributes"]["COLOR_0"] = file.accessor(
        std::vector<std::uint8_t>{255, 0, 0, 255, 0, 0, 255, 0, 0, 0, 0, 0}, 5121, "VEC3", 3);
    file.root["accessors"].back()["normalized"] = true;
    file.root["accessors"].back()["count"] = 3;
    const auto model = file.import();
    ASSERT_TRUE(model.has_value()) << model.error().message();
    EXPECT_EQ(model->value.bounds.max, glm::dvec3(1, 1, 0));
    EXPECT_EQ(model->value.materials.front().color, glm::vec3(0.8F, 0, 0));
}

TEST(GltfImporter, TakesMaterialsAsTheFileHasThem) {
    GltfText file;
    file.box({0, 0, 0}, {1, 1, 1})["material"] = 0;
    file.root["materials"] = {
        {{"name", "pane"},
         {"alphaMode", "BLEND"},
         {"emissiveFactor", {0.5, 0, 0}},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.1, 0.2, 0.3, 0.25}}, {"metallicFactor", 0.4}}},
         {"extensions",
          {{"KHR_materials_clearcoat", {{"clearcoatFactor", 0.75}}},
           {"KHR_materials_transmission", {{"transmissionFactor", 0.5}}}}}}};
    const auto model = file.import();
    ASSERT_TRUE(model.has_value());
    const GltfMaterial& m = model->value.materials.front();
    EXPECT_EQ(m.name, "pane");
    EXPECT_NEAR(m.color.y, 0.2F, 1e-5F);
    EXPECT_FLOAT_EQ(m.alpha, 0.25F);
    EXPECT_FLOAT_EQ(m.metallic, 0.4F);
    EXPECT_FLOAT_EQ(m.roughness, 1.0F);
    EXPECT_FLOAT_EQ(m.clearCoat, 0.75F);
    EXPECT_FLOAT_EQ(m.transmission, 0.5F);
    EXPECT_FLOAT_EQ(m.emission.x, 0.5F);
}

TEST(GltfImporter, RefusesAnExtensionThatItDoesNotKnowByName) {
    GltfText file;
    file.box({0, 0, 0}, {1, 1, 1});
    file.root["extensionsRequired"] = {"KHR_texture_transform", "KHR_texture_basisu"};
    expectError(file.import(), ErrorCode::Refused, "KHR_texture_basisu");
}

TEST(GltfImporter, RefusesAFileWithoutTrianglesAndSaysWhy) {
    GltfText empty;
    empty.root.erase("nodes");
    expectError(empty.import(), ErrorCode::Refused, "holds no triangle");
    GltfText lines;
    lines.mesh({0, 0, 0, 1, 0, 0}, {})["mode"] = 1;
    expectError(lines.import(), ErrorCode::Refused, "lines and points are not shown");
}

TEST(GltfImporter, RefusesTooManyTrianglesByTheFilesOwnCountsAlone) {
    GltfText file;
    file.box({0, 0, 0}, {1, 1, 1});
    file.root["accessors"][1]["count"] = 90'000'000;  // far more than the buffer holds
    expectError(file.import(), ErrorCode::ResourceLimit, "has 30000000 triangles");
    GltfText many;
    many.box({0, 0, 0}, {1, 1, 1});
    GltfOptions few;
    few.maxTriangles = 11;
    expectError(many.import(few), ErrorCode::ResourceLimit, "has 12 triangles, more than 11");
}

TEST(GltfImporter, LeavesOutAPrimitiveThatDoesNotLieWithinItsBuffer) {
    GltfText file;
    file.box({0, 0, 0}, {1, 1, 1});
    file.box({2, 0, 0}, {3, 1, 1});
    file.root["nodes"].push_back({{"mesh", 1}});
    file.root["scenes"][0]["nodes"] = {0, 1};
    file.root["accessors"][2]["count"] = 1000;
    const auto model = file.import();
    ASSERT_TRUE(model.has_value()) << model.error().message();
    EXPECT_EQ(codes(*model), "primitive-skipped");
    EXPECT_EQ(model->value.triangles.size(), 12U);
    EXPECT_EQ(model->counts.skipped, 1U);
}

TEST(GltfImporter, LeavesOutTrianglesWithAVertexThatDoesNotExist) {
    GltfText file;
    file.mesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2, 0, 1, 3});
    const auto model = file.import();
    ASSERT_TRUE(model.has_value()) << model.error().message();
    EXPECT_EQ(codes(*model), "index-out-of-range");
    EXPECT_EQ(model->value.triangles.size(), 1U);
}

TEST(GltfImporter, ShowsANodeOnceThatIsItsOwnAncestor) {
    GltfText file;
    file.box({0, 0, 0}, {1, 1, 1});
    file.root["nodes"] = {{{"mesh", 0}, {"children", {1}}}, {{"children", {0}}}};
    const auto model = file.import();
    ASSERT_TRUE(model.has_value()) << model.error().message();
    EXPECT_EQ(codes(*model), "node-loop");
    EXPECT_EQ(model->value.triangles.size(), 12U);
}

TEST(GltfImporter, ReadsNoFileOutsideItsFolder) {
    const TemporaryFolder folder;
    folder.write("secret.bin", std::string(100, 'x'));
    std::filesystem::create_directories(folder / "inside");
    for (const char* uri :
         {"../secret.bin", "/etc/passwd", "..%2Fsecret.bin", "https://example.org/a.bin"}) {
        json root{{"asset", {{"version", "2.0"}}},
                  {"buffers", {{{"byteLength", 4}, {"uri", uri}}}}};
        expectError(importVehicleBytes(root.dump(), folder / "inside" / "a.gltf", {}, {}),
                    ErrorCode::Refused, "names a file outside its folder");
    }
}

/// A square of 2 * edge * edge triangles.
GltfText square(int edge) {
    GltfText file;
    std::vector<float> positions;
    std::vector<std::uint16_t> indices;
    for (int i = 0; i <= edge; ++i) {
        for (int j = 0; j <= edge; ++j) {
            positions.insert(positions.end(), {float(i), 0.0F, float(j)});
            if (i < edge && j < edge) {
                const auto a = std::uint16_t(i * (edge + 1) + j);
                const auto b = std::uint16_t(a + edge + 1);
                indices.insert(indices.end(), {a, std::uint16_t(a + 1), b, b, std::uint16_t(a + 1),
                                               std::uint16_t(b + 1)});
            }
        }
    }
    file.mesh(positions, indices);
    return file;
}

TEST(GltfImporter, SimplifiesWhatIsFarTooFineAndSaysSo) {
    GltfOptions options;
    options.mostKept = 1000;
    const auto model = square(60).import(options);
    ASSERT_TRUE(model.has_value()) << model.error().message();
    EXPECT_EQ(codes(*model), "simplified");
    EXPECT_EQ(model->value.fileTriangles, 7200U);
    EXPECT_LE(model->value.triangles.size(), 1000U);
    EXPECT_NEAR(model->value.bounds.size().x, 60.0, 1e-3);
    // Vertices that no triangle has any more are gone too.
    EXPECT_LE(model->value.positions.size(), 3 * model->value.triangles.size());
}

TEST(GltfImporter, SimplifiesTrianglesThatHaveNoNeighbours) {
    // No edge can be collapsed: every triangle has vertices of its own, apart from all others.
    GltfText file;
    std::vector<float> positions;
    for (int i = 0; i < 4000; ++i) {
        const float x = float(i % 64);
        const float z = float(i / 64);
        positions.insert(positions.end(), {x, 0, z, x + 0.5F, 0, z, x, 0, z + 0.5F});
    }
    file.mesh(positions, {});
    GltfOptions options;
    options.mostKept = 500;
    const auto model = file.import(options);
    ASSERT_TRUE(model.has_value()) << model.error().message();
    EXPECT_EQ(codes(*model), "simplified");
    EXPECT_LE(model->value.triangles.size(), 1000U);
    EXPECT_NEAR(model->value.bounds.size().x, 63.5, 2.0);
}

TEST(GltfImporter, RefusesTooManyPartsThatAreTooSmallToBeSimplified) {
    GltfText file;
    file.box({0, 0, 0}, {1, 1, 1});
    for (int i = 0; i < 20; ++i) {
        file.root["nodes"].push_back({{"mesh", 0}, {"translation", {2 * i, 0, 0}}});
        file.root["nodes"][0]["children"].push_back(i + 1);
    }
    GltfOptions options;
    options.mostKept = 100;
    options.mostLeft = 200;
    expectError(file.import(options), ErrorCode::ResourceLimit, "triangles, more than 200");
}

TEST(GltfImporter, RefusesWhatIsNestedWithoutEnd) {
    GltfText file;
    file.box({0, 0, 0}, {1, 1, 1});
    std::string text = file.text();
    text.insert(1, "\"extras\":" + std::string(100'000, '[') + std::string(100'000, ']') + ",");
    expectError(importVehicleBytes(text, "/nonexistent/thing.gltf", {}, {}), ErrorCode::Unreadable,
                "is nested deeper than");
}

TEST(GltfImporter, TakesAWholeNumberThatIsWrittenWithAPoint) {
    GltfText file;
    file.box({0, 0, 0}, {1, 1, 1});
    file.root["accessors"][1]["count"] = 36.0;
    file.root["nodes"][0]["mesh"] = 0.0;
    const auto model = file.import();
    ASSERT_TRUE(model.has_value()) << model.error().message();
    EXPECT_EQ(model->value.triangles.size(), 12U);
}

/// As a .glb; `says` is the length that the binary chunk claims.
std::string asGlb(const GltfText& file, std::size_t says) {
    std::string text = file.text();
    json root = json::parse(text);
    root["buffers"] = {{{"byteLength", file.bytes().size()}}};
    text = root.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto word = [](std::size_t n) {
        const auto value = std::uint32_t(n);
        return std::string(reinterpret_cast<const char*>(&value), 4);
    };
    return "glTF" + word(2) + word(28 + text.size() + file.bytes().size()) + word(text.size()) +
           "JSON" + text + word(says) + std::string("BIN\0", 4) + file.bytes();
}

TEST(GltfImporter, ReadsTheBinaryChunkAndNothingBeyondIt) {
    GltfText file;
    file.box({0, 0, 0}, {1, 1, 1});
    const std::size_t size = file.bytes().size();
    const auto model = importVehicleBytes(asGlb(file, size), "/nonexistent/thing.glb", {}, {});
    ASSERT_TRUE(model.has_value()) << model.error().message();
    EXPECT_EQ(model->value.triangles.size(), 12U);
    expectError(importVehicleBytes(asGlb(file, size + 8), "/nonexistent/thing.glb", {}, {}),
                ErrorCode::Unreadable, "is cut off within a chunk");
    expectError(importVehicleBytes(asGlb(file, size - 4), "/nonexistent/thing.glb", {}, {}),
                ErrorCode::Unreadable, "buffer 0 is not in the file");
}

TEST(GltfImporter, TellsByNameWhatOfAFileIsNoGltf) {
    GltfText file;
    file.box({0, 0, 0}, {1, 1, 1});
    file.root["accessors"][0]["type"] = "VEC9";
    expectError(file.import(), ErrorCode::Unreadable, "VEC9");
}

TEST(GltfImporter, LeavesOutAPrimitiveWhoseIndicesDoNotExist) {
    GltfText file;
    file.box({0, 0, 0}, {1, 1, 1});
    json broken = file.root["meshes"][0]["primitives"][0];
    broken["indices"] = 17;
    file.root["meshes"][0]["primitives"].push_back(broken);
    file.root["meshes"][0]["primitives"].push_back(5);
    const auto model = file.import();
    ASSERT_TRUE(model.has_value()) << model.error().message();
    EXPECT_EQ(codes(*model), "primitive-skipped primitive-skipped");
    EXPECT_EQ(model->value.triangles.size(), 12U);
}

}  // namespace
}  // namespace reflet
