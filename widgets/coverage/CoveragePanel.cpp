// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/coverage/CoveragePanel.h"

#include "widgets/common/Look.h"
#include "widgets/coverage/CoverageLook.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFrame>
#include <QGridLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLocale>
#include <QPainter>
#include <QPushButton>
#include <QSpinBox>
#include <QStackedWidget>
#include <QTreeWidget>
#include <QVBoxLayout>

namespace reflet {

namespace {

constexpr int kPlaceRole = Qt::UserRole;
constexpr int kProbeRole = Qt::UserRole + 1;
constexpr int kSwatch = 12;
constexpr int kIndentation = 12;
constexpr std::size_t kFewFacades = 5;  // more are folded
constexpr double kLargeFont = 1.9;
enum Wish { ForCoverage, ForCount };

/// A square in the colour of a coverage.
QIcon swatch(double coverage) {
    QPixmap picture(kSwatch, kSwatch);
    picture.fill(coverageTone(coverage));
    QPainter painter(&picture);
    painter.setPen(QColor(20, 24, 28));
    painter.drawRect(0, 0, kSwatch - 1, kSwatch - 1);
    return picture;
}

QString areaText(double squareMetres) {
    return CoveragePanel::tr("%1 m²").arg(QLocale().toString(squareMetres, 'f', 0));
}

QString withError(const Estimate& estimate) {
    return CoveragePanel::tr("%1 ± %2").arg(percentText(estimate.mean),
                                            percentText(estimate.error));
}

}  // namespace

struct CoveragePanel::Impl {
    QPushButton *measure = nullptr, *suggest = nullptr, *acceptAll = nullptr, *dismiss = nullptr;
    QCheckBox* map = nullptr;
    QLabel *total = nullptr, *totalText = nullptr, *details = nullptr, *stale = nullptr;
    QComboBox* kind = nullptr;
    QStackedWidget* amounts = nullptr;
    QDoubleSpinBox* coverage = nullptr;
    QSpinBox* count = nullptr;
    QFrame* card = nullptr;
    QLabel *sentence = nullptr, *comparison = nullptr, *movesTitle = nullptr;
    QWidget* moves = nullptr;
    QTreeWidget* tree = nullptr;
    bool measuring = false, suggesting = false, possible = false;

    void makeTop(CoveragePanel* panel, QVBoxLayout* layout);
    void makeSuggest(CoveragePanel* panel, QVBoxLayout* layout);
    void makeCard(CoveragePanel* panel, QVBoxLayout* layout);
    void makeTree(CoveragePanel* panel, QVBoxLayout* layout);
    void showButtons();
    QTreeWidgetItem* group(const QString& title, const QString& figure = {});
    static QTreeWidgetItem* row(QTreeWidgetItem* parent, const QString& what,
                                const QString& figure);
    static void setPlace(QTreeWidgetItem* item, const glm::dvec3& place) {
        item->setData(0, kPlaceRole, QVariant::fromValue(place));
    }
    void showRoutes(const CoverageFacts& facts);
    void showPlaces(const CoverageFacts& facts);
    void showFacades(const CoverageFacts& facts);
    void showProbes(const CoverageFacts& facts);
    void showMoves(CoveragePanel* panel, const std::vector<SuggestionFacts::Move>& list);
};

void CoveragePanel::Impl::makeTop(CoveragePanel* panel, QVBoxLayout* layout) {
    measure = new QPushButton(panel);
    measure->setObjectName(QStringLiteral("measureCoverage"));
    total = new QLabel(panel);
    total->setObjectName(QStringLiteral("coverageTotal"));
    QFont large = total->font();
    large.setPointSizeF(kLargeFont * large.pointSizeF());
    large.setBold(true);
    total->setFont(large);
    totalText = new QLabel(panel);
    totalText->setObjectName(QStringLiteral("coverageTotalText"));
    totalText->setWordWrap(true);
    details = new QLabel(panel);
    details->setObjectName(QStringLiteral("coverageDetails"));
    details->setWordWrap(true);
    details->setTextInteractionFlags(Qt::TextSelectableByMouse);
    stale = new QLabel(panel);
    stale->setObjectName(QStringLiteral("coverageStale"));
    stale->setWordWrap(true);
    stale->hide();
    map = new QCheckBox(tr("Show it on the city and in the plan"), panel);
    map->setObjectName(QStringLiteral("coverageMapShown"));
    for (QWidget* widget :
         std::initializer_list<QWidget*>{measure, total, totalText, stale, details, map})
        layout->addWidget(widget);
    connect(measure, &QPushButton::clicked, panel, [this, panel] {
        if (measuring)
            Q_EMIT panel->cancelRequested();
        else
            Q_EMIT panel->measureRequested();
    });
    connect(map, &QCheckBox::clicked, panel, &CoveragePanel::mapToggled);
}

void CoveragePanel::Impl::makeSuggest(CoveragePanel* panel, QVBoxLayout* layout) {
    auto* line = new QHBoxLayout;
    kind = new QComboBox(panel);
    kind->setObjectName(QStringLiteral("suggestKind"));
    kind->setAccessibleName(tr("What the suggestion shall reach"));
    kind->insertItem(ForCoverage, tr("To a coverage of"));
    kind->insertItem(ForCount, tr("New probes at most"));
    coverage = new QDoubleSpinBox(panel);
    coverage->setObjectName(QStringLiteral("suggestCoverage"));
    coverage->setAccessibleName(tr("Coverage to reach"));
    coverage->setRange(1.0, 100.0);
    coverage->setDecimals(1);
    coverage->setSuffix(tr(" %"));
    coverage->setValue(95.0);
    count = new QSpinBox(panel);
    count->setObjectName(QStringLiteral("suggestCount"));
    count->setAccessibleName(tr("New probes"));
    count->setRange(1, 500);
    count->setValue(10);
    amounts = new QStackedWidget(panel);
    amounts->addWidget(coverage);
    amounts->addWidget(count);
    amounts->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);
    line->addWidget(kind, 1);
    line->addWidget(amounts);
    layout->addLayout(line);
    suggest = new QPushButton(panel);
    suggest->setObjectName(QStringLiteral("suggestProbes"));
    layout->addWidget(suggest);
    connect(kind, &QComboBox::currentIndexChanged, amounts, &QStackedWidget::setCurrentIndex);
    connect(suggest, &QPushButton::clicked, panel, [this, panel] {
        if (suggesting)
            Q_EMIT panel->cancelRequested();
        else
            Q_EMIT panel->suggestRequested(panel->wish());
    });
}

