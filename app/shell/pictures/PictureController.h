// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/shell/Workbench.h"
#include "app/shell/pictures/PictureDialog.h"

#include <QObject>
#include <functional>

class QMenu;

namespace reflet {

class CompareController;
struct FilmOptions;

/// *Save picture*, *Save film* and named views: what a planner takes away.
class PictureController : public QObject {
    Q_OBJECT
public:
    /// viewsMenu: filled with the project's views.
    PictureController(Workbench& bench, const CompareController& compare, QMenu* viewsMenu,
                      QObject* parent);

    void savePicture(const PictureChoice& choice, const QString& path);

Q_SIGNALS:
    void savedSomething();

private:
    void askForPicture();
    void askForFilm();
    [[nodiscard]] FilmOptions filmOptions(const PictureChoice& choice) const;
    void saveFilm(const PictureChoice& choice, const QString& path);
    void askForPath(const QString& title, const QString& filter, const QString& suffix,
                    const std::function<void(const QString&)>& then);
    void tellSaved(const QString& path);
    void keepView();
    void storeCamera(const QString& name);
    void goToView(const QString& name);
    void showViews();

    Workbench& m_bench;
    const CompareController& m_compare;
    QMenu* m_views;
};

}  // namespace reflet
