// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/tiles/TilesImporter.h"

#include "core/base/Files.h"
#include "core/geo/Crs.h"
#include "importers/common/CityBuilder.h"
#include "importers/common/Geocentric.h"
#include "importers/common/NamedTypes.h"
#include "importers/common/PhotoMesh.h"
#include "importers/common/UpAxis.h"
#include "importers/tiles/TileChoice.h"
#include "importers/tiles/TileContent.h"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace reflet {

namespace fs = std::filesystem;

namespace {

using namespace importers;
using namespace tiles;

constexpr std::size_t kMostTriangles = 100'000'000;
constexpr std::size_t kMostNamed = 20;  // tiles that are told one by one
constexpr const char* kGeographic = "EPSG:4326";

/// Geocentric points as longitude and latitude in degrees and the height above the ellipsoid.
Result<CrsTransform> geographicFromGeocentric() {
    const auto geocentric = Crs::parse("EPSG:4978");
    const auto geographic = Crs::parse(kGeographic);
    if (!geocentric)
        return tl::unexpected(geocentric.error());
    if (!geographic)
        return tl::unexpected(geographic.error());
    return CrsTransform::create(*geocentric, *geographic);
}

bool isFinite(const glm::dvec3& p) {
    return std::isfinite(p.x + p.y + p.z);
}

/// The objects of a mesh: its features, or else its nodes.
class MeshObjects {
public:
    /// `skin`: it is a photo of all that there is, not of buildings.
    MeshObjects(const TilePart& part, const TileUse& tile, bool instance, bool skin)
        : m_part(part), m_tile(tile), m_instance(instance), m_skin(skin) {}

    /// The object of each triangle, in the order of the mesh; objects are added to `city`.
    std::vector<std::uint32_t> list(SourceCity& city, std::size_t number) {
        std::vector<std::uint32_t> owners(m_part.mesh.triangles.size());
        for (const auto& node : m_part.mesh.parts) {
            for (std::uint32_t i = 0; i < node.triangleCount; ++i) {
                const std::uint32_t t = node.firstTriangle + i;
                owners[t] = objectOf(m_part.mesh.triangles[t], node.name, city, number);
            }
        }
        return owners;
    }

private:
    [[nodiscard]] std::string nameOf(std::uint32_t feature, const std::string& node) const {
        if (feature == gltf::CityMesh::kNoFeature)
            return node.empty() ? m_tile.name : fmt::format("{}/{}", m_tile.name, node);
        for (const auto* names : {&m_part.batchNames, &m_part.mesh.featureNames}) {
            if (feature < names->size() && !(*names)[feature].empty())
                return (*names)[feature];
        }
        return fmt::format("{}#{}", m_tile.name, feature);
    }

    [[nodiscard]] CityObjectType typeOf(const gltf::CityMesh::Triangle& triangle,
                                        const std::string& node) const {
        if (const auto named = typeByName(node))
            return *named;
        const auto& material = m_part.mesh.materials[triangle.material].name;
        const auto unless = m_instance ? CityObjectType::Generic
                            : m_skin   ? CityObjectType::TinRelief
                                       : CityObjectType::Building;
        return typeByName(material).value_or(typeByName(m_tile.name).value_or(unless));
    }

    std::uint32_t objectOf(const gltf::CityMesh::Triangle& triangle, const std::string& node,
                           SourceCity& city, std::size_t number) {
        const auto next = std::uint32_t(city.objects.size());
        const bool featured = triangle.feature != gltf::CityMesh::kNoFeature;
        const auto [known, isNew] =
            m_numbers.try_emplace({triangle.feature, featured ? std::string() : node}, next);
        if (!isNew)
            return known->second;
        ObjectOutline object;
        object.id = nameOf(triangle.feature, node);
        if (m_instance)
            object.id += fmt::format(" ({})", number + 1);
        object.type = typeOf(triangle, node);
        object.typeName = toString(object.type);
        object.firstGeometry = std::uint32_t(city.geometries.size());
        object.geometryCount = 1;
        city.geometries.push_back({GeometryType::MultiSurface, {}, 0, kNone});
        city.objects.push_back(std::move(object));
        return next;
    }

