// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/Place.h"
#include "core/base/Error.h"

#include <QDialog>
#include <QString>
#include <optional>
#include <vector>

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QPushButton;
class QStackedWidget;

namespace reflet {

/// A model of the project that can be placed or moved.
struct PlaceableModel {
    QString path;                             ///< as the project has it
    std::optional<ModelPlacement> placement;  ///< where it stands now; nullopt = as its file says
    bool hasPlace = false;                    ///< its file tells its CRS: it can only be moved
};

/// Asks where a model without a place stands: by longitude and latitude, by two pairs of points, or
/// by hand. It stays open, with what was typed, until finish() is called: what goes wrong is told
/// in it.
class PlaceDialog : public QDialog {
    Q_OBJECT
public:
    /// models: at least one.
    PlaceDialog(std::vector<PlaceableModel> models, QWidget* parent);

    [[nodiscard]] PlaceRequest chosen() const;
    /// What was asked for is done: closes.
    void finish() { QDialog::accept(); }
    /// What was asked for failed: says so, and lets it be corrected.
    void tell(const Error& error);

    /// Asks for the placing.
    void accept() override;

Q_SIGNALS:
    void placeRequested(const reflet::PlaceRequest& request);

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
    void showModel();
    void check();
    /// What keeps the fields from being a place; empty = nothing.
    [[nodiscard]] QString missing() const;
    /// What is odd about them; empty = nothing.
    [[nodiscard]] QString doubt() const;

    std::vector<PlaceableModel> m_known;
    QComboBox* m_models;
    QComboBox* m_how;
    QStackedWidget* m_pages;
    QLabel* m_note;
    QPushButton* m_place;
    Fields m_earth, m_points, m_hand;
    bool m_asked = false;  ///< and not yet answered
};

}  // namespace reflet
