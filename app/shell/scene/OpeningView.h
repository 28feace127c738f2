// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/shell/Workbench.h"
#include "core/project/Project.h"

#include <QObject>
#include <QSettings>
#include <optional>

namespace reflet {

/// Puts the camera where a project that is opened looks best: where the user last looked at this
/// file, else the project's first view, else on the pavement beside its first vehicle, else over
/// all of it. The vehicles stand where they are in that view.
class OpeningView : public QObject {
    Q_OBJECT
public:
    OpeningView(Workbench& bench, QObject* parent);

    /// Another project is in the document. The camera is put at once, before there is a city.
    void projectOpened();
    /// Keeps the camera for the file that is shown, if the user has moved it since.
    void remember();

private:
    enum class Waiting { No, ForCity, ForVehicles };

    [[nodiscard]] std::optional<View> known() const;
    [[nodiscard]] std::optional<View> remembered() const;
    void cityCame();
    void lookFromThePavement();
    /// A city that is scattered over kilometres: begins where most of it stands.
    void frameBusiest();
    void show(const View& view, bool animate);

    Workbench& m_bench;
    QSettings m_settings;
    QString m_file;            ///< that is shown; empty: a project without a name
    glm::dvec3 m_origin{0.0};  ///< of its frame
    Waiting m_waiting = Waiting::No;
    std::optional<View> m_shown;  ///< what the user was shown at first
};

}  // namespace reflet
