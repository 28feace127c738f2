// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/tuning/TuningPanel.h"

#include "widgets/common/DragSlider.h"
#include "widgets/common/Look.h"
#include "widgets/tuning/DetailSection.h"
#include "widgets/tuning/ExpertSection.h"
#include "widgets/tuning/FigureTable.h"
#include "widgets/tuning/FrameChart.h"
#include "widgets/tuning/Presets.h"

#include <QComboBox>
#include <QElapsedTimer>
#include <QFormLayout>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QLocale>
#include <QPushButton>
#include <QScrollArea>
#include <QToolButton>
#include <QVBoxLayout>
#include <array>
#include <cmath>
#include <limits>

namespace reflet {

namespace {

constexpr qint64 kFigureInterval = 250;  ///< milliseconds between texts that can still be read

QString presetName(int preset) {
    const std::array<QString, kPresets> names{TuningPanel::tr("Fast"), TuningPanel::tr("Good"),
                                              TuningPanel::tr("Balanced"), TuningPanel::tr("Fine"),
                                              TuningPanel::tr("Exact")};
    return names[std::size_t(preset)];
}

QString ratioText(double ratio) {
    return std::isinf(ratio) ? QStringLiteral("∞") : QLocale().toString(ratio, 'g', 3);
}

std::optional<double> ratioFromText(const QString& text) {
    const QString trimmed = text.trimmed().toLower();
    if (trimmed == QStringLiteral("∞") || trimmed.startsWith(QStringLiteral("inf")))
        return std::numeric_limits<double>::infinity();
    bool ok = false;
    double value = QLocale().toDouble(trimmed, &ok);
    if (!ok)
        value = trimmed.toDouble(&ok);
    if (!ok || !(value >= 0.0))
        return std::nullopt;
    return value;
}

QLabel* sectionTitle(const QString& text, QWidget* parent) {
    auto* label = new QLabel(text, parent);
    QFont font = label->font();
    font.setBold(true);
    label->setFont(font);
    label->setContentsMargins(0, 8, 0, 0);
    return label;
}

}  // namespace

struct TuningPanel::Impl {
    explicit Impl(TuningPanel* owner) : panel(owner) {}

    TuningPanel* panel;
    MemSettings tuning;
    BakeSettings bake;
    QWidget* content = nullptr;
    DragSlider* quality = nullptr;
    QLabel* qualityName = nullptr;
    DragSlider* detail = nullptr;
    QLineEdit* ratio = nullptr;
    QComboBox* left = nullptr;
    QComboBox* right = nullptr;
    std::array<QLabel*, 6> live{};
    FrameChart* chart = nullptr;
    DetailSection* levels = nullptr;
    FigureTable* table = nullptr;
    QPushButton* measure = nullptr;
    QToolButton* expertButton = nullptr;
    ExpertSection* expert = nullptr;
    QElapsedTimer sinceFigures;

