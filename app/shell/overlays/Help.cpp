// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/overlays/Help.h"

#include "app/pipeline/Version.h"
#include "app/shell/Commands.h"
#include "app/shell/Icons.h"
#include "app/shell/overlays/Card.h"

#include <QCoreApplication>
#include <QGridLayout>
#include <QLabel>
#include <QVBoxLayout>

namespace reflet {
namespace {

constexpr int kTextWidth = 620;
constexpr int kKeyColumns = 3;
constexpr int kProgramIconSide = 64;

QString text(const char* source) {
    return QCoreApplication::translate("reflet::Help", source);
}

QLabel* paragraph(const QString& html) {
    auto* label = new QLabel(html);
    label->setWordWrap(true);
    label->setTextFormat(Qt::RichText);
    label->setFixedWidth(kTextWidth);
    label->setOpenExternalLinks(true);
    return label;
}

QString withoutMnemonic(QString menuText) {
    return menuText.remove(QLatin1Char('&')).remove(QStringLiteral("…"));
}

/// The keys of one group of commands, as a table of its own.
QLabel* keysOf(CommandGroup group, const Commands& commands) {
    QString rows;
    for (const CommandInfo& info : allCommands()) {
        const QAction* action = commands.action(info.command);
        if (info.group != group || action->shortcut().isEmpty()) {
            continue;
        }
        rows += QStringLiteral("<tr><td style='padding-right:14px'><b>%1</b></td><td>%2</td></tr>")
                    .arg(action->shortcut().toString(QKeySequence::NativeText).toHtmlEscaped(),
                         withoutMnemonic(action->text()).toHtmlEscaped());
    }
    auto* label =
        new QLabel(QStringLiteral("<h3>%1</h3><table cellpadding='2'>%2</table>")
                       .arg(withoutMnemonic(Commands::groupTitle(group)).toHtmlEscaped(), rows));
    label->setTextFormat(Qt::RichText);
    return label;
}

QLabel* mouseKeys() {
    const std::pair<const char*, const char*> rows[] = {
        {QT_TRANSLATE_NOOP("reflet::Help", "Drag"),
         QT_TRANSLATE_NOOP("reflet::Help", "Turn around the place under the cursor")},
        {QT_TRANSLATE_NOOP("reflet::Help", "Shift + drag, or middle button"),
         QT_TRANSLATE_NOOP("reflet::Help", "Move along the ground")},
        {QT_TRANSLATE_NOOP("reflet::Help", "Wheel"),
         QT_TRANSLATE_NOOP("reflet::Help", "Nearer and farther")},
        {QT_TRANSLATE_NOOP("reflet::Help", "Click"),
         QT_TRANSLATE_NOOP("reflet::Help", "Select; drag a probe or a corner to move it")},
        {QT_TRANSLATE_NOOP("reflet::Help", "Escape"),
         QT_TRANSLATE_NOOP("reflet::Help", "Put the tool down, leave the walk")},
    };
    QString cells;
    for (const auto& [keys, meaning] : rows) {
        cells += QStringLiteral("<tr><td style='padding-right:14px'><b>%1</b></td><td>%2</td></tr>")
                     .arg(text(keys), text(meaning));
    }
    auto* label =
        new QLabel(QStringLiteral("<h3>%1</h3><table cellpadding='2'>%2</table>")
                       .arg(text(QT_TRANSLATE_NOOP("reflet::Help", "In the picture")), cells));
    label->setTextFormat(Qt::RichText);
    return label;
}

}  // namespace

void showKeys(const Commands& commands, QWidget* window) {
    auto* card = new Card(text(QT_TRANSLATE_NOOP("reflet::Help", "Keys")), window);
    card->setObjectName(QStringLiteral("keysOverlay"));
    auto* grid = new QGridLayout;
    grid->setHorizontalSpacing(kTextWidth / 15);
    int cell = 0;
    for (const auto group : {CommandGroup::File, CommandGroup::Edit, CommandGroup::Place,
                             CommandGroup::View, CommandGroup::Compare}) {
        grid->addWidget(keysOf(group, commands), cell / kKeyColumns, cell % kKeyColumns,
                        Qt::AlignTop);
        ++cell;
    }
    grid->addWidget(mouseKeys(), cell / kKeyColumns, cell % kKeyColumns, Qt::AlignTop);
    card->body()->addLayout(grid);
    card->open();
}

void showExplanation(QWidget* window) {
    auto* card = new Card(text(QT_TRANSLATE_NOOP("reflet::Help", "What am I seeing?")), window);
    card->setObjectName(QStringLiteral("explanationOverlay"));
    const char* const paragraphs[] = {
        QT_TRANSLATE_NOOP("reflet::Help",
                          "A vehicle drives down a street. Its paint and its windows are shiny, so "
                          "in them you should see that street: the right house at the right place, "
                          "sliding along as the vehicle passes."),
        QT_TRANSLATE_NOOP("reflet::Help",
                          "<b>The bar</b> divides the picture; drag it. On one side the vehicle "
                          "reflects only the sky, as in most presentations. On the other side it "
                          "reflects what stands around it, by Reflet."),
        QT_TRANSLATE_NOOP(
            "reflet::Help",
            "<b>Reflection probes</b> make that possible. Each is a point above the "
            "street that has looked once in all directions, and remembers what it saw "
            "and how far away it was. While the vehicle drives, Reflet follows rays "
            "from where the vehicle is now into the city, finds the place that each "
            "one meets, and fetches its colour from the probes that saw that place. "
            "That is fast enough for a drive without a pause."),
        QT_TRANSLATE_NOOP("reflet::Help",
                          "<b>The reference, ray traced</b>, is what the vehicle truly reflects in "
                          "this model. It is slow, so it is worked out for a vehicle that stands "
                          "still. <i>Check against the reference</i> says in figures how close "
                          "Reflet comes, and shows both side by side. It is true to the model: a "
                          "façade that the model does not have is not reflected."),
    };
    for (const char* source : paragraphs) {
        card->body()->addWidget(paragraph(text(source)));
    }
    card->open();
}

void showAbout(QWidget* window) {
    auto* card = new Card(text(QT_TRANSLATE_NOOP("reflet::Help", "About Reflet")), window);
    card->setObjectName(QStringLiteral("aboutOverlay"));
    auto* picture = new QLabel;
    picture->setPixmap(programIcon().pixmap(kProgramIconSide));
    card->body()->addWidget(picture);
    card->body()->addWidget(paragraph(
        text(QT_TRANSLATE_NOOP("reflet::Help",
                               "<b>Reflet %1</b><br>Vehicles that reflect the city they drive "
                               "through: placed, tuned, measured and shown."))
            .arg(QString::fromLatin1(kVersion))));
    card->body()->addWidget(paragraph(text(QT_TRANSLATE_NOOP(
        "reflet::Help",
        "Free software under the GNU General Public License, version 3 or later: use it, study it, "
        "change it and pass it on. It comes without any warranty."))));
    card->body()->addWidget(paragraph(
        text(
            QT_TRANSLATE_NOOP(
                "reflet::Help",
                "Made with Qt %1 (LGPL-3.0), CGAL (GPL-3.0 and LGPL-3.0), Embree (Apache-2.0), "
                "oneTBB (Apache-2.0), PROJ (MIT), GDAL (MIT), OpenImageIO (Apache-2.0), GLM (MIT), "
                "libepoxy (MIT), simdjson (Apache-2.0), nlohmann-json (MIT), fmt (MIT), "
                "GeographicLib (MIT), xxHash (BSD-2-Clause) and tl::expected (CC0-1.0)."))
            .arg(QString::fromLatin1(qVersion()))));
    card->body()->addWidget(paragraph(text(QT_TRANSLATE_NOOP(
        "reflet::Help",
        "The methods are those of Meyer and Loscos, <i>Real-time reflection on moving vehicles in "
        "urban environments</i> (2003), and of the papers that build upon it; the manual names "
        "them all."))));
    card->open();
}

}  // namespace reflet
