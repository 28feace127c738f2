// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/tuning/TuningPanel.h"

namespace reflet {
struct TuningPanel::Impl {};
TuningPanel::TuningPanel(QWidget* parent) : QWidget(parent), m_impl(std::make_unique<Impl>()) {}
TuningPanel::~TuningPanel() = default;
void TuningPanel::setTuning(const MemSettings&) {}
void TuningPanel::setBake(const BakeSettings&) {}
void TuningPanel::setMethods(Method, std::optional<Method>) {}
void TuningPanel::setFrame(const FrameStatistics&, double) {}
void TuningPanel::setFigures(const std::vector<MethodFigures>&, const QString&) {}
void TuningPanel::setFiguresStale(bool) {}
void TuningPanel::setMeasuring(bool) {}
void TuningPanel::setFrameBudget(double) {}
}  // namespace reflet
