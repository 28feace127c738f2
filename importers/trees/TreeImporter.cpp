// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/trees/TreeImporter.h"

#include "importers/common/LayerCrs.h"
#include "importers/trees/TreeFields.h"
#include "importers/trees/TreeShape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

namespace reflet::trees {

namespace {

using namespace importers;

constexpr std::size_t kMostTrees = 4'000'000;
constexpr std::size_t kInAPiece = 8192;

class RegisterImport {
public:
    RegisterImport(VectorFile& file, CityBuilder& builder, std::string subject)
        : m_file(file), m_builder(builder), m_subject(std::move(subject)) {}

    Result<void> run(const JobContext& job) {
        for (const auto stage :
             {&RegisterImport::chooseLayers, &RegisterImport::collect, &RegisterImport::place,
              &RegisterImport::build, &RegisterImport::account}) {
            if (auto done = (this->*stage)(job); !done)
                return done;
        }
        return {};
    }

private:
    struct Layer {
        std::size_t index = 0;
        TreeReader reader;
    };

    Result<void> chooseLayers(const JobContext& job);
    Result<void> collect(const JobContext& job);
    Result<void> place(const JobContext& job);
    Result<void> build(const JobContext& job);
    Result<void> account(const JobContext& job);

    void take(Layer& layer, const PointFeature& feature);
    [[nodiscard]] std::string idOf(std::string id, const PointFeature& feature);
    [[nodiscard]] double defaultHeight() const {
        return m_builder.options().defaultHeight.value_or(kUnknownHeight);
    }
    void note(Severity severity, const char* code, std::string text, const char* remedy = "") {
        m_builder.fileDiagnostics().push_back({severity, code, "", std::move(text), remedy});
    }

