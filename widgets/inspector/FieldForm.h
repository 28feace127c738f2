// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "widgets/common/NumberEdit.h"

#include <QWidget>
#include <functional>

class QCheckBox;
class QComboBox;
class QFormLayout;
class QLabel;
class QLineEdit;

namespace reflet {

/// How a number is edited.
struct NumberField {
    double least = -1e8;
    double most = 1e8;
    double step = 1.0;
    int decimals = 2;
    QString unit;  ///< with its leading space
};

/// A column of named fields; each has a tool tip, a buddy and an accessible name.
class FieldForm : public QWidget {
    Q_OBJECT

public:
    explicit FieldForm(QWidget* parent = nullptr);

    using OnNumber = std::function<void(double, DragPhase)>;
    using OnText = std::function<void(const QString&)>;

    NumberEdit* number(const QString& name, const QString& help, const NumberField& field,
                       const OnNumber& edited);
    /// Reported at Enter or when the focus leaves, and only when it changed; Escape takes back.
    QLineEdit* text(const QString& name, const QString& help, const OnText& edited);
    QComboBox* choice(const QString& name, const QString& help,
                      const std::function<void(int)>& chosen);
    QCheckBox* check(const QString& name, const QString& help,
                     const std::function<void(bool)>& toggled);
    /// Text to be read, and copied.
    QLabel* fact(const QString& name, const QString& help = {});
    QLabel* heading();
    void row(QWidget* widget);
    /// Hides or shows a field and its label.
    void setShown(QWidget* field, bool shown);

private:
    QFormLayout* m_layout;
};

/// Shows a text that the user is not editing just now.
void showText(QLineEdit* edit, const QString& text);

}  // namespace reflet