    const TilePart& m_part;
    const TileUse& m_tile;
    bool m_instance, m_skin;
    std::map<std::pair<std::uint32_t, std::string>, std::uint32_t> m_numbers;
};

class TilesImport {
public:
    TilesImport(const TileTree& tree, CityBuilder& builder, const fs::path& path)
        : m_tree(tree),
          m_builder(builder),
          m_path(path),
          m_alone(tree.tiles.size() == 1 && tree.tiles.front().file == path) {}

    Result<void> run(const JobContext& job) {
        const auto count = double(m_tree.tiles.size());
        for (std::size_t i = 0; i < m_tree.tiles.size(); ++i) {
            const TileUse& tile = m_tree.tiles[i];
            const JobContext phase = job.phase(tile.name, double(i) / count, double(i + 1) / count);
            auto added = addTile(tile, JobContext({}, job.stopToken()));
            phase.progress(1.0);
            if (added)
                continue;
            const ErrorCode code = added.error().code;
            const bool alone = m_tree.tiles.size() == 1;
            if (alone || m_fatal || (code != ErrorCode::Unreadable && code != ErrorCode::Refused))
                return added;
            noteBad(tile, added.error());
        }
        if (!m_placed && m_lastError)
            return tl::unexpected(*m_lastError);
        if (!m_placed)
            return nothing();
        tell();
        return {};
    }

private:
    /// The error of a tileset, or of a glTF file, without triangles.
    Result<void> nothing() {
        const bool tileset = m_tree.tiles.size() != 1 || m_tree.tiles.front().file != m_path;
        const auto& remarks = tileset ? m_tree.remarks : m_builder.fileDiagnostics();
        const std::string what =
            tileset ? "has no tile with triangles" : "holds no triangle that can be read";
        const std::string remedy =
            tileset ? "Choose a tileset of meshes." : "Export the model again, with its meshes.";
        if (remarks.empty())
            return fail(ErrorCode::Unreadable, what, m_path.string(), remedy);
        const Diagnostic& first = remarks.front();
        return fail(ErrorCode::Unreadable,
                    fmt::format("{}: {}{}{}", what, first.object, first.object.empty() ? "" : ": ",
                                first.text),
                    m_path.string(), first.remedy.empty() ? remedy : first.remedy);
    }

    void note(Severity severity, const char* code, std::string object, std::string text,
              std::string remedy = {}) {
        m_builder.fileDiagnostics().push_back(
            {severity, code, std::move(object), std::move(text), std::move(remedy)});
    }

    void noteBad(const TileUse& tile, const Error& error) {
        m_lastError = error;
        if (m_bad++ < kMostNamed)
            note(Severity::Error, "tile-unreadable", tile.name,
                 error.what + "; the tile was left out", error.remedy);
    }

    Result<void> addTile(const TileUse& tile, const JobContext& job) {
        constexpr ContentLimits kLimits;
        const auto bytes = readFile(tile.file, m_builder.options().maxFileBytes);
        if (!bytes)
            return tl::unexpected(bytes.error());
        auto parts = readTileContent(*bytes, tile.file, tile.zUp, kLimits, job);
        if (!parts)
            return tl::unexpected(parts.error());
        for (const TilePart& part : *parts) {
            for (std::size_t i = 0; i < part.tile_from_mesh.size(); ++i) {
                if (auto added = addPlace(part, tile, i, job); !added)
                    return added;
            }
            note(part);
        }
        return {};
    }

    void note(const TilePart& part) {
        m_outOfRange += part.mesh.outOfRange;
        for (const Diagnostic& remark : part.mesh.remarks) {
            if (m_remarks++ < kMostNamed)
                m_builder.fileDiagnostics().push_back(remark);
        }
    }

