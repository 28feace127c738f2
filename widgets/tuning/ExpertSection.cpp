// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/tuning/ExpertSection.h"

#include "widgets/common/NumberEdit.h"

#include <QCheckBox>
#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QToolButton>
#include <array>

namespace reflet {

namespace {

constexpr std::array kMapSizes{32, 64, 128, 256, 512};
constexpr std::array kProbeSizes{32, 64, 128, 256, 512, 1024};

/// Chooses `size`, which is added when a project has one of its own.
void chooseSize(QComboBox* box, int size) {
    int index = box->findData(size);
    if (index < 0) {
        box->addItem(QStringLiteral("%1 × %1").arg(size), size);
        index = box->count() - 1;
    }
    box->setCurrentIndex(index);
}

}  // namespace

ExpertSection::ExpertSection(QWidget* parent) : QWidget(parent), m_grid(new QGridLayout(this)) {
    m_grid->setContentsMargins(0, 0, 0, 0);
    m_grid->setColumnStretch(1, 1);
    addNumber(tr("&Mesh size N"),
              tr("Quads along an edge of each face before any are divided; 10 in the paper"),
              &MemSettings::meshSize, 1.0, 128.0, 1.0, 0);
    addNumber(tr("&Smallest quad"),
              tr("Quads are not divided below this many texels; 1 is the finest"),
              &MemSettings::smallestQuad, 1.0, 64.0, 1.0, 0);
    addNumber(tr("&Error bound"),
              tr("Divide quads where the look-up would be this many texels beside the true place, "
                 "instead of by depth; 0 = by depth, as in the paper"),
              &MemSettings::errorBound, 0.0, 16.0, 0.1, 1);
    addNumber(tr("Probes per &vehicle"),
              tr("The most probes that one reflection is made from; 2 in the paper"),
              &MemSettings::remsPerVehicle, 1.0, double(kMostRems), 1.0, 0);
    addResolutions();
    addFlag(tr("Refine where probes change over"),
            tr("Divide quads also where another probe takes over or where city meets sky"),
            &MemSettings::refineAtValidity);
    addFlag(tr("Correct hits by the probes' distances"),
            tr("The height model knows slanting walls as stairs; the probes know better"),
            &MemSettings::refineHits);
    addFlag(tr("See from the body, not from its middle"),
            tr("Reflections are looked up where the mirrored ray ends; off, as if all were "
               "infinitely far, as in the paper"),
            &MemSettings::parallax);
    addFlag(tr("Trace edges texel by texel"), tr("At silhouettes each texel gets a ray of its own"),
            &MemSettings::traceEdgeTexels);
    addChoice(
        tr("&Interpolation"),
        tr("How pictures run across a quad: exact on planes, or linear as the hardware of 2003 "
           "did it"),
        "expertInterpolation", {tr("Exact"), tr("As in the paper")}, &MemSettings::interpolation);
    addChoice(
        tr("Probes by"),
        tr("Which probes show a point: those that see it best, or the same two for all, as in "
           "the paper"),
        "expertWeighting", {tr("Sight"), tr("As in the paper")}, &MemSettings::weighting);
}

void ExpertSection::addRow(const QString& name, const QString& help, QWidget* editor,
                           std::function<void()> show, std::function<bool()> isAutomatic,
                           std::function<void()> reset) {
    const int row = m_grid->rowCount();
    editor->setToolTip(help);
    const QString plain = QString(name).remove(QLatin1Char('&'));
    editor->setAccessibleName(plain);
    if (auto* number = qobject_cast<NumberEdit*>(editor)) {
        m_grid->addWidget(new DragLabel(name, number, this), row, 0);
        m_grid->addWidget(editor, row, 1);
    } else if (qobject_cast<QCheckBox*>(editor)) {
        m_grid->addWidget(editor, row, 0, 1, 2);
    } else {
        auto* label = new QLabel(name, this);
        label->setBuddy(editor);
        m_grid->addWidget(label, row, 0);
        m_grid->addWidget(editor, row, 1);
    }
    auto* automatic = new QToolButton(this);
    automatic->setText(tr("Automatic"));
    automatic->setToolTip(tr("Back to what Reflet chooses by itself: %1").arg(plain));
    automatic->setAccessibleName(automatic->toolTip());
    automatic->setAutoRaise(true);
    connect(automatic, &QToolButton::clicked, this, reset);
    m_grid->addWidget(automatic, row, 2);
    m_fields.push_back({automatic, std::move(show), std::move(isAutomatic)});
}

template <class T>
void ExpertSection::addNumber(const QString& name, const QString& help, T MemSettings::*member,
                              double least, double most, double step, int decimals) {
    auto* edit = new NumberEdit(this);
    edit->setObjectName(QStringLiteral("expertNumber%1").arg(m_fields.size()));
    edit->setRange(least, most);
    edit->setSingleStep(step);
    edit->setDecimals(decimals);
    connect(edit, &NumberEdit::edited, this, [this, member](double value, DragPhase phase) {
        m_tuning.*member = T(value);
        report(phase);
    });
    addRow(
        name, help, edit, [this, edit, member] { edit->show(double(m_tuning.*member)); },
        [this, member] { return m_tuning.*member == MemSettings{}.*member; },
        [this, member] {
            m_tuning.*member = MemSettings{}.*member;
            report(DragPhase::End);
        });
}

void ExpertSection::addFlag(const QString& name, const QString& help, bool MemSettings::*member) {
    auto* box = new QCheckBox(name, this);
    connect(box, &QCheckBox::clicked, this, [this, member](bool on) {
        m_tuning.*member = on;
        report(DragPhase::End);
    });
    addRow(
        name, help, box, [this, box, member] { box->setChecked(m_tuning.*member); },
        [this, member] { return m_tuning.*member == MemSettings{}.*member; },
        [this, member] {
            m_tuning.*member = MemSettings{}.*member;
            report(DragPhase::End);
        });
}

void ExpertSection::addResolutions() {
    auto* map = new QComboBox(this);
    map->setObjectName(QStringLiteral("expertMapResolution"));
    for (const int size : kMapSizes)
        map->addItem(QStringLiteral("%1 × %1").arg(size), size);
    connect(map, &QComboBox::activated, this, [this, map] {
        m_tuning.resolution = map->currentData().toInt();
        report(DragPhase::End);
    });
    addRow(
        tr("Ma&p resolution"), tr("Texels of each of the six faces that a vehicle reflects"), map,
        [this, map] { chooseSize(map, m_tuning.resolution); },
        [this] { return m_tuning.resolution == MemSettings{}.resolution; },
        [this] {
            m_tuning.resolution = MemSettings{}.resolution;
            report(DragPhase::End);
        });

    auto* probe = new QComboBox(this);
    probe->setObjectName(QStringLiteral("expertProbeResolution"));
    for (const int size : kProbeSizes)
        probe->addItem(QStringLiteral("%1 × %1").arg(size), size);
    connect(probe, &QComboBox::activated, this, [this, probe] {
        m_bake.resolution = probe->currentData().toInt();
        bakeChanged(m_bake);
    });
    addRow(
        tr("Pr&obe resolution"),
        tr("Texels of each of a probe's six pictures; probes are baked again when this changes"),
        probe, [this, probe] { chooseSize(probe, m_bake.resolution); },
        [this] { return m_bake.resolution == BakeSettings{}.resolution; },
        [this] {
            m_bake.resolution = BakeSettings{}.resolution;
            bakeChanged(m_bake);
        });
}

template <class T>
void ExpertSection::addChoice(const QString& name, const QString& help, const char* objectName,
                              const QStringList& texts, T MemSettings::*member) {
    auto* box = new QComboBox(this);
    box->setObjectName(QLatin1String(objectName));
    box->addItems(texts);
    connect(box, &QComboBox::activated, this, [this, member](int index) {
        m_tuning.*member = T(index);
        report(DragPhase::End);
    });
    addRow(
        name, help, box, [this, box, member] { box->setCurrentIndex(int(m_tuning.*member)); },
        [this, member] { return m_tuning.*member == MemSettings{}.*member; },
        [this, member] {
            m_tuning.*member = MemSettings{}.*member;
            report(DragPhase::End);
        });
}

void ExpertSection::show(const MemSettings& tuning, const BakeSettings& bake) {
    m_tuning = tuning;
    m_bake = bake;
    for (const Field& field : m_fields) {
        field.show();
        field.automatic->setEnabled(!field.isAutomatic());
    }
}

}  // namespace reflet
