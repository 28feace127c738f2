// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/UpdateSource.h"

#include <QDialog>

class QTreeWidgetItem;

namespace reflet {

/// Lists what a new delivery of a city file changes, before anything is changed. Accepted: it shall
/// take the place of the old one.
class UpdateDialog : public QDialog {
    Q_OBJECT
public:
    explicit UpdateDialog(SourceUpdate update, QWidget* parent = nullptr);

    [[nodiscard]] const SourceUpdate& update() const { return m_update; }

Q_SIGNALS:
    /// Show the place of a change in the city. Frame coordinates.
    void placeWanted(const reflet::Box& box, const QString& object);

private:
    void addChanges(QTreeWidgetItem* parent, ObjectChange::Kind kind);

    SourceUpdate m_update;
};

}  // namespace reflet
