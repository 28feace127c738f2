// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/document/JobRunner.h"
#include "app/document/ProjectDocument.h"
#include "app/shell/StartOptions.h"
#include "app/shell/Workbench.h"

#include <QMainWindow>

namespace reflet {

class Autosave;
class CompareController;
class EditController;
class FileController;
class LiveCity;
class OpeningView;
class PictureController;
class ReflectController;
class SceneController;
class TourController;
class WindowLayout;

/// The window: the picture, the panels, and everything that ties them to the document.
class MainWindow : public QMainWindow {
    Q_OBJECT
public:
    explicit MainWindow(QWidget* parent = nullptr);
    ~MainWindow() override;

    /// Shows what the program was started with: files, or the sample.
    void start(const StartOptions& options);

    [[nodiscard]] ProjectDocument& document() { return m_document; }
    [[nodiscard]] JobRunner& jobs() { return m_jobs; }
    [[nodiscard]] const Workbench& bench() const { return m_bench; }

protected:
    void closeEvent(QCloseEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dragLeaveEvent(QDragLeaveEvent* event) override;
    void dropEvent(QDropEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    void connectWindowCommands();
    void makeThemeMenu();
    void showTitle();
    void offerRecovery();

    // Declared before what refers to them: destroyed after it.
    ProjectDocument m_document;
    JobRunner m_jobs;
    Workbench m_bench;
    WindowLayout* m_layout = nullptr;
    FileController* m_files = nullptr;
    SceneController* m_scene = nullptr;
    OpeningView* m_openingView = nullptr;
    EditController* m_edit = nullptr;
    CompareController* m_compare = nullptr;
    ReflectController* m_reflect = nullptr;
    TourController* m_tour = nullptr;
    PictureController* m_pictures = nullptr;
    Autosave* m_autosave = nullptr;
    QString m_hintBeforeDrag;
    bool m_mayClose = false;
};

}  // namespace reflet
