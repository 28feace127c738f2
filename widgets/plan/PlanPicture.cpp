// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/plan/PlanPicture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet {

namespace {

constexpr double kMostPixels = 16e6;      ///< of level 0
constexpr float kRoofHeight = 2.0F;       ///< metres above the ground from which it is no kerb
constexpr int kShadowCells = 14;          ///< how far a shadow is followed
constexpr float kShadowSlope = 1.1F;      ///< of the light's rays, metres a metre
constexpr float kSmallestLevel = 256.0F;  ///< pixels along an edge

/// One level's worth of heights, sampled every `stride` cells, row 0 north.
struct Relief {
    int columns = 0;
    int rows = 0;
    float spacing = 1.0F;
    const Heightfield* field = nullptr;
    int stride = 1;

    [[nodiscard]] std::size_t cell(int x, int y) const {
        const int i = std::min(x * stride, field->grid.columns - 1);
        const int j = std::max(0, field->grid.rows - 1 - y * stride);
        return field->grid.index(i, j);
    }
    [[nodiscard]] float top(int x, int y) const {
        return field->topCenter[cell(std::clamp(x, 0, columns - 1), std::clamp(y, 0, rows - 1))];
    }
};

struct Tint {
    float red, green, blue;
};

Tint mix(const Tint& a, const Tint& b, float t) {
    return {a.red + t * (b.red - a.red), a.green + t * (b.green - a.green),
            a.blue + t * (b.blue - a.blue)};
}

/// share: 0 at the lowest ground of the city, 1 at the highest.
Tint groundTint(float share) {
    return mix({196.0F, 203.0F, 204.0F}, {226.0F, 222.0F, 208.0F}, share);
}

/// above: metres over the ground.
Tint roofTint(float above) {
    const float share = std::clamp(std::log2(above / kRoofHeight) / 5.0F, 0.0F, 1.0F);
    return mix({222.0F, 184.0F, 150.0F}, {150.0F, 88.0F, 72.0F}, share);
}

/// Lambert's law for a light from the north-west, 45 degrees high, flattened for a quiet map.
float hillshade(const Relief& relief, int x, int y) {
    const float here = relief.top(x, y);
    const auto height = [&](int u, int v) {
        const float top = relief.top(u, v);
        return isMissing(top) ? here : top;
    };
    // Walls would be black and white lines: slopes are limited.
    const auto slope = [&](float difference) {
        return std::clamp(difference / (2.0F * relief.spacing), -1.5F, 1.5F);
    };
    const float east = slope(height(x + 1, y) - height(x - 1, y));
    const float south = slope(height(x, y + 1) - height(x, y - 1));
    const float cosine =
        (0.5F * east + 0.5F * south + 0.7071F) / std::sqrt(1.0F + east * east + south * south);
    return 0.55F + 0.64F * std::clamp(cosine, 0.0F, 1.0F);
}

/// 1 in full light, less under what stands to the north-west.
float openness(const Relief& relief, int x, int y, float here) {
    float worst = 0.0F;
    for (int step = 1; step <= kShadowCells; ++step) {
        if (x - step < 0 || y - step < 0)
            break;
        const float top = relief.top(x - step, y - step);
        const float ray = here + kShadowSlope * 1.4142F * relief.spacing * float(step);
        if (!isMissing(top) && top > ray)
            worst = std::max(worst, std::min(1.0F, (top - ray) / 2.0F));
    }
    return 1.0F - 0.32F * worst;
}

std::array<float, 2> groundRange(const Heightfield& field) {
    constexpr std::size_t kSamples = 50'000;
    const std::size_t step = std::max<std::size_t>(1, field.ground.size() / kSamples);
    std::vector<float> heights;
    for (std::size_t i = 0; i < field.ground.size(); i += step)
        if (!isMissing(field.ground[i]))
            heights.push_back(field.ground[i]);
    if (heights.empty())
        return {0.0F, 1.0F};
    std::sort(heights.begin(), heights.end());
    const float low = heights[heights.size() / 50];
    const float high = heights[heights.size() - 1 - heights.size() / 50];
    return {low, std::max(high, low + 10.0F)};  // a flat city has one colour, not noise
}

QRgb shade(const Relief& relief, const std::array<float, 2>& range, int x, int y) {
    const float top = relief.top(x, y);
    if (isMissing(top))
        return qRgba(0, 0, 0, 0);
    const float ground = relief.field->ground[relief.cell(x, y)];
    const float above = isMissing(ground) ? 0.0F : top - ground;
    const bool roof = above > kRoofHeight;
    const Tint tint =
        roof ? roofTint(above)
             : groundTint(std::clamp((top - range[0]) / (range[1] - range[0]), 0.0F, 1.0F));
    const float light = hillshade(relief, x, y) * openness(relief, x, y, top);
    const auto channel = [light](float value) {
        return int(std::clamp(value * light, 0.0F, 255.0F));
    };
    return qRgb(channel(tint.red), channel(tint.green), channel(tint.blue));
}

}  // namespace

std::shared_ptr<const PlanPicture> paintPlan(const Heightfield& heightfield,
                                             const std::stop_token& stop) {
    const GridSpec& grid = heightfield.grid;
    if (grid.cellCount() == 0)
        return nullptr;
    Relief relief;
    relief.field = &heightfield;
    relief.stride = std::max(1, int(std::ceil(std::sqrt(double(grid.cellCount()) / kMostPixels))));
    relief.columns = (grid.columns + relief.stride - 1) / relief.stride;
    relief.rows = (grid.rows + relief.stride - 1) / relief.stride;
    relief.spacing = float(grid.cellSize * relief.stride);

    auto picture = std::make_shared<PlanPicture>();
    picture->west = grid.x0;
    picture->north = grid.yMax();
    picture->metresAPixel = grid.cellSize * relief.stride;
    const std::array<float, 2> range = groundRange(heightfield);
    QImage image(relief.columns, relief.rows, QImage::Format_ARGB32_Premultiplied);
    if (image.isNull())
        return nullptr;
    for (int y = 0; y < relief.rows; ++y) {
        if (stop.stop_requested())
            return nullptr;
        auto* line = reinterpret_cast<QRgb*>(image.scanLine(y));
        for (int x = 0; x < relief.columns; ++x)
            line[x] = shade(relief, range, x, y);
    }
    picture->levels.push_back(image);
    while (float(std::max(image.width(), image.height())) > kSmallestLevel) {
        if (stop.stop_requested())
            return nullptr;
        image = image.scaled(std::max(1, image.width() / 2), std::max(1, image.height() / 2),
                             Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
        picture->levels.push_back(image);
    }
    return picture;
}

}  // namespace reflet
