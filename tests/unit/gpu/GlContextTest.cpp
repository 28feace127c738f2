// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/EglDisplays.h"
#include "core/gpu/GlContext.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <thread>

namespace reflet {
namespace {

class HeadlessGl : public testing::Test {
protected:
    void SetUp() override {
        if (eglDisplayCandidates().empty())
            GTEST_SKIP() << "EGL offers no display here.";
    }
};

/// Clears a texture of 4 x 4 texels through a framebuffer and reads one back.
std::array<std::uint8_t, 4> clearedTexel(float red, float green, float blue) {
    GLuint texture = 0;
    GLuint framebuffer = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, GL_RGBA8, 4, 4);
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, texture, 0);
    EXPECT_EQ(glCheckNamedFramebufferStatus(framebuffer, GL_FRAMEBUFFER),
              static_cast<GLenum>(GL_FRAMEBUFFER_COMPLETE));
    const std::array<float, 4> color = {red, green, blue, 1.0F};
    glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, color.data());
    std::array<std::uint8_t, 4 * 16> texels{};
    glGetTextureImage(texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(texels.size()),
                      texels.data());
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteTextures(1, &texture);
    return {texels[20], texels[21], texels[22], texels[23]};
}

using Texel = std::array<std::uint8_t, 4>;

TEST_F(HeadlessGl, IsOpenGl45Core) {
    const auto context = GlContext::createHeadless();
    ASSERT_TRUE(context) << context.error().message();
    GLint major = 0;
    GLint minor = 0;
    GLint profile = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    EXPECT_GE(major * 10 + minor, 45);
    EXPECT_EQ(profile, GL_CONTEXT_CORE_PROFILE_BIT);
}

TEST_F(HeadlessGl, TellsTheDriverAndThePathThatWasTaken) {
    const auto context = GlContext::createHeadless();
    ASSERT_TRUE(context) << context.error().message();
    EXPECT_EQ((*context)->renderer(), reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
    EXPECT_EQ((*context)->version(), reinterpret_cast<const char*>(glGetString(GL_VERSION)));
    bool known = false;
    for (const auto& candidate : eglDisplayCandidates())
        known = known || candidate.path == (*context)->path();
    EXPECT_TRUE(known) << (*context)->path();
}

TEST_F(HeadlessGl, DrawsIntoATextureAndReadsItBack) {
    const auto context = GlContext::createHeadless();
    ASSERT_TRUE(context) << context.error().message();
    EXPECT_EQ(clearedTexel(1.0F, 0.0F, 0.2F), (Texel{255, 0, 51, 255}));
}

TEST_F(HeadlessGl, CanBeMadeAgainAfterItWasDestroyed) {
    for (int i = 0; i < 3; ++i) {
        const auto context = GlContext::createHeadless();
        ASSERT_TRUE(context) << context.error().message();
        EXPECT_EQ(clearedTexel(0.0F, 1.0F, 0.0F), (Texel{0, 255, 0, 255}));
    }
}

TEST_F(HeadlessGl, EachThreadCanHaveItsOwn) {
    Texel fromThread{};
    std::string problem;
    const auto context = GlContext::createHeadless();
    ASSERT_TRUE(context) << context.error().message();
    std::thread([&] {
        const auto own = GlContext::createHeadless();
        if (own) {
            fromThread = clearedTexel(0.0F, 0.0F, 1.0F);
        } else {
            problem = own.error().message();
        }
    }).join();
    EXPECT_EQ(problem, "");
    EXPECT_EQ(fromThread, (Texel{0, 0, 255, 255}));
    EXPECT_EQ(clearedTexel(1.0F, 1.0F, 0.0F), (Texel{255, 255, 0, 255}));
}

TEST_F(HeadlessGl, SaysWhatTheDriverLacksWhenItIsTooOld) {
    if (const auto usual = GlContext::createHeadless();
        usual && (*usual)->renderer().find("llvmpipe") == std::string::npos)
        GTEST_SKIP() << "Only Mesa's drivers can be told to look old.";
    ::setenv("MESA_GL_VERSION_OVERRIDE", "3.3", 1);
    ::setenv("MESA_GLSL_VERSION_OVERRIDE", "330", 1);
    const auto context = GlContext::createHeadless();
    ::unsetenv("MESA_GL_VERSION_OVERRIDE");
    ::unsetenv("MESA_GLSL_VERSION_OVERRIDE");
    ASSERT_FALSE(context);
    EXPECT_EQ(context.error().code, ErrorCode::ResourceLimit);
    EXPECT_EQ(context.error().subject, "OpenGL 4.5 core");
    EXPECT_NE(context.error().what.find("Mesa surfaceless: "), std::string::npos)
        << context.error().message();
    EXPECT_NE(context.error().remedy.find("libgl1-mesa-dri"), std::string::npos);
}

}  // namespace
}  // namespace reflet
