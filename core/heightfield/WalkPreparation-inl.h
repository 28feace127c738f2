// SPDX-License-Identifier: GPL-3.0-or-later
// Part of TrackWalk.cpp, for each instruction set once more.
#if defined(REFLET_CORE_HEIGHTFIELD_WALK_PREPARATION_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef REFLET_CORE_HEIGHTFIELD_WALK_PREPARATION_INL
#undef REFLET_CORE_HEIGHTFIELD_WALK_PREPARATION_INL
#else
#define REFLET_CORE_HEIGHTFIELD_WALK_PREPARATION_INL
#endif

#include "core/heightfield/TrackWalk.h"
#include "core/heightfield/WalkLanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace reflet::HWY_NAMESPACE {
namespace {

/// Makes the walks of tracks ready.
class Preparation {
public:
    Preparation(const TiledHeights& heights, const TrackBatch& batch)
        : m_heights(heights),
          m_batch(batch),
          m_x{heights.grid.x0, heights.grid.cellSize, double(heights.grid.columns)},
          m_y{heights.grid.y0, heights.grid.cellSize, double(heights.grid.rows)} {}

    /// Whether there is a walk left; it is then in walks() at index().
    bool next() {
        for (;;) {
            while (m_at < m_count) {
                if (m_walks.t[m_at] < m_walks.until[m_at])
                    return true;
                ++m_at;
            }
            if (m_done == m_batch.tracks.size())
                return false;
            prepare();
        }
    }
    void take() { ++m_at; }
    [[nodiscard]] std::size_t count() const { return m_count; }
    void skip(std::size_t to) { m_at = std::min(to, m_count); }
    [[nodiscard]] Walks<kPrepared>& walks() { return m_walks; }
    [[nodiscard]] std::size_t index() const { return m_at; }

private:
    void prepare() {
        m_at = 0;
        m_count = std::min(kPrepared, m_batch.tracks.size() - m_done);
        for (std::size_t k = 0; k < m_count; ++k) {
            const Track& track = m_batch.tracks[m_done + k];
            m_walks.x.start[k] = track.originX;
            m_walks.y.start[k] = track.originY;
            m_walks.x.direction[k] = track.directionX;
            m_walks.y.direction[k] = track.directionY;
            m_walks.originZ[k] = track.originZ;
            m_walks.directionZ[k] = m_batch.directionZ[track.first];
            m_walks.next[k] = track.first;
            m_walks.last[k] = track.last;
        }
        const std::size_t lanes = hn::Lanes(D());
        for (std::size_t k = m_count; k < m_count + lanes && k < kPrepared; ++k) {
            m_walks.x.start[k] = m_walks.y.start[k] = m_walks.originZ[k] = 0.0;
            m_walks.x.direction[k] = m_walks.y.direction[k] = m_walks.directionZ[k] = 1.0;
        }
        // Step by step for all: what one vector waits for is done for others meanwhile.
        for (std::size_t k = 0; k < m_count; k += lanes)
            prepareLanes(k);
        for (std::size_t k = 0; k < m_count; k += lanes)
            locate(k);
        // Most begin low: go down to where they are at once.
        for (int level = 0; level < 2; ++level) {
            for (std::size_t k = 0; k < m_count; k += lanes)
                goDownWhere(k);
        }
        m_done += m_count;
    }

    /// An axis; `enter` and `leave`: of the grid.
    static void prepareAxis(Axis<kPrepared>& axis, std::size_t k, const Extent& extent, V& enter,
                            V& leave) {
        const D d;
        const V zero = hn::Zero(d);
        const V one = set(1.0);
        const V forever = set(kForever);
        const V start = hn::Load(d, axis.start + k);
        V direction = hn::Load(d, axis.direction + k);
        V inverse = hn::Div(one, direction);
        const M parallel = hn::Eq(hn::Abs(inverse), forever);
        direction = hn::IfThenElse(parallel, zero, direction);
        inverse = hn::IfThenElse(parallel, one, inverse);
        const M up = hn::Or(parallel, hn::Gt(direction, zero));
        const V ahead = hn::IfThenElse(up, one, zero);
        hn::Store(hn::IfThenElse(parallel, forever, set(extent.zero)), d, axis.timeOrigin + k);
        hn::Store(hn::IfThenElse(parallel, zero, start), d, axis.origin + k);
        hn::Store(inverse, d, axis.inverse + k);
        hn::Store(ahead, d, axis.ahead + k);
        hn::Store(hn::IfThenElse(up, one, set(-1.0)), d, axis.step + k);
        hn::Store(direction, d, axis.direction + k);

        const AxisLanes lanes(axis, k);
        const V cellSize = set(extent.cellSize);
        const V count = set(extent.count);
        const V near = lanes.time(lanes.timeOrigin, hn::IfThenElse(up, zero, count), cellSize);
        const V far = lanes.time(lanes.timeOrigin, hn::IfThenElse(up, count, zero), cellSize);
        const V end = hn::Add(set(extent.zero), hn::Mul(count, cellSize));
        const M inside = hn::And(hn::Ge(start, set(extent.zero)), hn::Lt(start, end));
        const V beside = hn::IfThenElse(inside, hn::Neg(forever), forever);
        enter = larger(enter, hn::IfThenElse(parallel, beside, near));
        leave = smaller(leave, far);
    }

