// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/DragSlider.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QSignalBlocker>
#include <QStyle>
#include <QStyleOptionSlider>
#include <QWheelEvent>

namespace reflet {

namespace {

bool movesSlider(int key) {
    switch (key) {
        case Qt::Key_Left:
        case Qt::Key_Right:
        case Qt::Key_Up:
        case Qt::Key_Down:
        case Qt::Key_PageUp:
        case Qt::Key_PageDown:
        case Qt::Key_Home:
        case Qt::Key_End:
            return true;
        default:
            return false;
    }
}

}  // namespace

DragSlider::DragSlider(QWidget* parent)
    : QSlider(Qt::Horizontal, parent),
      m_sequence([this](int value, DragPhase phase) { Q_EMIT moved(value, phase); }) {
    setFocusPolicy(Qt::StrongFocus);
    connect(this, &QSlider::valueChanged, this, [this](int value) { m_sequence.step(value); });
}

void DragSlider::show(int value) {
    if (m_sequence.pressed())
        return;
    const QSignalBlocker quiet(this);
    setValue(value);
}

int DragSlider::valueAt(double x) const {
    QStyleOptionSlider option;
    initStyleOption(&option);
    const QRect groove =
        style()->subControlRect(QStyle::CC_Slider, &option, QStyle::SC_SliderGroove, this);
    const int handle =
        style()->subControlRect(QStyle::CC_Slider, &option, QStyle::SC_SliderHandle, this).width();
    const int span = groove.width() - handle;
    return QStyle::sliderValueFromPosition(
        minimum(), maximum(), int(x) - groove.left() - handle / 2, span, option.upsideDown);
}

void DragSlider::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton)
        return;
    m_mouse = true;
    m_sequence.press(value());
    setSliderDown(true);
    setValue(valueAt(event->position().x()));
}

void DragSlider::mouseMoveEvent(QMouseEvent* event) {
    if (m_mouse)
        setValue(valueAt(event->position().x()));
}

void DragSlider::mouseReleaseEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton || !m_mouse)
        return;
    m_mouse = false;
    setSliderDown(false);
    m_sequence.release();
}

void DragSlider::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Escape && m_sequence.pressed()) {
        m_mouse = false;
        setSliderDown(false);
        const int before = m_sequence.before();
        m_sequence.cancel();
        show(before);
        return;
    }
    if (movesSlider(event->key()) && !event->isAutoRepeat())
        m_sequence.press(value());
    QSlider::keyPressEvent(event);
}

void DragSlider::keyReleaseEvent(QKeyEvent* event) {
    QSlider::keyReleaseEvent(event);
    if (movesSlider(event->key()) && !event->isAutoRepeat() && !m_mouse)
        m_sequence.release();
}

void DragSlider::focusOutEvent(QFocusEvent* event) {
    QSlider::focusOutEvent(event);
    m_mouse = false;
    setSliderDown(false);
    m_sequence.release();
}

void DragSlider::wheelEvent(QWheelEvent* event) {
    if (hasFocus())
        QSlider::wheelEvent(event);
    else
        event->ignore();
}

}  // namespace reflet
