// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/EglDisplays.h"

#include <gtest/gtest.h>

namespace reflet {
namespace {

TEST(EglDisplays, FindsAnExtensionOnlyAsAWholeWord) {
    const char* extensions = "EGL_EXT_device_base  EGL_EXT_device_query EGL_MESA_x";
    EXPECT_TRUE(hasExtension(extensions, "EGL_EXT_device_base"));
    EXPECT_TRUE(hasExtension(extensions, "EGL_EXT_device_query"));
    EXPECT_TRUE(hasExtension(extensions, "EGL_MESA_x"));
    EXPECT_FALSE(hasExtension(extensions, "EGL_EXT_device"));
    EXPECT_FALSE(hasExtension(extensions, "EGL_MESA_x_y"));
    EXPECT_FALSE(hasExtension(extensions, "MESA_x"));
    EXPECT_FALSE(hasExtension("", "EGL_MESA_x"));
    EXPECT_FALSE(hasExtension(nullptr, "EGL_MESA_x"));
}

TEST(EglDisplays, NamesThePathOfEveryCandidate) {
    const auto candidates = eglDisplayCandidates();
    if (candidates.empty())
        GTEST_SKIP() << "EGL offers no display here.";
    for (const auto& candidate : candidates) {
        EXPECT_NE(candidate.display, nullptr);
        EXPECT_FALSE(candidate.path.empty());
    }
}

}  // namespace
}  // namespace reflet
