// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/Place.h"

#include <QDialog>
#include <QStringList>

class QComboBox;
class QDoubleSpinBox;
class QStackedWidget;

namespace reflet {

/// Asks where a model without a place stands: by longitude and latitude, by two pairs of points, or
/// by hand.
class PlaceDialog : public QDialog {
    Q_OBJECT
public:
    /// models: paths as the project has them; at least one.
    explicit PlaceDialog(const QStringList& models, QWidget* parent);

    [[nodiscard]] PlaceRequest chosen() const;

private:
    using Fields = std::vector<QDoubleSpinBox*>;
    struct Field {
        const char* name;  ///< object name, for tests
        QString label;
        double limit;
        int decimals;
    };
    Fields addPage(const QString& title, const QString& explanation,
                   std::initializer_list<Field> fields);

    QComboBox* m_models;
    QComboBox* m_how;
    QStackedWidget* m_pages;
    Fields m_earth, m_points, m_hand;
};

}  // namespace reflet
