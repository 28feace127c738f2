// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/shell/Workbench.h"

#include <QObject>
#include <QString>
#include <vector>

class QAction;
class QDockWidget;
class QMainWindow;
class QMenu;
class QUndoStack;
class QUndoView;

namespace reflet {

class JobChip;
class MessageBar;

/// Puts the parts of the window into their places: menus, tools, panels. The places are kept in the
/// settings from one start to the next.
class WindowLayout : public QObject {
    Q_OBJECT
public:
    /// Makes all panels and views and writes them into `bench`; commands must be there already.
    WindowLayout(Workbench& bench, QMainWindow* window);

    [[nodiscard]] QMenu* recentMenu() const { return m_recent; }
    [[nodiscard]] QMenu* viewsMenu() const { return m_views; }
    /// The undo stack's steps are shown in a panel.
    void setUndoStack(QUndoStack* stack);

    /// Shows a panel by its object name ("tuningDock", ...) and brings it to the front.
    void showPanel(const QString& objectName);
    void save() const;
    void restore();
    void reset();

private:
    QDockWidget* addPanel(const QString& name, const QString& title, const QString& icon,
                          QWidget* content, Qt::DockWidgetArea area);
    void makePanels();
    void makeMenus();
    void makeToolBar();
    void makeSideBar();
    void makeStatusBar();
    void addCommands(QMenu* menu, std::initializer_list<int> commands);

    Workbench& m_bench;
    QMainWindow* m_window;
    QMenu* m_recent = nullptr;
    QMenu* m_views = nullptr;
    std::vector<QDockWidget*> m_panels;
    QUndoView* m_history = nullptr;
    QByteArray m_firstState;
};

}  // namespace reflet
