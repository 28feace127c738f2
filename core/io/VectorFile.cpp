// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/VectorFile.h"

#include "core/io/GdalSession.h"
#include "core/io/GdalVector.h"

#include <atomic>
#include <cmath>
#include <cpl_vsi.h>
#include <exception>
#include <utility>

namespace reflet {

namespace {

constexpr const char* kDrivers[] = {"GeoJSON",    "GeoJSONSeq", "GPKG", "ESRI Shapefile",
                                    "FlatGeobuf", "CSV",        nullptr};
constexpr int kDeepest = 16;

/// A table without geometry is none of ours, but GeoJSON calls a layer so whose geometries are all
/// unreadable.
bool mayHaveAreas(OGRwkbGeometryType type, bool geoJson) {
    type = wkbFlatten(type);
    return (type != wkbNone || geoJson) && type != wkbPoint && type != wkbMultiPoint &&
           OGR_GT_IsSubClassOf(type, wkbCurve) == 0 &&
           OGR_GT_IsSubClassOf(type, wkbMultiCurve) == 0;
}

bool hasPoints(OGRwkbGeometryType type) {
    type = wkbFlatten(type);
    return type == wkbPoint || type == wkbMultiPoint || type == wkbNone;
}

PlanPolygon planOf(const OGRPolygon& source, bool northFirst, AreaFeature& feature) {
    PlanPolygon polygon;
    for (const OGRLinearRing* line : source) {
        auto& ring = polygon.rings.emplace_back();
        const int count = line->getNumPoints();
        ring.reserve(std::size_t(count));
        feature.points += std::size_t(count);
        feature.unclosed = feature.unclosed || line->get_IsClosed() == 0;
        for (int i = 0; i < count; ++i) {
            const glm::dvec2 p(line->getX(i), line->getY(i));
            ring.push_back(northFirst ? glm::dvec2(p.y, p.x) : p);
        }
    }
    return polygon;
}

void collectAreas(const OGRGeometry& geometry, bool northFirst, AreaFeature& feature, int depth) {
    if (depth > kDeepest)
        return;
    if (geometry.hasCurveGeometry() != 0) {
        const std::unique_ptr<OGRGeometry> linear(geometry.getLinearGeometry());
        if (linear)
            collectAreas(*linear, northFirst, feature, depth + 1);
        return;
    }
    const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
    if (type == wkbPolygon || type == wkbTriangle) {
        feature.polygons.push_back(planOf(*geometry.toPolygon(), northFirst, feature));
    } else if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection) != 0) {
        for (const OGRGeometry* part : *geometry.toGeometryCollection())
            collectAreas(*part, northFirst, feature, depth + 1);
    } else if (OGR_GT_IsSubClassOf(type, wkbPolyhedralSurface) != 0) {
        for (const OGRPolygon* part : *geometry.toPolyhedralSurface())
            collectAreas(*part, northFirst, feature, depth + 1);
    }
}

std::vector<std::string> valuesOf(const OGRFeature& feature, std::span<const std::size_t> fields) {
    std::vector<std::string> values;
    values.reserve(fields.size());
    for (const std::size_t field : fields) {
        const int index = int(field);
        const bool known = feature.IsFieldSetAndNotNull(index) != 0;
        values.emplace_back(known ? feature.GetFieldAsString(index) : "");
    }
    return values;
}

AreaFeature areasOf(const OGRFeature& source, bool northFirst,
                    std::span<const std::size_t> fields) {
    AreaFeature feature;
    feature.number = source.GetFID();
    feature.values = valuesOf(source, fields);
    const OGRGeometry* const geometry = source.GetGeometryRef();
    if (geometry == nullptr || geometry->IsEmpty() != 0) {
        feature.kind = AreaFeature::Kind::NoGeometry;
        return feature;
    }
    collectAreas(*geometry, northFirst, feature, 0);
    if (feature.polygons.empty())
        feature.kind = AreaFeature::Kind::NotAnArea;
    return feature;
}

void addPlace(const OGRPoint& point, bool northFirst, PointFeature& feature) {
    if (point.IsEmpty() != 0)
        return;
    const double height = point.Is3D() != 0 ? point.getZ() : std::nan("");
    feature.places.emplace_back(northFirst ? glm::dvec3(point.getY(), point.getX(), height)
                                           : glm::dvec3(point.getX(), point.getY(), height));
}

PointFeature pointsOf(const OGRFeature& source, bool northFirst,
                      std::span<const std::size_t> fields) {
    PointFeature feature;
    feature.number = source.GetFID();
    feature.values = valuesOf(source, fields);
    const OGRGeometry* const geometry = source.GetGeometryRef();
    if (geometry == nullptr)
        return feature;
    const OGRwkbGeometryType type = wkbFlatten(geometry->getGeometryType());
    if (type == wkbPoint) {
        addPlace(*geometry->toPoint(), northFirst, feature);
    } else if (type == wkbMultiPoint) {
        for (const OGRPoint* point : *geometry->toMultiPoint())
            addPlace(*point, northFirst, feature);
    }
    return feature;
}

