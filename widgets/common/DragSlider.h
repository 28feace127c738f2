// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "widgets/common/DragSequence.h"

#include <QSlider>

namespace reflet {

/// A horizontal slider whose handle comes to where one presses, and that reports the phases of a
/// drag (mouse, or a held key). Escape takes a drag back. The wheel acts only with the focus, so
/// that scrolling a panel changes nothing.
class DragSlider : public QSlider {
    Q_OBJECT

public:
    explicit DragSlider(QWidget* parent = nullptr);

    /// Shows a value without reporting it; left alone while the user drags.
    void show(int value);
    using QSlider::show;
    [[nodiscard]] bool dragging() const { return m_sequence.pressed(); }

Q_SIGNALS:
    void moved(int value, reflet::DragPhase phase);

protected:
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void keyReleaseEvent(QKeyEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;

private:
    [[nodiscard]] int valueAt(double x) const;

    DragSequence<int> m_sequence;
    bool m_mouse = false;
};

}  // namespace reflet
