// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/coverage/Suggest.h"

#include "app/pipeline/coverage/Candidates.h"
#include "core/base/ParallelFor.h"
#include "core/base/Stopwatch.h"
#include "core/coverage/ChosenPlaces.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <random>
#include <set>

namespace reflet {

namespace {

/// Candidates of large cities are looked from more coarsely; what comes of it is verified.
constexpr std::size_t kFewCandidates = 2000;
constexpr int kCoarseSight = 64;  // texels along an edge
constexpr int kAttempts = 4;      // to reach a coverage on samples that are not optimised
constexpr double kSamplesPerMetre = 40.0, kSamplesPerPlace = 4.0;
constexpr std::size_t kFewestSamples = 16'384;
constexpr std::size_t kMostOptimised = std::size_t{1} << 20U;
constexpr std::size_t kMostEntries = 400'000'000;  // of the table: 3.2 GB
constexpr int kRandomRuns = 5;
constexpr std::size_t kMoves = 3;
constexpr std::size_t kMoversTried = 8;
constexpr double kWorthMoving = 1e-3;
/// For samples that the optimisation has not seen.
constexpr std::uint64_t kOtherSeed = 0x5eed;

Result<void> checkOptions(const SuggestOptions& options) {
    if (!options.coverage && !options.count) {
        return fail(ErrorCode::Usage, "neither a coverage nor a number of probes is asked for",
                    "suggest", "Write e.g. --coverage 0.95 or --count 27.");
    }
    if (options.coverage && !(*options.coverage > 0.0 && *options.coverage <= 1.0)) {
        return fail(ErrorCode::Usage, "a coverage lies above 0 and up to 1", "--coverage",
                    "Write e.g. 0.95 for 95 %.");
    }
    if (options.count && *options.count > 100'000)
        return fail(ErrorCode::Usage, "that many probes cannot be had", "--count",
                    "Take up to 100,000.");
    if (!(options.spacing >= 0.5 && options.spacing <= 1000.0)) {
        return fail(ErrorCode::Usage, "the spacing of candidates is out of range", "--spacing",
                    "Take 0.5 to 1000 m.");
    }
    return {};
}

std::size_t samplesFor(const CoveragePlan& plan, const SuggestOptions& options) {
    double length = 0.0;
    for (const DemandLine& line : plan.lines)
        length += line.route->length();
    const double wanted = plan.ground ? kSamplesPerPlace * double(plan.ground->places.size())
                                      : kSamplesPerMetre * length;
    const std::size_t most = std::min(kMostOptimised, options.mostSamples);
    return std::clamp(std::size_t(std::min(wanted, 1e9)), std::min(kFewestSamples, most), most);
}

/// The rows of places.
Result<std::vector<ServiceRow>> rowsOf(const PreparedCity& city, const Demand& demand,
                                       const std::vector<glm::dvec3>& places,
                                       const JobContext& job) {
    const int full = city.project().bake.resolution;
    const int sight = places.size() <= kFewCandidates ? full : std::min(full, kCoarseSight);
    const ServiceRule rule(city.heightfield().grid, full);
    const SampleIndex index(demand);
    std::vector<ServiceRow> rows(places.size());
    std::atomic<std::size_t> done{0}, entries{0};
    parallelFor(0, places.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last && !job.cancelled() && entries < kMostEntries; ++i) {
            rows[i] = serviceRow(demand, index, rule, sightFrom(city.tracer(), places[i], sight));
            entries += rows[i].entries.size();
            if (++done % 16 == 0)
                job.progress(double(done) / double(places.size()));
        }
    });
    if (job.cancelled())
        return tl::unexpected(JobContext::cancelledError());
    if (entries >= kMostEntries) {
        return fail(ErrorCode::ResourceLimit,
                    fmt::format("{} candidates are too many for {} samples", places.size(),
                                demand.samples.size()),
                    city.project().name, "Take a larger --spacing, or a part of the routes.");
    }
    return rows;
}

/// Coverage of places alone, on the demand of a table.
Result<double> coverageOfPlaces(const PreparedCity& city, const Demand& demand,
                                const std::vector<glm::dvec3>& places, const JobContext& job) {
    auto rows = rowsOf(city, demand, places, job);
    if (!rows)
        return tl::unexpected(rows.error());
    ServiceTable table{demand.samples.size(), std::move(*rows)};
    std::vector<std::size_t> all(table.rows.size());
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = i;
    return worthOf(table, all, 0.0);
}

std::string listOf(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i)
        text += fmt::format("{}{}", i == 0 ? "" : i + 1 == names.size() ? " and " : ", ", names[i]);
    return text;
}

