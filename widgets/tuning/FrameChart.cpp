// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/tuning/FrameChart.h"

#include "widgets/common/Look.h"

#include <QHelpEvent>
#include <QLocale>
#include <QPainter>
#include <QTimer>
#include <QToolTip>
#include <algorithm>
#include <array>
#include <vector>

namespace reflet {

namespace {

constexpr qint64 kSpan = 10'000;       ///< milliseconds that are shown
constexpr int kRepaintInterval = 100;  ///< milliseconds
constexpr std::array<QRgb, 6> kStages{DataColor::kSky,    DataColor::kBlue,   DataColor::kGreen,
                                      DataColor::kYellow, DataColor::kOrange, DataColor::kPurple};

std::array<QString, 6> stageNames() {
    return {FrameChart::tr("city"),    FrameChart::tr("rays"),     FrameChart::tr("maps"),
            FrameChart::tr("in maps"), FrameChart::tr("vehicles"), FrameChart::tr("overlays")};
}

/// The next of 1, 2, 5, 10, 20 ... that is not below.
double niceTop(double value) {
    double power = 1.0;
    while (power * 10.0 < value)
        power *= 10.0;
    for (const double factor : {1.0, 2.0, 5.0})
        if (power * factor >= value)
            return power * factor;
    return power * 10.0;
}

}  // namespace

FrameChart::FrameChart(QWidget* parent) : QWidget(parent), m_repaint(new QTimer(this)) {
    setAccessibleName(tr("Time of the last frames by stage"));
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    m_clock.start();
    m_repaint->setInterval(kRepaintInterval);
    connect(m_repaint, &QTimer::timeout, this, [this] {
        drop();
        update();
        if (m_samples.empty())
            m_repaint->stop();
    });
}

void FrameChart::addFrame(const FrameStatistics& statistics) {
    m_samples.push_back(
        {m_clock.elapsed(),
         {float(statistics.city), float(statistics.tracing), float(statistics.maps),
          float(statistics.inMaps), float(statistics.bodies), float(statistics.overlays)},
         float(statistics.milliseconds)});
    drop();
    if (!m_repaint->isActive())
        m_repaint->start();
}

void FrameChart::setBudget(double milliseconds) {
    m_budget = milliseconds;
    update();
}

void FrameChart::clear() {
    m_samples.clear();
    update();
}

QSize FrameChart::sizeHint() const {
    return {240, 5 * fontMetrics().height()};
}

QSize FrameChart::minimumSizeHint() const {
    return {120, 4 * fontMetrics().height()};
}

void FrameChart::drop() {
    const qint64 now = m_clock.elapsed();
    while (!m_samples.empty() && now - m_samples.front().at > kSpan)
        m_samples.pop_front();
}

double FrameChart::top() const {
    float most = 0.0F;
    for (const Sample& sample : m_samples)
        most = std::max(most, sample.total);
    return niceTop(std::max(1.5 * m_budget, double(most)));
}

/// One column a pixel, the slowest frame of each: spikes stay visible and paint time is bounded.
void FrameChart::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    const int line = fontMetrics().height();
    const QRect plot = rect().adjusted(0, 2, 0, -line - 2);
    painter.fillRect(plot, palette().color(QPalette::Base));
    const double most = top();
    const auto y = [&](double ms) { return plot.bottom() - plot.height() * ms / most; };

    const qint64 now = m_clock.elapsed();
    std::vector<const Sample*> columns(std::size_t(std::max(1, plot.width())), nullptr);
    for (const Sample& sample : m_samples) {
        const auto x = (kSpan - (now - sample.at)) * (plot.width() - 1) / kSpan;
        const Sample*& column = columns[std::size_t(std::clamp<qint64>(x, 0, plot.width() - 1))];
        if (!column || sample.total > column->total)
            column = &sample;
    }
    // A column lasts until the next frame.
    const Sample* last = nullptr;
    for (int x = 0; x < plot.width(); ++x) {
        const Sample* sample = columns[std::size_t(x)] ? columns[std::size_t(x)] : last;
        last = sample;
        if (!sample)
            continue;
        double from = 0.0;
        for (std::size_t stage = 0; stage < kStages.size(); ++stage) {
            const double to = from + double(sample->stages[stage]);
            painter.fillRect(QRectF(plot.left() + x, y(to), 1.0, y(from) - y(to)),
                             QColor(kStages[stage]));
            from = to;
        }
        const double total = double(sample->total);
        if (total > from)
            painter.fillRect(QRectF(plot.left() + x, y(total), 1.0, y(from) - y(total)),
                             QColor(DataColor::kGrey));
    }
    painter.setPen(QPen(palette().color(QPalette::WindowText), 1.0, Qt::DashLine));
    painter.drawLine(QPointF(plot.left(), y(m_budget)), QPointF(plot.right(), y(m_budget)));
    const QString budget = tr("%1 ms").arg(QLocale().toString(m_budget, 'f', 0));
    painter.drawText(QPointF(plot.left() + 3.0, y(m_budget) - 3.0), budget);

    double x = plot.left();
    const auto names = stageNames();
    for (std::size_t stage = 0; stage < names.size(); ++stage) {
        const double box = 0.6 * line;
        painter.fillRect(QRectF(x, height() - 0.8 * line, box, box), QColor(kStages[stage]));
        painter.setPen(palette().color(QPalette::WindowText));
        x += box + 3.0;
        painter.drawText(QPointF(x, height() - fontMetrics().descent()), names[stage]);
        x += fontMetrics().horizontalAdvance(names[stage]) + line * 0.7;
    }
}

bool FrameChart::event(QEvent* event) {
    if (event->type() != QEvent::ToolTip)
        return QWidget::event(event);
    QString text = tr("The last ten seconds; the dashed line is what a frame may take.");
    if (!m_samples.empty()) {
        const auto names = stageNames();
        for (std::size_t stage = 0; stage < names.size(); ++stage)
            text +=
                QLatin1Char('\n') +
                tr("%1: %2 ms")
                    .arg(names[stage], QLocale().toString(m_samples.back().stages[stage], 'f', 1));
    }
    QToolTip::showText(static_cast<QHelpEvent*>(event)->globalPos(), text, this);
    return true;
}

}  // namespace reflet
