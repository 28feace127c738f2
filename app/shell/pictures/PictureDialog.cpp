// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/pictures/PictureDialog.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QRadioButton>
#include <QSpinBox>
#include <QVBoxLayout>

namespace reflet {
namespace {

constexpr QSize kHd(1280, 720);
constexpr QSize kFullHd(1920, 1080);
constexpr QSize kUltraHd(3840, 2160);
constexpr QSize kPoster(4961, 3508);  // A3 at 300 dots an inch
constexpr int kRemarkWidth = 420;
constexpr int kLongestFilm = 600;  // seconds

}  // namespace

PictureDialog::PictureDialog(For purpose, const QSize& shown, const QString& remark,
                             QWidget* parent)
    : QDialog(parent) {
    const bool picture = purpose == For::Picture;
    setObjectName(picture ? QStringLiteral("pictureDialog") : QStringLiteral("filmDialog"));
    setWindowTitle(picture ? tr("Save picture") : tr("Save film"));
    auto* form = new QFormLayout;
    addSizes(form, picture, shown);
    if (picture) {
        addQuality(form);
    } else {
        addCourse(form);
    }
    auto* note = new QLabel(remark);
    note->setObjectName(QStringLiteral("pictureRemark"));
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

void PictureDialog::addSizes(QFormLayout* form, bool picture, const QSize& shown) {
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
    form->addRow(tr("S&ize"), m_size);
}

void PictureDialog::addQuality(QFormLayout* form) {
    auto* quick = new QRadioButton(tr("&Quick: as on the screen"));
    quick->setObjectName(QStringLiteral("pictureQuick"));
    quick->setChecked(true);
    m_best = new QRadioButton(tr("&Best: light and shadows ray traced, takes minutes"));
    m_best->setObjectName(QStringLiteral("pictureBest"));
    form->addRow(tr("Quality"), quick);
    form->addRow(QString(), m_best);
}

void PictureDialog::addCourse(QFormLayout* form) {
    m_seconds = new QSpinBox;
    m_seconds->setObjectName(QStringLiteral("filmSeconds"));
    m_seconds->setRange(1, kLongestFilm);
    m_seconds->setValue(PictureChoice().seconds);
    m_seconds->setSuffix(tr(" s"));
    form->addRow(tr("&Length"), m_seconds);
    m_camera = new QComboBox;
    m_camera->setObjectName(QStringLiteral("filmCamera"));
    m_camera->addItem(tr("As on the screen"), false);
    m_camera->addItem(tr("From the pavement, turning after the vehicle"), true);
    form->addRow(tr("&Camera"), m_camera);
}

PictureChoice PictureDialog::choice() const {
    PictureChoice choice;
    choice.size = m_size->currentData().toSize();
    choice.best = m_best && m_best->isChecked();
    if (m_seconds) {
        choice.seconds = m_seconds->value();
        choice.pavement = m_camera->currentData().toBool();
    }
    return choice;
}

}  // namespace reflet
