// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QAbstractButton>
#include <QLabel>
#include <QWidget>

namespace reflet {

/// The arrow to the north; a click turns the view there.
class Compass : public QAbstractButton {
    Q_OBJECT
public:
    explicit Compass(QWidget* parent);
    /// yaw: of the viewing direction, counter-clockwise from east, radians.
    void setYaw(double yaw);
    [[nodiscard]] QSize sizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    double m_yaw = 0.0;
};

/// A length in the picture and what it is on the ground.
class ScaleBar : public QWidget {
    Q_OBJECT
public:
    explicit ScaleBar(QWidget* parent);
    /// Metres that a pixel of the widget spans; not positive or not finite: the bar is not drawn.
    void setMetresPerPixel(double metres);
    [[nodiscard]] QString text() const;
    [[nodiscard]] QSize sizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    double m_metresPerPixel = 0.0;
    double m_length = 0.0;  ///< metres, a round number
};

/// The largest of 1, 2 or 5 times a power of ten that is at most `metres`; 0 for none.
[[nodiscard]] double roundLength(double metres);

/// The small signs along the lower edge: caption on the left, scale and compass on the right. Lays
/// them out in its parent; they are its parent's children, so that they lie over the picture.
class Hud : public QObject {
    Q_OBJECT
public:
    explicit Hud(QWidget* parent);

    void setShown(bool shown);
    void setCaption(const QString& text);
    void setView(double yaw, double metresPerPixel);
    void layOut();

Q_SIGNALS:
    void northWanted();

private:
    QWidget* m_parent;
    QLabel* m_caption;
    ScaleBar* m_scale;
    Compass* m_compass;
    bool m_shown = true;
};

}  // namespace reflet
