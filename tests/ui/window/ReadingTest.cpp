// SPDX-License-Identifier: GPL-3.0-or-later
// What a file does not tell in the usual words is told in the inspector.
#include "app/document/ProjectDocument.h"
#include "core/heightfield/Heightfield.h"
#include "tests/ui/window/WindowTestSupport.h"
#include "widgets/common/NumberEdit.h"
#include "widgets/inspector/Inspector.h"
#include "widgets/panels/MessageBar.h"

#include <QLabel>
#include <algorithm>
#include <cmath>

namespace reflet::test {
namespace {

class ReadingTest : public WindowTest {
protected:
    /// Two houses of 30 and 21 m, by an attribute that nobody guesses.
    std::filesystem::path footprints() {
        const auto house = [](double x, double height) {
            return "{\"type\":\"Feature\",\"properties\":{\"oberkante_x\":" +
                   std::to_string(height) +
                   "},\"geometry\":{\"type\":\"Polygon\",\"coordinates\":[[[" + std::to_string(x) +
                   ",5700000],[" + std::to_string(x + 12.0) + ",5700000],[" +
                   std::to_string(x + 12.0) + ",5700012],[" + std::to_string(x) + ",5700012],[" +
                   std::to_string(x) + ",5700000]]]}}";
        };
        return folder.write("houses.geojson",
                            "{\"type\":\"FeatureCollection\",\"crs\":{\"type\":\"name\","
                            "\"properties\":{\"name\":\"urn:ogc:def:crs:EPSG::25832\"}},"
                            "\"features\":[" +
                                house(500000.0, 30.0) + "," + house(500030.0, 21.0) + "]}");
    }
    static void select(MainWindow& window) {
        const std::string path = window.document().project().models.front().path;
        window.document().selection()->set({ProjectItem::Kind::Model, path});
        ASSERT_TRUE(QTest::qWaitFor([&] { return field<QLineEdit>(window, "modelHeightField"); },
                                    kPatience));
    }
    template <class Field>
    static Field* field(MainWindow& window, const char* name) {
        return window.bench().inspector->findChild<Field*>(QString::fromLatin1(name));
    }
    static void type(QWidget* edit, const QString& text) {
        edit->setFocus();
        QTest::keyClick(edit, Qt::Key_A, Qt::ControlModifier);
        QTest::keyClicks(edit, text);
        QTest::keyClick(edit, Qt::Key_Return);
    }
    /// How far the highest roof is above the ground.
    static double tallest(MainWindow& window) {
        const auto& city = window.bench().live->city();
        if (!city || !city->heightfield)
            return 0.0;
        const Heightfield& heights = *city->heightfield;
        double most = 0.0;
        for (std::size_t cell = 0; cell < heights.ground.size(); ++cell) {
            const float above = heights.topCenter[cell] - heights.ground[cell];
            most = std::max(most, above > 0.0F ? double(above) : 0.0);
        }
        return most;
    }
    static bool becomes(MainWindow& window, double height) {
        return QTest::qWaitFor([&] { return std::abs(tallest(window) - height) < 0.3; }, kPatience);
    }
};

TEST_F(ReadingTest, HousesGetTheirHeightsFromTheAttributeThatTheUserNames) {
    MainWindow window;
    open(window, footprints());
    ASSERT_TRUE(becomes(window, 9.0)) << "nothing is known of their heights: " << tallest(window);
    select(window);
    type(field<QLineEdit>(window, "modelHeightField"), QStringLiteral("oberkante_x"));
    EXPECT_TRUE(becomes(window, 30.0)) << tallest(window);
    EXPECT_EQ(window.document().project().models.front().heightField, "oberkante_x");
    press(window, Qt::Key_Z, Qt::ControlModifier);
    EXPECT_TRUE(becomes(window, 9.0)) << "undo";
    EXPECT_EQ(window.document().project().models.front().heightField, "");
    type(field<NumberEdit>(window, "modelDefaultHeight"), QStringLiteral("14"));
    EXPECT_TRUE(becomes(window, 14.0)) << tallest(window);
}

TEST_F(ReadingTest, AnAttributeThatIsNotThereIsToldAndLosesNothing) {
    MainWindow window;
    open(window, footprints());
    ASSERT_TRUE(becomes(window, 9.0));
    select(window);
    auto* height = field<QLineEdit>(window, "modelHeightField");
    type(height, QStringLiteral("no_such_attribute"));
    EXPECT_TRUE(QTest::qWaitFor(
        [&] {
            const auto labels = window.findChild<MessageBar*>()->findChildren<QLabel*>();
            return std::any_of(labels.begin(), labels.end(), [](const QLabel* label) {
                return label->text().contains(QStringLiteral("no_such_attribute"));
            });
        },
        kPatience));
    EXPECT_EQ(window.document().project().models.front().heightField, "");
    EXPECT_NEAR(tallest(window), 9.0, 0.3) << "the city stays";
    EXPECT_EQ(height->text(), QString()) << "the field shows what holds";
    type(height, QStringLiteral("oberkante_x"));
    EXPECT_TRUE(becomes(window, 30.0)) << tallest(window);
}

}  // namespace
}  // namespace reflet::test
