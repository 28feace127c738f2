// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/CaptionedPictures.h"

#include "core/base/DotFont.h"

#include <algorithm>
#include <cctype>

namespace reflet {

namespace {

constexpr int kGap = 8;           // pixels between pictures, and around all
constexpr int kLettersWide = 40;  // that fit above a picture
constexpr glm::vec3 kInk{0.1F};

/// Pixels of a dot above a picture of that width.
int dotSize(int width) {
    return std::max(1, width / (kLettersWide * kDotAdvance));
}

int captionHeight(int width) {
    return kDotRows * dotSize(width) + kGap;
}

class Sheet {
public:
    Sheet(int width, int height)
        : m_image{
              width, height,
              std::vector<glm::vec3>(std::size_t(width) * std::size_t(height), glm::vec3(1.0F))} {}

    void put(const DisplayImage& image, int left, int top) {
        for (int row = 0; row < image.height; ++row) {
            std::copy_n(&image.pixels[std::size_t(row) * std::size_t(image.width)], image.width,
                        &at(left, top + row));
        }
    }
    void write(const std::string& text, int left, int top, int width) {
        const int dot = dotSize(width);
        for (std::size_t k = 0; k < text.size(); ++k) {
            const DotGlyph* glyph =
                dotGlyph(char(std::toupper(static_cast<unsigned char>(text[k]))));
            const int start = int(k) * kDotAdvance * dot;
            if (glyph == nullptr || start + kDotColumns * dot > width)
                continue;
            for (int i = 0; i < kDotRows * dot * kDotColumns * dot; ++i) {
                const int row = i / (kDotColumns * dot), column = i % (kDotColumns * dot);
                if (((*glyph)[std::size_t(row / dot)] >> (kDotColumns - 1 - column / dot)) & 1)
                    at(left + start + column, top + row) = kInk;
            }
        }
    }
    [[nodiscard]] DisplayImage take() { return std::move(m_image); }

private:
    glm::vec3& at(int column, int row) {
        return m_image.pixels[std::size_t(row) * std::size_t(m_image.width) + std::size_t(column)];
    }
    DisplayImage m_image;
};

}  // namespace

DisplayImage arranged(std::span<const std::vector<CaptionedPicture>> rows) {
    int width = 0, height = kGap;
    std::vector<int> tops;
    for (const auto& row : rows) {
        int wide = kGap, high = 0;
        for (const CaptionedPicture& picture : row) {
            wide += picture.image.width + kGap;
            high = std::max(high, captionHeight(picture.image.width) + picture.image.height);
        }
        tops.push_back(height);
        width = std::max(width, wide);
        height += high + kGap;
    }
    Sheet sheet(width, height);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        int left = kGap;
        for (const CaptionedPicture& picture : rows[i]) {
            const int wide = picture.image.width;
            sheet.write(picture.caption, left, tops[i], wide);
            sheet.put(picture.image, left, tops[i] + captionHeight(wide));
            left += wide + kGap;
        }
    }
    return sheet.take();
}

}  // namespace reflet
