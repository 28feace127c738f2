// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QDialog>
#include <QSize>

class QComboBox;
class QRadioButton;

namespace reflet {

/// What a picture shall be like.
struct PictureChoice {
    QSize size;
    bool best = false;  ///< ray traced, else as on the screen
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
    QComboBox* m_size = nullptr;
    QRadioButton* m_best = nullptr;
};

}  // namespace reflet
