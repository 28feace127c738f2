// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/coverage/CoverageWork.h"

#include "app/pipeline/coverage/Candidates.h"
#include "widgets/common/Look.h"
#include "widgets/coverage/CoverageLook.h"

#include <glm/geometric.hpp>

#include <QCoreApplication>
#include <QLocale>
#include <QStringList>
#include <algorithm>

namespace reflet {

namespace {

constexpr double kBandStep = 2.5;          // metres between points of a band
constexpr double kCandidateSpacing = 5.0;  // metres, where a place near a spot is looked for
constexpr double kLeastGain = 0.0005;      // of a suggested probe, as a share of all
constexpr std::size_t kAtOnce = 8;         // probes that are looked from between two polls

struct Words {
    Q_DECLARE_TR_FUNCTIONS(reflet::CoverageController)
};

QString nameOf(const CoveragePlan& plan, std::size_t line) {
    const std::string& name = plan.names[line];
    return QString::fromStdString(name.empty() ? plan.lines[line].id : name);
}

CoveredBand bandOf(const CoveragePlan& plan, const CoveredStretch& stretch) {
    CoveredBand band;
    band.coverage = stretch.coverage;
    const Route& route = *plan.lines[stretch.line].route;
    const double length = stretch.to - stretch.from;
    const int pieces = std::max(1, int(length / kBandStep));
    for (int i = 0; i <= pieces; ++i)
        band.line.push_back(route.at(stretch.from + length * i / pieces));
    return band;
}

std::vector<CoveredSpot> spotsOf(std::vector<SurfacePatch> patches) {
    std::erase_if(patches, [](const SurfacePatch& patch) { return !patch.wall; });
    if (patches.size() > kMostSpots) {
        std::nth_element(
            patches.begin(), patches.begin() + std::ptrdiff_t(kMostSpots), patches.end(),
            [](const SurfacePatch& a, const SurfacePatch& b) { return a.samples > b.samples; });
        patches.resize(kMostSpots);
    }
    std::vector<CoveredSpot> spots;
    spots.reserve(patches.size());
    for (const SurfacePatch& patch : patches)
        spots.push_back({patch.middle, patch.normal, 0.5 * CoverageReport::kPatch, patch.coverage});
    return spots;
}

CoverageOverlay overlayOf(const CoveragePlan& plan, const std::vector<CoveredStretch>& stretches,
                          std::vector<SurfacePatch> patches) {
    CoverageOverlay overlay;
    for (const CoveredStretch& stretch : stretches) {
        if (stretch.samples > 0)
            overlay.bands.push_back(bandOf(plan, stretch));
    }
    overlay.spots = spotsOf(std::move(patches));
    return overlay;
}

void addRoutes(const CoveragePlan& plan, const std::vector<CoveredStretch>& stretches,
               CoverageFacts& facts) {
    for (std::size_t line = 0; line < plan.lines.size(); ++line) {
        std::vector<CoveredStretch> own;
        for (const CoveredStretch& stretch : stretches) {
            if (stretch.line == line)
                own.push_back(stretch);
        }
        const LineFigures figures = lineFigures(own);
        facts.routes.push_back(
            {nameOf(plan, line), figures, plan.lines[line].route->at(figures.worstStation)});
    }
    for (const CoveredStretch& stretch : worstStretches(
             stretches, plan.lines, CoverageReport::kWorstPlaces, CoverageReport::kWorstApart)) {
        facts.worst.push_back(
            {Words::tr("%1, %2 to %3")
                 .arg(nameOf(plan, stretch.line), QLocale().toString(stretch.from, 'f', 0),
                      metresText(stretch.to, 0)),
             stretch.coverage,
             plan.lines[stretch.line].route->at(0.5 * (stretch.from + stretch.to))});
    }
}

Estimate seenBy(const SampleCoverage& samples, int atLeast) {
    std::vector<float> values;
    values.reserve(samples.seenBy.size());
    for (const unsigned char count : samples.seenBy)
        values.push_back(int(count) >= atLeast ? 1.0F : 0.0F);
    return estimateOf(values);
}

ShownCoverage shownOf(const CoverageReport& report, const glm::dvec3& origin) {
    ShownCoverage shown;
    CoverageFacts& facts = shown.facts;
    facts.coverage = report.coverage;
    facts.seen = report.seen;
    facts.seenTwice = report.seenTwice;
    facts.shown = report.shown;
    facts.reflectedWalls = report.reflectedWalls;
    facts.uncoveredWalls = report.uncoveredWalls;
    addRoutes(report.plan, report.stretches, facts);
    for (const ObjectCoverage& object : report.objects) {
        facts.facades.push_back({QString::fromStdString(object.object), object.uncovered,
                                 object.reflected, object.position - origin});
    }
    for (const ProbeCoverage& probe : report.probes)
        facts.probes.push_back({QString::fromStdString(probe.id), probe.serves, probe.loss});
    shown.overlay = overlayOf(report.plan, report.stretches, report.patches);
    return shown;
}

QString sentenceOf(const Suggestion& suggestion) {
    const int count = int(suggestion.probes.size());
    const QString reach = percentText(suggestion.optimised);
    if (count == 0)
        return Words::tr("No further probe is needed: coverage is %1.").arg(reach);
    const QString bound = percentText(std::max(suggestion.coverageBound, suggestion.optimised));
    const QString before = percentText(suggestion.before.mean);
    const bool raises = suggestion.before.mean > 0.0;
    if (count == 1)
        return raises
                   ? Words::tr(
                         "One more probe raises coverage from %1 to %2; no other could "
                         "exceed %3.")
                         .arg(before, reach, bound)
                   : Words::tr("One probe reaches %1; no other could exceed %2.").arg(reach, bound);
    const QString probes = QString::number(count);
    return raises
               ? Words::tr(
                     "%1 more probes raise coverage from %2 to %3; no other %1 could "
                     "exceed %4.")
                     .arg(probes, before, reach, bound)
               : Words::tr("%1 probes reach %2; no %1 could exceed %3.").arg(probes, reach, bound);
}

}  // namespace

Result<MeasuredCoverage> measureCoverage(std::shared_ptr<const PreparedCity> city,
                                         const JobContext& job) {
    const auto report = reportCoverage(*city, {}, job.phase("measuring", 0.0, 0.8));
    if (!report)
        return tl::unexpected(report.error());
    const JobContext following = job.phase("preparing to follow", 0.8, 1.0);
    const std::vector<Probe>& all = city->project().probes;
    MeasuredCoverage measured;
    measured.shown = shownOf(*report, city->project().frame.origin);
    measured.watch = std::make_shared<CoverageWatch>(city, report->plan, kFollowedSamples, 0);
    // Some at a time, so that it can be cancelled in between; those that are known cost nothing.
    for (std::size_t known = 0; known < all.size();) {
        if (job.cancelled())
            return tl::unexpected(JobContext::cancelledError());
        known = std::min(known + kAtOnce, all.size());
        measured.watch->follow({all.begin(), all.begin() + std::ptrdiff_t(known)});
        following.progress(double(known) / double(all.size()));
    }
    return measured;
}

ShownCoverage shownCoverage(const CoverageWatch& watch, const std::vector<Probe>& probes) {
    const CoveragePlan& plan = watch.plan();
    const SampleCoverage& samples = watch.samples();
    const std::vector<CoveredStretch> stretches = watch.stretches(CoverageReport::kStretch);
    ShownCoverage shown;
    CoverageFacts& facts = shown.facts;
    facts.coverage = watch.coverage();
    facts.seen = seenBy(samples, 1);
    facts.seenTwice = seenBy(samples, 2);
    addRoutes(plan, stretches, facts);
    std::vector<double> serves(probes.size(), 0.0);
    for (const std::uint32_t probe : samples.rem) {
        if (probe < serves.size())
            serves[probe] += 1.0 / double(samples.rem.size());
    }
    for (std::size_t i = 0; i < probes.size(); ++i)
        facts.probes.push_back({QString::fromStdString(probes[i].id), serves[i], std::nullopt});
    shown.overlay =
        overlayOf(plan, stretches, surfacePatches(watch.demand(), samples, CoverageReport::kPatch));
    return shown;
}

SuggestionFacts factsOf(const Suggestion& suggestion) {
    SuggestionFacts facts;
    facts.pending = int(suggestion.probes.size());
    facts.sentence = sentenceOf(suggestion);
    if (!suggestion.reached)
        facts.sentence += QLatin1Char(' ') + Words::tr("What was asked for is out of reach.");
    QStringList lines;
    if (facts.pending > 0)
        lines << Words::tr("Checked on other samples: %1 ± %2")
                     .arg(percentText(suggestion.after.mean), percentText(suggestion.after.error))
              << Words::tr("Shown in the picture then: %1").arg(percentText(suggestion.shown));
    const Suggestion::Baselines& other = suggestion.baselines;
    if (other.uniform)
        lines << Words::tr("As many, evenly spaced: %1").arg(percentText(*other.uniform));
    if (other.junctions)
        lines << Words::tr("At the %1 junctions and ends alone: %2")
                     .arg(QString::number(other.junctionCount), percentText(*other.junctions));
    if (other.random)
        lines << Words::tr("As many, at random: %1").arg(percentText(*other.random));
    if (other.uniformCount)
        lines << Words::tr("Evenly spaced, it would take %1 probes for the same.")
                     .arg(QString::number(*other.uniformCount));
    facts.comparison = lines.join(QLatin1Char('\n'));
    for (const ProbeMove& move : suggestion.moves)
        facts.moves.push_back({QString::fromStdString(move.id), move.gain});
    return facts;
}

Result<std::optional<SuggestedProbe>> suggestNear(const CoverageWatch& watch,
                                                  const PreparedCity& city, const glm::dvec3& spot,
                                                  const JobContext& job) {
    const auto candidates =
        probeCandidates(city, watch.plan(), kCandidateSpacing, job.phase("places", 0.0, 0.2));
    if (!candidates)
        return tl::unexpected(candidates.error());
    const JobContext looking = job.phase("looking", 0.2, 1.0);
    std::optional<SuggestedProbe> best;
    std::size_t done = 0;
    for (const glm::dvec3& place : candidates->places) {
        looking.progress(double(++done) / double(candidates->places.size()));
        if (glm::distance(glm::dvec2(place), glm::dvec2(spot)) > kNearby)
            continue;
        if (job.cancelled())
            return tl::unexpected(JobContext::cancelledError());
        const double gain = watch.gainOf(place, city.project().bake.resolution);
        if (gain <= std::max(kLeastGain, best ? best->gain : 0.0))
            continue;
        best.emplace();
        best->position = place + city.project().frame.origin;
        best->gain = gain;
        best->coverage = watch.coverage().mean + gain;
    }
    return best;
}

}  // namespace reflet
