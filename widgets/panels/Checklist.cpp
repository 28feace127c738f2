// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/Checklist.h"

#include "widgets/common/Look.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QToolButton>
#include <QVBoxLayout>

namespace reflet {

namespace {

constexpr int kMark = 18;  ///< logical pixels

/// A ring with the step's number, or a disc with a tick.
QIcon stepIcon(int number, bool done, const QPalette& palette) {
    QIcon icon;
    for (const int ratio : {1, 2, 3}) {
        QPixmap pixmap(kMark * ratio, kMark * ratio);
        pixmap.setDevicePixelRatio(ratio);
        pixmap.fill(Qt::transparent);
        QPainter painter(&pixmap);
        painter.setRenderHint(QPainter::Antialiasing);
        const QRectF disc(1.0, 1.0, kMark - 2.0, kMark - 2.0);
        if (done) {
            painter.setPen(Qt::NoPen);
            painter.setBrush(QColor(DataColor::kGreen));
            painter.drawEllipse(disc);
            painter.setPen(QPen(Qt::white, 2.0, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
            painter.drawPolyline(QPolygonF({{5.0, 9.5}, {8.0, 12.5}, {13.0, 6.0}}));
        } else {
            painter.setPen(QPen(mutedText(palette), 1.3));
            painter.drawEllipse(disc);
            QFont font = painter.font();
            font.setPixelSize(11);
            painter.setFont(font);
            painter.drawText(disc, Qt::AlignCenter, QString::number(number));
        }
        icon.addPixmap(pixmap);
    }
    return icon;
}

}  // namespace

Checklist::Checklist(QWidget* parent) : QWidget(parent) {
    setAccessibleName(tr("First steps"));
    auto* layout = new QVBoxLayout(this);
    layout->setSpacing(2);
    auto* heading = new QHBoxLayout;
    m_title = new QLabel(this);
    m_title->setObjectName(QStringLiteral("checklistTitle"));
    QFont bold = m_title->font();
    bold.setBold(true);
    m_title->setFont(bold);
    auto* close = new QToolButton(this);
    close->setObjectName(QStringLiteral("checklistClose"));
    close->setText(tr("Leave"));
    close->setAutoRaise(true);
    close->setToolTip(tr("Close this list; it can be opened again from the Help menu"));
    connect(close, &QToolButton::clicked, this, &Checklist::left);
    heading->addWidget(m_title, 1);
    heading->addWidget(close);
    layout->addLayout(heading);

    const std::array<QString, kSteps> titles{
        tr("Drop a city"), tr("Draw a route"), tr("Make it reflect"),
        tr("Check against the reference"), tr("Save a picture or a film")};
    const std::array<QString, kSteps> helps{
        tr("Drag a CityJSON or CityGML file into the window, or press to choose one."),
        tr("Press, then click where the vehicle starts and where it ends."),
        tr("Puts a vehicle on the route and reflection probes along it."),
        tr("Traces the reflections anew and says how close Reflet comes."),
        tr("Something to take away: a picture, or 20 seconds of film.")};
    for (std::size_t i = 0; i < kSteps; ++i) {
        auto* button = new QPushButton(titles[i], this);
        button->setObjectName(QStringLiteral("step%1").arg(i + 1));
        button->setFlat(true);
        button->setIconSize({kMark, kMark});
        button->setStyleSheet(QStringLiteral("text-align: left; padding: 4px;"));
        button->setToolTip(helps[i]);
        button->setAccessibleDescription(helps[i]);
        connect(button, &QPushButton::clicked, this, [this, i] { Q_EMIT stepActivated(int(i)); });
        auto* help = new QLabel(helps[i], this);
        help->setWordWrap(true);
        help->setContentsMargins(kMark + 14, 0, 0, 6);
        m_buttons[i] = button;
        m_help[i] = help;
        layout->addWidget(button);
        layout->addWidget(help);
    }
    layout->addStretch();
    refresh();
}

void Checklist::setDone(Step step, bool done) {
    if (m_done[std::size_t(step)] == done)
        return;
    m_done[std::size_t(step)] = done;
    refresh();
}

void Checklist::setPossible(Step step, bool possible) {
    m_possible[std::size_t(step)] = possible;
    m_buttons[std::size_t(step)]->setEnabled(possible);
}

void Checklist::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange && m_title)
        refresh();
}

/// The first step that is open says how; the others only their names.
void Checklist::refresh() {
    bool next = true;
    int count = 0;
    for (std::size_t i = 0; i < kSteps; ++i) {
        const bool current = !m_done[i] && next;
        next = next && m_done[i];
        count += m_done[i] ? 1 : 0;
        m_buttons[i]->setIcon(stepIcon(int(i) + 1, m_done[i], palette()));
        m_buttons[i]->setAccessibleName(m_done[i] ? tr("%1, done").arg(m_buttons[i]->text())
                                                  : m_buttons[i]->text());
        QFont font = m_buttons[i]->font();
        font.setBold(current);
        m_buttons[i]->setFont(font);
        m_help[i]->setVisible(current);
    }
    m_title->setText(count == kSteps ? tr("All five steps are done")
                                     : tr("Five steps · %1 done").arg(count));
}

}  // namespace reflet