void CoveragePanel::Impl::makeCard(CoveragePanel* panel, QVBoxLayout* layout) {
    card = new QFrame(panel);
    card->setObjectName(QStringLiteral("suggestionCard"));
    card->setFrameShape(QFrame::StyledPanel);
    auto* inside = new QVBoxLayout(card);
    sentence = new QLabel(card);
    sentence->setObjectName(QStringLiteral("suggestionSentence"));
    sentence->setWordWrap(true);
    QFont bold = sentence->font();
    bold.setBold(true);
    sentence->setFont(bold);
    comparison = new QLabel(card);
    comparison->setObjectName(QStringLiteral("suggestionComparison"));
    comparison->setWordWrap(true);
    auto* buttons = new QHBoxLayout;
    acceptAll = new QPushButton(card);
    acceptAll->setObjectName(QStringLiteral("acceptSuggestions"));
    dismiss = new QPushButton(tr("None"), card);
    dismiss->setObjectName(QStringLiteral("dismissSuggestions"));
    dismiss->setToolTip(tr("Take the suggested probes away (Esc)"));
    buttons->addWidget(acceptAll, 1);
    buttons->addWidget(dismiss);
    movesTitle = new QLabel(tr("Moving these would help most:"), card);
    moves = new QWidget(card);
    (new QVBoxLayout(moves))->setContentsMargins(0, 0, 0, 0);
    inside->addWidget(sentence);
    inside->addWidget(comparison);
    inside->addLayout(buttons);
    inside->addWidget(movesTitle);
    inside->addWidget(moves);
    layout->addWidget(card);
    card->hide();
    connect(acceptAll, &QPushButton::clicked, panel, &CoveragePanel::acceptAllRequested);
    connect(dismiss, &QPushButton::clicked, panel, &CoveragePanel::dismissRequested);
}

void CoveragePanel::Impl::makeTree(CoveragePanel* panel, QVBoxLayout* layout) {
    tree = new QTreeWidget(panel);
    tree->setObjectName(QStringLiteral("coverageTree"));
    tree->setAccessibleName(tr("Coverage in detail"));
    tree->setColumnCount(2);
    tree->setHeaderHidden(true);
    tree->setAlternatingRowColors(true);
    tree->setUniformRowHeights(true);
    tree->setIndentation(kIndentation);
    tree->header()->setStretchLastSection(false);
    tree->header()->setSectionResizeMode(0, QHeaderView::Stretch);
    tree->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
    layout->addWidget(tree, 1);
    const auto show = [panel](QTreeWidgetItem* item) {
        if (const QVariant place = item->data(0, kPlaceRole); place.isValid())
            Q_EMIT panel->placeActivated(place.value<glm::dvec3>());
        if (const QString probe = item->data(0, kProbeRole).toString(); !probe.isEmpty())
            Q_EMIT panel->probeActivated(probe);
    };
    connect(tree, &QTreeWidget::itemClicked, panel, show);
    connect(tree, &QTreeWidget::itemActivated, panel, show);
}

