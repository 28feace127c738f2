// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/obj/ObjImporter.h"

#include "core/base/Files.h"
#include "importers/common/CityBuilder.h"
#include "importers/common/NamedTypes.h"
#include "importers/common/PhotoMesh.h"
#include "importers/common/UpAxis.h"
#include "importers/obj/ObjFile.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace reflet {

namespace {

using namespace importers;
using namespace obj;

constexpr std::size_t kLargestLibrary = std::size_t(64) << 20;

/// The materials of a file, with where their images lie.
class Looks {
public:
    Looks(const ObjFile& file, const std::filesystem::path& path, std::vector<Diagnostic>& remarks)
        : m_folder(path.has_parent_path() ? path.parent_path() : ".") {
        for (const std::string& name : file.libraries)
            addLibrary(name);
        if (!m_missing.empty())
            remarks.push_back(
                {Severity::Warning, "materials-missing", "",
                 fmt::format("its library of materials {} was not found beside it", m_missing),
                 "Put the .mtl file where the model names it, below its folder."});
        std::size_t unknown = 0;
        for (const std::string& name : file.materials)
            unknown += name.empty() || m_known.contains(name) ? 0 : 1;
        if (unknown > 0 && m_missing.empty())
            remarks.push_back({Severity::Info, "material-unknown", "",
                               fmt::format("{} of its materials are in no library and have no "
                                           "colour of their own",
                                           unknown),
                               ""});
    }

    /// The number of a material in `city`, which it is added to; kNone where it has no look.
    std::uint32_t materialOf(const std::string& name, SourceCity& city) {
        const auto known = m_known.find(name);
        if (known == m_known.end())
            return kNone;
        city.materials.push_back(known->second.look);
        return std::uint32_t(city.materials.size() - 1);
    }
    std::uint32_t textureOf(const std::string& name, SourceCity& city) {
        const auto known = m_known.find(name);
        if (known == m_known.end() || known->second.image.empty())
            return kNone;
        city.textures.push_back({known->second.image, !known->second.clamp});
        return std::uint32_t(city.textures.size() - 1);
    }

private:
    void addLibrary(const std::string& name) {
        const auto file = confinedPath(m_folder, name);
        const auto text =
            file ? readFile(*file, kLargestLibrary) : Result<std::string>(std::string());
        if (!file || !text) {
            m_missing += fmt::format("{}{:.80}", m_missing.empty() ? "" : ", ", name);
            return;
        }
        // Images lie relative to the library.
        const std::string below =
            file->parent_path().lexically_relative(m_folder.lexically_normal()).generic_string();
        for (ObjMaterial& material : readMaterials(*text)) {
            const bool inside = !below.empty() && below != "." && !below.starts_with("..");
            const bool relative = !material.image.empty() && material.image.front() != '/' &&
                                  material.image.find(':') == std::string::npos;
            if (inside && relative)
                material.image = below + "/" + material.image;
            const std::string key = material.look.name;
            m_known.insert_or_assign(key, std::move(material));
        }
    }

    std::filesystem::path m_folder;
    std::map<std::string, ObjMaterial> m_known;
    std::string m_missing;
};

/// Which city object a face is of.
class Objects {
public:
    /// `unless`: what objects are whose names do not tell.
    Objects(const ObjFile& file, std::string fallback, CityObjectType unless)
        : m_file(file), m_fallback(std::move(fallback)), m_unless(unless) {
        std::set<std::uint32_t> objects;
        for (const auto& face : file.faces)
            objects.insert(face.object);
        m_byGroup = objects.size() < 2;
        if (m_byGroup && !objects.empty() && !file.objects[*objects.begin()].empty())
            m_fallback = file.objects[*objects.begin()];
        for (const std::string& name : file.materials)
            m_types.push_back(typeByName(name));
        for (const auto& face : file.faces)
            m_kinds[nameOf(face.object, face.group)].insert(typeOf(face));
    }

    std::uint32_t operator()(const ObjFile::Face& face, SourceCity& city) {
        return number(nameOf(face.object, face.group), typeOf(face), city);
    }
    /// Of a face that is left out: whatever its material.
    std::uint32_t operator()(const ObjFile::Fault& fault, SourceCity& city) {
        const std::uint32_t name = nameOf(fault.object, fault.group);
        const auto kinds = m_kinds.find(name);
        return number(name,
                      kinds != m_kinds.end() ? *kinds->second.begin()
                                             : typeByName(text(name)).value_or(m_unless),
                      city);
    }

private:
    [[nodiscard]] std::uint32_t nameOf(std::uint32_t object, std::uint32_t group) const {
        return m_byGroup ? group : object;
    }
    [[nodiscard]] const std::string& text(std::uint32_t name) const {
        return m_byGroup ? m_file.groups[name] : m_file.objects[name];
    }
    [[nodiscard]] CityObjectType typeOf(const ObjFile::Face& face) const {
        const auto own = typeByName(text(nameOf(face.object, face.group)));
        return own ? *own : m_types[face.material].value_or(m_unless);
    }

