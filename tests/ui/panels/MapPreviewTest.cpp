// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/environment/CubeDirection.h"
#include "tests/ui/Patience.h"
#include "tests/ui/panels/PanelTestSupport.h"
#include "widgets/preview/MapCanvas.h"
#include "widgets/preview/MapPicture.h"
#include "widgets/preview/MapPreview.h"

#include <QLabel>
#include <QSignalSpy>
#include <QWheelEvent>
#include <set>

namespace reflet {
namespace {

constexpr int kSize = 8;

/// Each texel tells where it is: red its face, green its column, blue its row.
std::shared_ptr<const ReferenceEnvironmentMap> tellingMap() {
    auto map = std::make_shared<ReferenceEnvironmentMap>();
    map->radiance = CubeMap<glm::vec3>(kSize);
    map->distance = CubeMap<float>(kSize);
    for (int face = 0; face < 6; ++face) {
        for (int row = 0; row < kSize; ++row) {
            for (int column = 0; column < kSize; ++column) {
                map->radiance.at(face, column, row) = {0.1F * float(face), 0.1F * float(column),
                                                       0.1F * float(row)};
                map->distance.at(face, column, row) =
                    face == 4 ? kInfinity : float(1 + column + row);
            }
        }
    }
    return map;
}

TEST(MapPictureTest, TheCrossShowsEachTexelExactlyOnce) {
    std::set<std::array<int, 3>> seen;
    for (int y = 0; y < 3 * kSize; ++y)
        for (int x = 0; x < 4 * kSize; ++x)
            if (const auto texel = crossTexel(kSize, {x, y}))
                seen.insert({texel->face, texel->column, texel->row});
    EXPECT_EQ(seen.size(), std::size_t(6 * kSize * kSize));
}

TEST(MapPictureTest, NeighboursInTheMiddleRowOfTheCrossAreNeighboursInTheWorld) {
    for (int y = kSize; y < 2 * kSize; ++y) {
        for (int x = 0; x + 1 < 4 * kSize; ++x) {
            const auto a = crossTexel(kSize, {x, y});
            const auto b = crossTexel(kSize, {x + 1, y});
            ASSERT_TRUE(a && b);
            const auto direction = [](const Texel& t) {
                return glm::normalize(texelDirection(kSize, t.face, t.column, t.row));
            };
            EXPECT_GT(glm::dot(direction(*a), direction(*b)), 0.95) << x << ", " << y;
        }
    }
    // Upright: the row above is higher.
    EXPECT_GT(texelDirection(kSize, 2, crossTexel(kSize, {kSize + 3, kSize})->column,
                             crossTexel(kSize, {kSize + 3, kSize})->row)
                  .z,
              0.5);
}

TEST(MapPictureTest, TheMiddleOfTheBallLooksBackAndItsEdgeAhead) {
    EXPECT_LT(glm::length(*ballDirection(0.0, 0.0) - glm::dvec3(0.0, -1.0, 0.0)), 1e-12);
    EXPECT_LT(glm::length(*ballDirection(0.0, std::sqrt(0.5)) - glm::dvec3(0.0, 0.0, 1.0)), 1e-9);
    EXPECT_FALSE(ballDirection(0.8, 0.8).has_value());
}

TEST(MapPictureTest, SkyHasAColourThatNoDistanceHas) {
    const DistanceRange range{1.0F, 200.0F};
    for (float metres = 0.5F; metres < 500.0F; metres *= 1.03F)
        EXPECT_NE(distanceColor(metres, range), kSkyColor);
    EXPECT_EQ(distanceColor(kInfinity, range), kSkyColor);
}

TEST(MapPictureTest, WhatNoProbeSeesIsMarkedAndAllElseIsGrey) {
    constexpr int kEdge = 4;
    auto radiance = std::make_shared<CubeMap<glm::vec3>>(kEdge, glm::vec3(0.9F, 0.2F, 0.1F));
    auto distance = std::make_shared<CubeMap<float>>(kEdge, 5.0F);
    auto uncovered = std::make_shared<CubeMap<unsigned char>>(kEdge);
    uncovered->at(2, 1, 3) = 1;
    const QImage image = paintMap({radiance, distance, uncovered}, MapProjection::Cross,
                                  MapQuantity::Validity, 1.0F, {});
    int marked = 0;
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const auto texel = crossTexel(kEdge, {x, y});
            if (!texel)
                continue;
            const QRgb shown = image.pixel(x, y);
            if (*texel == Texel{2, 1, 3}) {
                EXPECT_EQ(shown, kUncoveredColor);
                ++marked;
            } else {
                EXPECT_EQ(qRed(shown), qBlue(shown));
            }
        }
    }
    EXPECT_EQ(marked, 1);
}

class MapPreviewTest : public testing::Test {
protected:
    void SetUp() override {
        test::showWidget(preview, 640, 560);
        canvas = test::child<MapCanvas>(preview, "mapCanvas");
        const QSignalSpy painted(canvas, &MapCanvas::painted);
        preview.setReference(tellingMap(), QStringLiteral("rem-1"));
        ASSERT_TRUE(QTest::qWaitFor([&] { return painted.count() > 0; }, test::kPatience));
    }
    MapPreview preview;
    MapCanvas* canvas = nullptr;
};

TEST_F(MapPreviewTest, TheValueUnderTheCursorIsThatOfTheTexelShownThere) {
    const QPoint point(canvas->width() / 2 - 40, canvas->height() / 2 + 12);
    const auto found = canvas->at(point);
    ASSERT_TRUE(found.has_value());
    test::moveMouse(*canvas, point, Qt::NoButton);
    const QString text = test::child<QLabel>(preview, "mapValue")->text();
    EXPECT_TRUE(text.contains(
        QStringLiteral("texel %1 / %2").arg(found->first.column).arg(found->first.row)))
        << text.toStdString();
    EXPECT_TRUE(text.contains(QStringLiteral("north"))) << text.toStdString();
}

TEST_F(MapPreviewTest, TheWheelZoomsToTheTexelUnderTheCursor) {
    const QPoint point(canvas->width() / 2 - 40, canvas->height() / 2 + 12);
    const auto before = canvas->at(point);
    for (int i = 0; i < 20; ++i) {
        QWheelEvent wheel(point, canvas->mapToGlobal(point), {}, {0, 120}, Qt::NoButton, {},
                          Qt::NoScrollPhase, false);
        QApplication::sendEvent(canvas, &wheel);
    }
    ASSERT_TRUE(canvas->at(point).has_value());
    EXPECT_EQ(canvas->at(point)->first, before->first);
    EXPECT_EQ(canvas->at(point + QPoint(5, 0))->first.face, before->first.face);
    QTest::keyClick(canvas, Qt::Key_Home);
    EXPECT_FALSE(canvas->at({2, 2}).has_value()) << "all of it is shown, the corner is empty";
}

TEST_F(MapPreviewTest, NoMapIsAnInvitationNotAnError) {
    preview.setReference(nullptr, QString());
    EXPECT_FALSE(canvas->at({100, 100}).has_value());
    test::moveMouse(*canvas, {100, 100}, Qt::NoButton);
    EXPECT_TRUE(test::child<QLabel>(preview, "mapValue")->text().isEmpty());
}

}  // namespace
}  // namespace reflet
