// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/reflection/DetailPlanner.h"

#include "core/reconstruction/Surroundings.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>

namespace reflet {

namespace {

constexpr double kFarSurroundings = 100.0;  // metres
/// Metres in one picture beyond which a body did not drive but was put elsewhere.
constexpr double kJump = 5.0;

}  // namespace

void DetailPlanner::setCity(std::shared_ptr<const DrawnCity> city) {
    if (city == m_city)
        return;
    m_city = std::move(city);
    m_held.clear();
    m_budget.reset();
    m_hiding = {};
    if (m_city && m_city->heightfield) {
        m_hiding = std::async(std::launch::async, [field = m_city->heightfield] {
                       return Hiding(*field);
                   }).share();
    }
}

const Hiding* DetailPlanner::hiding() const {
    const bool known =
        m_hiding.valid() && m_hiding.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
    return known ? &m_hiding.get() : nullptr;
}

double DetailPlanner::nearestOf(const Body& body) const {
    return m_city && m_city->tracer
               ? nearestSurroundings(*m_city->tracer, body.center, kFarSurroundings)
               : kFarSurroundings;
}

std::vector<DetailPlanner::Choice> DetailPlanner::plan(std::span<const Body> bodies,
                                                       const glm::dvec3& eye,
                                                       const MemSettings& tuned, bool shrunk) {
    struct Looked {
        BodyView view;
        double step = 0.0;  // metres since the last picture
        bool hidden = false;
        std::optional<Detail> held;
    };
    std::vector<Looked> looked;
    FrameBudget::Demand demand;
    const auto unitsWith = [&](const Detail& detail, std::size_t others) {
        return unitsOf(detail) + m_budget.othersWeight() * unitsOfOthers(detail, others);
    };
    const Hiding* hiding = this->hiding();
    for (const Body& body : bodies) {
        Looked now;
        now.hidden = hiding != nullptr && hiding->hides(eye, body.bounds);
        if (const auto held = m_held.find({body.reflector, body.body}); held != m_held.end()) {
            now.step = glm::distance(held->second.center, body.center);
            now.held = held->second.detail;
        }
        if (now.step > kJump)
            now.step = 0.0;
        now.view = {body.pixels, body.squeeze, body.interest,
                    now.hidden ? kFarSurroundings : nearestOf(body)};
        for (int coarse = 0; coarse <= kMostCoarse && !now.hidden; ++coarse) {
            const Detail detail = chooseDetail(now.view, tuned, coarse);
            const auto at = std::size_t(coarse);
            const double units = unitsWith(detail, body.others);
            demand.units[at] += units * std::min(1.0, now.step / detail.reuse);
            demand.largest[at] = std::max(demand.largest[at], units);
        }
        looked.push_back(now);
    }
    m_budget.setBudget(tuned.lod.frameBudget);
    m_budget.plan(demand, shrunk);

    std::vector<Choice> choices;
    std::map<Key, Held> held;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const Looked& now = looked[i];
        const Detail detail = chooseDetail(now.view, tuned, m_budget.coarse(), now.held);
        held[{bodies[i].reflector, bodies[i].body}] = {detail, bodies[i].center};
        choices.push_back({detail, now.view.pixels * now.view.interest,
                           unitsWith(detail, bodies[i].others), now.hidden});
    }
    m_held = std::move(held);
    return choices;
}

}  // namespace reflet
