// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/tiles/TileContent.h"

#include "core/base/Files.h"
#include "importers/common/Geocentric.h"
#include "importers/tiles/TileTables.h"

#include <fmt/format.h>
#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>

namespace reflet::tiles {

using importers::eastNorthUp;
using importers::isGeocentric;

namespace {

constexpr std::size_t kTableHeader = 28;  // of b3dm; i3dm has one word more
constexpr std::size_t kCompositeHeader = 16;
constexpr std::size_t kSmallestTile = 12;
constexpr const char* kAgain = "Ask for the tile again, or make the tileset anew.";

std::uint32_t word(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof(value));
    return value;
}

/// glTF has y up; a tile has z up: (x, y, z) becomes (x, -z, y).
glm::dmat4 zUp_from_yUp() {
    return {
        {1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}, {0.0, -1.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};
}

bool isFinite(const glm::dmat4& m) {
    double sum = 0.0;
    for (int column = 0; column < 4; ++column)
        sum += glm::dot(m[column], glm::dvec4(1.0));
    return std::isfinite(sum);
}

/// The parts of a b3dm or i3dm.
struct Tables {
    TileTable features, batches;
    std::string_view payload;
};

class ContentReader {
public:
    ContentReader(const std::filesystem::path& path, bool zUp, const ContentLimits& limits,
                  const JobContext& job)
        : m_path(path), m_zUp(zUp), m_limits(limits), m_job(job) {}

    Result<void> readFile(std::string_view bytes) {
        m_whole = bytes;
        return read(bytes, 0);
    }
    std::vector<TilePart> result() && { return std::move(m_parts); }

private:
    Result<void> read(std::string_view bytes, int depth) {
        const std::string_view magic = bytes.substr(0, 4);
        if (magic == "b3dm")
            return readBatched(bytes);
        if (magic == "i3dm")
            return readInstanced(bytes);
        if (magic == "cmpt")
            return readComposite(bytes, depth);
        const std::size_t first = bytes.find_first_not_of(" \t\r\n");
        if (magic == "glTF" || (first != std::string_view::npos && bytes[first] == '{'))
            return addMesh(bytes, {glm::dmat4(1.0)}, {}, std::nullopt);
        if (magic == "pnts")
            return fail(ErrorCode::Refused, "is a point cloud, which has no surfaces",
                        m_path.string(), "Choose a tileset of meshes.");
        return fail(ErrorCode::Unreadable, "is of no content of tiles that Reflet knows",
                    m_path.string(),
                    "Known are glTF, b3dm, i3dm and cmpt: get the file again, or export it anew.");
    }

    [[nodiscard]] tl::unexpected<Error> damaged(const char* what) const {
        return fail(ErrorCode::Unreadable, what, m_path.string(), kAgain);
    }

    Result<Tables> tables(std::string_view bytes, std::size_t header) const {
        if (bytes.size() < header)
            return damaged("is cut off within its header");
        if (word(bytes, 4) != 1)
            return damaged("is of a version that is not 1");
        const std::size_t length = word(bytes, 8);
        if (length > bytes.size() || length < header)
            return damaged("is cut off");
        std::string_view rest = bytes.substr(header, length - header);
        std::array<std::string_view, 4> parts;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const std::size_t size = word(bytes, 12 + 4 * i);
            if (size > rest.size())
                return damaged("has tables that are longer than itself");
            parts[i] = rest.substr(0, size);
            rest.remove_prefix(size);
        }
        return Tables{TileTable(parts[0], parts[1]), TileTable(parts[2], parts[3]), rest};
    }

    Result<void> readBatched(std::string_view bytes) {
        const auto parts = tables(bytes, kTableHeader);
        if (!parts)
            return tl::unexpected(parts.error());
        return addMesh(parts->payload, {glm::dmat4(1.0)}, parts->batches.names(),
                       parts->features.triple("RTC_CENTER"));
    }

    Result<void> readInstanced(std::string_view bytes) {
        constexpr std::size_t kHeader = kTableHeader + 4;
        const auto parts = tables(bytes, kHeader);
        if (!parts)
            return tl::unexpected(parts.error());
        auto places = instances(parts->features);
        if (!places)
            return tl::unexpected(places.error());
        const auto center = parts->features.triple("RTC_CENTER");
        if (word(bytes, kTableHeader) == 1)
            return addMesh(parts->payload, *std::move(places), {}, center);
        const std::string name(parts->payload.substr(0, parts->payload.find('\0')));
        const auto file =
            confinedPath(m_path.parent_path(), name.substr(0, name.find_last_not_of(' ') + 1));
        constexpr std::size_t kLargest = std::size_t(1) << 30;
        const auto model =
            file ? reflet::readFile(*file, kLargest) : damaged("names a model outside its folder");
        if (!model)
            return tl::unexpected(model.error());
        return addMesh(*model, *std::move(places), {}, center, &*file);
    }

    /// Where the instances stand (3D Tiles 1.0, Instanced 3D Model).
    Result<std::vector<glm::dmat4>> instances(const TileTable& table) const {
        const std::size_t count = table.count("INSTANCES_LENGTH");
        if (count > m_limits.maxInstances)
            return fail(ErrorCode::ResourceLimit, fmt::format("has {} instances", count),
                        m_path.string(), "Choose a part of the city.");
        std::vector<double> points = table.floats("POSITION", count, 3);
        if (points.empty() && table.has("POSITION_QUANTIZED")) {
            points = table.shorts("POSITION_QUANTIZED", count, 3);
            const auto offset = table.triple("QUANTIZED_VOLUME_OFFSET");
            const auto scale = table.triple("QUANTIZED_VOLUME_SCALE");
            if (!offset || !scale)
                return damaged("has positions of no known volume");
            constexpr double kSteps = 65535.0;
            for (std::size_t i = 0; i < points.size(); ++i)
                points[i] = (*offset)[int(i % 3)] + points[i] / kSteps * (*scale)[int(i % 3)];
        }
        if (points.size() != 3 * count)
            return damaged("has positions that are not all there");
        const auto ups = table.floats("NORMAL_UP", count, 3);
        const auto rights = table.floats("NORMAL_RIGHT", count, 3);
        const auto scales = table.floats("SCALE", count, 1);
        const auto axes = table.floats("SCALE_NON_UNIFORM", count, 3);
        const glm::dvec3 center = table.triple("RTC_CENTER").value_or(glm::dvec3(0.0));
        std::vector<glm::dmat4> places;
        for (std::size_t i = 0; i < count; ++i) {
            const auto triple = [&](const std::vector<double>& list) {
                return glm::dvec3(list[3 * i], list[3 * i + 1], list[3 * i + 2]);
            };
            const glm::dvec3 at = triple(points);
            glm::dmat3 turn(1.0);
            if (!ups.empty() && !rights.empty())
                turn = glm::dmat3(triple(rights), triple(ups),
                                  glm::cross(triple(rights), triple(ups)));
            else if (table.has("EAST_NORTH_UP") && isGeocentric(at + center))
                turn = eastNorthUp(at + center);
            const glm::dvec3 scale = (scales.empty() ? 1.0 : scales[i]) *
                                     (axes.empty() ? glm::dvec3(1.0) : triple(axes));
            places.push_back(glm::translate(glm::dmat4(1.0), at) * glm::dmat4(turn) *
                             glm::scale(glm::dmat4(1.0), scale));
        }
        return places;
    }

    Result<void> readComposite(std::string_view bytes, int depth) {
        if (depth >= m_limits.deepest)
            return damaged("nests composites too deep");
        if (bytes.size() < kCompositeHeader)
            return damaged("is cut off within its header");
        const std::uint32_t count = word(bytes, 12);
        std::string_view rest = bytes.substr(kCompositeHeader);
        for (std::uint32_t i = 0; i < count; ++i) {
            if (rest.size() < kSmallestTile)
                return damaged("is cut off: it holds fewer tiles than it says");
            const std::size_t length = word(rest, 8);
            if (length < kSmallestTile || length > rest.size())
                return damaged("is cut off within an inner tile");
            if (auto inner = read(rest.substr(0, length), depth + 1); !inner)
                return inner;
            rest.remove_prefix(length);
        }
        return {};
    }

    /// `ownFile`: the glTF is not within the tile but that file.
    Result<void> addMesh(std::string_view bytes, std::vector<glm::dmat4> places,
                         std::vector<std::string> names, const std::optional<glm::dvec3>& center,
                         const std::filesystem::path* ownFile = nullptr) {
        const std::filesystem::path& file = ownFile != nullptr ? *ownFile : m_path;
        auto meshes = gltf::readCityMeshes(bytes, file, m_limits.maxTriangles, m_job);
        if (!meshes)
            return tl::unexpected(meshes.error());
        const std::uint64_t begin =
            ownFile != nullptr ? 0 : std::uint64_t(bytes.data() - m_whole.data());
        for (gltf::CityMesh& mesh : *meshes) {
            for (gltf::CityMesh::Texture& texture : mesh.textures)
                settle(texture.image, file, begin);
            TilePart part{std::move(mesh), file, {}, names};
            if (auto added = addPlaces(part, places, center); !added)
                return added;
            m_parts.push_back(std::move(part));
        }
        return {};
    }

    /// Images within the glTF are within the file, which begins with something else.
    static void settle(gltf::ImagePlace& image, const std::filesystem::path& file,
                       std::uint64_t begin) {
        if (!image.file.empty() || !image.uri.empty())
            return;
        image.file = file;
        image.offset += begin;
    }

    Result<void> addPlaces(TilePart& part, const std::vector<glm::dmat4>& places,
                           const std::optional<glm::dvec3>& center) {
        const gltf::CityMesh& mesh = part.mesh;
        const std::size_t count = places.size() * mesh.file_from_mesh.size();
        m_triangles += mesh.triangles.size() * count;
        if (m_triangles > m_limits.maxTriangles || count > m_limits.maxInstances)
            return fail(ErrorCode::ResourceLimit,
                        fmt::format("has more than {} triangles or {} instances",
                                    m_limits.maxTriangles, m_limits.maxInstances),
                        m_path.string(), "Choose a part of the city.");
        const glm::dvec3 shift =
            center.value_or(glm::dvec3(0.0)) + mesh.rtcCenter.value_or(glm::dvec3(0.0));
        const bool zUp = m_zUp || (mesh.georeference && mesh.georeference->zUp);
        const glm::dmat4 axes = zUp ? glm::dmat4(1.0) : zUp_from_yUp();
        for (const glm::dmat4& place : places) {
            for (const glm::dmat4& file_from_mesh : mesh.file_from_mesh)
                part.tile_from_mesh.push_back(glm::translate(glm::dmat4(1.0), shift) * place *
                                              axes * file_from_mesh);
        }
        std::erase_if(part.tile_from_mesh, [](const glm::dmat4& m) { return !isFinite(m); });
        return {};
    }

    const std::filesystem::path& m_path;
    std::string_view m_whole;  ///< the file
    bool m_zUp;
    const ContentLimits& m_limits;
    const JobContext& m_job;
    std::size_t m_triangles = 0;
    std::vector<TilePart> m_parts;
};

}  // namespace

Result<std::vector<TilePart>> readTileContent(std::string_view bytes,
                                              const std::filesystem::path& path, bool zUp,
                                              const ContentLimits& limits, const JobContext& job) {
    ContentReader reader(path, zUp, limits, job);
    if (auto read = reader.readFile(bytes); !read)
        return tl::unexpected(read.error());
    return std::move(reader).result();
}

}  // namespace reflet::tiles
