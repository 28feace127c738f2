// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/overlay/Plates.h"

#include <QPainter>
#include <QPalette>

namespace reflet {

namespace {

constexpr int kOpacity = 205;  // of 255
constexpr double kCorner = 5.0;

class Plate : public QLabel {
public:
    explicit Plate(QWidget* parent) : QLabel(parent) {
        setAttribute(Qt::WA_TransparentForMouseEvents);
        setTextFormat(Qt::PlainText);
        setContentsMargins(9, 4, 9, 4);
    }

protected:
    void paintEvent(QPaintEvent* event) override {
        QPainter painter(this);
        paintPlate(painter, rect(), PlateColors(palette()));
        painter.end();
        QLabel::paintEvent(event);
    }
};

}  // namespace

PlateColors::PlateColors(const QPalette& palette)
    : ground(palette.color(QPalette::Window)), text(palette.color(QPalette::WindowText)) {
    ground.setAlpha(kOpacity);
}

QLabel* makePlate(QWidget* parent) {
    return new Plate(parent);
}

void paintPlate(QPainter& painter, const QRectF& area, const PlateColors& colors) {
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(colors.ground);
    painter.drawRoundedRect(area, kCorner, kCorner);
}

}  // namespace reflet
