// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/MessageBar.h"

#include "widgets/common/Look.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

namespace reflet {

namespace {

constexpr int kIcon = 20;
constexpr int kStripe = 4;  ///< width of the coloured stripe at the left

QColor severityColor(Severity severity) {
    switch (severity) {
        case Severity::Info:
            return QColor(DataColor::kBlue);
        case Severity::Warning:
            return QColor(DataColor::kOrange);
        case Severity::Error:
            break;
    }
    return QColor(DataColor::kVermilion);
}

QString sentence(const QString& text) {
    if (text.isEmpty())
        return text;
    QString result = text;
    result[0] = result[0].toUpper();
    if (!QStringLiteral(".!?…").contains(result.back()))
        result += QLatin1Char('.');
    return result;
}

QString richText(const Message& message) {
    QString text = QStringLiteral("<b>%1</b>").arg(sentence(message.what).toHtmlEscaped());
    if (!message.subject.isEmpty())
        text += QStringLiteral("<br>") + message.subject.toHtmlEscaped();
    if (!message.remedy.isEmpty())
        text += QStringLiteral("<br>") + sentence(message.remedy).toHtmlEscaped();
    return text;
}

}  // namespace

Message toMessage(const Error& error) {
    Message message;
    message.severity = Severity::Error;
    message.what = QString::fromStdString(error.what);
    message.subject = QString::fromStdString(error.subject);
    message.remedy = QString::fromStdString(error.remedy);
    QStringList trail;
    for (const std::string& context : error.trail)
        trail << QString::fromStdString(context);
    message.details = trail.join(QLatin1Char('\n'));
    return message;
}

MessageBar::MessageBar(QWidget* parent) : QFrame(parent) {
    setFocusPolicy(Qt::StrongFocus);
    setAutoFillBackground(true);
    setBackgroundRole(QPalette::ToolTipBase);
    setForegroundRole(QPalette::ToolTipText);
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(kStripe + 8, 6, 6, 6);
    m_icon = new QLabel(this);
    m_text = new QLabel(this);
    m_text->setObjectName(QStringLiteral("messageText"));
    m_details = new QLabel(this);
    for (QLabel* label : {m_text, m_details}) {
        label->setWordWrap(true);
        label->setTextInteractionFlags(Qt::TextSelectableByMouse);
        label->setForegroundRole(QPalette::ToolTipText);
    }
    m_text->setTextFormat(Qt::RichText);
    m_details->setTextFormat(Qt::PlainText);
    auto* texts = new QVBoxLayout;
    texts->addWidget(m_text);
    texts->addWidget(m_details);
    m_actions = new QHBoxLayout;
    auto* actionRow = new QHBoxLayout;  // keeps the buttons to the left
    actionRow->addLayout(m_actions);
    actionRow->addStretch();
    texts->addLayout(actionRow);
    m_more = new QToolButton(this);
    m_more->setObjectName(QStringLiteral("messageDetails"));
    m_more->setText(tr("Details"));
    m_more->setCheckable(true);
    m_more->setToolTip(tr("Show where this happened"));
    connect(m_more, &QToolButton::toggled, m_details, &QLabel::setVisible);
    m_waiting = new QLabel(this);
    m_waiting->setForegroundRole(QPalette::ToolTipText);
    auto* cross = new QToolButton(this);
    cross->setObjectName(QStringLiteral("messageClose"));
    cross->setText(QStringLiteral("✕"));
    cross->setAutoRaise(true);
    cross->setToolTip(tr("Close (Escape)"));
    cross->setAccessibleName(tr("Close this message"));
    connect(cross, &QToolButton::clicked, this, &MessageBar::close);

    layout->addWidget(m_icon, 0, Qt::AlignTop);
    layout->addLayout(texts, 1);
    layout->addWidget(m_waiting, 0, Qt::AlignTop);
    layout->addWidget(m_more, 0, Qt::AlignTop);
    layout->addWidget(cross, 0, Qt::AlignTop);
    hide();
}

quint64 MessageBar::post(const Message& message) {
    for (const Entry& entry : m_queue) {
        const Message& other = entry.message;
        if (other.what == message.what && other.subject == message.subject &&
            other.remedy == message.remedy)
            return entry.id;
    }
    // What went wrong comes before what went well.
    const auto behind = std::find_if(m_queue.begin(), m_queue.end(), [&](const Entry& entry) {
        return entry.message.severity < message.severity;
    });
    m_queue.insert(behind, {m_next, message});
    showFront();
    return m_next++;
}

void MessageBar::dismiss(quint64 id) {
    const auto found = std::find_if(m_queue.begin(), m_queue.end(),
                                    [id](const Entry& entry) { return entry.id == id; });
    if (found == m_queue.end())
        return;
    m_queue.erase(found);
    showFront();
    Q_EMIT dismissed(id);
}

void MessageBar::dismissAll() {
    while (!m_queue.empty())
        dismiss(m_queue.front().id);
}

void MessageBar::close() {
    if (!m_queue.empty())
        dismiss(m_queue.front().id);
}

void MessageBar::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Escape && !m_queue.empty()) {
        close();
        return;
    }
    QFrame::keyPressEvent(event);
}

void MessageBar::changeEvent(QEvent* event) {
    QFrame::changeEvent(event);
    if (event->type() == QEvent::PaletteChange)
        update();
}

void MessageBar::paintEvent(QPaintEvent* event) {
    QFrame::paintEvent(event);
    if (m_queue.empty())
        return;
    QPainter painter(this);
    painter.fillRect(0, 0, kStripe, height(), severityColor(m_queue.front().message.severity));
    painter.setPen(palette().color(QPalette::Mid));
    painter.drawLine(0, height() - 1, width(), height() - 1);
}

void MessageBar::showFront() {
    while (QLayoutItem* item = m_actions->takeAt(0)) {
        item->widget()->hide();
        item->widget()->deleteLater();
        delete item;
    }
    if (m_queue.empty()) {
        hide();
        return;
    }
    const Entry& front = m_queue.front();
    const Message& message = front.message;
    m_icon->setPixmap(severityIcon(message.severity).pixmap({kIcon, kIcon}, devicePixelRatioF()));
    m_icon->setAccessibleName(severityText(message.severity));
    m_text->setText(richText(message));
    m_details->setText(message.details);
    m_more->setChecked(false);
    m_details->hide();
    m_more->setVisible(!message.details.isEmpty());
    m_waiting->setVisible(m_queue.size() > 1);
    m_waiting->setText(tr("and %n more", nullptr, int(m_queue.size()) - 1));
    for (int i = 0; i < message.actions.size(); ++i) {
        auto* button = new QPushButton(message.actions[i], this);
        button->setObjectName(QStringLiteral("messageAction%1").arg(i));
        connect(button, &QPushButton::clicked, this, [this, i, id = front.id] {
            Q_EMIT actionTriggered(id, i);
            dismiss(id);
        });
        m_actions->addWidget(button, 0, Qt::AlignTop);
    }
    setAccessibleName(severityText(message.severity) + QStringLiteral(": ") + message.what);
    setAccessibleDescription(message.subject + QStringLiteral(" ") + message.remedy);
    show();
    update();
}

}  // namespace reflet
