// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/tuning/FigureTable.h"

#include "widgets/common/Look.h"

#include <QHeaderView>
#include <QLabel>
#include <QLocale>
#include <QTableWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <array>

namespace reflet {

namespace {

enum Column { Name, Psnr, Ssim, Flip, Wrong, Time, Quads, Rays, Uncovered, kColumns };

}  // namespace

FigureTable::FigureTable(QWidget* parent) : QWidget(parent) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    m_table = new QTableWidget(0, kColumns, this);
    m_table->setObjectName(QStringLiteral("figures"));
    m_table->setAccessibleName(tr("How close each method comes to the reference"));
    m_table->setHorizontalHeaderLabels({tr("Method"), tr("PSNR"), tr("SSIM"), tr("FLIP"),
                                        tr("Wrong surface"), tr("ms"), tr("Quads"), tr("Rays"),
                                        tr("Not covered")});
    const std::array<QString, kColumns> helps{
        QString(),
        tr("Peak signal-to-noise ratio against the reference, in decibels: more is better; from "
           "about 30 dB on differences are hard to see while driving"),
        tr("Structural similarity with the reference: 1 is the same"),
        tr("How much change is seen between this and the reference, from 0 (none) to 1: less is "
           "better"),
        tr("Share of directions that show another surface than is there"),
        tr("Milliseconds for a local map"),
        tr("Pieces of the adaptive mesh"),
        tr("Rays into the height model, or into the city for the reference"),
        tr("Share of directions that no probe sees")};
    for (int column = 0; column < kColumns; ++column)
        m_table->horizontalHeaderItem(column)->setToolTip(helps[std::size_t(column)]);
    m_table->verticalHeader()->hide();
    m_table->setEditTriggers(QAbstractItemView::NoEditTriggers);
    m_table->setSelectionMode(QAbstractItemView::NoSelection);
    m_table->setTabKeyNavigation(false);
    m_table->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
    m_table->setShowGrid(false);
    m_note = new QLabel(this);
    m_note->setWordWrap(true);
    layout->addWidget(m_table);
    layout->addWidget(m_note);
    setFigures({}, {});
}

void FigureTable::setFigures(const std::vector<MethodRow>& figures, const QString& pose) {
    m_pose = pose;
    m_stale = false;
    m_table->setVisible(!figures.empty());
    m_table->setRowCount(int(figures.size()));
    const QLocale locale;
    std::optional<double> best;
    for (const MethodRow& each : figures)
        if (each.psnr)
            best = std::max(best.value_or(*each.psnr), *each.psnr);
    for (std::size_t row = 0; row < figures.size(); ++row) {
        const MethodRow& each = figures[row];
        const bool reference = each.method == Method::RayTrace;
        const auto count = [&](std::size_t value) {
            return value == 0 ? QStringLiteral("–") : locale.toString(qulonglong(value));
        };
        const auto share = [&](const std::optional<double>& value) {
            return value ? tr("%1 %").arg(locale.toString(100.0 * *value, 'f', 1))
                         : QStringLiteral("–");
        };
        const std::array<QString, kColumns> texts{
            methodText(each.method),
            each.psnr   ? tr("%1 dB").arg(locale.toString(*each.psnr, 'f', 1))
            : reference ? QStringLiteral("–")
                        : tr("identical"),
            each.ssim ? locale.toString(*each.ssim, 'f', 3) : QStringLiteral("–"),
            each.flip ? locale.toString(*each.flip, 'f', 3) : QStringLiteral("–"),
            share(each.wrongSurface),
            locale.toString(each.milliseconds, 'f', 1),
            count(each.quads),
            count(each.rays),
            share(each.uncovered)};
        for (int column = 0; column < kColumns; ++column) {
            auto* item = new QTableWidgetItem(texts[std::size_t(column)]);
            if (column != Name)
                item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
            else
                item->setToolTip(methodHelp(each.method));
            QFont font = m_table->font();
            font.setBold(best && each.psnr && *each.psnr == *best);
            item->setFont(font);
            m_table->setItem(int(row), column, item);
        }
    }
    m_table->resizeColumnsToContents();
    m_table->resizeRowsToContents();
    int height = m_table->horizontalHeader()->sizeHint().height() + 2 * m_table->frameWidth();
    for (int row = 0; row < m_table->rowCount(); ++row)
        height += m_table->rowHeight(row);
    constexpr int kScrollBarRoom = 16;
    m_table->setFixedHeight(height + kScrollBarRoom);
    showNote();
}

void FigureTable::setStale(bool stale) {
    m_stale = stale;
    m_table->setEnabled(!stale);
    showNote();
}

void FigureTable::showNote() {
    if (m_table->rowCount() == 0)
        m_note->setText(tr("Not measured yet."));
    else if (m_stale)
        m_note->setText(
            tr("Measured at %1; something has changed since. Check again.").arg(m_pose));
    else
        m_note->setText(tr("Measured at %1.").arg(m_pose));
}

}  // namespace reflet
