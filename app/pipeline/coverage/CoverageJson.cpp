// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/coverage/CoverageJson.h"

#include "app/pipeline/LonLat.h"

#include <fmt/format.h>

namespace reflet {

namespace {

using nlohmann::json;

/// Positions with their longitudes and latitudes, written in the order in which they were given.
class Positions {
public:
    Positions(const ProjectFrame& frame, const std::vector<glm::dvec3>& places)
        : m_places(places), m_degrees(lonLatOf(frame, places)) {}

    void write(json& into, std::size_t k) const {
        into["position"] = {m_places[k].x, m_places[k].y, m_places[k].z};
        into["lon"] = m_degrees ? json((*m_degrees)[k].x) : json();
        into["lat"] = m_degrees ? json((*m_degrees)[k].y) : json();
    }

private:
    std::vector<glm::dvec3> m_places;
    std::optional<std::vector<glm::dvec2>> m_degrees;
};

template <class Items>
Positions positionsOf(const ProjectFrame& frame, const Items& items) {
    std::vector<glm::dvec3> places;
    for (const auto& item : items)
        places.push_back(item.position);
    return {frame, places};
}

json optional(const std::optional<double>& value) {
    return value ? json(*value) : json();
}

json crsOf(const Project& project) {
    return project.frame.crs ? json(*project.frame.crs) : json();
}

json totals(const CoverageReport& report) {
    json out{{"total", report.coverage.mean},
             {"error", report.coverage.error},
             {"seen", report.seen.mean},
             {"seenTwice", report.seenTwice.mean},
             {"shown", report.shown.mean},
             {"worst", nullptr},
             {"p05", nullptr},
             {"largestGap", nullptr}};
    if (!report.plan.ground) {
        out["worst"] = report.figures.worst;
        out["p05"] = report.figures.p05;
        out["largestGap"] = report.figures.largestGap;
    }
    return out;
}

json toJson(const RouteCoverage& route) {
    const LineFigures& f = route.figures;
    return {{"id", route.id},
            {"name", route.name},
            {"attributes", route.attributes},
            {"length", f.length},
            {"coverage", f.coverage},
            {"seen", f.seen},
            {"seenTwice", f.seenTwice},
            {"worst", f.worst},
            {"worstStation", f.worstStation},
            {"p05", f.p05},
            {"largestGap", f.largestGap}};
}

json worstJson(const CoverageReport& report, const Project& project) {
    const Positions positions = positionsOf(project.frame, report.worst);
    json out = json::array();
    for (std::size_t k = 0; k < report.worst.size(); ++k) {
        const WorstPlace& place = report.worst[k];
        json item{{"route", place.route},
                  {"name", place.name},
                  {"from", place.from},
                  {"to", place.to},
                  {"metres", place.to - place.from},
                  {"coverage", place.coverage}};
        positions.write(item, k);
        out.push_back(item);
    }
    return out;
}

json objectsJson(const CoverageReport& report, const Project& project) {
    const Positions positions = positionsOf(project.frame, report.objects);
    json out = json::array();
    for (std::size_t k = 0; k < report.objects.size(); ++k) {
        const ObjectCoverage& object = report.objects[k];
        json item{{"id", object.object},
                  {"type", object.type},
                  {"reflected", object.reflected},
                  {"uncovered", object.uncovered}};
        positions.write(item, k);
        out.push_back(item);
    }
    return out;
}

json probesJson(const CoverageReport& report, const Project& project) {
    const Positions positions = positionsOf(project.frame, project.probes);
    json out = json::array();
    for (std::size_t k = 0; k < report.probes.size() && k < project.probes.size(); ++k) {
        json item{{"id", report.probes[k].id},
                  {"serves", report.probes[k].serves},
                  {"loss", report.probes[k].loss}};
        positions.write(item, k);
        out.push_back(item);
    }
    return out;
}

json baselinesJson(const Suggestion::Baselines& baselines) {
    return {{"uniform", optional(baselines.uniform)},
            {"junctions", optional(baselines.junctions)},
            {"random", optional(baselines.random)},
            {"junctionCount", baselines.junctionCount},
            {"uniformCount", baselines.uniformCount ? json(*baselines.uniformCount) : json()}};
}

json suggestedJson(const Suggestion& suggestion, const Project& project) {
    const Positions positions = positionsOf(project.frame, suggestion.probes);
    json out = json::array();
    for (std::size_t k = 0; k < suggestion.probes.size(); ++k) {
        const SuggestedProbe& probe = suggestion.probes[k];
        json item{{"id", probe.id},
                  {"gain", probe.gain},
                  {"coverage", probe.coverage},
                  {"routes", probe.routes},
                  {"reason", probe.reason}};
        positions.write(item, k);
        out.push_back(item);
    }
    return out;
}

json movesJson(const Suggestion& suggestion) {
    json out = json::array();
    for (const ProbeMove& move : suggestion.moves)
        out.push_back(
            {{"id", move.id}, {"to", {move.to.x, move.to.y, move.to.z}}, {"gain", move.gain}});
    return out;
}

json remarksJson(const std::vector<Diagnostic>& remarks) {
    json out = json::array();
    for (const Diagnostic& remark : remarks)
        out.push_back({{"severity", toString(remark.severity)},
                       {"code", remark.code},
                       {"object", remark.object},
                       {"text", remark.text},
                       {"remedy", remark.remedy}});
    return out;
}

}  // namespace

json coverageJson(const CoverageReport& report, const Project& project) {
    json routes = json::array();
    for (const RouteCoverage& route : report.routes)
        routes.push_back(toJson(route));
    return {
        {"coverage", totals(report)},
        {"routes", routes},
        {"worst", worstJson(report, project)},
        {"facades", {{"reflected", report.reflectedWalls}, {"uncovered", report.uncoveredWalls}}},
        {"objects", objectsJson(report, project)},
        {"probes", probesJson(report, project)},
        {"crs", crsOf(project)},
        {"on", report.plan.ground ? "ground" : "routes"},
        {"samples", report.demand.samples.size()},
        {"seconds", report.seconds}};
}

json suggestionJson(const Suggestion& suggestion, const Project& project) {
    return {{"probes", suggestedJson(suggestion, project)},
            {"reached", suggestion.reached},
            {"coverage",
             {{"before", suggestion.before.mean},
              {"after", suggestion.after.mean},
              {"error", suggestion.after.error},
              {"shown", suggestion.shown},
              {"worst", suggestion.worst},
              {"p05", suggestion.p05}}},
            {"certificate",
             {{"upperBound", suggestion.coverageBound},
              {"ratio", suggestion.ratio()},
              {"optimised", suggestion.optimised},
              {"worth", suggestion.worth},
              {"worthBound", suggestion.worthBound},
              {"prefix", suggestion.certificate.prefix},
              {"everything", suggestion.certificate.everything},
              {"dual", suggestion.certificate.dual},
              {"fewest", suggestion.fewest}}},
            {"baselines", baselinesJson(suggestion.baselines)},
            {"moves", movesJson(suggestion)},
            {"crs", crsOf(project)},
            {"candidates", suggestion.candidates},
            {"samples", suggestion.samples},
            {"remarks", remarksJson(suggestion.remarks)},
            {"seconds", suggestion.seconds}};
}

std::string certificateSentence(const Suggestion& suggestion) {
    const std::size_t count = suggestion.probes.size();
    if (count == 0)
        return fmt::format("No new probe: the coverage is {:.1f} %.",
                           100.0 * suggestion.before.mean);
    return fmt::format(
        "{} new probe{} reach{} {:.1f} %; the best possible with {} is {:.1f} % ({:.1f} % of it).",
        count, count == 1 ? "" : "s", count == 1 ? "es" : "", 100.0 * suggestion.optimised, count,
        100.0 * suggestion.coverageBound, 100.0 * suggestion.ratio());
}

}  // namespace reflet
