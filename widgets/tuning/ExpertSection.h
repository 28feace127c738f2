// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/EnvironmentBaker.h"
#include "core/reconstruction/Reconstruction.h"
#include "widgets/ViewIntents.h"

#include <QWidget>
#include <functional>
#include <vector>

class QGridLayout;
class QToolButton;

namespace reflet {

/// The settings that only experts turn, each with a button back to the automatic value.
class ExpertSection : public QWidget {
    Q_OBJECT

public:
    explicit ExpertSection(QWidget* parent = nullptr);

    void show(const MemSettings& tuning, const BakeSettings& bake);
    using QWidget::show;

    std::function<void(const MemSettings&, DragPhase)> tuningChanged;
    std::function<void(const BakeSettings&)> bakeChanged;

private:
    /// A field, how it is shown, and how it goes back.
    struct Field {
        QToolButton* automatic;
        std::function<void()> show;
        std::function<bool()> isAutomatic;
    };
    void addRow(const QString& name, const QString& help, QWidget* editor,
                std::function<void()> show, std::function<bool()> isAutomatic,
                std::function<void()> reset);
    template <class T>
    void addNumber(const QString& name, const QString& help, T MemSettings::*member, double least,
                   double most, double step, int decimals);
    void addFlag(const QString& name, const QString& help, bool MemSettings::*member);
    void addResolutions();
    /// A list of the values of an enumeration, in their order.
    template <class T>
    void addChoice(const QString& name, const QString& help, const char* objectName,
                   const QStringList& texts, T MemSettings::*member);
    void report(DragPhase phase) { tuningChanged(m_tuning, phase); }

    MemSettings m_tuning;
    BakeSettings m_bake;
    QGridLayout* m_grid;
    std::vector<Field> m_fields;
};

}  // namespace reflet
