// SPDX-License-Identifier: GPL-3.0-or-later
// What extensions hold: compressed meshes, other descriptions of a surface, and lies in them.
#include "tests/unit/importers/GltfText.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <functional>
#include <meshoptimizer.h>

namespace reflet {

using namespace test;

namespace {

void expectWarning(const Imported<GltfModel>& imported, const std::string& code) {
    EXPECT_TRUE(std::any_of(imported.diagnostics.begin(), imported.diagnostics.end(),
                            [&](const Diagnostic& d) { return d.code == code; }))
        << code;
}

constexpr glm::vec3 kTetrahedron[] = {{0, 0, 0}, {4, 0, 0}, {0, 2, 0}, {0, 0, 1}};
constexpr int kFaces[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};

/// A tetrahedron, red and opaque as to its vertices, as Draco writes it. Positions have the id 0,
/// colours the id 1.
std::string dracoTetrahedron() {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(4);
    const int position =
        builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int color = builder.AddAttribute(draco::GeometryAttribute::COLOR, 4, draco::DT_FLOAT32);
    const float red[] = {1.0F, 0.0F, 0.0F, 1.0F};
    for (int f = 0; f < 4; ++f) {
        const draco::FaceIndex face{std::uint32_t(f)};
        builder.SetAttributeValuesForFace(position, face, &kTetrahedron[kFaces[3 * f]],
                                          &kTetrahedron[kFaces[3 * f + 1]],
                                          &kTetrahedron[kFaces[3 * f + 2]]);
        builder.SetAttributeValuesForFace(color, face, red, red, red);
    }
    const auto mesh = builder.Finalize();
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(draco::Encoder().EncodeMeshToBuffer(*mesh, &buffer).ok());
    return std::string(buffer.data(), buffer.size());
}

/// A file whose only primitive is that tetrahedron; its accessors have no data of their own.
GltfText dracoFile() {
    GltfText file;
    const int view = file.view(dracoTetrahedron());
    file.root["accessors"] = {{{"componentType", 5123}, {"count", 12}, {"type", "SCALAR"}},
                              {{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}},
                              {{"componentType", 5126}, {"count", 4}, {"type", "VEC4"}}};
    file.root["meshes"] = {
        {{"primitives",
          {{{"indices", 0},
            {"attributes", {{"POSITION", 1}, {"COLOR_0", 2}}},
            {"extensions",
             {{"KHR_draco_mesh_compression",
               {{"bufferView", view}, {"attributes", {{"POSITION", 0}, {"COLOR_0", 1}}}}}}}}}}}};
    file.root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    return file;
}

json& dracoOf(GltfText& file) {
    return file.root["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
}

double volumeOf(const GltfModel& model) {
    double volume = 0.0;
    for (const glm::uvec3& t : model.triangles) {
        const auto& p = model.positions;
        volume += double(glm::dot(p[t.x], glm::cross(p[t.y], p[t.z]))) / 6.0;
    }
    return volume;
}

TEST(GltfDraco, IsTheMeshThatWasCompressed) {
    const auto model = dracoFile().import();
    ASSERT_TRUE(model.has_value()) << model.error().message();
    EXPECT_EQ(model->value.fileTriangles, 4U);
    EXPECT_EQ(model->value.triangles.size(), 4U);
    EXPECT_TRUE(model->diagnostics.empty());
    EXPECT_NEAR(model->value.bounds.max.x, 4.0, 1e-3);
    EXPECT_NEAR(model->value.bounds.max.y, 2.0, 1e-3);
    EXPECT_NEAR(model->value.bounds.max.z, 1.0, 1e-3);
    EXPECT_NEAR(volumeOf(model->value), 8.0 / 6.0, 1e-3);
    ASSERT_EQ(model->value.materials.size(), 1U);
    EXPECT_FLOAT_EQ(model->value.materials[0].color.y, 0.0F);
    EXPECT_GT(model->value.materials[0].color.x, 0.5F);
}

TEST(GltfDraco, IsLeftOutWhereItsNumbersLie) {
    const std::vector<std::function<void(GltfText&)>> lies{
        [](GltfText& f) { dracoOf(f)["bufferView"] = 99; },
        [](GltfText& f) { dracoOf(f)["bufferView"] = -1; },
        [](GltfText& f) { dracoOf(f)["bufferView"] = "0"; },
        [](GltfText& f) { dracoOf(f)["attributes"]["POSITION"] = 77; },
        [](GltfText& f) { dracoOf(f)["attributes"] = 5; },
        [](GltfText& f) { f.root["bufferViews"][0]["buffer"] = 3; },
        [](GltfText& f) { f.root["bufferViews"][0]["byteOffset"] = 1'000'000; },
        [](GltfText& f) { f.root["bufferViews"][0]["byteLength"] = 20; },
        [](GltfText& f) { f.root["accessors"][0]["count"] = 9; },  // it holds more
        [](GltfText& f) { f.root["meshes"][0]["primitives"][0]["indices"] = 42; },
    };
    for (std::size_t i = 0; i < lies.size(); ++i) {
        GltfText file = dracoFile();
        lies[i](file);
        const auto model = file.import();
        ASSERT_FALSE(model.has_value()) << i;
        EXPECT_EQ(model.error().code, ErrorCode::Refused) << i;
        EXPECT_NE(model.error().what.find("its compressed mesh cannot be read"), std::string::npos)
            << i << ": " << model.error().what;
    }
}

/// A box whose positions and indices are packed by meshopt; the buffer 1 stands for both.
GltfText meshoptFile() {
    GltfText file;
    file.box({0, 0, 0}, {3, 2, 1});
    const std::string bytes = file.bytes();
    const auto at = [&](int view) {
        return bytes.data() + file.root["bufferViews"][view]["byteOffset"].get<int>();
    };
    std::vector<unsigned char> positions(meshopt_encodeVertexBufferBound(8, 12));
    positions.resize(meshopt_encodeVertexBuffer(positions.data(), positions.size(), at(0), 8, 12));
    std::vector<std::uint16_t> list(36);
    std::memcpy(list.data(), at(1), 72);
    std::vector<unsigned char> indices(meshopt_encodeIndexBufferBound(36, 8));
    indices.resize(
        meshopt_encodeIndexBuffer(indices.data(), indices.size(), list.data(), list.size()));
    const auto pack = [&](int view, const std::vector<unsigned char>& packed, int count, int stride,
                          const char* mode) {
        const int source = file.view(std::string(packed.begin(), packed.end()));
        const json place = file.root["bufferViews"][source];
        file.root["bufferViews"][view] = {{"buffer", 1},
                                          {"byteLength", count * stride},
                                          {"extensions",
                                           {{"EXT_meshopt_compression",
                                             {{"buffer", 0},
                                              {"byteOffset", place["byteOffset"]},
                                              {"byteLength", place["byteLength"]},
                                              {"byteStride", stride},
                                              {"count", count},
                                              {"mode", mode}}}}}};
    };
    pack(0, positions, 8, 12, "ATTRIBUTES");
    pack(1, indices, 36, 2, "TRIANGLES");
    file.moreBuffers = {
        {{"byteLength", 168}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    file.root["extensionsRequired"] = {"EXT_meshopt_compression"};
    return file;
}

json& meshoptOf(GltfText& file, int view) {
    return file.root["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
}

TEST(GltfMeshopt, IsTheMeshThatWasCompressed) {
    const auto model = meshoptFile().import();
    ASSERT_TRUE(model.has_value()) << model.error().message();
    EXPECT_TRUE(model->diagnostics.empty());
    EXPECT_EQ(model->value.triangles.size(), 12U);
    EXPECT_EQ(model->value.bounds.max, glm::dvec3(3, 2, 1));
    EXPECT_NEAR(volumeOf(model->value), 6.0, 1e-5);
}

TEST(GltfMeshopt, IsLeftOutWhereItsNumbersLie) {
    const std::vector<std::function<void(json&)>> lies{
        [](json& e) { e["count"] = 2'000'000'000; },
        [](json& e) { e["count"] = 0; },
        [](json& e) { e["byteStride"] = 10; },
        [](json& e) { e["byteStride"] = -4; },
        [](json& e) { e["byteLength"] = 5; },
        [](json& e) { e["byteOffset"] = 1'000'000'000; },
        [](json& e) { e["buffer"] = 8; },
        [](json& e) { e["mode"] = "TRIANGLES"; },
        [](json& e) { e["filter"] = "OCTAHEDRAL"; },
        [](json& e) { e["filter"] = "UNKNOWN"; },
        [](json& e) { e = json::object(); },
    };
    for (std::size_t i = 0; i < lies.size(); ++i) {
        GltfText file = meshoptFile();
        lies[i](meshoptOf(file, 0));
        const auto model = file.import();
        ASSERT_FALSE(model.has_value()) << i;
        EXPECT_EQ(model.error().code, ErrorCode::Refused) << i;
        EXPECT_NE(model.error().what.find("EXT_meshopt_compression cannot be unpacked"),
                  std::string::npos)
            << i << ": " << model.error().what;
    }
}

TEST(GltfMeshopt, LeavesTheRestOfTheFileWhereOneViewCannotBeUnpacked) {
    GltfText file = meshoptFile();
    file.box({0, 0, 0}, {1, 1, 1});
    file.root["nodes"][0]["children"] = {1};
    file.root["nodes"].push_back({{"mesh", 1}});
    meshoptOf(file, 1)["mode"] = "INDICES";
    const auto model = file.import();
    ASSERT_TRUE(model.has_value()) << model.error().message();
    expectWarning(*model, "view-unreadable");
    expectWarning(*model, "primitive-skipped");
    EXPECT_EQ(model->value.bounds.max, glm::dvec3(1, 1, 1));
}

TEST(GltfMaterials, TakeColorsOfVerticesWithAnAlphaThatIsNotUsed) {
    GltfText file;
    json& primitive = file.mesh({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2});
    primitive["material"] = 0;
    primitive["attributes"]["COLOR_0"] =
        file.accessor(std::vector<std::uint16_t>{0, 65535, 0, 9, 0, 65535, 0, 9, 0, 65535, 0, 9},
                      5123, "VEC4", 4);
    file.root["accessors"].back()["normalized"] = true;
    file.root["materials"] = {
        {{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.5, 0.5, 1.0}}}}}};
    const auto model = file.import();
    ASSERT_TRUE(model.has_value()) << model.error().message();
    const GltfMaterial& m = model->value.materials.front();
    EXPECT_EQ(m.color, glm::vec3(0.0F, 0.5F, 0.0F));
    EXPECT_FLOAT_EQ(m.alpha, 1.0F);
}

json glossOnly() {
    return {{"alphaMode", "BLEND"},
            {"extensions",
             {{"KHR_materials_pbrSpecularGlossiness",
               {{"diffuseFactor", {0.5, 0.25, 0.125, 0.75}}, {"glossinessFactor", 0.75}}}}}};
}

TEST(GltfMaterials, TakeSpecularAndGlossinessWhereAFileHasNothingElse) {
    GltfText file;
    file.box({0, 0, 0}, {1, 1, 1})["material"] = 0;
    file.root["materials"] = {glossOnly()};
    file.root["extensionsRequired"] = {"KHR_materials_pbrSpecularGlossiness"};
    const auto model = file.import();
    ASSERT_TRUE(model.has_value()) << model.error().message();
    const GltfMaterial& m = model->value.materials.front();
    EXPECT_EQ(m.color, glm::vec3(0.5F, 0.25F, 0.125F));
    EXPECT_FLOAT_EQ(m.alpha, 0.75F);
    EXPECT_FLOAT_EQ(m.metallic, 0.0F);
    EXPECT_FLOAT_EQ(m.roughness, 0.25F);
}

TEST(GltfMaterials, TakeMetalAndRoughnessWhereAFileHasBoth) {
    GltfText file;
    file.box({0, 0, 0}, {1, 1, 1})["material"] = 0;
    json both = glossOnly();
    both["pbrMetallicRoughness"] = {{"roughnessFactor", 0.5}};
    file.root["materials"] = {both};
    const auto model = file.import();
    ASSERT_TRUE(model.has_value()) << model.error().message();
    const GltfMaterial& m = model->value.materials.front();
    EXPECT_EQ(m.color, glm::vec3(1.0F));
    EXPECT_FLOAT_EQ(m.metallic, 1.0F);
    EXPECT_FLOAT_EQ(m.roughness, 0.5F);
}

}  // namespace
}  // namespace reflet
