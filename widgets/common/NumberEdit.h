// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "widgets/common/DragSequence.h"

#include <QDoubleSpinBox>
#include <QLabel>

namespace reflet {

/// A number with a unit. Typing is one change, at Enter or when the focus leaves; held arrow keys
/// and buttons, and a drag of its DragLabel, are one sequence of phases. Escape takes back.
class NumberEdit : public QDoubleSpinBox {
    Q_OBJECT

public:
    explicit NumberEdit(QWidget* parent = nullptr);

    /// Shows a value without reporting it; left alone while the user edits.
    void show(double value);
    using QDoubleSpinBox::show;
    /// Several things with different values are edited at once.
    void showSeveral(double first);

    void beginDrag();
    void dragBy(int steps);
    void endDrag();
    [[nodiscard]] bool dragging() const { return m_sequence.pressed(); }

Q_SIGNALS:
    void edited(double value, reflet::DragPhase phase);

protected:
    void keyPressEvent(QKeyEvent* event) override;
    void keyReleaseEvent(QKeyEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    [[nodiscard]] QString textFromValue(double value) const override;
    [[nodiscard]] double valueFromText(const QString& text) const override;
    QValidator::State validate(QString& text, int& position) const override;

private:
    void leaveSeveral();

    DragSequence<double> m_sequence;
    bool m_several = false;
    double m_first = 0.0;  ///< what stands behind "several"
    QString m_unit;        ///< the suffix meanwhile
};

/// A field's name; dragging it sideways changes the number beside it, finer with Shift.
class DragLabel : public QLabel {
    Q_OBJECT

public:
    DragLabel(const QString& text, NumberEdit* edit, QWidget* parent = nullptr);

protected:
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;

private:
    NumberEdit* m_edit;
    double m_lastX = 0.0;
    double m_rest = 0.0;
};

}  // namespace reflet
