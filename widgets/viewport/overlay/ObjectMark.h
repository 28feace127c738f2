// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/math/Geometry.h"
#include "widgets/viewport/camera/ViewGeometry.h"

#include <QLabel>
#include <QLineF>
#include <QWidget>
#include <vector>

namespace reflet {

/// The twelve edges of a box in a picture, in its pixels; what lies behind the camera is cut off.
[[nodiscard]] std::vector<QLineF> edgesInPicture(const Box& box, const ViewGeometry& view);

/// Frames one thing of the scene with the edges of its box, and names it. Covers its parent, the
/// picture, and lets the mouse through.
class ObjectMark : public QWidget {
    Q_OBJECT
public:
    explicit ObjectMark(QWidget* parent);

    /// An empty box: nothing is marked. Project frame.
    void setObject(const Box& box, const QString& name);
    [[nodiscard]] QString name() const { return m_box.empty() ? QString() : m_label->text(); }
    void setView(const ViewGeometry& view);

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    Box m_box;
    QLabel* m_label;
    std::vector<QLineF> m_edges;
};

}  // namespace reflet