void CoveragePanel::Impl::showButtons() {
    measure->setText(measuring ? tr("Stop measuring") : tr("Measure coverage"));
    measure->setEnabled(possible && !suggesting);
    measure->setToolTip(
        tr("How much of what vehicles mirror along the routes the probes show rightly"));
    suggest->setText(suggesting ? tr("Stop") : tr("Suggest probes…"));
    suggest->setEnabled(possible && !measuring);
    suggest->setToolTip(tr("Work out where probes serve most, with a proof of how good that is"));
}

QTreeWidgetItem* CoveragePanel::Impl::group(const QString& title, const QString& figure) {
    auto* item = new QTreeWidgetItem(tree, {title, figure});
    QFont bold = tree->font();
    bold.setBold(true);
    item->setFont(0, bold);
    item->setFont(1, bold);
    item->setExpanded(true);
    return item;
}

QTreeWidgetItem* CoveragePanel::Impl::row(QTreeWidgetItem* parent, const QString& what,
                                          const QString& figure) {
    auto* item = new QTreeWidgetItem(parent, {what, figure});
    item->setTextAlignment(1, Qt::AlignRight | Qt::AlignVCenter);
    item->setToolTip(0, what);
    return item;
}

void CoveragePanel::Impl::showRoutes(const CoverageFacts& facts) {
    QTreeWidgetItem* title = group(tr("Routes"));
    for (const CoverageFacts::Route& route : facts.routes) {
        const LineFigures& f = route.figures;
        QTreeWidgetItem* item = row(title, route.name, percentText(f.coverage));
        item->setIcon(0, swatch(f.coverage));
        setPlace(item, route.worst);
        row(item, tr("Length"), metresText(f.length, 0));
        setPlace(row(item, tr("Worst point, at %1").arg(metresText(f.worstStation, 0)),
                     percentText(f.worst)),
                 route.worst);
        row(item, tr("A twentieth is below"), percentText(f.p05));
        row(item, tr("Longest gap below 50 %"), metresText(f.largestGap, 0));
        row(item, tr("Seen by one probe"), percentText(f.seen));
        row(item, tr("Seen by two probes"), percentText(f.seenTwice));
        item->setExpanded(facts.routes.size() == 1);
    }
}

void CoveragePanel::Impl::showPlaces(const CoverageFacts& facts) {
    if (facts.worst.empty())
        return;
    QTreeWidgetItem* title = group(tr("Worst places"));
    for (const CoverageFacts::Place& place : facts.worst) {
        QTreeWidgetItem* item = row(title, place.name, percentText(place.coverage));
        item->setIcon(0, swatch(place.coverage));
        setPlace(item, place.place);
    }
}

void CoveragePanel::Impl::showFacades(const CoverageFacts& facts) {
    if (facts.facades.empty())
        return;
    QTreeWidgetItem* title = group(tr("Façades not covered"), areaText(facts.uncoveredWalls));
    title->setToolTip(0, tr("Of %1 that vehicles mirror").arg(areaText(facts.reflectedWalls)));
    for (const CoverageFacts::Facade& facade : facts.facades) {
        QTreeWidgetItem* item = row(title, facade.object, areaText(facade.uncovered));
        item->setToolTip(1, tr("Of %1 that vehicles mirror").arg(areaText(facade.reflected)));
        setPlace(item, facade.place);
    }
    title->setExpanded(facts.facades.size() <= kFewFacades);
}

void CoveragePanel::Impl::showProbes(const CoverageFacts& facts) {
    if (facts.probes.empty())
        return;
    QTreeWidgetItem* title = group(tr("Probes"));
    for (const CoverageFacts::ProbeShare& probe : facts.probes) {
        const bool waste = probe.serves < kWaste;
        const QString share = percentText(probe.serves);
        QTreeWidgetItem* item = row(title, probe.id, waste ? tr("waste · %1").arg(share) : share);
        if (waste)
            item->setToolTip(0,
                             tr("%1 serves next to nothing: remove it, or move it").arg(probe.id));
        if (probe.loss)
            item->setToolTip(
                1, tr("Without it, coverage would be %1 less").arg(percentText(*probe.loss)));
        item->setData(0, kProbeRole, probe.id);
        if (waste)
            item->setIcon(0, severityIcon(Severity::Warning));
    }
    title->setExpanded(true);
}

