// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/EglDisplays.h"
#include "core/gpu/GlContext.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <memory>

namespace reflet::test {

/// A test with a current OpenGL 4.5 core context; skipped where EGL knows no display at all.
class GlFixture : public testing::Test {
protected:
    void SetUp() override {
        if (eglDisplayCandidates().empty())
            GTEST_SKIP() << "EGL offers no display here.";
        auto context = GlContext::createHeadless();
        ASSERT_TRUE(context) << context.error().message();
        m_context = std::move(*context);
        GLint profile = 0;
        glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
        ASSERT_EQ(profile, GL_CONTEXT_CORE_PROFILE_BIT);
        ASSERT_GE(epoxy_gl_version(), 45);
    }
    void TearDown() override {
        if (m_context) {
            EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
        }
    }

    std::unique_ptr<GlContext> m_context;
};

}  // namespace reflet::test
