// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/GeoFile.h"
#include "core/io/GridFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace reflet {

namespace {

constexpr std::size_t kMostSpans = 16;  // of a column that are written

struct Layer {
    std::string name;
    std::function<float(std::size_t cell)> height;
    const std::vector<float>* stored = nullptr;  ///< of a layer that the heightfield holds
};

Layer storedLayer(const char* name, const std::vector<float>& heights) {
    return {name, [&heights](std::size_t cell) { return heights[cell]; }, &heights};
}

/// A bound of the n-th solid stretch of each column, from 0; missing where there is none.
Layer spanLayer(std::string name, const Heightfield& field, std::size_t n,
                float HeightSpan::*bound) {
    return {std::move(name), [&field, n, bound](std::size_t cell) {
                const auto column = field.spans.at(cell);
                return n < column.size() ? column[n].*bound : kMissingHeight;
            }};
}

std::size_t mostSpans(const Heightfield& field) {
    std::size_t most = 1;
    for (std::size_t n = 1; n < field.spans.first().size(); ++n)
        most = std::max<std::size_t>(most, field.spans.first()[n] - field.spans.first()[n - 1]);
    return most;
}

std::vector<Layer> chosenLayers(const Heightfield& field, int count) {
    if (count == 1)
        return {storedLayer("top_max", field.topMax)};
    std::vector<Layer> layers{storedLayer("ground", field.ground),
                              storedLayer("top_max", field.topMax)};
    if (count == 3)
        layers.push_back(storedLayer("top_center", field.topCenter));
    layers.push_back(spanLayer("ceil_min", field, 1, &HeightSpan::low));
    layers.push_back(spanLayer("over_top", field, 1, &HeightSpan::high));
    if (count < 3)
        return layers;
    layers.push_back({"base_top", [&field](std::size_t cell) {
                          const auto column = field.spans.at(cell);
                          return column.empty() ? field.topMax[cell] : column.front().high;
                      }});
    for (std::size_t n = 2; n < std::min(mostSpans(field), kMostSpans); ++n) {
        layers.push_back(spanLayer(fmt::format("low_{}", n + 1), field, n, &HeightSpan::low));
        layers.push_back(spanLayer(fmt::format("high_{}", n + 1), field, n, &HeightSpan::high));
    }
    return layers;
}

GridDescription describe(const Heightfield& field, const ProjectFrame& frame) {
    return {
        true,
        {{"REFLET_CELL_SIZE", fmt::format("{}", field.grid.cellSize)},
         {"REFLET_ORIGIN", fmt::format("{} {} {}", frame.origin.x, frame.origin.y, frame.origin.z)},
         {"REFLET_VERTICAL", frame.vertical.value_or("unknown")}}};
}

}  // namespace

Result<void> writeHeightfield(const Heightfield& field, const ProjectFrame& frame, int layers,
                              const std::filesystem::path& path) {
    if (layers < 1 || layers > 3)
        return fail(ErrorCode::Usage,
                    "a heightfield has one to three layers, not " + std::to_string(layers),
                    path.string(), "Choose 1, 2 or 3.");
    const std::vector<Layer> chosen = chosenLayers(field, layers);
    for (const Layer& layer : chosen)
        if (field.grid.cellCount() == 0 ||
            (layer.stored != nullptr && layer.stored->size() != field.grid.cellCount()))
            return fail(ErrorCode::Refused, "the layer " + layer.name + " is empty", path.string());
    std::vector<GridBand> bands;
    for (const Layer& layer : chosen)
        bands.push_back({layer.name, "metre", [&layer, z = frame.origin.z](std::size_t cell) {
                             return double(layer.height(cell)) + z;
                         }});
    return writeGrid(field.grid, bands, describe(field, frame), frame, path);
}

}  // namespace reflet