void CoveragePanel::Impl::showMoves(CoveragePanel* panel,
                                    const std::vector<SuggestionFacts::Move>& list) {
    qDeleteAll(moves->findChildren<QPushButton*>(QString(), Qt::FindDirectChildrenOnly));
    for (const SuggestionFacts::Move& move : list) {
        auto* button = new QPushButton(tr("Move %1: %2").arg(move.id, gainText(move.gain)), moves);
        button->setObjectName(QStringLiteral("moveProbe_") + move.id);
        moves->layout()->addWidget(button);
        connect(button, &QPushButton::clicked, panel,
                [panel, id = move.id] { Q_EMIT panel->moveRequested(id); });
    }
    movesTitle->setVisible(!list.empty());
    moves->setVisible(!list.empty());
}

CoveragePanel::CoveragePanel(QWidget* parent) : QWidget(parent), m_impl(std::make_unique<Impl>()) {
    setAccessibleName(tr("Coverage"));
    auto* layout = new QVBoxLayout(this);
    m_impl->makeTop(this, layout);
    m_impl->makeSuggest(this, layout);
    m_impl->makeCard(this, layout);
    m_impl->makeTree(this, layout);
    m_impl->showButtons();
    setFacts({});
}

CoveragePanel::~CoveragePanel() = default;

void CoveragePanel::setFacts(const std::optional<CoverageFacts>& facts) {
    const QStringList open = [this] {
        QStringList names;
        for (QTreeWidgetItemIterator it(m_impl->tree); *it; ++it)
            if ((*it)->isExpanded())
                names << (*it)->text(0);
        return names;
    }();
    const bool first = m_impl->tree->topLevelItemCount() == 0;
    m_impl->tree->clear();
    m_impl->total->setVisible(facts.has_value());
    m_impl->details->setVisible(facts.has_value());
    m_impl->tree->setVisible(facts.has_value());
    if (!facts) {
        m_impl->totalText->setText(
            tr("Measure how much of what vehicles mirror along their routes the probes show "
               "rightly, and where they do not."));
        return;
    }
    m_impl->total->setText(withError(facts->coverage));
    m_impl->totalText->setText(tr("of what vehicles mirror is served by a probe."));
    QStringList lines{tr("Seen by at least one probe: %1").arg(percentText(facts->seen.mean)),
                      tr("Seen by at least two: %1").arg(percentText(facts->seenTwice.mean))};
    if (facts->shown)
        lines << tr("Shown in the picture: %1").arg(withError(*facts->shown));
    m_impl->details->setText(lines.join(QLatin1Char('\n')));
    m_impl->showRoutes(*facts);
    m_impl->showPlaces(*facts);
    m_impl->showFacades(*facts);
    m_impl->showProbes(*facts);
    for (QTreeWidgetItemIterator it(m_impl->tree); !first && *it; ++it)
        (*it)->setExpanded(open.contains((*it)->text(0)));
}

void CoveragePanel::setStale(const QString& why) {
    m_impl->stale->setText(why);
    m_impl->stale->setVisible(!why.isEmpty());
}

void CoveragePanel::setMeasuring(bool measuring) {
    m_impl->measuring = measuring;
    m_impl->showButtons();
}

void CoveragePanel::setSuggesting(bool suggesting) {
    m_impl->suggesting = suggesting;
    m_impl->showButtons();
}

void CoveragePanel::setSuggestion(const std::optional<SuggestionFacts>& suggestion) {
    m_impl->card->setVisible(suggestion.has_value());
    if (!suggestion)
        return;
    m_impl->sentence->setText(suggestion->sentence);
    m_impl->comparison->setText(suggestion->comparison);
    m_impl->comparison->setVisible(!suggestion->comparison.isEmpty());
    m_impl->acceptAll->setText(tr("Accept all %1").arg(suggestion->pending));
    m_impl->acceptAll->setToolTip(tr("Add the suggested probes to the project (Enter)"));
    m_impl->acceptAll->setVisible(suggestion->pending > 0);
    m_impl->showMoves(this, suggestion->moves);
}

void CoveragePanel::setMapShown(bool shown) {
    m_impl->map->setChecked(shown);
}

void CoveragePanel::setPossible(bool possible) {
    m_impl->possible = possible;
    m_impl->showButtons();
}

SuggestionWish CoveragePanel::wish() const {
    SuggestionWish wish;
    if (m_impl->kind->currentIndex() == ForCoverage)
        wish.coverage = m_impl->coverage->value() / 100.0;
    else
        wish.count = m_impl->count->value();
    return wish;
}

}  // namespace reflet
