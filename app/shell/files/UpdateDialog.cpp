// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/files/UpdateDialog.h"

#include <QDialogButtonBox>
#include <QHeaderView>
#include <QLabel>
#include <QLocale>
#include <QPushButton>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>

namespace reflet {

namespace {

constexpr int kChangeRole = Qt::UserRole;
constexpr int kWidth = 620, kHeight = 460;

QString detailsOf(const ObjectChange& change) {
    QStringList details;
    if (change.geometry)
        details << UpdateDialog::tr("shape or place");
    if (change.appearance)
        details << UpdateDialog::tr("materials, textures or kinds of surfaces");
    if (change.description)
        details << UpdateDialog::tr("class or parent");
    if (change.attributes)
        details << UpdateDialog::tr("attributes");
    return details.join(QStringLiteral(", "));
}

QString titleOf(ObjectChange::Kind kind, std::size_t count) {
    const QString number = QLocale().toString(qulonglong(count));
    switch (kind) {
        case ObjectChange::Kind::Added:
            return UpdateDialog::tr("Added: %1").arg(number);
        case ObjectChange::Kind::Removed:
            return UpdateDialog::tr("Removed: %1").arg(number);
        case ObjectChange::Kind::Changed:
            break;
    }
    return UpdateDialog::tr("Changed: %1").arg(number);
}

QString reasonOf(AffectedProbe::Why why) {
    switch (why) {
        case AffectedProbe::Why::Sees:
            return UpdateDialog::tr("sees %1");
        case AffectedProbe::Why::Lit:
            return UpdateDialog::tr("shows what takes light or shadow from %1");
        case AffectedProbe::Why::Near:
            break;
    }
    return UpdateDialog::tr("stands near %1");
}

}  // namespace

UpdateDialog::UpdateDialog(SourceUpdate update, QWidget* parent)
    : QDialog(parent), m_update(std::move(update)) {
    setObjectName(QStringLiteral("updateDialog"));
    setWindowTitle(tr("What the new file changes"));
    resize(kWidth, kHeight);
    auto* layout = new QVBoxLayout(this);
    auto* summary = new QLabel(
        tr("%1 objects stay as they are. Probes, routes and vehicles are kept; probes that show "
           "a change take their pictures anew.")
            .arg(QLocale().toString(qulonglong(m_update.changes.unchanged))),
        this);
    summary->setWordWrap(true);
    layout->addWidget(summary);

    auto* tree = new QTreeWidget(this);
    tree->setObjectName(QStringLiteral("updateChanges"));
    tree->setAccessibleName(tr("Changes, by object"));
    tree->setHeaderLabels({tr("Object"), tr("Class"), tr("What is new")});
    tree->setAlternatingRowColors(true);
    tree->setUniformRowHeights(true);
    for (const auto kind :
         {ObjectChange::Kind::Added, ObjectChange::Kind::Removed, ObjectChange::Kind::Changed})
        addChanges(tree->invisibleRootItem(), kind);
    auto* probes = new QTreeWidgetItem(
        tree, {tr("Probes that show a change: %1")
                   .arg(QLocale().toString(qulonglong(m_update.probes.size())))});
    for (const AffectedProbe& probe : m_update.probes) {
        const QString object = QString::fromStdString(probe.object);
        new QTreeWidgetItem(probes, {QString::fromStdString(probe.id), tr("Probe"),
                                     reasonOf(probe.why).arg(object)});
    }
    tree->expandAll();
    tree->header()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
    layout->addWidget(tree, 1);

    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
    auto* apply = buttons->addButton(tr("Update"), QDialogButtonBox::AcceptRole);
    apply->setObjectName(QStringLiteral("updateApply"));
    apply->setDefault(true);
    layout->addWidget(buttons);
    connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(tree, &QTreeWidget::itemActivated, this, [this](QTreeWidgetItem* item) {
        const QVariant number = item->data(0, kChangeRole);
        if (!number.isValid())
            return;
        const ObjectChange& change = m_update.changes.objects[number.toUInt()];
        Q_EMIT placeWanted(change.before.empty() ? change.after : change.before,
                           QString::fromStdString(change.id));
    });
}

void UpdateDialog::addChanges(QTreeWidgetItem* parent, ObjectChange::Kind kind) {
    // A list that nobody reads to its end need not be built to its end.
    constexpr std::size_t kShown = 2000;
    const auto& all = m_update.changes.objects;
    const std::size_t count = m_update.changes.count(kind);
    auto* group = new QTreeWidgetItem(parent, {titleOf(kind, count)});
    std::size_t shown = 0;
    for (std::size_t i = 0; i < all.size() && shown < kShown; ++i) {
        if (all[i].kind != kind)
            continue;
        auto* row =
            new QTreeWidgetItem(group, {QString::fromStdString(all[i].id),
                                        QString::fromStdString(all[i].type), detailsOf(all[i])});
        row->setData(0, kChangeRole, uint(i));
        ++shown;
    }
    if (shown < count)
        new QTreeWidgetItem(group, {tr("… and %1 more").arg(qulonglong(count - shown))});
}

}  // namespace reflet
