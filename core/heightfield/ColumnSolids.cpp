// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/ColumnSolids.h"

#include <algorithm>
#include <limits>

namespace reflet {

namespace {

constexpr float kDown = -std::numeric_limits<float>::infinity();
constexpr int kDirections = 8;

using Records = std::span<const SpanRecord>;
using Solids = std::vector<HeightSpan>;

struct Hollow {
    float low = 0.0F;
    float high = 0.0F;
};

/// One object's crossings along one of the lines beside the centre, from above.
class Winding {
public:
    Winding(Records crossings, CityObjectType kind, HeightPolicy policy, Solids& out)
        : m_crossings(crossings), m_kind(kind), m_policy(policy), m_out(out) {}

    void along(int direction) {
        int inside = 0;
        std::size_t entry = 0;
        for (std::size_t n = 0; n < m_crossings.size(); ++n) {
            if ((m_crossings[n].beside >> direction & 1) == 0)
                continue;
            if (inside == 0)
                entry = n;
            inside += m_crossings[n].facing;
            if (inside == 0)
                m_out.push_back({m_crossings[n].low, m_crossings[entry].high, m_kind, false});
        }
        if (inside != 0)
            open(entry, direction);
    }

private:
    /// No underside: it stands on the ground, or is a mere surface.
    void open(std::size_t entry, int direction) {
        if (m_policy == HeightPolicy::Solid) {
            m_out.push_back({kDown, m_crossings[entry].high, m_kind, false});
            return;
        }
        for (const SpanRecord& crossing : m_crossings.subspan(entry)) {
            if ((crossing.beside >> direction & 1) != 0)
                m_out.push_back({crossing.low, crossing.high, m_kind, true});
        }
    }

    Records m_crossings;
    CityObjectType m_kind;
    HeightPolicy m_policy;
    Solids& m_out;
};

void addWinding(Records crossings, CityObjectType kind, HeightPolicy policy, Solids& out) {
    const bool everywhere = std::all_of(crossings.begin(), crossings.end(),
                                        [](const SpanRecord& r) { return r.beside == 0xff; });
    Winding winding(crossings, kind, policy, out);
    for (int direction = 0; direction < (everywhere ? 1 : kDirections); ++direction)
        winding.along(direction);
    for (const SpanRecord& r : crossings) {
        if (r.beside == 0)  // it is touched by an edge or a corner, from between the directions
            out.push_back({r.low, r.high, kind, false});
    }
}

/// Where a tunnel is hollow: between a ceiling and the floor under it; of a shell that shows only
/// its outside, between that.
void addHollows(Records crossings, std::vector<Hollow>& out) {
    for (const int upper : {-1, 1}) {
        const SpanRecord* above = nullptr;
        const std::size_t before = out.size();
        for (const SpanRecord& crossing : crossings) {
            if ((crossing.beside & 1) == 0)
                continue;
            if (above != nullptr && above->facing == upper && crossing.facing == -upper)
                out.push_back({crossing.high, above->low});
            above = &crossing;
        }
        if (out.size() > before)
            return;
    }
}

/// [-infinity, top] without the hollows.
void addGround(float top, std::vector<Hollow> hollows, Solids& out) {
    std::sort(hollows.begin(), hollows.end(),
              [](const Hollow& a, const Hollow& b) { return a.low < b.low; });
    float low = kDown;
    for (const Hollow& hollow : hollows) {
        if (hollow.low > top)
            break;
        if (hollow.low >= low)
            out.push_back({low, hollow.low, CityObjectType::TinRelief, false});
        low = std::max(low, hollow.high);
    }
    if (low <= top)
        out.push_back({low, top, CityObjectType::TinRelief, false});
}

/// Calls use(its records) for each object and kind.
template <class Use>
void eachObject(Records records, const Use& use) {
    for (std::size_t n = 0; n < records.size();) {
        std::size_t end = n + 1;
        while (end < records.size() && records[end].object == records[n].object &&
               records[end].kind == records[n].kind)
            ++end;
        use(records.subspan(n, end - n));
        n = end;
    }
}

float lowestOf(Records records) {
    return std::min_element(records.begin(), records.end(),
                            [](const auto& a, const auto& b) { return a.low < b.low; })
        ->low;
}

/// What one object adds at the centre or over the cell, the winding of a shell left out.
void addPlain(Records of, CityObjectType kind, bool hollows, Solids& out) {
    const HeightPolicy policy = of.front().policy;
    if (policy == HeightPolicy::Crown) {
        out.push_back({lowestOf(of), of.front().high, kind, false});
        return;
    }
    const bool ground = policy == HeightPolicy::Ground;
    const bool column = policy == HeightPolicy::Column || policy == HeightPolicy::Cover;
    for (const SpanRecord& r : of)
        out.push_back({column || (ground && !hollows) ? kDown : r.low, r.high, kind, false});
}

/// Unites what touches or leaves less than the clearance between. Of two tops the higher names the
/// kind, of equal ones the lesser kind.
Solids united(Solids solids, double clearance) {
    std::sort(solids.begin(), solids.end(), [](const HeightSpan& a, const HeightSpan& b) {
        return a.low != b.low ? a.low < b.low : a.high < b.high;
    });
    Solids out;
    for (const HeightSpan& next : solids) {
        if (out.empty() || double(next.low) - double(out.back().high) > clearance) {
            out.push_back(next);
            continue;
        }
        HeightSpan& last = out.back();
        last.hollow = last.hollow && next.hollow;
        if (next.high > last.high || (next.high == last.high && next.kind < last.kind)) {
            last.high = next.high;
            last.kind = next.kind;
        }
    }
    return out;
}

/// Nothing for a column that the layer's height says all about. `free`: something that is not in
/// the layer stands here too.
Solids checked(Solids solids, float top, bool free) {
    if (!free) {
        std::erase_if(solids, [&](const HeightSpan& s) { return s.low > top; });
        solids.back().high = std::min(solids.back().high, top);
    }
    const bool all = solids.back().high == top && (solids.size() == 1);
    const bool lost = !free && solids.back().high < top;
    return all || lost ? Solids{} : solids;
}

}  // namespace

ColumnSpans solidsOf(Records records, const ColumnHeights& heights, const CityModel& city,
                     double clearance) {
    std::vector<Hollow> hollows;
    bool tunnel = false;
    eachObject(records, [&](Records of) {
        if (of.front().policy != HeightPolicy::Tunnel)
            return;
        tunnel = true;
        if (of.front().kind == SpanRecord::Kind::Crossing)
            addHollows(of, hollows);
    });
    Solids center;
    addGround(heights.ground, hollows, center);
    Solids pieces;
    eachObject(records, [&](Records of) {
        const CityObjectType kind = city.objects[of.front().object].type;
        const HeightPolicy policy = of.front().policy;
        const bool crossings = of.front().kind == SpanRecord::Kind::Crossing;
        const bool shell = policy == HeightPolicy::Solid || policy == HeightPolicy::Overhead;
        if (crossings && shell) {
            addWinding(of, kind, policy, center);
        } else {
            addPlain(of, kind, !hollows.empty(), crossings ? center : pieces);
        }
    });
    pieces.insert(pieces.end(), center.begin(), center.end());
    return {checked(united(std::move(center), clearance), heights.topCenter, tunnel),
            checked(united(std::move(pieces), clearance), heights.topMax, tunnel), tunnel};
}

}  // namespace reflet