    /// One standing of a mesh as a piece of the city.
    Result<void> addPlace(const TilePart& part, const TileUse& tile, std::size_t number,
                          const JobContext& job) {
        if (part.mesh.triangles.empty())
            return {};
        m_triangles += part.mesh.triangles.size();
        if (m_triangles > kMostTriangles) {
            m_fatal = true;
            return fail(ErrorCode::ResourceLimit,
                        fmt::format("has more than {} triangles", kMostTriangles), m_path.string(),
                        "Import a part of it: one of the tilesets that it refers to.");
        }
        SourceCity city;
        city.format = "3D Tiles";
        city.lodNames = {""};
        city.materials = part.mesh.materials;
        for (const gltf::CityMesh::Texture& texture : part.mesh.textures)
            city.textures.push_back(textureOf(texture, part.file));
        for (const auto& corners : part.mesh.uv)
            city.textureVertices.insert(city.textureVertices.end(), corners.begin(), corners.end());
        auto vertices = placed(part, tile, number);
        if (!vertices)
            return tl::unexpected(vertices.error());
        city.vertices = *std::move(vertices);
        const bool isInstance = part.mesh.instanced || part.tile_from_mesh.size() > 1;
        const auto owners = MeshObjects(part, tile, isInstance,
                                        !isInstance && isPhotoMesh(part.mesh, city.vertices))
                                .list(city, number);
        if (auto done = place(city); !done) {
            m_fatal = true;
            return done;
        }
        CityPiece piece = m_builder.begin(std::move(city));
        const bool mirrored = glm::determinant(glm::dmat3(tile.world_from_tile) *
                                               glm::dmat3(part.tile_from_mesh[number])) < 0.0;
        fill(piece, part.mesh, owners, mirrored);
        auto added = m_builder.add(std::move(piece), job);
        m_fatal = m_fatal || !added;
        return added;
    }

    /// One skin with an image on it, which no features divide.
    [[nodiscard]] bool isPhotoMesh(const gltf::CityMesh& mesh,
                                   std::vector<glm::dvec3> vertices) const {
        std::vector<std::array<std::uint32_t, 3>> triangles;
        for (const gltf::CityMesh::Triangle& t : mesh.triangles) {
            if (t.feature != mesh.triangles.front().feature || mesh.textures.empty())
                return false;
            triangles.push_back(t.vertex);
        }
        if (*m_geocentric) {
            // From degrees to about metres.
            constexpr double kDegree = 111'320.0;
            for (glm::dvec3& p : vertices)
                p = {p.x * kDegree * std::cos(glm::radians(p.y)), p.y * kDegree, p.z};
        }
        return isSkinOverGround(vertices, triangles);
    }

    /// An image by its name relative to the folder of the tileset, or by its number in its file.
    [[nodiscard]] TextureEntry textureOf(const gltf::CityMesh::Texture& texture,
                                         const fs::path& file) const {
        const fs::path folder = m_path.has_parent_path() ? m_path.parent_path() : fs::path(".");
        const gltf::ImagePlace& image = texture.image;
        TextureEntry out;
        out.repeat = texture.repeat;
        out.alpha = texture.alpha;
        if (!image.uri.empty()) {
            const fs::path beside = file.parent_path().lexically_relative(folder);
            // What has a scheme or leads out of the folder stays as it is, to be told as that.
            const bool relative =
                image.uri.find(':') == std::string::npos && image.uri.front() != '/';
            out.image =
                relative ? (beside / image.uri).lexically_normal().generic_string() : image.uri;
            return out;
        }
        out.image = fmt::format("{} (image {})", file.lexically_relative(folder).generic_string(),
                                texture.number);
        out.embedded = EmbeddedImage{image.offset, image.length, image.bytes};
        if (!image.broken)
            out.path = image.file.string();
        return out;
    }

