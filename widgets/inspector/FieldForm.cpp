// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/inspector/FieldForm.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QWheelEvent>

namespace reflet {

namespace {

/// Remembers what it showed, so that only changes are reported and Escape takes back.
class TextEdit : public QLineEdit {
public:
    using QLineEdit::QLineEdit;

protected:
    void keyPressEvent(QKeyEvent* event) override {
        if (event->key() == Qt::Key_Escape && isModified()) {
            setText(property("shown").toString());
            setModified(false);
            return;
        }
        QLineEdit::keyPressEvent(event);
    }
};

/// A combo box among scrolled fields: the wheel acts only with the focus.
class ChoiceBox : public QComboBox {
public:
    explicit ChoiceBox(QWidget* parent) : QComboBox(parent) {
        setFocusPolicy(Qt::StrongFocus);
        setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
        setMinimumContentsLength(8);
    }

protected:
    void wheelEvent(QWheelEvent* event) override {
        if (hasFocus())
            QComboBox::wheelEvent(event);
        else
            event->ignore();
    }
};

}  // namespace

FieldForm::FieldForm(QWidget* parent) : QWidget(parent), m_layout(new QFormLayout(this)) {
    m_layout->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    m_layout->setRowWrapPolicy(QFormLayout::WrapLongRows);
    m_layout->setContentsMargins(6, 4, 6, 4);
}

NumberEdit* FieldForm::number(const QString& name, const QString& help, const NumberField& field,
                              const OnNumber& edited) {
    auto* edit = new NumberEdit(this);
    edit->setRange(field.least, field.most);
    edit->setDecimals(field.decimals);
    edit->setSingleStep(field.step);
    edit->setSuffix(field.unit);
    edit->setToolTip(help);
    edit->setAccessibleName(QString(name).remove(QLatin1Char('&')));
    connect(edit, &NumberEdit::edited, this, edited);
    m_layout->addRow(new DragLabel(name, edit, this), edit);
    return edit;
}

QLineEdit* FieldForm::text(const QString& name, const QString& help, const OnText& edited) {
    auto* edit = new TextEdit(this);
    edit->setToolTip(help);
    edit->setAccessibleName(QString(name).remove(QLatin1Char('&')));
    connect(edit, &QLineEdit::editingFinished, this, [edit, edited] {
        if (!edit->isModified() || edit->text() == edit->property("shown").toString())
            return;
        edit->setModified(false);
        edited(edit->text());
    });
    m_layout->addRow(name, edit);
    return edit;
}

QComboBox* FieldForm::choice(const QString& name, const QString& help,
                             const std::function<void(int)>& chosen) {
    auto* box = new ChoiceBox(this);
    box->setToolTip(help);
    box->setAccessibleName(QString(name).remove(QLatin1Char('&')));
    connect(box, &QComboBox::activated, this, chosen);
    m_layout->addRow(name, box);
    return box;
}

QCheckBox* FieldForm::check(const QString& name, const QString& help,
                            const std::function<void(bool)>& toggled) {
    auto* box = new QCheckBox(name, this);
    box->setToolTip(help);
    connect(box, &QCheckBox::clicked, this, toggled);
    m_layout->addRow(QString(), box);
    return box;
}

QLabel* FieldForm::fact(const QString& name, const QString& help) {
    auto* label = new QLabel(this);
    label->setWordWrap(true);
    label->setTextFormat(Qt::PlainText);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse);
    label->setToolTip(help);
    label->setAccessibleName(name);
    m_layout->addRow(name, label);
    return label;
}

QLabel* FieldForm::heading() {
    auto* label = new QLabel(this);
    QFont font = label->font();
    font.setBold(true);
    label->setFont(font);
    label->setWordWrap(true);
    label->setTextFormat(Qt::PlainText);
    m_layout->addRow(label);
    return label;
}

void FieldForm::row(QWidget* widget) {
    m_layout->addRow(widget);
}

void FieldForm::setShown(QWidget* field, bool shown) {
    m_layout->setRowVisible(field, shown);
}

void showText(QLineEdit* edit, const QString& text) {
    edit->setProperty("shown", text);
    if (edit->hasFocus() && edit->isModified())
        return;
    if (edit->text() != text)
        edit->setText(text);
    edit->setModified(false);
}

}  // namespace reflet
