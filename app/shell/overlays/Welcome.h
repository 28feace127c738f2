// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>
#include <vector>

class QLabel;
class QPushButton;
class QPushButton;

namespace reflet {

/// The first ten seconds: a caption at the foot of the moving picture, and three buttons.
class Welcome : public QWidget {
    Q_OBJECT
public:
    explicit Welcome(QWidget* parent = nullptr);
    void setCaption(const QString& caption, const QString& detail);
    /// Pixels that it needs at a width.
    /// Smaller letters and less air where the stage is narrow.
    void fit(int width);
    [[nodiscard]] int heightForStage(int width) const;

Q_SIGNALS:
    void openCityAsked();
    void driveAsked();
    void explanationAsked();
    void dismissed();

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    QLabel* m_caption = nullptr;
    QLabel* m_detail = nullptr;
    std::vector<QPushButton*> m_buttons;
    bool m_compact = false;
};

}  // namespace reflet
