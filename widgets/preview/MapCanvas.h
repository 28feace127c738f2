// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "widgets/preview/MapPicture.h"

#include <QImage>
#include <QWidget>
#include <thread>

namespace reflet {

/// The picture of an environment map: fitted, or zoomed to whole texels with the wheel.
class MapCanvas : public QWidget {
    Q_OBJECT

public:
    explicit MapCanvas(QWidget* parent = nullptr);
    ~MapCanvas() override;

    void setSource(MapSource source);
    void setExposure(float exposure);
    void setProjection(MapProjection projection);
    void setQuantity(MapQuantity quantity);
    [[nodiscard]] MapQuantity quantity() const { return m_quantity; }
    [[nodiscard]] const MapSource& source() const { return m_source; }
    /// The texel and direction under a point of the widget.
    [[nodiscard]] std::optional<std::pair<Texel, glm::dvec3>> at(const QPointF& point) const;

    [[nodiscard]] QSize sizeHint() const override { return {420, 320}; }
    [[nodiscard]] QSize minimumSizeHint() const override { return {160, 120}; }

Q_SIGNALS:
    void pointed(bool inside, reflet::Texel texel, glm::dvec3 direction);
    void painted();

protected:
    void paintEvent(QPaintEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void leaveEvent(QEvent* event) override;

private:
    void repaintMap();
    [[nodiscard]] QSizeF pictureSize() const;
    [[nodiscard]] double fittedScale() const;
    [[nodiscard]] QRectF target() const;
    void zoom(double factor, const QPointF& point);
    void point(const QPointF& position);
    void paintFaceNames(QPainter& painter, const QRectF& rect) const;

    MapSource m_source;
    MapProjection m_projection = MapProjection::Cross;
    MapQuantity m_quantity = MapQuantity::Radiance;
    float m_exposure = 1.0F;
    QImage m_image;
    std::jthread m_painter;
    quint64 m_number = 0;
    double m_zoom = 1.0;  ///< times the fitted scale
    QPointF m_shift;      ///< of the picture's middle from the widget's
    QPointF m_last;
};

}  // namespace reflet
