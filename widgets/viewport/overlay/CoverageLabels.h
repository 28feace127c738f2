// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/gpu/overlay/CoverageOverlay.h"
#include "widgets/viewport/camera/Ground.h"
#include "widgets/viewport/camera/ViewGeometry.h"

#include <QWidget>
#include <memory>
#include <vector>

namespace reflet {

class CoverageLegend;

/// The figures of a coverage over the picture: percentages beside the stretches that are near and
/// not hidden, gains beside suggested probes, and the legend. Covers its parent, the picture, and
/// lets the mouse through.
class CoverageLabels : public QWidget {
    Q_OBJECT
public:
    struct Label {
        QPointF at;  ///< middle of the text, in the picture's pixels
        QString text;
        bool ghost = false;
    };

    explicit CoverageLabels(QWidget* parent);

    /// Null: nothing is shown.
    void setCoverage(std::shared_ptr<const CoverageOverlay> coverage);
    /// `ground` hides what lies behind the city.
    void setView(const ViewGeometry& view, const Ground& ground);
    [[nodiscard]] const std::vector<Label>& labels() const { return m_labels; }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void offer(const Label& label);

    std::shared_ptr<const CoverageOverlay> m_coverage;
    std::vector<Label> m_labels;
    CoverageLegend* m_legend;
};

}  // namespace reflet
