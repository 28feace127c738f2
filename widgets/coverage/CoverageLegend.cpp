// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/coverage/CoverageLegend.h"

#include "core/gpu/overlay/CoverageOverlay.h"
#include "widgets/coverage/CoverageLook.h"
#include "widgets/viewport/overlay/Plates.h"

#include <QLinearGradient>
#include <QPainter>
#include <algorithm>

namespace reflet {

namespace {

constexpr int kMargin = 9;
constexpr int kGap = 5;
constexpr int kBar = 10;          // pixels, height of the scale
constexpr int kLeastWidth = 196;  // of the scale
constexpr int kMark = 18;         // width of a mark before its words

QString facadeWords() {
    return CoverageLegend::tr("Façade that no probe shows");
}

QString ghostWords() {
    return CoverageLegend::tr("Suggested probe: click to accept");
}

}  // namespace

CoverageLegend::CoverageLegend(QWidget* parent) : QWidget(parent) {
    setObjectName(QStringLiteral("coverageLegend"));
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setAccessibleName(tr("Coverage: dark blue is 0 %, yellow is 100 %; below 50 % is hatched"));
    resize(sizeHint());
}

void CoverageLegend::setGhosts(bool shown) {
    if (shown != m_ghosts) {
        m_ghosts = shown;
        resize(sizeHint());
        update();
    }
}

QSize CoverageLegend::sizeHint() const {
    const int line = fontMetrics().height();
    int width = std::max(kLeastWidth, kMark + 4 + fontMetrics().horizontalAdvance(facadeWords()));
    if (m_ghosts)
        width = std::max(width, kMark + 4 + fontMetrics().horizontalAdvance(ghostWords()));
    return {width + 2 * kMargin, 2 * kMargin + line + kBar + kGap + rows() * (line + kGap)};
}

void CoverageLegend::paintEvent(QPaintEvent* /*event*/) {
    const PlateColors colors(palette());
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    paintPlate(painter, rect(), colors);
    const int line = fontMetrics().height();
    const int inner = width() - 2 * kMargin;
    int y = kMargin;
    painter.setPen(colors.text);
    QFont bold = font();
    bold.setBold(true);
    painter.setFont(bold);
    painter.drawText(QRect(kMargin, y, inner, line), Qt::AlignLeft | Qt::AlignVCenter,
                     tr("Coverage"));
    painter.setFont(font());
    y += line;
    QLinearGradient scale(kMargin, 0.0, kMargin + inner, 0.0);
    for (int i = 0; i <= 10; ++i)
        scale.setColorAt(0.1 * i, coverageTone(0.1 * i));
    const QRect bar(kMargin, y + 2, inner, kBar);
    painter.setPen(QPen(colors.text, 1.0));
    painter.setBrush(scale);
    painter.drawRect(bar);
    const QRect poor(bar.left(), bar.top(), int(kPoorlyCovered * bar.width()), bar.height());
    painter.setClipRect(poor);
    painter.setPen(QPen(Qt::white, 1.6));
    for (int x = poor.left() - kBar; x < poor.right(); x += 8)
        painter.drawLine(x, poor.bottom() + 1, x + kBar, poor.top());
    painter.setClipping(false);
    y += kBar + kGap;
    painter.setPen(colors.text);
    const QRect under(kMargin, y, inner, line);
    painter.drawText(under, Qt::AlignLeft, percentText(0.0, 0));
    painter.drawText(under, Qt::AlignHCenter, percentText(0.5, 0));
    painter.drawText(under, Qt::AlignRight, percentText(1.0, 0));
    y += line + kGap;
    const auto words = [&](const QString& text) {
        painter.setPen(colors.text);
        painter.drawText(QRect(kMargin + kMark + 4, y, inner - kMark, line),
                         Qt::AlignLeft | Qt::AlignVCenter, text);
        y += line + kGap;
    };
    const auto middle = [&] { return QPointF(kMargin + 0.5 * kMark, y + 0.5 * line); };
    painter.setPen(QPen(coverageTone(0.1), 2.0));
    painter.setBrush(Qt::white);
    painter.drawRect(QRectF(middle() - QPointF(4.0, 4.0), QSizeF(8.0, 8.0)));
    words(facadeWords());
    if (m_ghosts) {
        paintGhostMark(painter, middle(), 6.0);
        words(ghostWords());
    }
}

}  // namespace reflet
