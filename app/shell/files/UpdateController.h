// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/UpdateSource.h"
#include "app/shell/Workbench.h"

#include <QObject>
#include <QString>
#include <string>

namespace reflet {

/// Puts a new delivery of a city file in the place of the old one: asks for the file, shows what it
/// changes, and makes it one step that can be undone.
class UpdateController : public QObject {
    Q_OBJECT
public:
    UpdateController(Workbench& bench, QObject* parent);

    /// `model`: its path in the project.
    void compare(const std::string& model, const QString& file);

Q_SIGNALS:
    void updated();

private:
    void chooseFile();
    /// The model that is meant; empty, and said, when it is not clear which.
    [[nodiscard]] std::string chosenModel() const;
    void show(SourceUpdate update);
    void apply(const SourceUpdate& update);

    Workbench& m_bench;
};

}  // namespace reflet
