// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geo/Crs.h"

#include "core/geo/CrsImpl.h"
#include "core/geo/CrsSpelling.h"
#include "core/geo/ProjHandles.h"

#include <cmath>
#include <utility>

namespace reflet {

namespace {

std::optional<std::string> code(const PJ* object) {
    const char* authority = proj_get_id_auth_name(object, 0);
    const char* number = proj_get_id_code(object, 0);
    if (authority == nullptr || number == nullptr)
        return std::nullopt;
    return std::string(authority) + ":" + number;
}

std::string wktOf(PJ_CONTEXT* context, const PJ* object) {
    const char* const options[] = {"MULTILINE=NO", nullptr};
    const char* text = proj_as_wkt(context, object, PJ_WKT2_2019, options);
    return text == nullptr ? std::string() : std::string(text);
}

/// The code of a CRS that carries none but is the same as one of EPSG's (Esri's .prj files).
/// PROJ's confidence of 90 means: equivalent, and the name is a known alias.
std::optional<std::string> identified(PJ_CONTEXT* context, const PJ* object) {
    int* confidence = nullptr;
    PJ_OBJ_LIST* list = proj_identify(context, object, "EPSG", nullptr, &confidence);
    std::optional<std::string> found;
    if (list != nullptr && proj_list_get_count(list) > 0 && confidence[0] >= 90) {
        const ProjObject match(proj_list_get(context, list, 0));
        found = code(match.get());
    }
    proj_int_list_destroy(confidence);
    proj_list_destroy(list);
    return found;
}

/// The parts of a CRS as PROJ objects of one context.
struct Parts {
    ProjObject horizontal;
    ProjObject vertical;
};

bool isVertical(const PJ* object) {
    return proj_get_type(object) == PJ_TYPE_VERTICAL_CRS;
}

/// WKT 1 hides a datum shift in the CRS (TOWGS84): what is bound is the CRS that is meant.
ProjObject withoutBinding(PJ_CONTEXT* context, ProjObject object) {
    if (object && proj_get_type(object.get()) == PJ_TYPE_BOUND_CRS) {
        ProjObject base(proj_get_source_crs(context, object.get()));
        if (base && (code(base.get()) || isVertical(base.get())))
            return base;
    }
    return object;
}

Parts split(PJ_CONTEXT* context, ProjObject crs) {
    Parts parts;
    if (proj_get_type(crs.get()) == PJ_TYPE_COMPOUND_CRS) {
        parts.vertical =
            withoutBinding(context, ProjObject(proj_crs_get_sub_crs(context, crs.get(), 1)));
        crs.reset(proj_crs_get_sub_crs(context, crs.get(), 0));
    }
    parts.horizontal = withoutBinding(context, std::move(crs));
    return parts;
}

/// The CRS below a binding that could not be dropped; its kind, axes and area are the whole's.
ProjObject unbound(PJ_CONTEXT* context, const PJ* object) {
    if (proj_get_type(object) == PJ_TYPE_BOUND_CRS)
        return ProjObject(proj_get_source_crs(context, object));
    return ProjObject(proj_clone(context, object));
}

std::optional<Crs::Impl::Kind> kindOf(const PJ* crs) {
    switch (proj_get_type(crs)) {
        case PJ_TYPE_GEOGRAPHIC_2D_CRS:
        case PJ_TYPE_GEOGRAPHIC_3D_CRS:
            return Crs::Impl::Kind::Geographic;
        case PJ_TYPE_GEOCENTRIC_CRS:
            return Crs::Impl::Kind::Geocentric;
        case PJ_TYPE_PROJECTED_CRS:
            return Crs::Impl::Kind::Projected;
        default:
            return std::nullopt;
    }
}

/// SI units (metres or radians) per unit of the first axis; 1 if PROJ does not tell.
double axisUnit(PJ_CONTEXT* context, const PJ* crs) {
    const ProjObject axes(proj_crs_get_coordinate_system(context, crs));
    double factor = 1.0;
    if (axes)
        proj_cs_get_axis_info(context, axes.get(), 0, nullptr, nullptr, nullptr, &factor, nullptr,
                              nullptr, nullptr);
    return factor > 0.0 ? factor : 1.0;
}

/// Longitude of the prime meridian, east of Greenwich in radians.
double primeMeridian(PJ_CONTEXT* context, const PJ* geodetic) {
    const ProjObject meridian(proj_get_prime_meridian(context, geodetic));
    double longitude = 0.0;
    double unit = 0.0;
    if (meridian)
        proj_prime_meridian_get_parameters(context, meridian.get(), &longitude, &unit, nullptr);
    return longitude * unit;
}

/// The area of use, published in degrees east of Greenwich, in the CRS's own axes: transformed by
/// the projection alone, as a datum's shift is nothing beside a tenth of the area.
std::optional<Crs::Impl::Area> ownArea(PJ_CONTEXT* context, const PJ* crs, Crs::Impl::Kind kind) {
    double west = 0.0;
    double south = 0.0;
    double east = 0.0;
    double north = 0.0;
    if (kind == Crs::Impl::Kind::Geocentric ||
        proj_get_area_of_use(context, crs, &west, &south, &east, &north, nullptr) == 0 ||
        west < -360.0)  // PROJ's way to say unknown is -1000
        return std::nullopt;
    const ProjObject geodetic(proj_crs_get_geodetic_crs(context, crs));
    if (!geodetic)
        return std::nullopt;
    if (east < west)
        east += 360.0;
    const double unit = axisUnit(context, geodetic.get());
    const double shift = primeMeridian(context, geodetic.get());
    constexpr double kDegree = kPi / 180.0;
    Crs::Impl::Area area{{(west * kDegree - shift) / unit, south * kDegree / unit},
                         {(east * kDegree - shift) / unit, north * kDegree / unit}};
    if (kind == Crs::Impl::Kind::Geographic)
        return area;

    const ProjObject raw(
        proj_create_crs_to_crs_from_pj(context, geodetic.get(), crs, nullptr, nullptr));
    const ProjObject projection(raw ? proj_normalize_for_visualization(context, raw.get())
                                    : nullptr);
    Crs::Impl::Area own{};
    if (!projection ||
        proj_trans_bounds(context, projection.get(), PJ_FWD, area.min.x, area.min.y, area.max.x,
                          area.max.y, &own.min.x, &own.min.y, &own.max.x, &own.max.y, 21) == 0 ||
        !std::isfinite(own.min.x + own.min.y + own.max.x + own.max.y))
        return std::nullopt;
    return own;
}

tl::unexpected<Error> refused(std::string what, std::string_view text, std::string remedy) {
    return fail(ErrorCode::Refused, std::move(what), std::string(text.substr(0, 80)),
                std::move(remedy));
}

std::string definitionOf(PJ_CONTEXT* context, const PJ* horizontal) {
    if (auto known = code(horizontal)) {
        // These differ in the order of the axes alone, and that is always (east, north) here.
        const bool lonLat = *known == "OGC:CRS84" || *known == "OGC:CRS84h";
        return lonLat ? std::string("EPSG:4326") : *known;
    }
    if (auto found = identified(context, horizontal))
        return *found;
    return wktOf(context, horizontal);
}

/// Geographic and projected CRSs with an ellipsoidal height become their two-dimensional selves.
ProjObject flat(PJ_CONTEXT* context, ProjObject crs, Crs::Impl::Kind kind) {
    if (kind == Crs::Impl::Kind::Geocentric)
        return crs;
    const ProjObject axes(proj_crs_get_coordinate_system(context, crs.get()));
    if (!axes || proj_cs_get_axis_count(context, axes.get()) < 3)
        return crs;
    ProjObject demoted(proj_crs_demote_to_2D(context, nullptr, crs.get()));
    return demoted ? std::move(demoted) : std::move(crs);
}

/// WKT gives a compound its code, but not the parts: the registry's own object knows theirs.
ProjObject fromRegistry(PJ_CONTEXT* context, ProjObject crs) {
    const auto known = code(crs.get());
    if (!known)
        return crs;
    ProjObject own(proj_create(context, known->c_str()));
    const bool same =
        own && proj_is_equivalent_to_with_ctx(context, crs.get(), own.get(),
                                              PJ_COMP_EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS) != 0;
    return same ? std::move(own) : std::move(crs);
}

}  // namespace

Result<Crs> Crs::parse(std::string_view text) {
    const auto spelling = projSpelling(text);
    if (!spelling)
        return tl::unexpected(spelling.error());
    const ProjContext& proj = threadProjContext();
    PJ_CONTEXT* const context = proj.get();
    ProjObject crs(proj_create(context, spelling->c_str()));
    if (!crs || proj_is_crs(crs.get()) == 0)
        return refused("no such coordinate reference system (" + proj.takeMessage() + ")", text,
                       "Look the code up at epsg.org and write it as EPSG:n.");
    if (isVertical(crs.get()))
        return refused("a height system alone gives no position", text,
                       "Write both parts, for example EPSG:25832+7837.");

    crs = fromRegistry(context, std::move(crs));
    auto impl = std::make_shared<Impl>();
    impl->name = proj_get_name(crs.get());
    impl->wkt = wktOf(context, crs.get());
    Parts parts = split(context, std::move(crs));
    const ProjObject base = parts.horizontal ? unbound(context, parts.horizontal.get()) : nullptr;
    const auto kind = base ? kindOf(base.get()) : std::nullopt;
    if (!kind)
        return refused("it is tied to no place on the Earth", text,
                       "Give a geographic or projected system, or \"local\" for local metres.");
    impl->kind = *kind;
    parts.horizontal = flat(context, std::move(parts.horizontal), *kind);
    impl->definition = definitionOf(context, parts.horizontal.get());
    if (parts.vertical) {
        impl->vertical = code(parts.vertical.get());
        if (!impl->vertical)
            impl->vertical = identified(context, parts.vertical.get());
    }
    impl->metresPerUnit = *kind == Impl::Kind::Geographic ? 0.0 : axisUnit(context, base.get());
    impl->area = ownArea(context, base.get(), *kind);
    return Crs(std::move(impl));
}

const std::string& Crs::horizontal() const {
    return m_impl->definition;
}
const std::optional<std::string>& Crs::vertical() const {
    return m_impl->vertical;
}
const std::string& Crs::name() const {
    return m_impl->name;
}
bool Crs::isGeographic() const {
    return m_impl->kind == Impl::Kind::Geographic;
}
bool Crs::isGeocentric() const {
    return m_impl->kind == Impl::Kind::Geocentric;
}
bool Crs::isProjected() const {
    return m_impl->kind == Impl::Kind::Projected;
}
double Crs::metresPerUnit() const {
    return m_impl->metresPerUnit;
}
std::string Crs::wkt() const {
    return m_impl->wkt;
}

bool Crs::areaContains(double east, double north) const {
    if (!m_impl->area)
        return true;
    const Impl::Area& area = *m_impl->area;
    const glm::dvec2 margin = 0.1 * (area.max - area.min);
    const glm::dvec2 min = area.min - margin;
    const glm::dvec2 max = area.max + margin;
    const auto inside = [&](double e) {
        return e >= min.x && e <= max.x && north >= min.y && north <= max.y;
    };
    // An area across the antimeridian runs beyond 180 degrees; longitudes do not.
    return inside(east) || (isGeographic() && inside(east + 360.0));
}

ProjStatus projStatus() {
    const ProjContext context;
    ProjStatus status;
    status.version = proj_info().release;
    const ProjObject probe(proj_create(context.get(), "EPSG:4326"));
    status.databaseOpens = probe != nullptr;
    if (const char* path = proj_context_get_database_path(context.get()))
        status.databasePath = path;
    return status;
}

}  // namespace reflet
