// SPDX-License-Identifier: GPL-3.0-or-later
// Part of TrackWalk.cpp, for each instruction set once more.
#if defined(REFLET_CORE_HEIGHTFIELD_WALK_ABREAST_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef REFLET_CORE_HEIGHTFIELD_WALK_ABREAST_INL
#undef REFLET_CORE_HEIGHTFIELD_WALK_ABREAST_INL
#else
#define REFLET_CORE_HEIGHTFIELD_WALK_ABREAST_INL
#endif

#include "core/heightfield/GridWalk.h"
#include "core/heightfield/WalkPreparation-inl.h"

#include <bit>

HWY_BEFORE_NAMESPACE();
namespace reflet::HWY_NAMESPACE {
namespace {

/// Walks tracks of one ray each, of which neighbours are alike: those of a vector begin and end
/// together. Several vectors in turns, so that none is waited for.
class Abreast {
public:
    Abreast(const TiledHeights& heights, const CellSpans& spans, const TrackBatch& batch)
        : m_heights(heights),
          m_spans(spans),
          m_batch(batch),
          m_preparation(heights, batch),
          m_x{heights.grid.x0, heights.grid.cellSize, double(heights.grid.columns)},
          m_y{heights.grid.y0, heights.grid.cellSize, double(heights.grid.rows)} {}

    void run() {
        const D d;
        const std::size_t lanes = hn::Lanes(d);
        while (m_preparation.next()) {
            Walks<kPrepared>& w = m_preparation.walks();
            alignas(64) double found[kPrepared];
            std::fill_n(found, kPrepared, kForever);
            for (std::size_t k = m_preparation.count(); k < kPrepared; ++k)
                w.until[k] = -kForever;
            for (std::uint32_t left = 0xffffffffU; left != 0;) {
                for (std::uint32_t rest = left; rest != 0; rest &= rest - 1) {
                    const auto v = std::size_t(std::countr_zero(rest));
                    if (v * lanes >= kPrepared || !advance(w, v * lanes, found + v * lanes))
                        left &= ~(1U << v);
                }
            }
            for (std::size_t k = 0; k < m_preparation.count(); ++k) {
                if (found[k] < kForever)
                    m_batch.answer(m_batch.ray[w.next[k]], found[k], cellOf(m_heights.grid, w, k));
            }
            m_preparation.skip(kPrepared);
        }
    }

private:
    /// One step of each of the rays; false when none is left. found: times of hits.
    HWY_INLINE bool advance(Walks<kPrepared>& w, std::size_t k, double* found) const {
        const D d;
        const V one = set(1.0);
        const V until = hn::Load(d, w.until + k);
        M alive =
            hn::And(hn::Lt(hn::Load(d, w.t + k), until), hn::Eq(hn::Load(d, found), set(kForever)));
        if (hn::AllFalse(d, alive))
            return false;
        hn::Store(hn::IfThenElse(alive, hn::Zero(d), one), d, w.held + k);
        goUp(m_heights, w, k);
        const Look look(m_heights, w, k, m_x, m_y);
        const M meets = hn::And(look.meets, alive);
        const M cells = hn::Eq(look.size, one);
        const M asked = hn::And(meets, cells);
        if (!hn::AllFalse(d, asked))
            alive = hn::AndNot(askColumns(w, k, look, asked, found), alive);
        const M down = hn::AndNot(cells, meets);
        const M moves = hn::AndNot(down, alive);
        const M stepX = hn::And(moves, hn::Le(look.leaveX, look.leave));
        const M stepY = hn::And(moves, hn::Le(look.leaveY, look.leave));
        const V stepsX = hn::IfThenElseZero(stepX, hn::Load(d, w.x.step + k));
        const V stepsY = hn::IfThenElseZero(stepY, hn::Load(d, w.y.step + k));
        hn::Store(hn::IfThenElse(moves, look.leave, look.t), d, w.t + k);
        hn::Store(hn::Add(look.i, stepsX), d, w.i + k);
        hn::Store(hn::Add(look.j, stepsY), d, w.j + k);
        if (!hn::AllFalse(d, down))
            goDown(m_heights, w, k, look, down, m_x, m_y);
        return true;
    }

    /// HeightWalk::meets() for the ray of each lane; where it hits, its time goes to `found`.
    HWY_INLINE M askColumns(const Walks<kPrepared>& w, std::size_t k, const Look& look, M asked,
                            double* found) const {
        const D d;
        const V origin = hn::Load(d, w.originZ + k);
        const V directionZ = hn::Load(d, w.directionZ + k);
        const M solid = hn::And(asked, hn::Gt(look.maximum, set(-kForever)));
        const M below = hn::Le(hn::Add(origin, hn::Mul(look.t, directionZ)), look.maximum);
        const V down = hn::Mul(hn::Sub(look.maximum, origin), hn::Div(set(1.0), directionZ));
        const M falls = hn::And(hn::Lt(directionZ, hn::Zero(d)), hn::Lt(down, look.leave));
        const V later = hn::IfThenElse(hn::Gt(down, look.t), down, look.t);
        const M hits = hn::And(solid, hn::Or(below, falls));
        hn::Store(hn::IfThenElse(hits, hn::IfThenElse(below, look.t, later), hn::Load(d, found)), d,
                  found);
        if (m_spans.empty())
            return hits;
        alignas(64) double leave[kMostLanes];
        hn::Store(look.leave, d, leave);
        for (unsigned rest = bits(asked); rest != 0; rest &= rest - 1) {
            const auto lane = std::size_t(std::countr_zero(rest));
            const auto column = m_spans.at(cellOf(m_heights.grid, w, k + lane));
            if (!column.empty()) {
                const HeightWalk z(w.originZ[k + lane], w.directionZ[k + lane]);
                found[lane] = z.meets(column, w.t[k + lane], leave[lane]);
            }
        }
        return hn::Lt(hn::Load(d, found), set(kForever));
    }

    const TiledHeights& m_heights;
    const CellSpans& m_spans;
    const TrackBatch& m_batch;
    Preparation m_preparation;
    Extent m_x, m_y;
};

}  // namespace
}  // namespace reflet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
