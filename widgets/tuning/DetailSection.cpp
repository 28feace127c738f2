// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/tuning/DetailSection.h"

#include "widgets/common/NumberEdit.h"

#include <QCheckBox>
#include <QGridLayout>
#include <QLabel>
#include <QLocale>
#include <QStringList>
#include <cmath>

namespace reflet {

namespace {

constexpr double kMostPictures = 120.0;  ///< a second
constexpr double kPercent = 100.0;

/// A budget as people choose it: whole pictures a second where it is about that.
double picturesOf(double milliseconds) {
    const double exact = 1000.0 / milliseconds;
    return std::abs(exact - std::round(exact)) < 0.35 ? std::round(exact) : exact;
}

}  // namespace

DetailSection::DetailSection(QWidget* parent)
    : QWidget(parent),
      m_on(new QCheckBox(tr("&Level of detail while things move"), this)),
      m_pace(new NumberEdit(this)),
      m_blur(new NumberEdit(this)),
      m_counts(new QLabel(this)) {
    m_on->setObjectName(QStringLiteral("lodOn"));
    m_on->setToolTip(
        tr("Finer reflections on vehicles that look large, coarser ones where time is short. "
           "Off: all in full quality, however long a picture takes"));
    m_pace->setObjectName(QStringLiteral("lodPace"));
    m_pace->setAccessibleName(tr("Smoothness"));
    m_pace->setToolTip(tr("Pictures a second that are kept while something moves"));
    m_pace->setRange(1000.0 / LodSettings::kMostBudget, kMostPictures);
    m_pace->setDecimals(0);
    m_pace->setSuffix(tr(" pictures a second"));
    m_blur->setObjectName(QStringLiteral("lodBlur"));
    m_blur->setAccessibleName(tr("Blur"));
    m_blur->setToolTip(
        tr("Reflections smear along the movement: 0 % sharp, 50 % as with a film "
           "camera, 100 % all the way from picture to picture"));
    m_blur->setRange(0.0, kPercent);
    m_blur->setSingleStep(10.0);
    m_blur->setDecimals(0);
    m_blur->setSuffix(tr(" %"));
    m_counts->setObjectName(QStringLiteral("lodCounts"));
    m_counts->setWordWrap(true);
    m_counts->setAccessibleName(tr("Reflections by level"));
    m_counts->setToolTip(tr("Bodies in the last picture by how their reflections were made"));

    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setColumnStretch(1, 1);
    grid->addWidget(m_on, 0, 0, 1, 2);
    grid->addWidget(new DragLabel(tr("S&moothness"), m_pace, this), 1, 0);
    grid->addWidget(m_pace, 1, 1);
    grid->addWidget(new DragLabel(tr("&Blur"), m_blur, this), 2, 0);
    grid->addWidget(m_blur, 2, 1);
    grid->addWidget(m_counts, 3, 0, 1, 2);

    connect(m_on, &QCheckBox::clicked, this, [this](bool on) {
        m_settings.on = on;
        report(DragPhase::End);
    });
    connect(m_pace, &NumberEdit::edited, this, [this](double value, DragPhase phase) {
        m_settings.frameBudget = 1000.0 / value;
        report(phase);
    });
    connect(m_blur, &NumberEdit::edited, this, [this](double value, DragPhase phase) {
        m_settings.blur = value / kPercent;
        report(phase);
    });
    show(m_settings);
    showFrame({});
}

void DetailSection::report(DragPhase phase) {
    if (changed)
        changed(m_settings, phase);
}

void DetailSection::show(const LodSettings& settings) {
    m_settings = settings;
    m_on->setChecked(settings.on);
    m_pace->show(picturesOf(settings.frameBudget));
    m_blur->show(kPercent * settings.blur);
}

void DetailSection::showFrame(const LodStatistics& statistics) {
    if (!statistics.on) {
        m_counts->setText(tr("Reflections: all in full quality"));
        return;
    }
    const QLocale locale;
    QStringList parts;
    const auto add = [&](std::size_t count, const QString& what) {
        if (count > 0)
            parts.append(what.arg(locale.toString(qulonglong(count)))
                             .replace(QLatin1Char(' '), QChar(QChar::Nbsp)));
    };
    add(statistics.full, tr("%1 full"));
    add(statistics.reduced, tr("%1 reduced"));
    add(statistics.blended, tr("%1 blended"));
    add(statistics.hidden, tr("%1 hidden"));
    add(statistics.shared, tr("%1 share a map"));
    add(statistics.waiting, tr("%1 wait"));
    QString text = parts.isEmpty() ? tr("Reflections: none in the picture")
                                   : tr("Reflections: %1").arg(parts.join(QStringLiteral(" · ")));
    if (statistics.coarse > 0)
        text += QLatin1Char('\n') + tr("All coarser by %1 of %2 steps to keep the pace")
                                        .arg(statistics.coarse)
                                        .arg(kMostCoarse);
    m_counts->setText(text);
}

}  // namespace reflet
