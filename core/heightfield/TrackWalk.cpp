// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/heightfield/TrackWalk.h"

#include "core/heightfield/GridWalk.h"

#include <array>
#include <bit>
#include <cstddef>
#include <limits>

// This file, and what it includes of -inl.h, is compiled once for each instruction set; the order
// of these lines matters.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/heightfield/TrackWalk.cpp"
#define HWY_DISABLED_TARGETS HWY_AVX3_DL
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "core/heightfield/WalkAbreast-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace reflet::HWY_NAMESPACE {
namespace {

/// Walks tracks, one in each lane; a lane that is done takes the next one.
class Walker {
public:
    Walker(const TiledHeights& heights, const CellSpans& spans, const TrackBatch& batch)
        : m_heights(heights),
          m_spans(spans),
          m_batch(batch),
          m_preparation(heights, batch),
          m_x{heights.grid.x0, heights.grid.cellSize, double(heights.grid.columns)},
          m_y{heights.grid.y0, heights.grid.cellSize, double(heights.grid.rows)} {}

    void run() {
        const std::size_t lanes = hn::Lanes(D());
        for (Lanes& set : m_sets) {
            for (std::size_t lane = 0; lane < lanes; ++lane)
                refill(set, lane);
        }
        for (bool any = true; any;) {
            any = false;
            for (Lanes& set : m_sets)
                advance(set);
            for (Lanes& set : m_sets) {
                if (set.active != 0)
                    settle(set);
                any = any || set.active != 0;
            }
        }
    }

private:
    using Lane = std::size_t;

    struct Lanes {
        Walks<kMostLanes> walks;
        alignas(64) double enter[kMostLanes];  ///< what was looked at last
        alignas(64) double leave[kMostLanes];
        alignas(64) double at[kMostLanes];
        alignas(64) double cell[kMostLanes];
        unsigned active = 0;   ///< lanes that walk, a bit each
        unsigned asked = 0;    ///< whose column is to be asked
        unsigned waiting = 0;  ///< that are held up
    };

    HWY_INLINE void refill(Lanes& lanes, Lane lane) {
        Walks<kMostLanes>& w = lanes.walks;
        if (m_preparation.next()) {
            copyWalk(w, lane, m_preparation.walks(), m_preparation.index());
            m_preparation.take();
            lanes.active |= 1U << lane;
            return;
        }
        // Stands still at the first block, forever.
        lanes.active &= ~(1U << lane);
        w.t[lane] = kForever;
        w.until[lane] = -kForever;
        w.i[lane] = w.j[lane] = w.offset[lane] = 0.0;
        w.x.step[lane] = w.y.step[lane] = 0.0;
        w.size[lane] = 64.0;
        w.stride[lane] = 0.0;
        w.held[lane] = 1.0;
        w.leave8[lane] = w.leave64[lane] = kForever;
    }

    /// Each lane that is not held up passes over a block or a column that is to be asked. Without a
    /// branch, so that several sets are on their way at a time.
    HWY_INLINE void advance(Lanes& lanes) const {
        const D d;
        Walks<kMostLanes>& w = lanes.walks;
        const Look look(m_heights, w, 0, m_x, m_y);
        const M cells = hn::Eq(look.size, set(1.0));
        const M meets = hn::And(look.meets, look.goes);
        hn::Store(look.t, d, lanes.enter);
        hn::Store(look.leave, d, lanes.leave);
        hn::Store(look.at, d, lanes.at);
        hn::Store(hn::Add(hn::Mul(look.j, set(m_x.count)), look.i), d, lanes.cell);
        lanes.asked = bits(hn::And(meets, cells));
        // On to the next one; through a corner both steps are due at once.
        const M down = hn::AndNot(cells, meets);
        const M moves = hn::AndNot(down, look.goes);
        const V t = hn::IfThenElse(moves, look.leave, look.t);
        const M stepX = hn::And(moves, hn::Le(look.leaveX, look.leave));
        const M stepY = hn::And(moves, hn::Le(look.leaveY, look.leave));
        hn::Store(t, d, w.t);
        hn::Store(hn::Add(look.i, hn::IfThenElseZero(stepX, hn::Load(d, w.x.step))), d, w.i);
        hn::Store(hn::Add(look.j, hn::IfThenElseZero(stepY, hn::Load(d, w.y.step))), d, w.j);
        const V end =
            hn::Min(hn::Load(d, w.until), hn::Min(hn::Load(d, w.leave8), hn::Load(d, w.leave64)));
        const M held = hn::Or(hn::Or(hn::Not(look.goes), down), hn::Ge(t, end));
        hn::Store(hn::IfThenElseZero(held, set(1.0)), d, w.held);
        lanes.waiting = bits(held) & lanes.active;
    }

