// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/ImageText.h"

#include <gtest/gtest.h>

namespace reflet {
namespace {

/// The columns of an image that are not white.
std::pair<int, int> inked(const DisplayImage& image) {
    int first = image.width, last = -1;
    for (int j = 0; j < image.height; ++j)
        for (int i = 0; i < image.width; ++i)
            if (image.pixels[std::size_t(j * image.width + i)] != glm::vec3(1.0F)) {
                first = std::min(first, i);
                last = std::max(last, i);
            }
    return {first, last};
}

TEST(ImageText, StandsWhereItsAlignmentSays) {
    const auto width = textWidth("96.1 %", 20);
    if (!width)
        GTEST_SKIP() << width.error().message();
    EXPECT_GT(*width, 40);
    EXPECT_LT(*width, 110);
    const auto drawn = [](ImageText::Align align) {
        DisplayImage image{300, 40, std::vector<glm::vec3>(300 * 40, glm::vec3(1.0F))};
        EXPECT_TRUE(drawTexts(image, {{"96.1 %", {150, 30}, 20, glm::vec3(0.0F), align}}));
        return inked(image);
    };
    const auto left = drawn(ImageText::Align::Left);
    const auto middle = drawn(ImageText::Align::Middle);
    const auto right = drawn(ImageText::Align::Right);
    EXPECT_NEAR(left.first, 150, 4);
    EXPECT_NEAR(right.second, 150, 4);
    EXPECT_NEAR(0.5 * (middle.first + middle.second), 150.0, 4.0);
}

TEST(ImageText, TellsOtherLettersByEnglishOnes) {
    const auto width = textWidth("Größe ± 2 m² – Łódź\xff", 20);
    if (!width)
        GTEST_SKIP() << width.error().message();
    EXPECT_EQ(*width, *textWidth("Groesse +/- 2 m2 - Lodz?", 20));
}

TEST(ImageText, MayLeaveThePicture) {
    DisplayImage image{20, 10, std::vector<glm::vec3>(200, glm::vec3(1.0F))};
    if (!textWidth("x", 12))
        GTEST_SKIP() << "no font";
    EXPECT_TRUE(drawTexts(image, {{"longer than that", {-30, 8}, 12, glm::vec3(0.0F)},
                                  {"below", {2, 90}, 12, glm::vec3(0.0F)},
                                  {"", {2, 2}, 12, glm::vec3(0.0F)}}));
}

}  // namespace
}  // namespace reflet