/// Between which values the middle four fifths of the weight lie.
std::pair<float, float> middleOf(std::vector<std::pair<float, double>>& weighted) {
    std::sort(weighted.begin(), weighted.end());
    double total = 0.0;
    for (const auto& [value, weight] : weighted)
        total += weight;
    std::pair<float, float> middle(weighted.front().first, weighted.back().first);
    double passed = 0.0;
    for (const auto& [value, weight] : weighted) {
        middle.first = passed <= 0.1 * total ? value : middle.first;
        passed += weight;
        if (passed >= 0.9 * total) {
            middle.second = value;
            break;
        }
    }
    return middle;
}

/// Everything that is worked out on the way.
class Suggester {
public:
    Suggester(const PreparedCity& city, const SuggestOptions& options)
        : m_city(city), m_options(options) {}

    [[nodiscard]] Result<Suggestion> run(const JobContext& job);

private:
    [[nodiscard]] Result<void> prepare(const JobContext& job);
    [[nodiscard]] Result<void> reach(const JobContext& job);
    [[nodiscard]] Result<void> choose(std::optional<double> coverage, const JobContext& job);
    [[nodiscard]] Result<void> bound(const JobContext& job);
    [[nodiscard]] Result<void> verify(const JobContext& job);
    [[nodiscard]] Result<void> compare(const JobContext& job);
    void findMoves();
    void explain();
    [[nodiscard]] std::string reasonFor(const PlacedRow& placed, const ChosenPlaces& before,
                                        std::vector<std::string>& routes) const;

    const PreparedCity& m_city;
    const SuggestOptions& m_options;
    CoveragePlan m_plan;
    Demand m_demand;
    std::vector<Probe> m_kept;             ///< of the project
    std::vector<glm::dvec3> m_candidates;  ///< project frame
    ServiceTable m_table;                  ///< rows: candidates, then what is kept
    std::vector<std::size_t> m_fixed;      ///< rows of what is kept
    Placement m_placement;
    Suggestion m_out;
};

Result<void> Suggester::prepare(const JobContext& job) {
    auto plan = coveragePlan(m_city, m_options);
    if (!plan)
        return tl::unexpected(plan.error());
    m_plan = std::move(*plan);
    auto candidates =
        probeCandidates(m_city, m_plan, m_options.spacing, job.phase("candidates", 0.0, 0.3));
    if (!candidates)
        return tl::unexpected(candidates.error());
    m_candidates = std::move(candidates->places);
    m_out.remarks = std::move(candidates->remarks);
    for (const Probe& probe : m_city.project().probes) {
        if (!m_options.afresh || probe.locked)
            m_kept.push_back(probe);
    }
    m_demand = m_plan.sample(m_city.tracer(), samplesFor(m_plan, m_options), m_options.seed);
    std::vector<glm::dvec3> places = m_candidates;
    for (const Probe& probe : m_kept) {
        m_fixed.push_back(places.size());
        places.push_back(m_city.inFrame(probe.position));
    }
    auto rows = rowsOf(m_city, m_demand, places, job.phase("looking", 0.3, 1.0));
    if (!rows)
        return tl::unexpected(rows.error());
    m_table = {m_demand.samples.size(), std::move(*rows)};
    m_out.candidates = m_candidates.size();
    m_out.samples = m_demand.samples.size();
    return {};
}

/// Chooses and verifies; where samples that were not optimised are served less than was asked for,
/// again with that much more.
Result<void> Suggester::reach(const JobContext& job) {
    std::optional<double> coverage = m_options.coverage;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        const JobContext part =
            job.phase("choosing", double(attempt) / kAttempts, double(attempt + 1) / kAttempts);
        if (auto done = choose(coverage, part.phase("choosing", 0.0, 0.6)); !done)
            return done;
        explain();
        if (auto done = verify(part.phase("checking", 0.6, 1.0)); !done)
            return done;
        const double missing = m_options.coverage.value_or(0.0) - m_out.after.mean;
        if (missing <= 0.0 || !(m_placement.coverage >= *coverage))
            break;
        coverage = std::min(1.0, m_placement.coverage + missing);
    }
    m_out.reached =
        (m_options.count && m_placement.chosen.size() >= *m_options.count) ||
        (m_options.coverage && m_out.after.mean >= *m_options.coverage - m_out.after.error);
    return {};
}

