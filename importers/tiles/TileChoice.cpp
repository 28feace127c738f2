// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/tiles/TileChoice.h"

#include "core/base/Files.h"
#include "importers/gltf/GltfOutline.h"
#include "importers/tiles/TileContent.h"

#include <fmt/format.h>

#include <map>

namespace reflet::tiles {

namespace {

/// Counts the triangles of files, each once.
class Counter {
public:
    /// Stops once there are more than `most`.
    std::size_t operator()(const TileTree& tree, std::size_t most, const JobContext& job) {
        std::size_t total = 0;
        for (const TileUse& tile : tree.tiles) {
            if (total > most || job.cancelled())
                break;
            const auto [known, isNew] = m_known.try_emplace(tile.file.string());
            if (isNew)
                known->second = countTileTriangles(tile.file);
            total += known->second;
        }
        return total;
    }

private:
    std::map<std::string, std::size_t> m_known;
};

Result<TileTree> treeAt(const std::filesystem::path& path, double error, const JobContext& job) {
    TreeLimits limits;
    limits.goodEnough = error;
    return readTileTree(path, limits, job);
}

}  // namespace

std::size_t countTileTriangles(const std::filesystem::path& file) {
    if (const auto outline = gltf::readOutline(file))
        return outline->triangles;
    // Composites and instances: what they hold tells.
    constexpr std::size_t kLargest = std::size_t(1) << 30;
    const auto bytes = readFile(file, kLargest);
    const auto parts = bytes ? readTileContent(*bytes, file, false, {}, {})
                             : Result<std::vector<TilePart>>(tl::unexpected(bytes.error()));
    std::size_t count = 0;
    for (std::size_t i = 0; parts && i < parts->size(); ++i)
        count += (*parts)[i].mesh.triangles.size() * (*parts)[i].tile_from_mesh.size();
    return count;
}

Result<TileTree> chooseTiles(const std::filesystem::path& path,
                             std::optional<double> geometricError, const JobContext& job,
                             std::size_t mostTriangles) {
    auto finest = treeAt(path, geometricError.value_or(-1.0), job);
    if (!finest || geometricError)
        return finest;
    Counter count;
    if (count(*finest, mostTriangles, job) <= mostTriangles)
        return finest;
    // The least error that fits: there are the fewer triangles the larger it is.
    const std::vector<double> errors = finest->errors;
    std::size_t low = 0, high = errors.size();
    std::optional<TileTree> best;
    std::size_t triangles = 0;
    while (low < high) {
        const std::size_t middle = (low + high) / 2;
        auto tree = treeAt(path, errors[middle], job);
        if (!tree)
            return tree;
        const std::size_t had = count(*tree, mostTriangles, job);
        if (had <= mostTriangles || middle + 1 == errors.size()) {
            best = *std::move(tree);
            triangles = had;
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    if (job.cancelled())
        return tl::unexpected(JobContext::cancelledError());
    if (!best)
        return finest;
    best->remarks.push_back(
        {Severity::Info, "tiles-coarser", "",
         fmt::format("tiles with a geometric error of up to {:g} m were taken, {} triangles: the "
                     "finest have more than {}",
                     errors[low], triangles, mostTriangles),
         "Say with --geometric-error how fine they shall be, or import a part: one of the tilesets "
         "that it refers to."});
    return *std::move(best);
}

}  // namespace reflet::tiles
