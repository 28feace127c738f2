// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/ImageText.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace reflet {

namespace {

namespace oiio = OIIO;

/// The first of these fonts that the system has; empty when it has none.
const std::string& fontName() {
    static const std::string found = [] {
        for (const char* name :
             {"DejaVuSans", "LiberationSans-Regular", "NotoSans-Regular", "FreeSans", "Arial"})
            if (oiio::ImageBufAlgo::text_size("x", 12, name).defined())
                return std::string(name);
        return std::string();
    }();
    return found;
}

/// The letters of Latin scripts (U+00C0 to U+017F) by those of English.
constexpr std::uint32_t kFirstLetter = 0xC0;
constexpr std::array<const char*, 192> kLetters{
    "A", "A", "A",  "A",  "Ae", "A", "Ae", "C", "E", "E", "E", "E", "I",  "I", "I",  "I",
    "D", "N", "O",  "O",  "O",  "O", "Oe", "x", "O", "U", "U", "U", "Ue", "Y", "Th", "ss",
    "a", "a", "a",  "a",  "ae", "a", "ae", "c", "e", "e", "e", "e", "i",  "i", "i",  "i",
    "d", "n", "o",  "o",  "o",  "o", "oe", "/", "o", "u", "u", "u", "ue", "y", "th", "y",
    "A", "a", "A",  "a",  "A",  "a", "C",  "c", "C", "c", "C", "c", "C",  "c", "D",  "d",
    "D", "d", "E",  "e",  "E",  "e", "E",  "e", "E", "e", "E", "e", "G",  "g", "G",  "g",
    "G", "g", "G",  "g",  "H",  "h", "H",  "h", "I", "i", "I", "i", "I",  "i", "I",  "i",
    "I", "i", "IJ", "ij", "J",  "j", "K",  "k", "k", "L", "l", "L", "l",  "L", "l",  "L",
    "l", "L", "l",  "N",  "n",  "N", "n",  "N", "n", "n", "N", "n", "O",  "o", "O",  "o",
    "O", "o", "Oe", "oe", "R",  "r", "R",  "r", "R", "r", "S", "s", "S",  "s", "S",  "s",
    "S", "s", "T",  "t",  "T",  "t", "T",  "t", "U", "u", "U", "u", "U",  "u", "U",  "u",
    "U", "u", "U",  "u",  "W",  "w", "Y",  "y", "Y", "Z", "z", "Z", "z",  "Z", "z",  "s"};

std::string folded(std::uint32_t character) {
    if (character >= kFirstLetter && character < kFirstLetter + kLetters.size())
        return kLetters[character - kFirstLetter];
    switch (character) {
        case 0xA0:  // no-break space
            return " ";
        case 0xB1:
            return "+/-";
        case 0xB2:
            return "2";
        case 0x2013:
        case 0x2014:
            return "-";
        case 0x2019:
            return "'";
        default:
            return "?";
    }
}

/// The text in ASCII. OpenImageIO 2.4 decodes no character of UTF-8 that has several bytes right:
/// it would draw a digit in the place of a letter.
std::string inAscii(const std::string& text) {
    std::string out;
    for (std::size_t k = 0; k < text.size();) {
        const auto first = static_cast<unsigned char>(text[k++]);
        if (first < 0x80U) {
            out += char(first);
            continue;
        }
        std::uint32_t character = first & (first < 0xE0U ? 0x1FU : first < 0xF0U ? 0x0FU : 0x07U);
        while (k < text.size() && (static_cast<unsigned char>(text[k]) & 0xC0U) == 0x80U)
            character = character << 6U | (static_cast<unsigned char>(text[k++]) & 0x3FU);
        out += folded(character);
    }
    return out;
}

tl::unexpected<Error> noFont() {
    return fail(ErrorCode::Refused, "there is no font to write into a picture with", "",
                "Install one, as the package fonts-dejavu-core.");
}

}  // namespace

Result<int> textWidth(const std::string& text, int size) {
    if (fontName().empty())
        return noFont();
    const oiio::ROI box = oiio::ImageBufAlgo::text_size(inAscii(text), size, fontName());
    return box.defined() ? box.width() : 0;
}

Result<void> drawTexts(DisplayImage& image, const std::vector<ImageText>& texts) {
    if (texts.empty())
        return {};
    if (fontName().empty())
        return noFont();
    // The buffer is the picture's own pixels.
    static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
    oiio::ImageBuf buffer(oiio::ImageSpec(image.width, image.height, 3, oiio::TypeDesc::FLOAT),
                          image.pixels.data());
    for (const ImageText& text : texts) {
        const std::string words = inAscii(text.text);
        const oiio::ROI box = oiio::ImageBufAlgo::text_size(words, text.size, fontName());
        if (!box.defined())
            continue;
        const int x = text.align == ImageText::Align::Left     ? text.at.x
                      : text.align == ImageText::Align::Middle ? text.at.x - box.width() / 2
                                                               : text.at.x - box.width();
        // The library asserts that some of it lies in the picture.
        const bool visible = x + box.xend > 0 && x + box.xbegin < image.width &&
                             text.at.y + box.yend > 0 && text.at.y + box.ybegin < image.height;
        if (!visible)
            continue;
        const std::array<float, 3> color{text.color.x, text.color.y, text.color.z};
        if (!oiio::ImageBufAlgo::render_text(buffer, x, text.at.y, words, text.size, fontName(),
                                             color))
            return fail(ErrorCode::Internal, "the text could not be drawn: " + buffer.geterror(),
                        text.text);
    }
    return {};
}

}  // namespace reflet