    /// The vertices in the CRS that the builder is told of.
    Result<std::vector<glm::dvec3>> placed(const TilePart& part, const TileUse& tile,
                                           std::size_t number) {
        const double unit = m_builder.options().unit.value_or(1.0);
        const glm::dmat4 world_from_mesh = tile.world_from_tile * part.tile_from_mesh[number];
        std::vector<glm::dvec3> points;
        points.reserve(part.mesh.vertices.size());
        for (const glm::dvec3& p : part.mesh.vertices)
            points.push_back(unit * glm::dvec3(world_from_mesh * glm::dvec4(p, 1.0)));
        // A tile's place is told by its tileset; a file alone may tell its own.
        if (m_alone && part.mesh.georeference) {
            const gltf::Georeference& said = *part.mesh.georeference;
            for (glm::dvec3& p : points)
                p = glm::dvec3(said.crs_from_file * glm::dvec4(p, 1.0));
            if (!said.crs.empty())
                m_declared = said.crs;
        }
        const auto first = std::find_if(points.begin(), points.end(), isFinite);
        const bool geocentric = first != points.end() && isGeocentric(*first);
        if (!m_geocentric)
            m_geocentric = geocentric;
        if (*m_geocentric != geocentric)
            return fail(ErrorCode::Refused, "lies elsewhere than the other tiles",
                        tile.file.string(), "Make the tileset anew.");
        if (!geocentric) {
            return points;
        }
        return geographic(std::move(points), tile);
    }

    Result<std::vector<glm::dvec3>> geographic(std::vector<glm::dvec3> points,
                                               const TileUse& tile) {
        if (!m_toGeographic) {
            auto operation = geographicFromGeocentric();
            if (!operation)
                return tl::unexpected(operation.error());
            m_toGeographic.emplace(*std::move(operation));
        }
        // What is no point, or lies far from the Earth's surface, is left out as a bad vertex.
        std::vector<glm::dvec3> sound;
        for (const glm::dvec3& p : points) {
            if (isFinite(p) && isGeocentric(p))
                sound.push_back(p);
        }
        if (auto done = m_toGeographic->apply(sound); !done)
            return tl::unexpected(done.error().in("placing " + tile.name));
        std::size_t next = 0;
        for (glm::dvec3& p : points)
            p = isFinite(p) && isGeocentric(p) ? sound[next++] : glm::dvec3(std::nan(""));
        return points;
    }

    Result<void> place(const SourceCity& city) {
        if (m_placed)
            return {};
        Extent extent;
        for (const glm::dvec3& p : city.vertices)
            extent.add(p);
        std::optional<std::string> declared = m_declared ? m_declared : crsBeside(m_path);
        if (*m_geocentric) {
            declared = kGeographic;  // written nowhere: it follows from the coordinates
            m_builder.crsIsOfFormat();
        }
        m_placed = true;
        return m_builder.place(declared, AxisOrder::EastNorth, std::move(extent));
    }

    static void fill(CityPiece& piece, const gltf::CityMesh& mesh,
                     const std::vector<std::uint32_t>& owners, bool mirrored) {
        // What is mirrored is walked round the other way.
        const std::array<std::uint32_t, 3> order =
            mirrored ? std::array{0U, 2U, 1U} : std::array{0U, 1U, 2U};
        SurfaceSoup& soup = piece.geometry.surfaces;
        piece.geometry.templateBegin = {0};  // there are none
        piece.geometry.usedBySurface.assign(piece.file.vertices.size(), false);
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            if (!piece.chosen[piece.file.objects[owners[t]].firstGeometry])
                continue;
            SurfaceSoup::Surface surface;
            surface.owner = owners[t];
            surface.material = mesh.triangles[t].material;
            surface.type = surfaceByName(mesh.materials[surface.material].name);
            surface.firstRing = std::uint32_t(soup.ringEnds.size());
            surface.ringCount = 1;
            if (mesh.triangles[t].texture != kNone) {
                surface.texture = mesh.triangles[t].texture;
                surface.firstUv = std::uint32_t(soup.uvs.size());
                for (const std::uint32_t k : order)
                    soup.uvs.push_back(std::uint32_t(3 * t) + k);
            }
            for (const std::uint32_t k : order) {
                const std::uint32_t vertex = mesh.triangles[t].vertex[k];
                soup.points.push_back(vertex);
                piece.geometry.usedBySurface[vertex] = true;
            }
            soup.ringEnds.push_back(std::uint32_t(soup.points.size()));
            soup.surfaces.push_back(surface);
            ++piece.geometry.writtenSurfaces;
            ++piece.geometry.writtenTriangles;
        }
    }