    void build();
    [[nodiscard]] QLayout* buildQuality();
    [[nodiscard]] QLayout* buildMethods();
    [[nodiscard]] QLayout* buildLive();
    void connectAll();
    void showTuning();
    void change(const MemSettings& value, DragPhase phase) {
        tuning = value;
        showTuning();
        Q_EMIT panel->tuningChanged(tuning, phase);
    }
    void setRatio(double value, DragPhase phase) {
        MemSettings next = tuning;
        next.depthRatio = value;
        change(next, phase);
    }
    void reportMethods() {
        const int index = right->currentIndex();
        std::optional<Method> other;
        if (index > 0)
            other = allMethods()[std::size_t(index) - 1];
        Q_EMIT panel->methodsChanged(allMethods()[std::size_t(left->currentIndex())], other);
    }
};

QLayout* TuningPanel::Impl::buildQuality() {
    auto* grid = new QGridLayout;
    grid->setColumnStretch(1, 1);
    quality = new DragSlider(panel);
    quality->setObjectName(QStringLiteral("qualitySlider"));
    quality->setRange(0, kPresets - 1);
    quality->setPageStep(1);
    quality->setTickPosition(QSlider::TicksBelow);
    quality->setTickInterval(1);
    quality->setAccessibleName(tr("Quality"));
    quality->setToolTip(tr("From fast to exact: sets detail and resolution together"));
    qualityName = new QLabel(panel);
    qualityName->setMinimumWidth(qualityName->fontMetrics().horizontalAdvance(tr("Own settings")));
    auto* qualityLabel = new QLabel(tr("&Quality"), panel);
    qualityLabel->setBuddy(quality);
    detail = new DragSlider(panel);
    detail->setObjectName(QStringLiteral("detailSlider"));
    detail->setRange(0, kDetailSteps);
    detail->setPageStep(kDetailSteps / 10);
    detail->setAccessibleName(tr("Detail at edges"));
    detail->setToolTip(
        tr("How finely reflections follow the edges of buildings: nothing at the "
           "left (R = ∞), every texel at the right (R = 0)"));
    ratio = new QLineEdit(panel);
    ratio->setObjectName(QStringLiteral("detailRatio"));
    ratio->setAccessibleName(tr("R"));
    ratio->setToolTip(tr("R, the ratio of distances above which a quad is divided: from 0 to ∞"));
    ratio->setFixedWidth(ratio->fontMetrics().horizontalAdvance(QStringLiteral("0.000000")));
    auto* detailLabel = new QLabel(tr("&Detail at edges"), panel);
    detailLabel->setBuddy(detail);
    grid->addWidget(qualityLabel, 0, 0);
    grid->addWidget(quality, 0, 1);
    grid->addWidget(qualityName, 0, 2);
    grid->addWidget(detailLabel, 1, 0);
    grid->addWidget(detail, 1, 1);
    grid->addWidget(ratio, 1, 2);
    return grid;
}

QLayout* TuningPanel::Impl::buildMethods() {
    auto* form = new QFormLayout;
    form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    left = new QComboBox(panel);
    right = new QComboBox(panel);
    left->setObjectName(QStringLiteral("methodLeft"));
    right->setObjectName(QStringLiteral("methodRight"));
    right->addItem(tr("nothing"));
    for (const Method method : allMethods()) {
        left->addItem(methodText(method));
        left->setItemData(left->count() - 1, methodHelp(method), Qt::ToolTipRole);
        right->addItem(methodText(method));
        right->setItemData(right->count() - 1, methodHelp(method), Qt::ToolTipRole);
    }
    left->setToolTip(tr("How reflections are made; left of the wipe when two are compared"));
    right->setToolTip(tr("What it is compared with, right of the wipe in the 3D view"));
    for (QComboBox* box : {left, right}) {
        box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
        box->setMinimumContentsLength(10);
    }
    form->addRow(tr("&Method"), left);
    form->addRow(tr("&Compare with"), right);
    return form;
}

QLayout* TuningPanel::Impl::buildLive() {
    auto* grid = new QGridLayout;
    const std::array<QString, 6> names{tr("Frame"),      tr("Frames a second"),
                                       tr("Local maps"), tr("Quads"),
                                       tr("Rays"),       tr("Not covered")};
    const std::array<QString, 6> helps{
        tr("Milliseconds that the last picture took"),
        tr("Pictures shown a second"),
        tr("How many local maps were drawn, and milliseconds for each"),
        tr("Pieces of the adaptive meshes in the last picture"),
        tr("Rays into the height model in the last picture"),
        tr("Share of directions that no probe sees: more probes help")};
    for (std::size_t i = 0; i < names.size(); ++i) {
        auto* name = new QLabel(names[i], panel);
        live[i] = new QLabel(QStringLiteral("–"), panel);
        live[i]->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
        live[i]->setAccessibleName(names[i]);
        name->setToolTip(helps[i]);
        live[i]->setToolTip(helps[i]);
        const int column = i % 2 == 0 ? 0 : 3;
        grid->addWidget(name, int(i / 2), column);
        grid->addWidget(live[i], int(i / 2), column + 1);
    }
    grid->setColumnMinimumWidth(2, 14);
    grid->setColumnStretch(1, 1);
    grid->setColumnStretch(4, 1);
    return grid;
}

void TuningPanel::Impl::build() {
    content = new QWidget(panel);
    auto* column = new QVBoxLayout(content);
    column->setSpacing(6);
    column->addLayout(buildQuality());
    column->addLayout(buildMethods());
    column->addWidget(sectionTitle(tr("What a picture costs"), panel));
    column->addLayout(buildLive());
    chart = new FrameChart(panel);
    column->addWidget(chart);
    levels = new DetailSection(panel);
    column->addWidget(levels);
    column->addWidget(sectionTitle(tr("How true it is"), panel));
    table = new FigureTable(panel);
    column->addWidget(table);
    measure = new QPushButton(tr("Check against the &reference"), panel);
    measure->setObjectName(QStringLiteral("measure"));
    measure->setToolTip(
        tr("Ray traces what the vehicle reflects where it is now, in the "
           "background, and measures every method against it"));
    column->addWidget(measure);
    expertButton = new QToolButton(panel);
    expertButton->setObjectName(QStringLiteral("expertButton"));
    expertButton->setText(tr("&Expert"));
    expertButton->setCheckable(true);
    expertButton->setAutoRaise(true);
    expertButton->setArrowType(Qt::RightArrow);
    expertButton->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    expertButton->setToolTip(tr("All settings of the method by their names in the paper"));
    expert = new ExpertSection(panel);
    expert->setVisible(false);
    column->addWidget(expertButton);
    column->addWidget(expert);
    column->addStretch();
    auto* scroll = new QScrollArea(panel);
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setWidget(content);
    auto* layout = new QVBoxLayout(panel);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(scroll);
}

void TuningPanel::Impl::connectAll() {
    QObject::connect(quality, &DragSlider::moved, panel, [this](int value, DragPhase phase) {
        change(withPreset(tuning, value), phase);
    });
    QObject::connect(detail, &DragSlider::moved, panel,
                     [this](int value, DragPhase phase) { setRatio(depthRatioAt(value), phase); });
    QObject::connect(ratio, &QLineEdit::editingFinished, panel, [this] {
        const auto value = ratioFromText(ratio->text());
        if (value && ratio->isModified() && *value != tuning.depthRatio)
            setRatio(*value, DragPhase::End);
        ratio->setText(ratioText(tuning.depthRatio));
    });
    QObject::connect(left, &QComboBox::activated, panel, [this] { reportMethods(); });
    QObject::connect(right, &QComboBox::activated, panel, [this] { reportMethods(); });
    QObject::connect(measure, &QPushButton::clicked, panel,
                     [this] { Q_EMIT panel->measureRequested(); });
    QObject::connect(expertButton, &QToolButton::toggled, panel, [this](bool open) {
        expertButton->setArrowType(open ? Qt::DownArrow : Qt::RightArrow);
        expert->setVisible(open);
    });
    levels->changed = [this](const LodSettings& value, DragPhase phase) {
        MemSettings next = tuning;
        next.lod = value;
        change(next, phase);
    };
    expert->tuningChanged = [this](const MemSettings& value, DragPhase phase) {
        change(value, phase);
    };
    expert->bakeChanged = [this](const BakeSettings& value) {
        bake = value;
        showTuning();
        Q_EMIT panel->bakeChanged(bake);
    };
}

void TuningPanel::Impl::showTuning() {
    const auto preset = presetOf(tuning);
    qualityName->setText(preset ? presetName(*preset) : tr("Own settings"));
    if (preset)
        quality->show(*preset);
    // A position may stand for a range of R: it is kept while it still fits.
    if (depthRatioAt(detail->value()) != tuning.depthRatio)
        detail->show(positionOf(tuning.depthRatio));
    if (!ratio->hasFocus() || !ratio->isModified())
        ratio->setText(ratioText(tuning.depthRatio));
    expert->show(tuning, bake);
    levels->show(tuning.lod);
    chart->setBudget(tuning.lod.frameBudget);
}

TuningPanel::TuningPanel(QWidget* parent) : QWidget(parent), m_impl(std::make_unique<Impl>(this)) {
    setAccessibleName(tr("Quality of reflections"));
    m_impl->build();
    m_impl->connectAll();
    m_impl->showTuning();
    setMethods(Method::Mem, std::nullopt);
}

TuningPanel::~TuningPanel() = default;

void TuningPanel::setTuning(const MemSettings& tuning) {
    m_impl->tuning = tuning;
    m_impl->showTuning();
}

void TuningPanel::setBake(const BakeSettings& bake) {
    m_impl->bake = bake;
    m_impl->showTuning();
}

void TuningPanel::setMethods(Method left, std::optional<Method> right) {
    const auto& methods = allMethods();
    for (std::size_t i = 0; i < methods.size(); ++i) {
        if (methods[i] == left)
            m_impl->left->setCurrentIndex(int(i));
        if (right && methods[i] == *right)
            m_impl->right->setCurrentIndex(int(i) + 1);
    }
    if (!right)
        m_impl->right->setCurrentIndex(0);
}

void TuningPanel::setFrame(const FrameStatistics& statistics, double framesPerSecond) {
    m_impl->chart->addFrame(statistics);
    if (m_impl->sinceFigures.isValid() && m_impl->sinceFigures.elapsed() < kFigureInterval)
        return;
    m_impl->sinceFigures.start();
    const QLocale locale;
    const auto number = [&](std::size_t value) { return locale.toString(qulonglong(value)); };
    const QString none = QStringLiteral("–");
    m_impl->levels->showFrame(statistics.lod);
    const double maps = double(statistics.localMaps);
    m_impl->live[0]->setText(tr("%1 ms").arg(locale.toString(statistics.milliseconds, 'f', 1)));
    m_impl->live[1]->setText(locale.toString(framesPerSecond, 'f', 0));
    m_impl->live[2]->setText(
        statistics.localMaps == 0
            ? none
            : tr("%1 × %2 ms")
                  .arg(number(statistics.localMaps),
                       locale.toString((statistics.tracing + statistics.maps) / maps, 'f', 1)));
    m_impl->live[3]->setText(number(statistics.quads));
    m_impl->live[4]->setText(number(statistics.rays));
    m_impl->live[5]->setText(
        statistics.vertices == 0
            ? none
            : tr("%1 %").arg(locale.toString(
                  100.0 * double(statistics.uncovered) / double(statistics.vertices), 'f', 1)));
}

void TuningPanel::setFigures(const std::vector<MethodRow>& figures, const QString& pose) {
    m_impl->table->setFigures(figures, pose);
}

void TuningPanel::setFiguresStale(bool stale) {
    m_impl->table->setStale(stale);
}

void TuningPanel::setMeasuring(bool measuring) {
    m_impl->measure->setEnabled(!measuring);
    m_impl->measure->setText(measuring ? tr("The reference is being traced …")
                                       : tr("Check against the &reference"));
}

}  // namespace reflet
