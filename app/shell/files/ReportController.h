// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/shell/Workbench.h"

#include <QObject>
#include <QString>

namespace reflet {

/// Shows the report on what was read of the city's files, saves it, and leads from a remark to its
/// object in the picture.
class ReportController : public QObject {
    Q_OBJECT
public:
    ReportController(Workbench& bench, QObject* parent);

    /// The city that comes next was imported just now: what was odd about it is told.
    void tellNextCity() { m_tell = true; }
    /// Frames and marks an object.
    void showObject(const QString& file, const QString& object);

Q_SIGNALS:
    void panelWanted();

private:
    void showReport();
    void tell();
    void chooseFile();
    void save(const QString& path);

    Workbench& m_bench;
    bool m_tell = false;
};

}  // namespace reflet