    /// What advance() left over: the columns that are asked, and lanes that wait for something,
    /// once they are several.
    HWY_INLINE void settle(Lanes& lanes) {
        for (unsigned rest = lanes.asked; rest != 0; rest &= rest - 1) {
            const auto lane = Lane(std::countr_zero(rest));
            if (askColumn(lanes.walks, lane,
                          {std::size_t(lanes.at[lane]), std::uint32_t(lanes.cell[lane]),
                           lanes.enter[lane], lanes.leave[lane]})) {
                lanes.walks.held[lane] = 1.0;
                lanes.waiting |= 1U << lane;
            }
        }
        if (2 * std::size_t(std::popcount(lanes.waiting)) >= hn::Lanes(D()) ||
            lanes.waiting == lanes.active)
            release(lanes);
    }

    /// Lets the lanes go on that are held up: with another track, out of the blocks that they have
    /// left, or into a block.
    HWY_INLINE void release(Lanes& lanes) {
        const D d;
        Walks<kMostLanes>& w = lanes.walks;
        for (unsigned done = bits(hn::Ge(hn::Load(d, w.t), hn::Load(d, w.until))) & lanes.active;
             done != 0; done &= done - 1)
            refill(lanes, Lane(std::countr_zero(done)));
        const M idle = hn::Eq(hn::Load(d, w.until), set(-kForever));
        hn::Store(hn::IfThenElseZero(idle, set(1.0)), d, w.held);
        goUp(m_heights, w, 0);
        const Look look(m_heights, w, 0, m_x, m_y);
        const M meets = hn::And(look.meets, look.goes);
        const M down = hn::AndNot(hn::Eq(look.size, set(1.0)), meets);
        if (!hn::AllFalse(d, down))
            goDown(m_heights, w, 0, look, down, m_x, m_y);
    }

    /// A column on the way of a track.
    struct Column {
        std::size_t position;  ///< in the tiled heights
        std::uint32_t cell;
        double enter, leave;
    };

    /// Which rays of the track meet the column; the rest goes on. True when none is left.
    HWY_INLINE bool askColumn(Walks<kMostLanes>& w, Lane lane, const Column& at) {
        const double height = double(m_heights.maximum[at.position]);
        const double t = at.enter;
        const double leave = at.leave;
        const std::uint32_t cell = at.cell;
        std::uint32_t next = w.next[lane];
        const std::uint32_t last = w.last[lane];
        const auto column = m_spans.at(cell);
        if (column.empty()) {
            next = askSolid(w.originZ[lane], height, t, leave, next, last, cell);
        } else {
            next = askHollow(w, lane, column, t, leave, cell);
        }
        if (next == w.next[lane])
            return false;
        w.next[lane] = next;
        if (next == last) {
            w.until[lane] = -kForever;
            return true;
        }
        const double directionZ = m_batch.directionZ[next];
        w.directionZ[lane] = directionZ;
        if (directionZ > 0.0) {
            const HeightWalk z(w.originZ[lane], directionZ);
            const double crossing = z.timeAt(m_heights.highest + w.margin[lane]);
            w.until[lane] = std::min(w.until[lane], crossing);
        }
        return false;
    }

