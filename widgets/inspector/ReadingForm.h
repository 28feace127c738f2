// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/project/Project.h"
#include "widgets/inspector/FieldForm.h"
#include "widgets/inspector/Inspector.h"

#include <functional>

namespace reflet {

/// How a city's file is understood: what a user may have to tell of it. Only what its kind of file
/// can be told is shown.
class ReadingForm : public FieldForm {
    Q_OBJECT

public:
    explicit ReadingForm(QWidget* parent);
    void show(const ModelReference& model, const ModelFacts& facts);
    using FieldForm::show;

    std::function<void(ModelReference)> changed;

private:
    QLineEdit* attribute(const QString& name, const QString& help, const char* objectName,
                         std::string ModelReference::*member);
    void showDetail(const QStringList& lods);

    ModelReference m_model;
    QLabel* m_heading;
    QComboBox* m_detail;
    QLineEdit* m_types;
    QLineEdit* m_height;
    QLineEdit* m_base;
    QLineEdit* m_crown;
    NumberEdit* m_defaultHeight;
    QComboBox* m_up;
    NumberEdit* m_unit;
};

}  // namespace reflet
