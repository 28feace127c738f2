// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/viewport/overlay/ObjectMark.h"

#include "widgets/viewport/overlay/Plates.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

constexpr double kNear = 0.05;      // metres before the camera
constexpr double kFarthest = 1e5;   // pixels: what lies farther out is not drawn
constexpr double kMargin = 0.3;     // metres around the object
constexpr int kGap = 8;             // pixels between the box and its name
constexpr double kHaloWidth = 4.0;  // pixels, under the line
constexpr double kLineWidth = 2.0;

glm::dvec3 corner(const Box& box, int number) {
    return {(number & 1) != 0 ? box.max.x : box.min.x, (number & 2) != 0 ? box.max.y : box.min.y,
            (number & 4) != 0 ? box.max.z : box.min.z};
}

bool isNear(const glm::dvec2& pixel) {
    return std::abs(pixel.x) < kFarthest && std::abs(pixel.y) < kFarthest;
}

}  // namespace

std::vector<QLineF> edgesInPicture(const Box& box, const ViewGeometry& view) {
    std::vector<QLineF> edges;
    if (box.empty())
        return edges;
    for (int from = 0; from < 8; ++from) {
        for (const int axis : {1, 2, 4}) {
            if ((from & axis) != 0)
                continue;
            glm::dvec3 a = corner(box, from), b = corner(box, from | axis);
            const double depthA = view.project(a).depth, depthB = view.project(b).depth;
            if (depthA < kNear && depthB < kNear)
                continue;
            if (depthA < kNear)
                a = glm::mix(a, b, (kNear - depthA) / (depthB - depthA));
            else if (depthB < kNear)
                b = glm::mix(b, a, (kNear - depthB) / (depthA - depthB));
            const glm::dvec2 p = view.project(a).pixel, q = view.project(b).pixel;
            if (isNear(p) && isNear(q))
                edges.emplace_back(p.x, p.y, q.x, q.y);
        }
    }
    return edges;
}

ObjectMark::ObjectMark(QWidget* parent) : QWidget(parent), m_label(makePlate(this)) {
    setObjectName(QStringLiteral("objectMark"));
    setAttribute(Qt::WA_TransparentForMouseEvents);
    m_label->setObjectName(QStringLiteral("objectMarkName"));
    hide();
}

void ObjectMark::setObject(const Box& box, const QString& name) {
    m_box = box;
    if (!box.empty()) {
        m_box.min -= glm::dvec3(kMargin);
        m_box.max += glm::dvec3(kMargin);
    }
    m_label->setText(name);
    setAccessibleName(name);
    setVisible(!box.empty());
}

void ObjectMark::setView(const ViewGeometry& view) {
    if (m_box.empty())
        return;
    if (parentWidget() != nullptr)
        setGeometry(parentWidget()->rect());
    m_edges = edgesInPicture(m_box, view);
    QRectF around;
    for (const QLineF& edge : m_edges)
        around = around.united(QRectF(edge.p1(), edge.p2()).normalized());
    m_label->setVisible(!m_edges.empty());
    m_label->adjustSize();
    const int x = int(around.center().x()) - m_label->width() / 2;
    const int y = int(around.top()) - m_label->height() - kGap;
    m_label->move(std::clamp(x, 0, std::max(0, width() - m_label->width())),
                  std::clamp(y, 0, std::max(0, height() - m_label->height())));
    update();
}

void ObjectMark::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QColor line = palette().color(QPalette::Highlight);
    // A dark edge under the line is seen on any picture.
    for (const auto& [color, width] :
         {std::pair(QColor(0, 0, 0, 140), kHaloWidth), std::pair(line, kLineWidth)}) {
        painter.setPen(QPen(color, width, Qt::SolidLine, Qt::RoundCap));
        for (const QLineF& edge : m_edges)
            painter.drawLine(edge);
    }
}

}  // namespace reflet