    std::uint32_t number(std::uint32_t name, CityObjectType type, SourceCity& city) {
        const auto next = std::uint32_t(city.objects.size());
        const auto [known, isNew] = m_numbers.try_emplace({name, type}, next);
        if (!isNew)
            return known->second;
        ObjectOutline object;
        object.id = text(name).empty() ? m_fallback : text(name);
        const auto kinds = m_kinds.find(name);
        if (kinds != m_kinds.end() && kinds->second.size() > 1)
            object.id += fmt::format("/{}", toString(type));
        object.type = type;
        object.typeName = toString(type);
        object.firstGeometry = std::uint32_t(city.geometries.size());
        object.geometryCount = 1;
        city.geometries.push_back({GeometryType::MultiSurface, {}, 0, kNone});
        city.objects.push_back(std::move(object));
        return next;
    }

    const ObjFile& m_file;
    std::string m_fallback;
    CityObjectType m_unless;
    bool m_byGroup = false;
    std::vector<std::optional<CityObjectType>> m_types;  ///< of the materials
    std::map<std::uint32_t, std::set<CityObjectType>> m_kinds;
    std::map<std::pair<std::uint32_t, CityObjectType>, std::uint32_t> m_numbers;
};

class ObjImport {
public:
    ObjImport(ObjFile file, CityBuilder& builder, const std::filesystem::path& path)
        : m_file(std::move(file)), m_builder(builder), m_path(path) {}

    Result<void> run(const JobContext& job) {
        if (m_file.faces.empty())
            return fail(ErrorCode::Unreadable, "has no faces that can be read", m_path.string(),
                        m_file.freeForms > 0 ? "Export its curved surfaces as meshes."
                                             : "Export the model again, with its meshes.");
        if (auto placed = place(); !placed)
            return placed;
        tell();
        CityPiece piece = makePiece();
        return m_builder.add(std::move(piece), job);
    }

private:
    Result<void> place() {
        const auto declared = crsBeside(m_path);
        const ImportOptions& options = m_builder.options();
        const bool hasCrs = declared || (!options.crs.empty() && options.crs != "local");
        Box box;
        for (const std::uint32_t corner : m_file.corners) {
            if (corner < m_file.vertices.size() &&
                std::isfinite(m_file.vertices[corner].x + m_file.vertices[corner].y +
                              m_file.vertices[corner].z))
                box.add(m_file.vertices[corner]);
        }
        const MeshAxes axes = meshAxes(box, hasCrs, options, m_builder.fileDiagnostics());
        Extent extent;
        for (glm::dvec3& vertex : m_file.vertices)
            vertex = axes(vertex);
        for (const auto& face : m_file.faces)
            extent.add(m_file.vertices[m_file.corners[face.firstCorner]]);
        return m_builder.place(declared, AxisOrder::EastNorth, std::move(extent));
    }

    void tell() {
        const auto say = [&](const char* code, std::string text, const char* remedy) {
            m_builder.fileDiagnostics().push_back(
                {Severity::Warning, code, "", std::move(text), remedy});
        };
        if (m_file.unreadable > 0)
            say("vertex-unreadable",
                fmt::format("{} vertices are no three numbers; what uses them is left out",
                            m_file.unreadable),
                "Export the model again; numbers need a point, not a comma.");
        if (m_file.freeForms > 0)
            say("free-form",
                fmt::format("{} curves and curved surfaces were left out", m_file.freeForms),
                "Export them as meshes.");
    }

    /// One skin with images on it; `textures` of the materials.
    [[nodiscard]] bool isPhotoMesh(const std::vector<std::uint32_t>& textures) const {
        std::vector<std::array<std::uint32_t, 3>> triangles;
        for (const auto& face : m_file.faces) {
            if (!face.textured || textures[face.material] == kNone)
                return false;
            const std::uint32_t* corner = m_file.corners.data() + face.firstCorner;
            for (std::uint32_t k = 2; k < face.corners; ++k)
                triangles.push_back({corner[0], corner[k - 1], corner[k]});
        }
        return isSkinOverGround(m_file.vertices, triangles);
    }

