// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/preview/MapPicture.h"

#include "core/environment/ImageMetrics.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>
#include <vector>

namespace reflet {

namespace {

constexpr int kBallPixels = 512;

struct Words {
    Q_DECLARE_TR_FUNCTIONS(reflet::MapPreview)
};

/// The sRGB curve by table, indexed by the square root: steps below a code value everywhere.
class DisplayCurve {
public:
    DisplayCurve() : m_codes(kSize + 1) {
        for (int i = 0; i <= kSize; ++i) {
            const float root = float(i) / float(kSize);
            m_codes[std::size_t(i)] = int(std::lround(255.0F * srgbFromLinear(root * root)));
        }
    }
    [[nodiscard]] int code(float linear) const {
        if (!(linear > 0.0F))  // and NaN
            return 0;
        const float root = std::sqrt(std::min(linear, 1.0F));
        return m_codes[std::size_t(root * float(kSize) + 0.5F)];
    }

private:
    static constexpr int kSize = 4096;
    std::vector<int> m_codes;
};

const DisplayCurve& displayCurve() {
    static const DisplayCurve curve;
    return curve;
}

class Colouring {
public:
    Colouring(const MapSource& source, MapQuantity quantity, float exposure)
        : m_source(source),
          m_quantity(quantity),
          m_exposure(exposure),
          m_range(distanceRange(*source.distance)) {}

    [[nodiscard]] QRgb of(const Texel& texel) const {
        if (m_quantity == MapQuantity::Distance)
            return distanceColor(m_source.distance->at(texel.face, texel.column, texel.row),
                                 m_range);
        const QRgb shown = color(m_source.radiance->at(texel.face, texel.column, texel.row));
        return m_quantity == MapQuantity::Validity ? marked(shown, texel) : shown;
    }
    /// Between texels; distances and marks are never mixed.
    [[nodiscard]] QRgb of(const glm::dvec3& direction) const {
        if (m_quantity != MapQuantity::Radiance)
            return of(texelAt(m_source.distance->resolution(), direction));
        return color(sampleBilinear(*m_source.radiance, direction));
    }

private:
    [[nodiscard]] QRgb marked(QRgb shown, const Texel& texel) const {
        const auto& uncovered = m_source.uncovered;
        if (uncovered && uncovered->at(texel.face, texel.column, texel.row) != 0)
            return kUncoveredColor;
        const int grey = qGray(shown) / 2;
        return qRgb(grey, grey, grey);
    }
    [[nodiscard]] QRgb color(const glm::vec3& radiance) const {
        const DisplayCurve& curve = displayCurve();
        return qRgb(curve.code(radiance.x * m_exposure), curve.code(radiance.y * m_exposure),
                    curve.code(radiance.z * m_exposure));
    }

    const MapSource& m_source;
    MapQuantity m_quantity;
    float m_exposure;
    DistanceRange m_range;
};

/// The texel of the map at (column, row) of an unfolded face.
Texel texelOfFace(int resolution, const CrossFace& face, int column, int row) {
    const double s = texelCoordinate(resolution, column);
    const double t = texelCoordinate(resolution, row);
    return texelAt(resolution, face.forward + s * face.right - t * face.up);
}

}  // namespace

DistanceRange distanceRange(const CubeMap<float>& distance) {
    std::vector<float> finite;
    constexpr std::size_t kSamples = 20'000;
    const auto& texels = distance.texels();
    const std::size_t step = std::max<std::size_t>(1, texels.size() / kSamples);
    for (std::size_t i = 0; i < texels.size(); i += step)
        if (std::isfinite(texels[i]) && texels[i] > 0.0F)
            finite.push_back(texels[i]);
    if (finite.empty())
        return {};
    std::sort(finite.begin(), finite.end());
    const float nearest = finite[finite.size() / 100];
    const float farthest = finite[finite.size() - 1 - finite.size() / 100];
    return {nearest, std::max(farthest, nearest * 1.5F)};
}

QRgb distanceColor(float distance, const DistanceRange& range) {
    if (!std::isfinite(distance))
        return kSkyColor;
    static constexpr std::array<std::array<int, 3>, 10> kViridis{{{68, 1, 84},
                                                                  {72, 40, 120},
                                                                  {62, 74, 137},
                                                                  {49, 104, 142},
                                                                  {38, 130, 142},
                                                                  {31, 158, 137},
                                                                  {53, 183, 121},
                                                                  {110, 206, 88},
                                                                  {181, 222, 43},
                                                                  {253, 231, 37}}};
    const float t = std::clamp(std::log(std::max(distance, 1e-6F) / range.nearest) /
                                   std::log(range.farthest / range.nearest),
                               0.0F, 1.0F) *
                    float(kViridis.size() - 1);
    const std::size_t i = std::min(std::size_t(t), kViridis.size() - 2);
    const float u = t - float(i);
    const auto channel = [&](std::size_t c) {
        return int(float(kViridis[i][c]) + u * float(kViridis[i + 1][c] - kViridis[i][c]));
    };
    return qRgb(channel(0), channel(1), channel(2));
}

const std::array<CrossFace, 6>& crossFaces() {
    static const std::array<CrossFace, 6> faces{{
        {2, 1, {1, 0, 0}, {0, -1, 0}, {0, 0, 1}},   // east
        {0, 1, {-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},   // west
        {1, 1, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}},    // north
        {3, 1, {0, -1, 0}, {-1, 0, 0}, {0, 0, 1}},  // south
        {1, 0, {0, 0, 1}, {1, 0, 0}, {0, -1, 0}},   // up
        {1, 2, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}},   // down
    }};
    return faces;
}

