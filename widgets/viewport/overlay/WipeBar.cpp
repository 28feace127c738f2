// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/overlay/WipeBar.h"

#include "widgets/viewport/overlay/Plates.h"

#include <QAccessible>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr int kWidth = 36;  // of the widget: as wide as the handle, easy to hit
constexpr double kHandleRadius = 15.0;
constexpr double kHandleHeight = 0.5;  // share of the height at which the handle sits
constexpr int kPlateTop = 14;
constexpr int kPlateGap = 14;  // between bar and name plate
constexpr double kKeyStep = 0.02;
constexpr double kKeyLeap = 0.1;

void drawArrow(QPainter& painter, const QPointF& tip, double direction) {
    QPainterPath path;
    path.moveTo(tip);
    path.lineTo(tip + QPointF(-5.0 * direction, -5.0));
    path.lineTo(tip + QPointF(-5.0 * direction, 5.0));
    path.closeSubpath();
    painter.fillPath(path, painter.pen().color());
}

}  // namespace

WipeBar::WipeBar(QWidget* parent)
    : QWidget(parent), m_left(makePlate(parent)), m_right(makePlate(parent)) {
    setObjectName(QStringLiteral("wipe"));
    m_left->setObjectName(QStringLiteral("wipeLeft"));
    m_right->setObjectName(QStringLiteral("wipeRight"));
    setFocusPolicy(Qt::StrongFocus);
    setCursor(Qt::SplitHCursor);
    setAccessibleName(tr("Wipe between two methods"));
    setToolTip(tr("Drag to compare; with the keyboard: arrow keys, Home and End"));
    m_left->hide();
    m_right->hide();
    hide();
}

void WipeBar::setNames(const QString& left, const QString& right) {
    m_left->setText(left);
    m_right->setText(right);
    describe();
    layOut();
}

void WipeBar::describe() {
    setAccessibleDescription(tr("left: %1, right: %2; at %3 percent")
                                 .arg(m_left->text(), m_right->text())
                                 .arg(std::lround(100.0 * m_share)));
}

void WipeBar::setShare(double share) {
    const double wanted = std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.5;
    if (wanted != m_share) {
        m_share = wanted;
        describe();
        layOut();
    }
}

void WipeBar::moveTo(double share) {
    const double before = m_share;
    setShare(share);
    if (m_share != before) {
        Q_EMIT moved(m_share);
    }
}

void WipeBar::layOut() {
    const int width = parentWidget()->width();
    const int x = int(std::lround(m_share * width));
    setGeometry(x - kWidth / 2, 0, kWidth, parentWidget()->height());
    for (QLabel* plate : {m_left, m_right}) {
        plate->adjustSize();
    }
    // A plate that would be cut off at the border vanishes: its side is hardly there any more.
    m_left->move(x - kPlateGap - m_left->width(), kPlateTop);
    m_right->move(x + kPlateGap, kPlateTop);
    m_left->setVisible(isVisible() && m_left->x() >= 0);
    m_right->setVisible(isVisible() && m_right->geometry().right() < width);
    raise();
}

QRectF WipeBar::handle() const {
    const QPointF middle(0.5 * width(), kHandleHeight * height());
    return {middle.x() - kHandleRadius, middle.y() - kHandleRadius, 2.0 * kHandleRadius,
            2.0 * kHandleRadius};
}

void WipeBar::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const double x = 0.5 * width();
    // White with a dark rim: visible on sky and on shadow alike.
    painter.setPen(QPen(QColor(0, 0, 0, 90), 4.0));
    painter.drawLine(QPointF(x, 0.0), QPointF(x, height()));
    painter.setPen(QPen(Qt::white, 2.0));
    painter.drawLine(QPointF(x, 0.0), QPointF(x, height()));

    const QRectF knob = handle();
    painter.setPen(QPen(hasFocus() ? palette().color(QPalette::Highlight) : QColor(0, 0, 0, 90),
                        hasFocus() ? 3.0 : 1.5));
    painter.setBrush(Qt::white);
    painter.drawEllipse(knob);
    painter.setPen(QColor(50, 54, 60));
    drawArrow(painter, knob.center() + QPointF(-10.0, 0.0), -1.0);
    drawArrow(painter, knob.center() + QPointF(10.0, 0.0), 1.0);
}

void WipeBar::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton) {
        event->ignore();
        return;
    }
    m_dragging = true;
    m_shareBefore = m_share;
    m_grabOffset = int(event->position().x()) - width() / 2;
    event->accept();
}

void WipeBar::mouseMoveEvent(QMouseEvent* event) {
    if (m_dragging) {
        const double x = mapToParent(event->position()).x() - m_grabOffset;
        moveTo(x / std::max(1, parentWidget()->width()));
    }
}

void WipeBar::mouseReleaseEvent(QMouseEvent* event) {
    m_dragging = m_dragging && event->button() != Qt::LeftButton;
}

bool WipeBar::event(QEvent* event) {
    // These keys are the bar's own while it has the focus, whatever shortcuts a window has.
    if (event->type() == QEvent::ShortcutOverride) {
        switch (static_cast<QKeyEvent*>(event)->key()) {
            case Qt::Key_Left:
            case Qt::Key_Right:
            case Qt::Key_Home:
            case Qt::Key_End:
                event->accept();
                return true;
            case Qt::Key_Escape:
                event->setAccepted(m_dragging);
                return m_dragging;
            default:
                break;
        }
    }
    return QWidget::event(event);
}

void WipeBar::keyPressEvent(QKeyEvent* event) {
    const double step = (event->modifiers() & Qt::ShiftModifier) != 0 ? kKeyLeap : kKeyStep;
    switch (event->key()) {
        case Qt::Key_Left:
            moveTo(m_share - step);
            break;
        case Qt::Key_Right:
            moveTo(m_share + step);
            break;
        case Qt::Key_Home:
            moveTo(0.0);
            break;
        case Qt::Key_End:
            moveTo(1.0);
            break;
        case Qt::Key_Escape:
            if (m_dragging) {
                m_dragging = false;
                moveTo(m_shareBefore);
                break;
            }
            [[fallthrough]];
        default:
            QWidget::keyPressEvent(event);
    }
}

void WipeBar::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    layOut();
}

void WipeBar::hideEvent(QHideEvent* event) {
    QWidget::hideEvent(event);
    m_left->hide();
    m_right->hide();
}

void WipeBar::focusInEvent(QFocusEvent* event) {
    QWidget::focusInEvent(event);
    update();
}

void WipeBar::focusOutEvent(QFocusEvent* event) {
    QWidget::focusOutEvent(event);
    update();
}

}  // namespace reflet
