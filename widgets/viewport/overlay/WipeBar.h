// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QLabel>
#include <QWidget>

namespace reflet {

/// The bar between two methods: an upright line with a round handle that is dragged, or moved with
/// the arrow keys, across its parent. Keeps itself and two name plates in place there.
class WipeBar : public QWidget {
    Q_OBJECT
public:
    explicit WipeBar(QWidget* parent);

    /// Share of the parent's width that lies left of the bar, 0..1.
    [[nodiscard]] double share() const { return m_share; }
    void setShare(double share);
    void setNames(const QString& left, const QString& right);
    /// To be called when the parent was resized.
    void layOut();

Q_SIGNALS:
    void moved(double share);

protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    bool event(QEvent* event) override;
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;

private:
    void moveTo(double share);
    void describe();
    [[nodiscard]] QRectF handle() const;

    double m_share = 0.5;
    double m_shareBefore = 0.5;  ///< when the drag began
    bool m_dragging = false;
    int m_grabOffset = 0;
    QLabel* m_left;  ///< the name plates, children of the parent
    QLabel* m_right;
};

}  // namespace reflet
