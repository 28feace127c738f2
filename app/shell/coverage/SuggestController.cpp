// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/coverage/SuggestController.h"

#include "app/document/LiveCity.h"
#include "app/document/ProjectDocument.h"
#include "app/shell/Commands.h"
#include "app/shell/Notices.h"
#include "app/shell/coverage/CoverageController.h"
#include "app/shell/coverage/CoverageWork.h"
#include "widgets/common/EditIntents.h"
#include "widgets/coverage/CoverageLook.h"

#include <QMenu>
#include <algorithm>
#include <set>
#include <utility>

namespace reflet {

namespace {

const QString kLane = QStringLiteral("suggest");

}  // namespace

SuggestController::SuggestController(Workbench& bench, CoverageController& coverage,
                                     QObject* parent)
    : QObject(parent), m_bench(bench), m_coverage(coverage) {
    CoveragePanel* panel = bench.coverage;
    const auto on = [this](Command command, auto slot) {
        connect(m_bench.commands->action(command), &QAction::triggered, this, slot);
    };
    connect(panel, &CoveragePanel::suggestRequested, this, &SuggestController::suggest);
    connect(panel, &CoveragePanel::cancelRequested, this,
            [this] { m_bench.jobs->cancelLane(kLane); });
    connect(panel, &CoveragePanel::acceptAllRequested, this, &SuggestController::acceptAll);
    connect(panel, &CoveragePanel::dismissRequested, this, &SuggestController::dismiss);
    connect(panel, &CoveragePanel::moveRequested, this,
            [this](const QString& id) { move(id.toStdString()); });
    connect(bench.intents, &EditIntents::ghostClicked, this,
            [this](const QString& id) { accept(id.toStdString()); });
    on(Command::SuggestProbes, [this] {
        Q_EMIT m_coverage.panelWanted();
        suggest(m_bench.coverage->wish());
    });
    on(Command::AcceptSuggestions, [this] { acceptAll(); });
    on(Command::DismissSuggestions, [this] { dismiss(); });
    connect(&coverage, &CoverageController::outdated, this, &SuggestController::dismiss);
    connect(bench.document, &ProjectDocument::projectChanged, this,
            &SuggestController::showPending);
    connect(bench.live, &LiveCity::cityChanged, this, &SuggestController::showPending);
    showPending();
}

void SuggestController::suggest(const SuggestionWish& wish) {
    const auto city = m_bench.live->prepared();
    if (!city)
        return;
    SuggestOptions options;
    options.coverage = wish.coverage;
    if (wish.count)
        options.count = std::size_t(*wish.count);
    m_bench.coverage->setSuggesting(true);
    m_bench.jobs->run<Suggestion>(
        {.title = tr("Suggesting probes"), .lane = kLane},
        [city, options](const JobContext& job) { return suggestProbes(*city, options, job); }, this,
        [this](Result<Suggestion> suggestion) {
            if (!suggestion && suggestion.error().code == ErrorCode::Cancelled &&
                m_bench.jobs->isBusy(kLane))
                return;  // another one took its place
            m_bench.coverage->setSuggesting(false);
            if (suggestion)
                show(std::move(*suggestion));
            else
                m_bench.notices->tell(suggestion.error());
        });
}

void SuggestController::show(Suggestion suggestion) {
    m_facts = factsOf(suggestion);
    m_suggestion = std::move(suggestion);
    showPending();
    Q_EMIT m_coverage.panelWanted();
}

std::vector<SuggestedProbe> SuggestController::pending() const {
    std::vector<SuggestedProbe> left;
    if (!m_suggestion)
        return left;
    std::set<std::string> taken;
    for (const Probe& probe : m_bench.document->project().probes)
        taken.insert(probe.id);
    for (const SuggestedProbe& probe : m_suggestion->probes) {
        if (taken.count(probe.id) == 0)
            left.push_back(probe);
    }
    return left;
}

void SuggestController::showPending() {
    const glm::dvec3 origin = m_bench.document->project().frame.origin;
    std::vector<GhostProbe> ghosts;
    for (const SuggestedProbe& probe : pending()) {
        const auto order = std::find_if(m_suggestion->probes.begin(), m_suggestion->probes.end(),
                                        [&](const auto& other) { return other.id == probe.id; });
        ghosts.push_back({probe.id, probe.position - origin,
                          int(order - m_suggestion->probes.begin()) + 1, probe.gain});
    }
    m_bench.commands->setEnabled({Command::AcceptSuggestions, Command::DismissSuggestions},
                                 !ghosts.empty());
    m_bench.commands->setEnabled({Command::SuggestProbes}, m_bench.live->prepared() != nullptr);
    if (m_facts)
        m_facts->pending = int(ghosts.size());
    m_bench.coverage->setSuggestion(m_facts);
    m_coverage.setGhosts(std::move(ghosts));
}

void SuggestController::accept(const std::string& id) {
    if (m_suggestion)
        m_bench.document->replaceProject(
            withSuggested(m_bench.document->project(), *m_suggestion, {id}),
            tr("Accept a suggested probe"));
}

void SuggestController::acceptAll() {
    std::vector<std::string> ids;
    for (const SuggestedProbe& probe : pending())
        ids.push_back(probe.id);
    if (!ids.empty())
        m_bench.document->replaceProject(
            withSuggested(m_bench.document->project(), *m_suggestion, ids),
            tr("Accept suggested probes"));
}

void SuggestController::dismiss() {
    m_suggestion.reset();
    m_facts.reset();
    showPending();
}

void SuggestController::move(const std::string& id) {
    if (!m_suggestion)
        return;
    const auto found = std::find_if(m_suggestion->moves.begin(), m_suggestion->moves.end(),
                                    [&](const ProbeMove& each) { return each.id == id; });
    if (found == m_suggestion->moves.end())
        return;
    const glm::dvec3 to = found->to;
    m_suggestion->moves.erase(found);
    if (m_facts)
        std::erase_if(m_facts->moves,
                      [&](const auto& each) { return each.id.toStdString() == id; });
    m_bench.document->moveProbe(id, to);
}

void SuggestController::suggestHere(const glm::dvec3& spot) {
    m_coverage.withWatch([this, spot] {
        const auto city = m_bench.live->prepared();
        if (!city)
            return;
        using Place = std::optional<SuggestedProbe>;
        m_bench.jobs->run<Place>(
            {.title = tr("Looking for a place"),
             .lane = CoverageController::watchLane(),
             .replace = false},
            [city, watch = m_coverage.watch(), spot](const JobContext& job) {
                return suggestNear(*watch, *city, spot, job);
            },
            this,
            [this](Result<Place> place) {
                if (!place)
                    m_bench.notices->tell(place.error());
                else if (*place)
                    add(**place);
                else
                    m_bench.notices->tell(
                        Severity::Info,
                        tr("No place within %1 m would add anything.").arg(int(kNearby)), {},
                        tr("What is mirrored there is served already, or cannot be seen from the "
                           "street."));
            });
    });
}

void SuggestController::add(SuggestedProbe probe) {
    std::set<std::string> taken;
    for (const Probe& each : m_bench.document->project().probes)
        taken.insert(each.id);
    if (!m_suggestion)
        m_suggestion.emplace();
    for (const SuggestedProbe& each : m_suggestion->probes)
        taken.insert(each.id);
    for (int number = 1; probe.id.empty() || taken.count(probe.id) > 0; ++number)
        probe.id = "here" + std::to_string(number);
    SuggestionFacts facts = m_facts.value_or(SuggestionFacts{});
    facts.sentence = tr("A probe here adds %1.").arg(percentText(probe.gain));
    facts.comparison.clear();
    m_facts = facts;
    m_suggestion->probes.push_back(std::move(probe));
    showPending();
    Q_EMIT m_coverage.panelWanted();
}

void SuggestController::extendMenu(QMenu* menu, const glm::dvec3& ground) {
    if (!m_bench.live->prepared())
        return;
    QAction* here = menu->addAction(tr("Suggest a probe near here"));
    here->setObjectName(QStringLiteral("suggestHere"));
    connect(here, &QAction::triggered, this, [this, ground] { suggestHere(ground); });
    menu->addAction(m_bench.commands->action(Command::CoverageShown));
}

}  // namespace reflet