    HWY_INLINE void prepareLanes(std::size_t k) {
        const D d;
        const V zero = hn::Zero(d);
        const V one = set(1.0);
        V enter = zero;
        V leave = set(kForever);
        prepareAxis(m_walks.x, k, m_x, enter, leave);
        prepareAxis(m_walks.y, k, m_y, enter, leave);
        const V originZ = hn::Load(d, m_walks.originZ + k);
        const V directionZ = hn::Load(d, m_walks.directionZ + k);
        const V margin =
            hn::Mul(set(1e-14), hn::Add(hn::Add(one, hn::Abs(originZ)), set(m_heights.magnitude)));
        const V crossing = hn::Mul(hn::Sub(hn::Add(set(m_heights.highest), margin), originZ),
                                   hn::Div(one, directionZ));
        const M falls = hn::Lt(directionZ, zero);
        const M rises = hn::Gt(directionZ, zero);
        const V t = hn::IfThenElse(falls, larger(enter, crossing), enter);
        const V until = hn::IfThenElse(rises, smaller(leave, crossing), leave);
        const V size = set(64.0);
        const V stride = set(double(m_heights.blockColumns));
        hn::Store(t, d, m_walks.t + k);
        hn::Store(until, d, m_walks.until + k);
        hn::Store(margin, d, m_walks.margin + k);
        hn::Store(size, d, m_walks.size + k);
        hn::Store(zero, d, m_walks.offset + k);
        hn::Store(stride, d, m_walks.stride + k);
        hn::Store(set(kForever), d, m_walks.leave8 + k);
        hn::Store(set(kForever), d, m_walks.leave64 + k);
        hn::Store(zero, d, m_walks.offset8 + k);
        hn::Store(zero, d, m_walks.held + k);
    }

    /// The block of 64 x 64 cells that each walk begins in.
    HWY_INLINE void locate(std::size_t k) {
        const D d;
        const V zero = hn::Zero(d);
        const V one = set(1.0);
        const V t = hn::Load(d, m_walks.t + k);
        const M walks = hn::Lt(t, hn::Load(d, m_walks.until + k));
        const V size = set(64.0);
        const V stride = set(double(m_heights.blockColumns));
        const V scale = set(1.0 / (64.0 * m_heights.grid.cellSize));
        const V lastColumn = hn::Sub(stride, one);
        const V lastRow = set(double(m_heights.blockRows - 1));
        const V i = blockAt(m_walks.x, k, t, size, scale, zero, lastColumn, walks, m_x);
        const V j = blockAt(m_walks.y, k, t, size, scale, zero, lastRow, walks, m_y);
        hn::Store(hn::IfThenElseZero(walks, i), d, m_walks.i + k);
        hn::Store(hn::IfThenElseZero(walks, j), d, m_walks.j + k);
    }

    HWY_INLINE void goDownWhere(std::size_t k) {
        const D d;
        const M walks = hn::Lt(hn::Load(d, m_walks.t + k), hn::Load(d, m_walks.until + k));
        const Look look(m_heights, m_walks, k, m_x, m_y);
        const M down = hn::And(walks, hn::AndNot(hn::Eq(look.size, set(1.0)), look.meets));
        if (!hn::AllFalse(d, down))
            goDown(m_heights, m_walks, k, look, down, m_x, m_y);
    }

    const TiledHeights& m_heights;
    const TrackBatch& m_batch;
    Extent m_x, m_y;
    Walks<kPrepared> m_walks;
    std::size_t m_done = 0;   ///< tracks made ready so far
    std::size_t m_count = 0;  ///< in m_walks
    std::size_t m_at = 0;     ///< the first of them that nobody took
};

}  // namespace
}  // namespace reflet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
