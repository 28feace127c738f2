// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/baking/EnvironmentBaker.h"
#include "core/gpu/Frame.h"
#include "widgets/ViewIntents.h"

#include <QString>
#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

namespace reflet {

/// How a method did at the measured pose.
struct MethodRow {
    Method method = Method::Mem;
    std::optional<double> psnr;  ///< decibels; nullopt: identical to the reference
    std::optional<double> ssim;
    double milliseconds = 0.0;  ///< a local map
    std::size_t quads = 0;
    std::size_t rays = 0;
    std::optional<double> uncovered;  ///< share of the mesh's vertices, 0..1
    std::optional<double> flip = {};  ///< 0..1; nullopt: identical to the reference
    /// Share of directions that show another surface, 0..1; nullopt without probes.
    std::optional<double> wrongSurface = {};
};

/// How finely reflections are made, what that costs and how true it is. Quality and detail first,
/// in a planner's words; the rest under Expert, each with Automatic (the default value).
class TuningPanel : public QWidget {
    Q_OBJECT

public:
    explicit TuningPanel(QWidget* parent = nullptr);
    ~TuningPanel() override;

    void setTuning(const MemSettings& tuning);
    void setBake(const BakeSettings& bake);
    void setMethods(Method left, std::optional<Method> right);
    /// What the last frame cost; may come at any rate, shown four times a second at most.
    void setFrame(const FrameStatistics& statistics, double framesPerSecond);
    /// pose: which vehicle stood where, and when ("tram 1, 12.4 s"). Empty figures: none yet.
    void setFigures(const std::vector<MethodRow>& figures, const QString& pose);
    /// The figures are of a pose, tuning or light that is no longer shown.
    void setFiguresStale(bool stale);
    void setMeasuring(bool measuring);

Q_SIGNALS:
    void tuningChanged(reflet::MemSettings tuning, reflet::DragPhase phase);
    void bakeChanged(reflet::BakeSettings bake);
    void methodsChanged(reflet::Method left, std::optional<reflet::Method> right);
    void measureRequested();

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

}  // namespace reflet