/// A file of GDAL's in memory, for as long as it is read. Every name is used once.
class MemoryFile {
public:
    MemoryFile(std::string_view bytes, const std::string& name)
        : m_bytes(bytes), m_folder("/vsimem/reflet-" + std::to_string(++s_last)) {
        m_path = m_folder + "/" + name;
        VSIFCloseL(VSIFileFromMemBuffer(m_path.c_str(), reinterpret_cast<GByte*>(m_bytes.data()),
                                        m_bytes.size(), FALSE));
    }
    ~MemoryFile() {
        if (!m_folder.empty())
            VSIRmdirRecursive(m_folder.c_str());
    }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    [[nodiscard]] const std::string& path() const { return m_path; }

private:
    static inline std::atomic<unsigned> s_last = 0;
    std::string m_bytes;
    std::string m_folder;
    std::string m_path;
};

}  // namespace

struct VectorFile::Impl {
    std::string subject;
    std::unique_ptr<MemoryFile> memory;
    GdalDataset dataset;
    std::string format;
    std::vector<VectorLayer> layers;

    template <class Make, class Take>
    Result<std::string> read(std::size_t layer, const Make& make, const Take& sink);

    void describe() {
        format = dataset->GetDriverName();
        for (OGRLayer* source : dataset->GetLayers()) {
            VectorLayer layer;
            layer.name = source->GetName();
            const OGRFeatureDefn& definition = *source->GetLayerDefn();
            for (int f = 0; f < definition.GetFieldCount(); ++f)
                layer.fields.emplace_back(definition.GetFieldDefn(f)->GetNameRef());
            const bool table = format == "CSV";  // whatever its columns hold
            layer.points = table || hasPoints(source->GetGeomType());
            layer.mayHaveAreas =
                !table && mayHaveAreas(source->GetGeomType(), gdal::isGeoJson(*dataset));
            const OGRSpatialReference* const system = source->GetSpatialRef();
            if (system != nullptr && system->IsLocal() == 0) {  // else metres from nowhere
                layer.crs = gdal::wktOf(*system);
                layer.assumedCrs = gdal::isGeoJson(*dataset) && system->IsGeographic() != 0;
            }
            layers.push_back(std::move(layer));
        }
    }
};

VectorFile::VectorFile(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
VectorFile::VectorFile(VectorFile&&) noexcept = default;
VectorFile& VectorFile::operator=(VectorFile&&) noexcept = default;
VectorFile::~VectorFile() = default;

Result<VectorFile> VectorFile::open(const std::filesystem::path& path) {
    try {
        const GdalSession session;
        auto dataset = gdal::openVector(path, kDrivers, session);
        if (!dataset)
            return tl::unexpected(dataset.error());
        auto impl = std::make_unique<Impl>();
        impl->subject = path.string();
        impl->dataset = *std::move(dataset);
        impl->describe();
        return VectorFile(std::move(impl));
    } catch (const std::exception& error) {
        return fail(ErrorCode::Unreadable, std::string("GDAL gave up: ") + error.what(),
                    path.string(), "Write it anew, e.g. with QGIS.");
    }
}

Result<VectorFile> VectorFile::open(std::string_view bytes, const std::string& name) {
    try {
        const GdalSession session;
        auto impl = std::make_unique<Impl>();
        impl->subject = name;
        impl->memory = std::make_unique<MemoryFile>(bytes, name);
        impl->dataset.reset(
            GDALDataset::Open(impl->memory->path().c_str(), GDAL_OF_VECTOR, kDrivers));
        if (!impl->dataset)
            return fail(ErrorCode::Unreadable, gdal::whyNot(session), name,
                        "GeoJSON, GeoPackage and shapefile work best.");
        impl->describe();
        return VectorFile(std::move(impl));
    } catch (const std::exception& error) {
        return fail(ErrorCode::Unreadable, std::string("GDAL gave up: ") + error.what(), name,
                    "Write it anew, e.g. with QGIS.");
    }
}

const std::string& VectorFile::format() const {
    return m_impl->format;
}

const std::vector<VectorLayer>& VectorFile::layers() const {
    return m_impl->layers;
}

template <class Make, class Take>
Result<std::string> VectorFile::Impl::read(std::size_t layer, const Make& make, const Take& sink) {
    try {
        const GdalSession session;
        OGRLayer* const source = dataset->GetLayer(int(layer));
        if (source == nullptr)
            return fail(ErrorCode::Internal, "it has no such layer", subject);
        const OGRSpatialReference* const system = source->GetSpatialRef();
        const bool northFirst = system != nullptr && gdal::northFirst(*system);
        source->ResetReading();
        while (const OGRFeatureUniquePtr feature{source->GetNextFeature()}) {
            if (!sink(make(*feature, northFirst)))
                break;
        }
        return session.failed() ? session.message() : std::string();
    } catch (const std::exception& error) {
        return fail(ErrorCode::Unreadable, std::string("GDAL gave up: ") + error.what(), subject,
                    "Write it anew, e.g. with QGIS.");
    }
}

Result<std::string> VectorFile::readAreas(std::size_t layer, std::span<const std::size_t> fields,
                                          const Sink& sink) {
    return m_impl->read(
        layer,
        [&](const OGRFeature& feature, bool northFirst) {
            return areasOf(feature, northFirst, fields);
        },
        sink);
}

Result<std::string> VectorFile::readPoints(std::size_t layer, std::span<const std::size_t> fields,
                                           const PointSink& sink) {
    return m_impl->read(
        layer,
        [&](const OGRFeature& feature, bool northFirst) {
            return pointsOf(feature, northFirst, fields);
        },
        sink);
}

}  // namespace reflet