QString faceName(int face) {
    const std::array<QString, 6> names{Words::tr("+X east"),  Words::tr("−X west"),
                                       Words::tr("+Y north"), Words::tr("−Y south"),
                                       Words::tr("+Z up"),    Words::tr("−Z down")};
    return names[std::size_t(face)];
}

std::optional<Texel> crossTexel(int resolution, const QPoint& pixel) {
    if (resolution <= 0 || pixel.x() < 0 || pixel.y() < 0)
        return std::nullopt;
    for (const CrossFace& face : crossFaces())
        if (pixel.x() / resolution == face.column && pixel.y() / resolution == face.row)
            return texelOfFace(resolution, face, pixel.x() % resolution, pixel.y() % resolution);
    return std::nullopt;
}

std::optional<glm::dvec3> ballDirection(double x, double y) {
    const double squared = x * x + y * y;
    if (squared > 1.0)
        return std::nullopt;
    // The normal of a unit ball seen along +y, and the mirrored line of sight.
    const glm::dvec3 normal(x, -std::sqrt(1.0 - squared), y);
    const glm::dvec3 sight(0.0, 1.0, 0.0);
    return sight - 2.0 * glm::dot(sight, normal) * normal;
}

QImage paintMap(const MapSource& source, MapProjection projection, MapQuantity quantity,
                float exposure, const std::stop_token& stop) {
    if (!source.radiance || source.radiance->empty() || source.distance->empty())
        return {};
    const Colouring colouring(source, quantity, exposure);
    if (projection == MapProjection::Sphere) {
        QImage image(kBallPixels, kBallPixels, QImage::Format_ARGB32_Premultiplied);
        image.fill(Qt::transparent);
        for (int y = 0; y < kBallPixels; ++y) {
            if (stop.stop_requested())
                return {};
            auto* line = reinterpret_cast<QRgb*>(image.scanLine(y));
            for (int x = 0; x < kBallPixels; ++x)
                if (const auto direction = ballDirection(texelCoordinate(kBallPixels, x),
                                                         -texelCoordinate(kBallPixels, y)))
                    line[x] = colouring.of(*direction);
        }
        return image;
    }
    const int n = source.radiance->resolution();
    QImage image(4 * n, 3 * n, QImage::Format_ARGB32_Premultiplied);
    if (image.isNull())
        return {};
    image.fill(Qt::transparent);
    for (const CrossFace& face : crossFaces()) {
        for (int row = 0; row < n; ++row) {
            if (stop.stop_requested())
                return {};
            auto* line =
                reinterpret_cast<QRgb*>(image.scanLine(face.row * n + row)) + face.column * n;
            for (int column = 0; column < n; ++column)
                line[column] = colouring.of(texelOfFace(n, face, column, row));
        }
    }
    return image;
}

}  // namespace reflet