    void tell() {
        for (const Diagnostic& remark : m_tree.remarks)
            m_builder.fileDiagnostics().push_back(remark);
        if (m_bad > kMostNamed)
            note(Severity::Error, "tile-unreadable", "",
                 fmt::format("{} tiles in all cannot be read", m_bad));
        if (m_outOfRange > 0)
            note(Severity::Warning, "index-out-of-range", "",
                 fmt::format("{} triangles with vertices that do not exist were left out",
                             m_outOfRange));
        if (*m_geocentric)
            note(Severity::Info, "ellipsoidal-heights", "",
                 "heights count from the WGS 84 ellipsoid, up to 100 m from those above the sea",
                 "Where other data are above the sea, move this model with `reflet-cli edit "
                 "--place MODEL=offset:0,0,U`.");
    }

    const TileTree& m_tree;
    CityBuilder& m_builder;
    const fs::path& m_path;
    bool m_alone;  ///< a file of glTF without a tileset
    std::optional<std::string> m_declared;
    std::optional<bool> m_geocentric;
    std::optional<CrsTransform> m_toGeographic;
    std::optional<Error> m_lastError;
    bool m_placed = false, m_fatal = false;
    std::size_t m_triangles = 0, m_outOfRange = 0, m_bad = 0, m_remarks = 0;
};

Result<Imported<CityImport>> run(Purpose purpose, const TileTree& tree, const char* format,
                                 const fs::path& path, const ImportOptions& options,
                                 const JobContext& job) {
    CityBuilder builder(purpose, path, options, 0);
    TilesImport import(tree, builder, path);
    if (auto done = import.run(job); !done)
        return tl::unexpected(done.error());
    auto result = builder.finish();
    if (result) {
        result->value.summary.format = format;
        result->value.summary.version = tree.version;
    }
    return result;
}

Result<Imported<CityImport>> runTileset(Purpose purpose, const fs::path& path,
                                        const ImportOptions& options, const JobContext& job) {
    constexpr double kTree = 0.05;  // of the progress
    const auto tree =
        chooseTiles(path, options.geometricError, job.phase("looking for tiles", 0.0, kTree));
    if (!tree)
        return tl::unexpected(tree.error());
    if (tree->tiles.empty() && !tree->remarks.empty())
        return fail(ErrorCode::Unreadable,
                    "has no tile that can be read: " + tree->remarks.front().text, path.string(),
                    tree->remarks.front().remedy);
    return run(purpose, *tree, "3D Tiles", path, options, job.phase("", kTree, 1.0));
}

Result<Imported<CityImport>> runGltf(Purpose purpose, const fs::path& path,
                                     const ImportOptions& options, const JobContext& job) {
    TileTree tree;
    tree.version = "2.0";
    tree.tiles.push_back({path, path.stem().string(), glm::dmat4(1.0), options.upAxis == "z"});
    return run(purpose, tree, "glTF", path, options, job);
}

}  // namespace

Result<Imported<CityImport>> importTiles(const fs::path& path, const ImportOptions& options,
                                         const JobContext& job) {
    return runTileset(Purpose::Import, path, options, job);
}

Result<Imported<SourceSummary>> inspectTiles(const fs::path& path, const ImportOptions& options,
                                             const JobContext& job) {
    return summaryOnly(runTileset(Purpose::Inspect, path, options, job));
}

Result<Imported<CityImport>> importGltfCity(const fs::path& path, const ImportOptions& options,
                                            const JobContext& job) {
    return runGltf(Purpose::Import, path, options, job);
}

Result<Imported<SourceSummary>> inspectGltfCity(const fs::path& path, const ImportOptions& options,
                                                const JobContext& job) {
    return summaryOnly(runGltf(Purpose::Inspect, path, options, job));
}

}  // namespace reflet
