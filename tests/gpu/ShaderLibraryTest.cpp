// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/base/ShaderLibrary.h"
#include "tests/gpu/GlFixture.h"

#include <algorithm>
#include <filesystem>
#include <set>

namespace reflet {
namespace {

using ShaderLibrary = test::GlFixture;

TEST(ShaderFiles, AllOfTheFolderAreEmbedded) {
    std::vector<std::string> files;
    for (const auto& entry :
         std::filesystem::directory_iterator(REFLET_SOURCE_DIR "/resources/shaders")) {
        if (entry.path().extension() == ".glsl")
            files.push_back(entry.path().filename().string());
    }
    std::sort(files.begin(), files.end());
    EXPECT_EQ(shaderFiles(), files);
    EXPECT_GE(files.size(), 5U);
}

TEST(ShaderFiles, EveryStageBelongsToAProgram) {
    std::set<std::string> used;
    for (const std::string& name : programNames()) {
        const auto stages = programStages(name);
        ASSERT_TRUE(stages) << stages.error().message();
        used.insert(stages->begin(), stages->end());
    }
    for (const std::string& file : shaderFiles()) {
        const bool stage = file.find('.') != file.rfind('.');
        EXPECT_TRUE(!stage || used.contains(file)) << file << " is in no program";
    }
}

TEST(ShaderFiles, AnIncludeIsResolvedOnceAndDefinesFollowTheVersion) {
    const auto source = shaderSource("localmap_mem.frag.glsl", {"ANSWER 42"});
    ASSERT_TRUE(source) << source.error().message();
    EXPECT_EQ(source->find("#include"), std::string::npos);
    const auto at = source->find("vec3 faceDirection(vec2 st)");
    ASSERT_NE(at, std::string::npos);
    EXPECT_EQ(source->find("vec3 faceDirection(vec2 st)", at + 1), std::string::npos);
    EXPECT_LT(source->find("#version 450 core"), source->find("#define ANSWER 42"));
}

TEST(ShaderFiles, AnUnknownOneIsAnErrorThatNamesIt) {
    const auto text = shaderText("no_such.frag.glsl");
    ASSERT_FALSE(text);
    EXPECT_EQ(text.error().subject, "no_such.frag.glsl");
    EXPECT_FALSE(programStages("no_such"));
}

TEST_F(ShaderLibrary, EveryProgramCompilesAndLinks) {
    const std::vector<std::string> names = programNames();
    ASSERT_FALSE(names.empty());
    for (const std::string& name : names) {
        const auto program = makeProgram(name);
        EXPECT_TRUE(program) << program.error().message();
    }
}

TEST_F(ShaderLibrary, ABrokenShaderGivesTheDriversWords) {
    // A define can break any shader: here main() gets a name that is none.
    const auto program = makeProgram("localmap_copy", {"main 1"});
    ASSERT_FALSE(program);
    EXPECT_EQ(program.error().code, ErrorCode::Internal);
    EXPECT_NE(program.error().subject.find("localmap_copy"), std::string::npos);
    EXPECT_NE(program.error().what.find("error"), std::string::npos) << program.error().what;
}

}  // namespace
}  // namespace reflet
