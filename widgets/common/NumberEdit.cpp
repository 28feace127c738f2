// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/NumberEdit.h"

#include <QKeyEvent>
#include <QLineEdit>
#include <QMouseEvent>
#include <QSignalBlocker>
#include <QWheelEvent>

namespace reflet {

namespace {

constexpr double kPixelsAStep = 4.0;
constexpr double kFinePixelsAStep = 20.0;

bool steps(int key) {
    return key == Qt::Key_Up || key == Qt::Key_Down || key == Qt::Key_PageUp ||
           key == Qt::Key_PageDown;
}

}  // namespace

NumberEdit::NumberEdit(QWidget* parent)
    : QDoubleSpinBox(parent),
      m_sequence([this](double value, DragPhase phase) { Q_EMIT edited(value, phase); }) {
    setKeyboardTracking(false);
    setFocusPolicy(Qt::StrongFocus);
    setAccelerated(true);
    setGroupSeparatorShown(false);
    connect(this, &QDoubleSpinBox::valueChanged, this, [this](double value) {
        leaveSeveral();
        m_sequence.step(value);
    });
    connect(this, &QDoubleSpinBox::editingFinished, this, [this] {
        // Typing, for several things, the value that the first one has already.
        if (m_several && lineEdit()->text() != textFromValue(value())) {
            leaveSeveral();
            m_sequence.step(value());
        }
    });
}

void NumberEdit::show(double value) {
    if (m_sequence.pressed() || (hasFocus() && lineEdit()->isModified()))
        return;
    const QSignalBlocker quiet(this);
    leaveSeveral();
    setValue(value);
    lineEdit()->setText(prefix() + textFromValue(this->value()) + suffix());
}

void NumberEdit::showSeveral(double first) {
    show(first);
    if (m_sequence.pressed() || (hasFocus() && lineEdit()->isModified()))
        return;
    const QSignalBlocker quiet(this);
    m_first = value();
    m_unit = suffix();
    m_several = true;
    setSuffix({});  // "several" has no unit
    lineEdit()->setText(textFromValue(first));
}

void NumberEdit::leaveSeveral() {
    if (std::exchange(m_several, false))
        setSuffix(m_unit);
}

void NumberEdit::beginDrag() {
    m_sequence.press(value());
}

void NumberEdit::dragBy(int steps) {
    if (m_sequence.pressed() && steps != 0)
        setValue(value() + steps * singleStep());
}

void NumberEdit::endDrag() {
    m_sequence.release();
}

void NumberEdit::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Escape) {
        const double before = m_sequence.pressed() ? m_sequence.before() : value();
        const bool undone = m_sequence.cancel() || lineEdit()->isModified();
        lineEdit()->setModified(false);
        show(before);
        if (undone)
            return;
    }
    if (steps(event->key()) && !event->isAutoRepeat())
        m_sequence.press(value());
    QDoubleSpinBox::keyPressEvent(event);
}

void NumberEdit::keyReleaseEvent(QKeyEvent* event) {
    QDoubleSpinBox::keyReleaseEvent(event);
    if (steps(event->key()) && !event->isAutoRepeat())
        m_sequence.release();
}

void NumberEdit::mousePressEvent(QMouseEvent* event) {
    interpretText();
    m_sequence.press(value());
    QDoubleSpinBox::mousePressEvent(event);
}

void NumberEdit::mouseReleaseEvent(QMouseEvent* event) {
    QDoubleSpinBox::mouseReleaseEvent(event);
    m_sequence.release();
}

void NumberEdit::focusOutEvent(QFocusEvent* event) {
    QDoubleSpinBox::focusOutEvent(event);
    m_sequence.release();
}

void NumberEdit::wheelEvent(QWheelEvent* event) {
    if (hasFocus())
        QDoubleSpinBox::wheelEvent(event);
    else
        event->ignore();
}

QString NumberEdit::textFromValue(double value) const {
    return m_several ? tr("several") : QDoubleSpinBox::textFromValue(value);
}

double NumberEdit::valueFromText(const QString& text) const {
    return text == tr("several") ? m_first : QDoubleSpinBox::valueFromText(text);
}

QValidator::State NumberEdit::validate(QString& text, int& position) const {
    if (m_several && text.startsWith(tr("several")))
        return QValidator::Acceptable;
    return QDoubleSpinBox::validate(text, position);
}

DragLabel::DragLabel(const QString& text, NumberEdit* edit, QWidget* parent)
    : QLabel(text, parent), m_edit(edit) {
    setBuddy(edit);
    setCursor(Qt::SizeHorCursor);
    setToolTip(tr("Drag sideways to change the value; with Shift in finer steps"));
}

void DragLabel::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton || !m_edit->isEnabled())
        return;
    m_lastX = event->globalPosition().x();
    m_rest = 0.0;
    m_edit->setFocus(Qt::MouseFocusReason);  // so that Escape reaches it
    m_edit->beginDrag();
}

void DragLabel::mouseMoveEvent(QMouseEvent* event) {
    if (!m_edit->dragging())
        return;
    const double x = event->globalPosition().x();
    const bool fine = event->modifiers().testFlag(Qt::ShiftModifier);
    m_rest += (x - m_lastX) / (fine ? kFinePixelsAStep : kPixelsAStep);
    m_lastX = x;
    const int whole = int(m_rest);
    m_rest -= whole;
    m_edit->dragBy(whole);
}

void DragLabel::mouseReleaseEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton)
        m_edit->endDrag();
}

}  // namespace reflet
