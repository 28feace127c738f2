// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/VectorWriter.h"

#include "core/base/Files.h"
#include "core/geo/Crs.h"
#include "core/io/GdalFrame.h"
#include "core/io/GdalSession.h"

#include <ogrsf_frmts.h>

#include <algorithm>
#include <optional>
#include <span>

namespace reflet {

namespace {

using System = std::optional<OGRSpatialReference>;

OGRFieldType typeOf(VectorColumn::Kind kind) {
    switch (kind) {
        case VectorColumn::Kind::Real:
            return OFTReal;
        case VectorColumn::Kind::Integer:
            return OFTInteger64;
        case VectorColumn::Kind::Yes:
            return OFTInteger;
        case VectorColumn::Kind::Text:
            break;
    }
    return OFTString;
}

bool addColumn(OGRLayer& layer, const VectorColumn& column) {
    OGRFieldDefn field(column.name.c_str(), typeOf(column.kind));
    if (column.kind == VectorColumn::Kind::Yes)
        field.SetSubType(OFSTBoolean);
    return layer.CreateField(&field) == OGRERR_NONE;
}

void setValue(OGRFeature& feature, int field, const VectorValue& value) {
    if (const auto* text = std::get_if<std::string>(&value))
        feature.SetField(field, text->c_str());
    else if (const auto* real = std::get_if<double>(&value))
        feature.SetField(field, *real);
    else if (const auto* integer = std::get_if<std::int64_t>(&value))
        feature.SetField(field, GIntBig(*integer));
    else if (const auto* yes = std::get_if<bool>(&value))
        feature.SetField(field, *yes ? 1 : 0);
}

void setGeometry(OGRFeature& feature, WrittenLayer::Kind kind, std::span<const glm::dvec3> points) {
    if (kind == WrittenLayer::Kind::Points) {
        const OGRPoint point(points[0].x, points[0].y, points[0].z);
        feature.SetGeometry(&point);
        return;
    }
    OGRLineString line;
    for (const glm::dvec3& p : points)
        line.addPoint(p.x, p.y, p.z);
    feature.SetGeometry(&line);
}

/// Adds the shapes of a layer; `tag`: the field that holds its name, or none.
bool addShapes(OGRLayer& target, const WrittenLayer& layer, int tag) {
    std::vector<int> fields;
    for (const VectorColumn& column : layer.columns)
        fields.push_back(target.GetLayerDefn()->GetFieldIndex(column.name.c_str()));
    for (const VectorShape& shape : layer.shapes) {
        if (shape.points.empty())
            continue;
        OGRFeature feature(target.GetLayerDefn());
        if (tag >= 0)
            feature.SetField(tag, layer.name.c_str());
        for (std::size_t k = 0; k < std::min(fields.size(), shape.values.size()); ++k)
            setValue(feature, fields[k], shape.values[k]);
        setGeometry(feature, layer.kind, shape.points);
        if (target.CreateFeature(&feature) != OGRERR_NONE)
            return false;
    }
    return true;
}

bool writeGeoPackage(GDALDataset& dataset, const std::vector<WrittenLayer>& layers,
                     const System& system) {
    OGRSpatialReference copy;
    if (system)
        copy = *system;
    else
        copy.SetLocalCS("Undefined Cartesian SRS");  // as GeoPackage calls local metres
    if (dataset.StartTransaction() != OGRERR_NONE)
        return false;
    for (const WrittenLayer& layer : layers) {
        const OGRwkbGeometryType type =
            layer.kind == WrittenLayer::Kind::Points ? wkbPoint25D : wkbLineString25D;
        OGRLayer* const target = dataset.CreateLayer(layer.name.c_str(), &copy, type);
        if (target == nullptr)
            return false;
        for (const VectorColumn& column : layer.columns)
            if (!addColumn(*target, column))
                return false;
        if (!addShapes(*target, layer, -1))
            return false;
    }
    return dataset.CommitTransaction() == OGRERR_NONE;
}

bool writeGeoJson(GDALDataset& dataset, const std::vector<WrittenLayer>& layers,
                  const System& system) {
    OGRSpatialReference copy;
    if (system)
        copy = *system;
    const char* const options[] = {"COORDINATE_PRECISION=9", nullptr};
    OGRLayer* const target = dataset.CreateLayer("reflet", system ? &copy : nullptr, wkbUnknown,
                                                 const_cast<char**>(options));
    if (target == nullptr || !addColumn(*target, {"layer", VectorColumn::Kind::Text}))
        return false;
    for (const WrittenLayer& layer : layers)
        for (const VectorColumn& column : layer.columns)
            if (target->GetLayerDefn()->GetFieldIndex(column.name.c_str()) < 0 &&
                !addColumn(*target, column))
                return false;
    const int tag = target->GetLayerDefn()->GetFieldIndex("layer");
    return std::all_of(layers.begin(), layers.end(),
                       [&](const WrittenLayer& layer) { return addShapes(*target, layer, tag); });
}

Result<void> write(const std::vector<WrittenLayer>& layers, const System& system, bool geoJson,
                   const std::filesystem::path& temporary, const std::filesystem::path& path) {
    const GdalSession session;
    const auto failed = [&] {
        return fail(ErrorCode::WriteFailed, "GDAL could not write it: " + session.message(),
                    path.string(), "Check the free space and the permissions of the folder.");
    };
    GDALDriver* const driver =
        GetGDALDriverManager()->GetDriverByName(geoJson ? "GeoJSON" : "GPKG");
    if (driver == nullptr)
        return fail(ErrorCode::Internal, "GDAL has no driver for it", path.string(),
                    "Install libgdal32 of Debian.");
    GdalDataset dataset(driver->Create(temporary.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    if (!dataset)
        return failed();
    const bool done = geoJson ? writeGeoJson(*dataset, layers, system)
                              : writeGeoPackage(*dataset, layers, system);
    dataset.reset();  // the file is complete only now
    if (!done || session.failed())
        return failed();
    return {};
}

/// By PROJ, never by a ballpark transformation as GDAL would.
Result<std::vector<WrittenLayer>> inDegrees(std::vector<WrittenLayer> layers,
                                            const ProjectFrame& frame) {
    const auto from = Crs::parse(*frame.crs);
    const auto to = Crs::parse("EPSG:4326");
    if (!from || !to)
        return tl::unexpected(from ? to.error() : from.error());
    const auto transform = CrsTransform::create(*from, *to);
    if (!transform)
        return tl::unexpected(transform.error());
    std::vector<glm::dvec3> all;
    for (const WrittenLayer& layer : layers)
        for (const VectorShape& shape : layer.shapes)
            all.insert(all.end(), shape.points.begin(), shape.points.end());
    if (auto done = transform->apply(all); !done)
        return tl::unexpected(done.error());
    auto next = all.begin();
    for (WrittenLayer& layer : layers)
        for (VectorShape& shape : layer.shapes)
            for (glm::dvec3& point : shape.points)
                point = *next++;
    return layers;
}

}  // namespace

Result<void> writeVector(const std::vector<WrittenLayer>& layers, const ProjectFrame& frame,
                         const std::filesystem::path& path) {
    const bool geoJson = path.extension() == ".geojson";
    if (!geoJson && path.extension() != ".gpkg")
        return fail(ErrorCode::Usage, "is in no form that layers are written in", path.string(),
                    "End it in .geojson or .gpkg.");
    ProjectFrame written = frame;
    std::vector<WrittenLayer> turned;
    if (geoJson && frame.crs) {
        auto degrees = inDegrees(layers, frame);
        if (!degrees)
            return tl::unexpected(degrees.error().in("while writing " + path.string()));
        turned = std::move(*degrees);
        written.crs = "EPSG:4326";
    }
    const auto system = gdal::horizontalReference(written);
    if (!system)
        return tl::unexpected(system.error());
    return writeAtomically(path, [&](const std::filesystem::path& temporary) {
        return write(turned.empty() ? layers : turned, *system, geoJson, temporary, path);
    });
}

}  // namespace reflet
