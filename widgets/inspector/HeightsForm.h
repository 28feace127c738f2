// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/heightfield/HeightfieldBuilder.h"
#include "widgets/inspector/FieldForm.h"

#include <functional>
#include <vector>

namespace reflet {

/// How the height model is made: its cells, and what each kind of thing in the city counts as.
class HeightsForm : public FieldForm {
    Q_OBJECT

public:
    explicit HeightsForm(QWidget* parent);
    void show(const HeightfieldSettings& settings);
    using FieldForm::show;

    std::function<void(HeightfieldSettings, DragPhase)> changed;

private:
    /// Classes that a planner calls by one name, and the box that says what they are.
    struct Kind {
        std::vector<CityObjectType> types;
        QComboBox* box = nullptr;
    };
    void addKind(const QString& name, const char* objectName, std::vector<CityObjectType> types);

    HeightfieldSettings m_settings;
    NumberEdit* m_cell;
    NumberEdit* m_clearance;
    std::vector<Kind> m_kinds;
};

}  // namespace reflet
