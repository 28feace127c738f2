// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/pictures/PictureDialog.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QRadioButton>
#include <QVBoxLayout>

namespace reflet {
namespace {

constexpr QSize kHd(1280, 720);
constexpr QSize kFullHd(1920, 1080);
constexpr QSize kUltraHd(3840, 2160);
constexpr QSize kPoster(4961, 3508);  // A3 at 300 dots an inch
constexpr int kRemarkWidth = 420;

}  // namespace

PictureDialog::PictureDialog(For purpose, const QSize& shown, const QString& remark,
                             QWidget* parent)
    : QDialog(parent) {
    const bool picture = purpose == For::Picture;
    setObjectName(picture ? QStringLiteral("pictureDialog") : QStringLiteral("filmDialog"));
    setWindowTitle(picture ? tr("Save picture") : tr("Save 20 s film"));

    m_size = new QComboBox;
    m_size->setObjectName(QStringLiteral("pictureSize"));
    auto add = [this](const QString& name, const QSize& size) {
        m_size->addItem(tr("%1 – %2 × %3").arg(name).arg(size.width()).arg(size.height()), size);
    };
    // Films need even numbers.
    add(tr("As on the screen"), QSize(shown.width() & ~1, shown.height() & ~1));
    add(tr("HD"), kHd);
    add(tr("Full HD, for slides"), kFullHd);
    add(tr("Ultra HD"), kUltraHd);
    if (picture) {
        add(tr("Poster, A3 at 300 dpi"), kPoster);
    }
    m_size->setCurrentIndex(picture ? 2 : 1);

    auto* quick = new QRadioButton(tr("&Quick: as on the screen"));
    quick->setObjectName(QStringLiteral("pictureQuick"));
    quick->setChecked(true);
    m_best = new QRadioButton(tr("&Best: light and shadows ray traced, takes minutes"));
    m_best->setObjectName(QStringLiteral("pictureBest"));

    auto* form = new QFormLayout;
    form->addRow(tr("&Size"), m_size);
    if (picture) {
        form->addRow(tr("Quality"), quick);
        form->addRow(QString(), m_best);
    } else {
        // Only OpenGL draws 600 pictures in a reasonable time.
        quick->setParent(this);
        quick->hide();
        m_best->setParent(this);
        m_best->hide();
    }
    auto* note = new QLabel(remark);
    note->setWordWrap(true);
    note->setMinimumWidth(kRemarkWidth);
    note->setVisible(!remark.isEmpty());
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Save | QDialogButtonBox::Cancel);
    buttons->button(QDialogButtonBox::Save)->setText(tr("&Save as…"));
    connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);

    auto* column = new QVBoxLayout(this);
    column->addLayout(form);
    column->addWidget(note);
    column->addWidget(buttons);
}

PictureChoice PictureDialog::choice() const {
    return {m_size->currentData().toSize(), m_best->isChecked()};
}

}  // namespace reflet