    /// HeightWalk::meets() for the lowest rays, several at a time; the first that passes.
    HWY_INLINE std::uint32_t askSolid(double originZ, double height, double t, double leave,
                                      std::uint32_t next, std::uint32_t last, std::uint32_t cell) {
        // A missing cell, where the ray's height overflows, is no column.
        if (height == -kForever)
            return next;
        const D d;
        const std::size_t lanes = hn::Lanes(d);
        const V enter = set(t);
        const V top = set(height);
        const V origin = set(originZ);
        while (next < last) {
            const V directionZ = hn::LoadU(d, m_batch.directionZ + next);
            const M below = hn::Le(hn::Add(origin, hn::Mul(enter, directionZ)), top);
            const V down = hn::Mul(hn::Sub(top, origin), hn::Div(set(1.0), directionZ));
            const M falls = hn::And(hn::Lt(directionZ, hn::Zero(d)), hn::Lt(down, set(leave)));
            const V later = hn::IfThenElse(hn::Gt(down, enter), down, enter);
            alignas(64) double found[kMostLanes];
            hn::Store(hn::IfThenElse(below, enter, later), d, found);
            const std::size_t asked = std::min<std::size_t>(lanes, last - next);
            const auto hits = std::size_t(std::countr_one(bits(hn::Or(below, falls))));
            const std::size_t count = std::min(hits, asked);
            for (std::size_t k = 0; k < count; ++k)
                m_batch.answer(m_batch.ray[next + k], found[k], cell);
            next += std::uint32_t(count);
            if (count < lanes)
                break;
        }
        return next;
    }

    /// The rays that a hollow column stops may be any: moves the others together, up to the end.
    std::uint32_t askHollow(Walks<kMostLanes>& w, Lane lane, std::span<const HeightSpan> column,
                            double t, double leave, std::uint32_t cell) {
        std::uint32_t kept = w.last[lane];
        for (std::uint32_t ray = w.last[lane]; ray-- > w.next[lane];) {
            const HeightWalk z(w.originZ[lane], m_batch.directionZ[ray]);
            const double found = z.meets(column, t, leave);
            if (std::isfinite(found)) {
                m_batch.answer(m_batch.ray[ray], found, cell);
                continue;
            }
            --kept;
            m_batch.directionZ[kept] = m_batch.directionZ[ray];
            m_batch.ray[kept] = m_batch.ray[ray];
        }
        return kept;
    }

    const TiledHeights& m_heights;
    const CellSpans& m_spans;
    const TrackBatch& m_batch;
    Preparation m_preparation;
    Extent m_x, m_y;
    std::array<Lanes, kSets> m_sets{};
};

}  // namespace

void walkTracksWide(const TiledHeights& heights, const CellSpans& spans, const TrackBatch& batch) {
    if (batch.abreast)
        return Abreast(heights, spans, batch).run();
    Walker(heights, spans, batch).run();
}

std::size_t lanesOfWalk() {
    return hn::Lanes(D());
}

}  // namespace reflet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace reflet {

HWY_EXPORT(walkTracksWide);
HWY_EXPORT(lanesOfWalk);

bool canWalk(const TiledHeights& heights) {
    return heights.maximum.size() < std::size_t(std::numeric_limits<std::int32_t>::max());
}

void walkTracks(const TiledHeights& heights, const CellSpans& spans, const TrackBatch& batch) {
    HWY_DYNAMIC_DISPATCH(walkTracksWide)(heights, spans, batch);
}

std::size_t walkLanes() {
    return HWY_DYNAMIC_DISPATCH(lanesOfWalk)();
}

std::vector<std::string> walkTargets() {
    std::vector<std::string> names;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
        names.emplace_back(hwy::TargetName(target));
    return names;
}

void useWalkTarget(const std::string& name) {
    hwy::SetSupportedTargetsForTest(0);
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        if (name == hwy::TargetName(target)) {
            hwy::SetSupportedTargetsForTest(target);
            break;
        }
    }
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace reflet
#endif
