// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>
#include <QSize>

class QComboBox;
class QFormLayout;
class QRadioButton;
class QSpinBox;

namespace reflet {

/// What a picture shall be like.
struct PictureChoice {
    QSize size;
    bool best = false;      ///< ray traced, else as on the screen
    int seconds = 20;       ///< of a film
    bool pavement = false;  ///< a film from places beside the route; else as on the screen
};

/// Asks for the size and the quality of a picture or a film.
class PictureDialog : public QDialog {
    Q_OBJECT
public:
    enum class For { Picture, Film };
    /// shown: the size of the picture on the screen.
    PictureDialog(For purpose, const QSize& shown, const QString& remark, QWidget* parent);
    [[nodiscard]] PictureChoice choice() const;

private:
    void addSizes(QFormLayout* form, bool picture, const QSize& shown);
    void addQuality(QFormLayout* form);
    void addCourse(QFormLayout* form);

    QComboBox* m_size = nullptr;
    QRadioButton* m_best = nullptr;  ///< of a picture
    QSpinBox* m_seconds = nullptr;   ///< of a film
    QComboBox* m_camera = nullptr;
};

}  // namespace reflet
