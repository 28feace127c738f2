// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/city/TexturePages.h"

#include "core/baking/MipTexture.h"
#include "core/base/ParallelFor.h"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace reflet {

namespace {

constexpr int kBorder = 1;
constexpr int kSmallestPage = 256;
constexpr int kLargestPage = 2048;
constexpr int kMaxLayers = 2048;  ///< least that OpenGL 4.5 promises

glm::ivec2 blockSize(const glm::ivec2& image) {
    // Level 1 and the column of the levels below it are at most half as wide, with their borders.
    int height = 0;
    for (int level = 1; (std::max(image.x, image.y) >> level) > 0; ++level) {
        height += std::max(image.y >> level, 1) + 2 * kBorder;
    }
    return {image.x + std::max(image.x / 2, 1) + 4 * kBorder,
            std::max(image.y + 2 * kBorder, height)};
}

struct Slot {
    std::size_t texture = 0;
    int firstLevel = 0;
    glm::ivec2 size{0};  ///< of the first level that is kept
    glm::ivec2 at{0};
    int page = 0;
};

/// Shelves: images in rows, the highest first. Returns the number of pages.
int pack(std::vector<Slot>& slots, int edge) {
    std::sort(slots.begin(), slots.end(), [](const Slot& a, const Slot& b) {
        return a.size.y != b.size.y ? a.size.y > b.size.y : a.texture < b.texture;
    });
    glm::ivec2 pen{0};
    int shelf = 0;
    int page = 0;
    for (Slot& slot : slots) {
        const glm::ivec2 block = blockSize(slot.size);
        if (pen.x + block.x > edge) {
            pen = {0, pen.y + shelf};
            shelf = 0;
        }
        if (pen.y + block.y > edge) {
            pen = {0, 0};
            shelf = 0;
            ++page;
        }
        slot.at = pen + kBorder;
        slot.page = page;
        pen.x += block.x;
        shelf = std::max(shelf, block.y);
    }
    return slots.empty() ? 0 : page + 1;
}

int wrapped(int i, int n, bool repeat) {
    return repeat ? (i + n) % n : std::clamp(i, 0, n - 1);
}

/// Copies a level with its border.
void place(const TextureImage& level, bool repeat, const glm::ivec2& at, int edge,
           std::uint8_t* page) {
    for (int y = -kBorder; y < level.height + kBorder; ++y) {
        const int row = wrapped(y, level.height, repeat);
        const std::uint8_t* from = &level.rgba[4 * std::size_t(row) * std::size_t(level.width)];
        std::uint8_t* to =
            page + 4 * (std::size_t(at.y + y) * std::size_t(edge) + std::size_t(at.x));
        std::memcpy(to, from, 4 * std::size_t(level.width));
        std::memcpy(to - 4, from + 4 * wrapped(-1, level.width, repeat), 4);
        std::memcpy(to + 4 * std::ptrdiff_t(level.width),
                    from + 4 * wrapped(level.width, level.width, repeat), 4);
    }
}

bool usable(const TextureImage& image) {
    return image.width > 0 && image.height > 0 &&
           image.rgba.size() == 4 * std::size_t(image.width) * std::size_t(image.height);
}

glm::ivec2 levelSize(const TextureImage& image, int level) {
    return {std::max(image.width >> level, 1), std::max(image.height >> level, 1)};
}

/// What fits on the largest page and, together, into the budget.
std::vector<Slot> chooseLevels(const std::vector<TextureImage>& images, std::size_t budget,
                               int& dropped) {
    std::vector<Slot> slots;
    for (std::size_t i = 0; i < images.size(); ++i) {
        if (usable(images[i])) {
            slots.push_back({i, 0, levelSize(images[i], 0), {}, 0});
        }
    }
    const auto bytes = [](const Slot& s) {
        const glm::ivec2 block = blockSize(s.size);
        return 4 * std::size_t(block.x) * std::size_t(block.y);
    };
    for (int largest = kLargestPage; largest > 1; largest /= 2) {
        std::size_t total = 0;
        for (Slot& s : slots) {
            while (blockSize(s.size).x > largest || blockSize(s.size).y > largest) {
                s.size = levelSize(images[s.texture], ++s.firstLevel);
                dropped = std::max(dropped, s.firstLevel);
            }
            total += bytes(s);
        }
        if (total <= budget) {
            break;
        }
    }
    return slots;
}

}  // namespace

glm::ivec2 TexturePages::levelOffset(int width, int height, int level) {
    if (level == 0) {
        return {0, 0};
    }
    glm::ivec2 at{width + 2 * kBorder, 0};
    for (int l = 1; l < level; ++l) {
        at.y += std::max(height >> l, 1) + 2 * kBorder;
    }
    return at;
}

TexturePages layOutTextures(const CityModel& city, const std::vector<TextureImage>& images,
                            std::size_t budget) {
    TexturePages pages;
    pages.places.assign(std::max<std::size_t>(city.textures.size(), 1), glm::uvec4(0U));
    std::vector<Slot> slots = chooseLevels(images, budget, pages.droppedLevels);
    if (slots.empty()) {
        return pages;
    }
    pages.edge = kSmallestPage;
    for (; pages.edge < kLargestPage; pages.edge *= 2) {
        const bool fits = std::all_of(slots.begin(), slots.end(), [&](const Slot& s) {
            const glm::ivec2 block = blockSize(s.size);
            return block.x <= pages.edge && block.y <= pages.edge;
        });
        if (fits && pack(slots, pages.edge) <= 4) {
            break;
        }
    }
    pages.layers = std::min(pack(slots, pages.edge), kMaxLayers);
    const std::size_t pageBytes = 4 * std::size_t(pages.edge) * std::size_t(pages.edge);
    pages.rgba.resize(pageBytes * std::size_t(pages.layers));
    parallelFor(0, slots.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const Slot& s = slots[i];
            if (s.texture >= city.textures.size() || s.page >= pages.layers) {
                continue;
            }
            const bool repeat = city.textures[s.texture].repeat;
            const MipTexture chain(images[s.texture], repeat);
            const auto levels = int(chain.levels().size()) - s.firstLevel;
            for (int level = 0; level < levels; ++level) {
                place(*chain.levels()[std::size_t(s.firstLevel + level)], repeat,
                      s.at + TexturePages::levelOffset(s.size.x, s.size.y, level), pages.edge,
                      pages.rgba.data() + pageBytes * std::size_t(s.page));
            }
            pages.places[s.texture] = {
                std::uint32_t(s.at.x), std::uint32_t(s.at.y),
                std::uint32_t(s.page) | std::uint32_t(levels) << 16 | (repeat ? 1U << 31 : 0U),
                std::uint32_t(s.size.x) | std::uint32_t(s.size.y) << 16};
        }
    });
    return pages;
}

}  // namespace reflet
