// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QWidget>

namespace reflet {

/// What the colours and marks of a coverage mean, on a small plate over a picture or a plan. Lets
/// the mouse through.
class CoverageLegend : public QWidget {
    Q_OBJECT
public:
    explicit CoverageLegend(QWidget* parent);

    /// Suggested probes are explained only where there are any.
    void setGhosts(bool shown);
    [[nodiscard]] QSize sizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    [[nodiscard]] int rows() const { return m_ghosts ? 3 : 2; }

    bool m_ghosts = false;
};

}  // namespace reflet