    VectorFile& m_file;
    CityBuilder& m_builder;
    std::string m_subject;
    std::vector<Layer> m_layers;
    std::vector<Tree> m_trees;
    std::unordered_set<std::string> m_ids;
    Box m_box;
    Extent m_extent;
};

Result<void> RegisterImport::chooseLayers(const JobContext& /*job*/) {
    for (std::size_t i = 0; i < m_file.layers().size(); ++i) {
        const VectorLayer& layer = m_file.layers()[i];
        if (!layer.points)
            continue;
        auto fields = chooseFields(layer.fields, m_builder.options(), m_subject);
        if (!fields)
            return tl::unexpected(fields.error());
        if (!m_layers.empty() && layer.crs != m_file.layers()[m_layers.front().index].crs)
            return fail(ErrorCode::Refused, "has layers in different coordinate reference systems",
                        m_subject, "Export each layer to a file of its own.");
        m_layers.push_back({i, TreeReader(*std::move(fields))});
    }
    return {};
}

std::string RegisterImport::idOf(std::string id, const PointFeature& feature) {
    if (id.empty() || m_ids.contains(id)) {
        const std::string number = std::to_string(feature.number);
        id = id.empty() ? number : fmt::format("{} ({})", id, number);
    }
    const std::string wanted = id;
    for (int k = 2; !m_ids.insert(id).second; ++k)
        id = fmt::format("{}/{}", wanted, k);
    return id;
}

void RegisterImport::take(Layer& layer, const PointFeature& feature) {
    Tree tree;
    layer.reader.read(feature, tree);
    tree.place = layer.reader.place(feature);
    if (tree.place && !(std::isfinite(tree.place->x) && std::isfinite(tree.place->y)))
        tree.place.reset();
    if (!tree.place)
        tree.notes.emplace_back(Issue::BadVertex, "its place");
    const std::string id(layer.reader.id(feature));
    // Several points under one entry are a tree each.
    const std::size_t count = std::max<std::size_t>(1, feature.places.size());
    for (std::size_t k = 0; k < count; ++k) {
        Tree one = tree;
        if (k > 0)
            one.place = glm::dvec2(feature.places[k]);
        one.outline.id = idOf(id, feature);
        if (one.place) {
            m_box.add(glm::dvec3(*one.place, 0.0));
            m_extent.add(glm::dvec3(*one.place, 0.0));
        }
        m_trees.push_back(std::move(one));
    }
}

Result<void> RegisterImport::collect(const JobContext& job) {
    for (Layer& layer : m_layers) {
        const std::vector<std::size_t> fields = layer.reader.fields();
        const auto damage =
            m_file.readPoints(layer.index, fields, [&](const PointFeature& feature) {
                take(layer, feature);
                return m_trees.size() <= kMostTrees && !job.cancelled();
            });
        if (!damage)
            return tl::unexpected(damage.error());
        if (!damage->empty())
            note(Severity::Warning, "damaged-file",
                 fmt::format("while reading, GDAL reports: {:.200}", *damage),
                 "Write the file anew, e.g. with QGIS.");
    }
    if (job.cancelled())
        return tl::unexpected(JobContext::cancelledError());
    if (m_trees.size() > kMostTrees)
        return fail(ErrorCode::ResourceLimit, "has more than 4 million points", m_subject,
                    "Cut out the part that you need, e.g. with QGIS or ogr2ogr -clipsrc.");
    const bool placed = std::any_of(m_trees.begin(), m_trees.end(),
                                    [](const Tree& tree) { return tree.place.has_value(); });
    if (!placed && !m_trees.empty())
        return fail(ErrorCode::Unreadable, "has no points, nor columns with coordinates", m_subject,
                    "Name the columns lon and lat, or east and north.");
    return {};
}

Result<void> RegisterImport::place(const JobContext& /*job*/) {
    const Layer& first = m_layers.front();
    const VectorLayer& layer = m_file.layers()[first.index];
    std::optional<std::string> declared = layerCrs(layer, m_box, m_builder.options());
    const TreeFields& fields = first.reader.choice();
    const bool byColumns = !layer.crs && (fields.degrees || (fields.both && !fields.east));
    if (byColumns && canBeDegrees(m_box) && m_builder.options().crs.empty())
        declared = "EPSG:4326";
    if (layer.assumedCrs || byColumns)
        m_builder.crsIsOfFormat();
    return m_builder.place(declared, AxisOrder::EastNorth, m_extent);
}

Result<void> RegisterImport::build(const JobContext& job) {
    const extrusion::MetricScale metres(m_builder.crs());
    std::size_t next = 0;
    do {
        const std::size_t end = std::min(m_trees.size(), next + kInAPiece);
        std::vector<Tree> some(std::make_move_iterator(m_trees.begin() + std::ptrdiff_t(next)),
                               std::make_move_iterator(m_trees.begin() + std::ptrdiff_t(end)));
        auto added = m_builder.add(pieceOf(m_builder, std::move(some), defaultHeight(), metres),
                                   JobContext({}, job.stopToken()));
        if (!added)
            return added;
        next = end;
        job.progress(double(next) / double(std::max<std::size_t>(m_trees.size(), 1)));
    } while (next < m_trees.size());
    return {};
}

/// Tells where the sizes came from, and for how many there were none.
Result<void> RegisterImport::account(const JobContext& /*job*/) {
    TreeTally all;
    std::string sources;
    for (const Layer& layer : m_layers) {
        const TreeTally& tally = layer.reader.tally();
        all.trees += tally.trees;
        all.heightAssumed += tally.heightAssumed;
        all.crownAssumed += tally.crownAssumed;
        all.unreadable += tally.unreadable;
        if (all.example.empty())
            all.example = tally.example;
        const std::string& described = layer.reader.choice().described;
        if (!described.empty())
            sources += (sources.empty() ? "" : "; ") + described;
    }
    constexpr const char* kFields =
        "Name the attributes with --height-field and --crown-field, or give a height with "
        "--default-height, or do so where the window shows the model.";
    note(Severity::Info, "trees-read",
         fmt::format("the points were taken for trees{}{}", sources.empty() ? "" : ": ", sources),
         kFields);
    if (all.unreadable > 0)
        note(Severity::Warning, "tree-size-unreadable",
             fmt::format("{} heights or crowns are no lengths that a tree has, such as \"{:.40}\"",
                         all.unreadable, all.example),
             kFields);
    if (all.crownAssumed > 0)
        note(Severity::Info, "tree-crown-assumed",
             fmt::format("{} of {} trees say nothing of their crown: 0.6 times their height was "
                         "taken, 0.4 times for conifers",
                         all.crownAssumed, all.trees),
             kFields);
    if (all.heightAssumed == 0)
        return {};
    const std::string text = fmt::format(
        "{} of {} trees say nothing of their height: 1.6 times their crown was taken, {:g} m where "
        "that is not known either",
        all.heightAssumed, all.trees, defaultHeight());
    if (m_builder.options().strict)
        return fail(ErrorCode::Refused, text + ", which --strict does not allow", m_subject,
                    kFields);
    note(Severity::Warning, "tree-height-assumed", text, kFields);
    return {};
}

}  // namespace

bool looksLikeRegister(const VectorFile& file) {
    const auto& layers = file.layers();
    return std::none_of(layers.begin(), layers.end(),
                        [](const VectorLayer& layer) { return layer.mayHaveAreas; }) &&
           std::any_of(layers.begin(), layers.end(),
                       [](const VectorLayer& layer) { return layer.points; });
}

Result<Imported<CityImport>> importRegister(Purpose purpose, VectorFile& file, std::size_t bytes,
                                            const std::filesystem::path& path,
                                            const ImportOptions& options, const JobContext& job) {
    CityBuilder builder(purpose, path, options, bytes);
    RegisterImport import(file, builder, path.string());
    if (auto done = import.run(job); !done)
        return tl::unexpected(done.error());
    auto result = builder.finish();
    if (result)
        result->value.summary.format = file.format();
    job.progress(1.0);
    return result;
}

}  // namespace reflet::trees