    CityPiece makePiece() {
        SourceCity city;
        city.format = "OBJ";
        city.lodNames = {""};
        Looks looks(m_file, m_path, m_builder.fileDiagnostics());
        std::vector<std::uint32_t> materials, textures;
        std::vector<SurfaceType> surfaces;
        for (const std::string& name : m_file.materials) {
            materials.push_back(looks.materialOf(name, city));
            textures.push_back(looks.textureOf(name, city));
            surfaces.push_back(surfaceByName(name));
        }
        const auto unless =
            isPhotoMesh(textures) ? CityObjectType::TinRelief : CityObjectType::Building;
        Objects objects(m_file, m_path.stem().string(), unless);
        std::vector<std::uint32_t> owners;
        owners.reserve(m_file.faces.size());
        for (const auto& face : m_file.faces)
            owners.push_back(objects(face, city));
        std::vector<std::uint32_t> faulty;
        for (const auto& fault : m_file.faults)
            faulty.push_back(objects(fault, city));
        city.vertices = std::move(m_file.vertices);
        city.textureVertices = std::move(m_file.texture);
        CityPiece piece = m_builder.begin(std::move(city));
        for (std::size_t i = 0; i < faulty.size(); ++i)
            piece.report.note(
                faulty[i],
                m_file.faults[i].outOfRange ? Issue::IndexOutOfRange : Issue::DegenerateSurface,
                fmt::format("line {}", m_file.faults[i].line));
        piece.geometry.templateBegin = {0};  // there are none
        piece.geometry.usedBySurface.assign(piece.file.vertices.size(), false);
        for (std::size_t i = 0; i < m_file.faces.size(); ++i) {
            const auto& face = m_file.faces[i];
            if (piece.chosen[piece.file.objects[owners[i]].firstGeometry])
                addFace(piece, face, owners[i], materials[face.material], textures[face.material],
                        surfaces[face.material]);
        }
        return piece;
    }

    void addFace(CityPiece& piece, const ObjFile::Face& face, std::uint32_t owner,
                 std::uint32_t material, std::uint32_t texture, SurfaceType type) const {
        SurfaceSoup& soup = piece.geometry.surfaces;
        SurfaceSoup::Surface surface;
        surface.owner = owner;
        surface.type = type;
        surface.material = material;
        surface.firstRing = std::uint32_t(soup.ringEnds.size());
        surface.ringCount = 1;
        const auto first = m_file.corners.begin() + face.firstCorner;
        for (auto corner = first; corner != first + face.corners; ++corner) {
            soup.points.push_back(*corner);
            piece.geometry.usedBySurface[*corner] = true;
        }
        if (texture != kNone && face.textured) {
            surface.texture = texture;
            surface.firstUv = std::uint32_t(soup.uvs.size());
            const auto uv = m_file.cornerUvs.begin() + face.firstCorner;
            soup.uvs.insert(soup.uvs.end(), uv, uv + face.corners);
        }
        soup.ringEnds.push_back(std::uint32_t(soup.points.size()));
        soup.surfaces.push_back(surface);
        ++piece.geometry.writtenSurfaces;
        piece.geometry.writtenTriangles += nominalTriangles(face.corners, 1);
    }

    ObjFile m_file;
    CityBuilder& m_builder;
    const std::filesystem::path& m_path;
};

Result<Imported<CityImport>> run(Purpose purpose, ByteSource& source,
                                 const std::filesystem::path& path, const ImportOptions& options,
                                 const JobContext& job) {
    auto file = readObj(source, path.string(), job.phase("reading", 0.0, 0.5));
    if (!file)
        return tl::unexpected(file.error());
    CityBuilder builder(purpose, path, options, source.size());
    ObjImport import(*std::move(file), builder, path);
    if (auto done = import.run(job.phase("", 0.5, 1.0)); !done)
        return tl::unexpected(done.error());
    auto result = builder.finish();
    if (result)
        result->value.summary.format = "OBJ";
    return result;
}

Result<Imported<CityImport>> runFile(Purpose purpose, const std::filesystem::path& path,
                                     const ImportOptions& options, const JobContext& job) {
    const auto source = openFile(path, options.maxFileBytes);
    if (!source)
        return tl::unexpected(source.error());
    return run(purpose, **source, path, options, job);
}

}  // namespace

Result<Imported<CityImport>> importObj(const std::filesystem::path& path,
                                       const ImportOptions& options, const JobContext& job) {
    return runFile(Purpose::Import, path, options, job);
}

Result<Imported<CityImport>> importObjBytes(std::string_view bytes,
                                            const std::filesystem::path& path,
                                            const ImportOptions& options, const JobContext& job) {
    const auto source = openBytes(bytes);
    return run(Purpose::Import, *source, path, options, job);
}

Result<Imported<SourceSummary>> inspectObj(const std::filesystem::path& path,
                                           const ImportOptions& options, const JobContext& job) {
    return summaryOnly(runFile(Purpose::Inspect, path, options, job));
}

}  // namespace reflet