Result<void> Suggester::choose(std::optional<double> coverage, const JobContext& job) {
    PlacementGoal goal;
    goal.coverage = coverage;
    goal.count = std::min(m_options.count.value_or(m_options.most), m_options.most);
    goal.leastGain = m_options.leastGain;
    auto placement = place(m_table, m_fixed, goal, job);
    if (!placement)
        return tl::unexpected(placement.error());
    m_placement = std::move(*placement);
    m_out.probes.clear();
    m_out.worth = m_placement.worth;
    m_out.optimised = m_placement.coverage;
    return {};
}

Result<void> Suggester::bound(const JobContext& job) {
    if (!m_options.certificate)
        return {};
    std::vector<std::size_t> order;
    for (const PlacedRow& placed : m_placement.chosen)
        order.push_back(placed.row);
    const std::size_t count = order.size();
    auto ofWorth =
        certify(m_table, m_fixed, order, count, kSecondShare, job.phase("bound", 0.0, 0.4));
    if (!ofWorth)
        return tl::unexpected(ofWorth.error());
    auto ofCoverage = certify(m_table, m_fixed, order, count, 0.0, job.phase("bound", 0.4, 0.8));
    if (!ofCoverage)
        return tl::unexpected(ofCoverage.error());
    m_out.certificate = *ofWorth;
    m_out.worthBound = ofWorth->upperBound();
    m_out.coverageBound = ofCoverage->upperBound();
    // Who asks for a number wants that number.
    m_out.fewest = count;
    if (!m_options.coverage)
        return {};
    const double wanted = m_placement.coverage;
    auto fewest = leastCount(m_table, m_fixed, order, wanted, count, job.phase("fewest", 0.8, 1.0));
    if (!fewest)
        return tl::unexpected(fewest.error());
    m_out.fewest = *fewest;
    return {};
}

/// On samples that were not optimised, with maps of the project's resolution.
Result<void> Suggester::verify(const JobContext& job) {
    std::vector<Probe> probes = m_kept;
    const std::size_t kept = probes.size();
    for (const SuggestedProbe& probe : m_out.probes)
        probes.push_back({probe.id, probe.position, std::nullopt, false});
    const auto rems = probeSights(m_city, probes, job.phase("checking", 0.0, 0.5));
    if (!rems)
        return tl::unexpected(rems.error());
    const ServiceRule rule(m_city.heightfield().grid);
    CoverageOptions options = m_options;
    options.seed = m_options.seed + kOtherSeed;
    SampleCoverage coverage;
    const Demand demand =
        sampleToError(m_plan, m_city.tracer(), options, [&](const Demand& samples) {
            coverage = coverageOf(samples, rule, *rems);
            return job.cancelled() ? std::vector<float>{} : coverage.best;
        });
    if (job.cancelled())
        return tl::unexpected(JobContext::cancelledError());
    m_out.after = estimateOf(coverage.best);
    RemSet before;
    for (std::size_t i = 0; i < kept; ++i)
        before.add(rems->pointers()[i]);
    m_out.before = estimateOf(coverageOf(demand, rule, before).best);
    const PreparedRems prepared(std::make_shared<const HeightfieldTracer>(m_city.tracer()), *rems);
    m_out.shown = estimateOf(coverageAtRunTime(demand, rule, m_city.tracer(), prepared,
                                               m_city.project().tuning))
                      .mean;
    if (!m_plan.lines.empty()) {
        constexpr double kStretch = 10.0;
        const LineFigures figures =
            lineFigures(coveredStretches(demand, coverage, m_plan.lines, kStretch));
        m_out.worst = figures.worst;
        m_out.p05 = figures.p05;
    }
    return {};
}

