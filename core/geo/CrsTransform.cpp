// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geo/Crs.h"
#include "core/geo/CrsImpl.h"
#include "core/geo/ProjHandles.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace reflet {

struct CrsTransform::Impl {
    ProjContext context;
    ProjObject operation;  ///< null: both CRSs are the same, points stay as they are
    bool usesHeight = false;
    double tolerance = 10.0;  ///< of the way there and back, in units of the source
    std::string from;
    std::string to;
    std::string name = "none (same system)";
    double accuracy = 0.0;
    bool stale = false;  ///< points were transformed since name and accuracy were asked for

    void transform(glm::dvec3* points, std::size_t count, PJ_DIRECTION direction) {
        stale = true;
        constexpr std::size_t kStride = sizeof(glm::dvec3);
        proj_trans_generic(operation.get(), direction, &points->x, kStride, count, &points->y,
                           kStride, count, usesHeight ? &points->z : nullptr,
                           usesHeight ? kStride : 0, usesHeight ? count : 0, nullptr, 0, 0);
    }
    /// PROJ picks among several operations point by point: asks for the one used last. Copying it
    /// costs more than to transform a point, so this waits until somebody wants to know.
    void noteOperation() {
        if (!std::exchange(stale, false))
            return;
        const ProjObject used(proj_trans_get_last_used_operation(operation.get()));
        if (!used)
            return;
        const PJ_PROJ_INFO info = proj_pj_info(used.get());
        name = info.description == nullptr ? std::string() : info.description;
        accuracy = info.accuracy;
    }
    [[nodiscard]] tl::unexpected<Error> refusal(const glm::dvec3& point) const {
        return fail(ErrorCode::Refused,
                    "the point " + std::to_string(point.x) + ", " + std::to_string(point.y) +
                        " cannot be transformed from " + from + " to " + to,
                    {}, "Check the coordinate reference system and the order of the axes.");
    }
};

namespace {

std::string shortName(const Crs& crs) {
    return crs.horizontal().size() <= 40 ? crs.horizontal() : crs.name();
}

bool isFinite(const glm::dvec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y);
}

/// The westernmost, easternmost, southernmost and northernmost of the points, each once.
std::vector<std::size_t> extremes(const std::vector<glm::dvec3>& points) {
    std::vector<std::size_t> at(4, 0);
    for (std::size_t i = 1; i < points.size(); ++i) {
        if (points[i].x < points[at[0]].x)
            at[0] = i;
        if (points[i].x > points[at[1]].x)
            at[1] = i;
        if (points[i].y < points[at[2]].y)
            at[2] = i;
        if (points[i].y > points[at[3]].y)
            at[3] = i;
    }
    std::sort(at.begin(), at.end());
    at.erase(std::unique(at.begin(), at.end()), at.end());
    return at;
}

}  // namespace

CrsTransform::CrsTransform(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
CrsTransform::CrsTransform(CrsTransform&&) noexcept = default;
CrsTransform& CrsTransform::operator=(CrsTransform&&) noexcept = default;
CrsTransform::~CrsTransform() = default;

Result<CrsTransform> CrsTransform::create(const Crs& from, const Crs& to) {
    auto impl = std::make_unique<Impl>();
    impl->from = shortName(from);
    impl->to = shortName(to);
    impl->tolerance = from.isGeographic() ? 1e-4 : 10.0 / from.metresPerUnit();
    if (from.horizontal() == to.horizontal())
        return CrsTransform(std::move(impl));
    if (to.isGeocentric())
        return fail(ErrorCode::Refused, "geocentric coordinates are no plan coordinates", impl->to,
                    "Choose a projected system in metres.");

    PJ_CONTEXT* const context = impl->context.get();
    const ProjObject source(proj_create(context, from.horizontal().c_str()));
    ProjObject target(proj_create(context, to.horizontal().c_str()));
    impl->usesHeight = from.isGeocentric();
    if (impl->usesHeight && target)
        target.reset(proj_crs_promote_to_3D(context, nullptr, target.get()));
    const char* const options[] = {"ALLOW_BALLPARK=NO", nullptr};
    const ProjObject raw(
        source && target
            ? proj_create_crs_to_crs_from_pj(context, source.get(), target.get(), nullptr, options)
            : nullptr);
    if (raw)
        impl->operation.reset(proj_normalize_for_visualization(context, raw.get()));
    if (!impl->operation)
        return fail(ErrorCode::Refused,
                    "no exact transformation is known from " + impl->from + " to " + impl->to, {},
                    "A guess could be wrong by hundreds of metres. Choose a target on the same "
                    "datum, or install PROJ's grids.");
    // Until a point was transformed the operation may be a set of candidates: probe the middle.
    if (const auto& area = from.impl().area) {
        glm::dvec3 middle(0.5 * (area->min + area->max), 0.0);
        impl->transform(&middle, 1, PJ_FWD);
    }
    return CrsTransform(std::move(impl));
}

Result<void> CrsTransform::apply(std::vector<glm::dvec3>& points) const {
    if (points.empty())
        return {};
    const auto broken = std::find_if_not(points.begin(), points.end(), isFinite);
    if (broken != points.end())
        return m_impl->refusal(*broken);
    if (!m_impl->operation)
        return {};

    std::vector<glm::dvec3> images = points;
    m_impl->transform(images.data(), images.size(), PJ_FWD);
    const auto lost = std::find_if_not(images.begin(), images.end(), isFinite);
    if (lost != images.end())
        return m_impl->refusal(points[std::size_t(lost - images.begin())]);

    // Outside of its area a projection may give numbers that mean nothing; there, the way back
    // leads elsewhere. The tolerance leaves room for another candidate operation on that way.
    for (const std::size_t k : extremes(points)) {
        glm::dvec3 back = images[k];
        m_impl->transform(&back, 1, PJ_INV);
        const double error = glm::length(glm::dvec2(back) - glm::dvec2(points[k]));
        if (!(error <= m_impl->tolerance))
            return m_impl->refusal(points[k]);
    }
    m_impl->transform(&points.front(), 1, PJ_FWD);  // so that the last one used is of this way
    points.swap(images);
    return {};
}

Result<glm::dvec3> CrsTransform::apply(const glm::dvec3& point) const {
    std::vector<glm::dvec3> one{point};
    if (auto done = apply(one); !done)
        return tl::unexpected(done.error());
    return one.front();
}

const std::string& CrsTransform::operationName() const {
    m_impl->noteOperation();
    return m_impl->name;
}
double CrsTransform::accuracy() const {
    m_impl->noteOperation();
    return m_impl->accuracy;
}

}  // namespace reflet