Result<void> Suggester::compare(const JobContext& job) {
    const std::size_t count = m_kept.size() + m_placement.chosen.size();
    if (!m_options.baselines || count == 0)
        return {};
    const auto coverageOf = [&](const std::vector<glm::dvec3>& places) {
        return coverageOfPlaces(m_city, m_demand, places, JobContext({}, job.stopToken()));
    };
    const auto uniform = coverageOf(evenPlaces(m_plan, count));
    if (!uniform)
        return tl::unexpected(uniform.error());
    m_out.baselines.uniform = *uniform;
    job.progress(0.2);

    const std::vector<glm::dvec3> junctions = junctionPlaces(m_plan);
    if (!junctions.empty()) {
        const auto covered = coverageOf(junctions);
        if (!covered)
            return tl::unexpected(covered.error());
        m_out.baselines.junctions = *covered;
        m_out.baselines.junctionCount = junctions.size();
    }
    // Of the candidates, by a generator whose numbers are the same everywhere.
    std::mt19937_64 random(m_options.seed + 1);
    double sum = 0.0;
    for (int run = 0; run < kRandomRuns && !m_candidates.empty(); ++run) {
        std::set<std::size_t> rows;
        while (rows.size() < std::min(count, m_candidates.size()))
            rows.insert(std::size_t(random() % m_candidates.size()));
        sum += worthOf(m_table, std::vector<std::size_t>(rows.begin(), rows.end()), 0.0);
    }
    m_out.baselines.random = sum / kRandomRuns;
    job.progress(0.4);

    // The least even spacing that reaches as much: doubled until it does, then halved in between.
    std::size_t low = count, high = count;
    bool reaches = *uniform >= m_placement.coverage;
    while (!reaches && high < 8 * count) {
        low = high;
        high = std::max(high + 1, high + high / 4);
        const auto covered = coverageOf(evenPlaces(m_plan, high));
        if (!covered)
            return tl::unexpected(covered.error());
        reaches = *covered >= m_placement.coverage;
    }
    if (!reaches)
        return {};
    if (high == count)
        low = 0;
    while (low + 1 < high) {
        const std::size_t middle = (low + high) / 2;
        const auto covered = coverageOf(evenPlaces(m_plan, middle));
        if (!covered)
            return tl::unexpected(covered.error());
        (*covered >= m_placement.coverage ? high : low) = middle;
    }
    m_out.baselines.uniformCount = high;
    return {};
}

/// One after the other, each with those before it done. Only probes that would be missed least are
/// tried: whatever place is best gains nearly the same, whoever comes.
void Suggester::findMoves() {
    ChosenPlaces places(m_table, kSecondShare);
    for (const std::size_t row : m_fixed)
        places.add(row);
    std::vector<std::size_t> free;  // of m_kept
    for (std::size_t k = 0; k < m_kept.size(); ++k) {
        if (!m_kept[k].locked)
            free.push_back(k);
    }
    const double samples = double(std::max<std::size_t>(m_table.samples, 1));
    while (m_out.moves.size() < kMoves && !free.empty()) {
        std::stable_sort(free.begin(), free.end(), [&](std::size_t x, std::size_t y) {
            return places.loss(m_fixed[x]).worth < places.loss(m_fixed[y]).worth;
        });
        struct Best {
            double gain = 0.0;
            std::size_t probe = 0, to = 0;
        } best;
        const double now = places.coverage();
        for (std::size_t i = 0; i < std::min(free.size(), kMoversTried); ++i) {
            const std::size_t row = m_fixed[free[i]];
            places.remove(row);
            std::vector<double> gains = places.gains();
            gains.resize(m_candidates.size());
            const auto most = std::max_element(gains.begin(), gains.end());
            if (most != gains.end()) {
                const auto to = std::size_t(most - gains.begin());
                places.add(to);
                const double gain = (places.coverage() - now) / samples;
                places.remove(to);
                if (gain > best.gain)
                    best = {gain, free[i], to};
            }
            places.add(row);
        }
        if (!(best.gain > kWorthMoving))
            return;
        places.remove(m_fixed[best.probe]);
        places.add(best.to);
        m_out.moves.push_back({m_kept[best.probe].id,
                               m_candidates[best.to] + m_city.project().frame.origin, best.gain});
        std::erase(free, best.probe);
    }
}

/// Where its gain lies, and of what kind it is.
std::string Suggester::reasonFor(const PlacedRow& placed, const ChosenPlaces& before,
                                 std::vector<std::string>& routes) const {
    std::map<std::uint32_t, double> byLine;
    std::map<std::uint32_t, std::vector<std::pair<float, double>>> stations;
    double gain = 0.0, unseen = 0.0, walls = 0.0, sky = 0.0;
    for (const ServiceRow::Entry& entry : m_table.rows[placed.row].entries) {
        const double more = double(entry.service) - double(before.best(entry.sample));
        if (!(more > 0.0))
            continue;
        const DemandSample& sample = m_demand.samples[entry.sample];
        gain += more;
        unseen += before.best(entry.sample) > 0.0F ? 0.0 : more;
        walls += !sample.sky() && std::abs(sample.normal.z) < 0.7F ? more : 0.0;
        sky += sample.sky() ? more : 0.0;
        byLine[sample.line] += more;
        stations[sample.line].emplace_back(sample.station, more);
    }
    if (!(gain > 0.0))
        return "Gives a second view of what one probe alone sees.";
    const double ground = gain - walls - sky;
    const char* const what = walls >= ground && walls >= sky ? "walls"
                             : ground >= sky                 ? "ground"
                                                             : "sky";
    std::vector<std::pair<double, std::uint32_t>> lines;
    for (const auto& [line, share] : byLine)
        lines.emplace_back(-share, line);
    std::sort(lines.begin(), lines.end());
    std::vector<std::string> where;
    for (const auto& [share, line] : lines) {
        if (m_plan.lines.empty() || -share < 0.1 * gain)
            continue;
        if (std::find(routes.begin(), routes.end(), m_plan.lines[line].id) != routes.end())
            continue;
        routes.push_back(m_plan.lines[line].id);
        const auto [from, to] = middleOf(stations[line]);
        where.push_back(fmt::format("{} ({:.0f} to {:.0f} m)", m_plan.names[line], from, to));
    }
    const std::string place = where.empty() ? "" : " along " + listOf(where);
    return fmt::format("Shows mostly {}{}; {:.0f} % of what it adds no other probe sees.", what,
                       place, 100.0 * unseen / gain);
}

void Suggester::explain() {
    std::set<std::string> taken;
    for (const Probe& probe : m_city.project().probes)
        taken.insert(probe.id);
    ChosenPlaces before(m_table, kSecondShare);
    for (const std::size_t row : m_fixed)
        before.add(row);
    int number = 0;
    for (const PlacedRow& placed : m_placement.chosen) {
        SuggestedProbe probe;
        do
            probe.id = fmt::format("s{:03}", ++number);
        while (!taken.insert(probe.id).second);
        // Rows of what is kept gain nothing: what is chosen is a candidate.
        probe.position = m_candidates[placed.row] + m_city.project().frame.origin;
        probe.gain = placed.gain;
        probe.coverage = placed.coverage;
        probe.reason = reasonFor(placed, before, probe.routes);
        before.add(placed.row);
        m_out.probes.push_back(std::move(probe));
    }
}

Result<Suggestion> Suggester::run(const JobContext& job) {
    const Stopwatch watch;
    if (auto done = prepare(job.phase("looking", 0.0, 0.5)); !done)
        return tl::unexpected(done.error());
    if (auto done = reach(job.phase("choosing", 0.5, 0.75)); !done)
        return tl::unexpected(done.error());
    findMoves();
    if (auto done = bound(job.phase("bound", 0.75, 0.9)); !done)
        return tl::unexpected(done.error());
    if (auto done = compare(job.phase("comparing", 0.9, 1.0)); !done)
        return tl::unexpected(done.error());
    m_out.seconds = watch.seconds();
    return std::move(m_out);
}

}  // namespace

Result<Suggestion> suggestProbes(const PreparedCity& city, const SuggestOptions& options,
                                 const JobContext& job) {
    if (auto sound = checkOptions(options); !sound)
        return tl::unexpected(sound.error());
    return Suggester(city, options).run(job);
}

Project withSuggested(Project project, const Suggestion& suggestion,
                      const std::vector<std::string>& only) {
    for (const SuggestedProbe& probe : suggestion.probes) {
        if (only.empty() || std::find(only.begin(), only.end(), probe.id) != only.end())
            project.probes.push_back({probe.id, probe.position, std::nullopt, false});
    }
    return project;
}

}  // namespace reflet
