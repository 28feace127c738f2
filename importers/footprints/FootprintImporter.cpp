// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/footprints/FootprintImporter.h"

#include "core/io/VectorFile.h"
#include "importers/common/CityBuilder.h"
#include "importers/common/LayerCrs.h"
#include "importers/extrusion/Building.h"
#include "importers/footprints/FootprintHeights.h"
#include "importers/trees/TreeImporter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <system_error>
#include <unordered_set>
#include <utility>

namespace reflet {

namespace {

using namespace importers;
using namespace footprints;
using extrusion::Building;

constexpr std::size_t kMostPoints = 60'000'000;
constexpr std::size_t kInAPiece = 8192;  // features

/// Where the layers of a file lie, and whether what they say about it can be true.
struct Whereabouts {
    std::optional<std::string> declared;  ///< as the builder wants it
    std::optional<Crs> crs;
    bool northFirst = false;
};

class FootprintImport {
public:
    FootprintImport(VectorFile& file, CityBuilder& builder, std::string subject)
        : m_file(file), m_builder(builder), m_subject(std::move(subject)) {}

    Result<void> run(const JobContext& job) {
        for (const auto stage :
             {&FootprintImport::chooseLayers, &FootprintImport::measure, &FootprintImport::place,
              &FootprintImport::build, &FootprintImport::account}) {
            if (auto done = (this->*stage)(job); !done)
                return done;
        }
        return {};
    }

private:
    struct Layer {
        std::size_t index = 0;
        HeightReader heights;
    };

    Result<void> chooseLayers(const JobContext& job);
    Result<void> measure(const JobContext& job);
    Result<void> place(const JobContext& job);
    Result<void> build(const JobContext& job);
    Result<void> account(const JobContext& job);

    Result<void> forEachFeature(const Layer& layer, bool withFields, const VectorFile::Sink& sink);
    [[nodiscard]] Building buildingOf(const AreaFeature& feature, Layer& layer);
    [[nodiscard]] std::string idOf(const AreaFeature& feature, const Layer& layer);
    Result<void> flush(const JobContext& job);
    void note(Severity severity, const char* code, std::string text, const char* remedy = "") {
        m_builder.fileDiagnostics().push_back({severity, code, "", std::move(text), remedy});
    }

    VectorFile& m_file;
    CityBuilder& m_builder;
    std::string m_subject;
    std::vector<Layer> m_layers;
    Box m_box;
    Extent m_extent;
    std::size_t m_features = 0;
    std::size_t m_points = 0;
    Whereabouts m_where;
    extrusion::MetricScale m_metres{std::nullopt};
    std::unordered_set<std::string> m_ids;
    std::vector<Building> m_pending;
    std::size_t m_heights = 0;  ///< features that could have one
};

Result<void> FootprintImport::chooseLayers(const JobContext& /*job*/) {
    std::optional<std::string> crs;
    for (std::size_t i = 0; i < m_file.layers().size(); ++i) {
        const VectorLayer& layer = m_file.layers()[i];
        if (!layer.mayHaveAreas) {
            note(Severity::Info, "layer-without-areas",
                 fmt::format("the layer {:.80} has no polygons and was left out", layer.name));
            continue;
        }
        auto fields = chooseFields(layer.fields, m_builder.options(), m_subject);
        if (!fields)
            return tl::unexpected(fields.error());
        if (!m_layers.empty() && layer.crs != m_file.layers()[m_layers.front().index].crs)
            return fail(ErrorCode::Refused, "has layers in different coordinate reference systems",
                        m_subject, "Export each layer to a file of its own.");
        m_layers.push_back({i, HeightReader(*std::move(fields), m_builder.options())});
    }
    if (m_layers.empty())
        return fail(ErrorCode::Unreadable, "has no layer with polygons", m_subject,
                    "Choose a file with the footprints of buildings.");
    return {};
}

Result<void> FootprintImport::forEachFeature(const Layer& layer, bool withFields,
                                             const VectorFile::Sink& sink) {
    const auto fields = withFields ? layer.heights.fields() : std::vector<std::size_t>{};
    const auto damage = m_file.readAreas(layer.index, fields, sink);
    if (!damage)
        return tl::unexpected(damage.error());
    if (withFields && !damage->empty())
        note(Severity::Warning, "damaged-file",
             fmt::format("while reading, GDAL reports: {:.200}", *damage),
             "Write the file anew, e.g. with QGIS.");
    return {};
}

/// A first pass: how much there is, and where.
Result<void> FootprintImport::measure(const JobContext& job) {
    for (const Layer& layer : m_layers) {
        auto read = forEachFeature(layer, false, [&](AreaFeature&& feature) {
            ++m_features;
            m_points += feature.points;
            for (const PlanPolygon& polygon : feature.polygons) {
                for (const glm::dvec2& p : polygon.rings.front()) {
                    if (std::isfinite(p.x) && std::isfinite(p.y))
                        m_box.add(glm::dvec3(p, 0.0));
                    m_extent.add(glm::dvec3(p, 0.0));
                }
            }
            return m_points <= kMostPoints && !job.cancelled();
        });
        if (!read)
            return read;
    }
    if (job.cancelled())
        return tl::unexpected(JobContext::cancelledError());
    if (m_points > kMostPoints)
        return fail(ErrorCode::ResourceLimit, "has more than 60 million points", m_subject,
                    "Cut out the part that you need, e.g. with QGIS or ogr2ogr -clipsrc.");
    return {};
}

Result<void> FootprintImport::place(const JobContext& /*job*/) {
    const VectorLayer& first = m_file.layers()[m_layers.front().index];
    const std::optional<std::string> declared = layerCrs(first, m_box, m_builder.options());
    // The builder will say all that is to be said; here it matters where east is, for solids have
    // an inside.
    std::vector<Diagnostic> unsaid;
    auto crs = sourceCrs(declared, m_builder.options(), m_builder.purpose() == Purpose::Inspect,
                         m_subject, unsaid);
    if (!crs)
        return tl::unexpected(crs.error());
    checkAxes(m_extent.middle(), AxisOrder::EastNorth, m_builder.options().axisOrder, *crs, unsaid);
    m_where = {declared, crs->crs, crs->swapAxes};
    if (m_where.northFirst) {
        m_extent.swapAxes();
        note(Severity::Info, "axis-order",
             m_builder.options().axisOrder.empty()
                 ? "the coordinates have the latitude first and were read that way"
                 : "the coordinates were read with north first, as was asked");
    }
    m_metres = extrusion::MetricScale(m_where.crs);
    if (first.assumedCrs)
        m_builder.crsIsOfFormat();
    return m_builder.place(declared, AxisOrder::Settled, m_extent);
}

std::string FootprintImport::idOf(const AreaFeature& feature, const Layer& layer) {
    std::string id(layer.heights.id(feature));
    if (id.empty() || m_ids.contains(id)) {
        const std::string number = std::to_string(feature.number);
        id = id.empty() ? number : fmt::format("{} ({})", id, number);
        if (m_ids.contains(id))
            id = fmt::format("{}/{}", m_file.layers()[layer.index].name, id);
    }
    m_ids.insert(id);
    return id;
}

Building FootprintImport::buildingOf(const AreaFeature& feature, Layer& layer) {
    Building building;
    building.outline.id = idOf(feature, layer);
    building.outline.type = CityObjectType::Building;
    building.outline.typeName = "Building";
    if (feature.kind != AreaFeature::Kind::Areas) {
        const bool none = feature.kind == AreaFeature::Kind::NoGeometry;
        building.notes.emplace_back(Issue::NoArea, none ? "it has no geometry that can be read"
                                                        : "it is a point or a line");
        return building;
    }
    std::string problem;
    bool repaired = feature.unclosed;
    if (feature.unclosed)
        problem = "a ring does not end where it begins";
    for (const PlanPolygon& polygon : feature.polygons) {
        MendedPolygons mended = mendPolygon(m_where.northFirst ? turned(polygon) : polygon);
        repaired = repaired || mended.repaired || mended.polygons.empty();
        if (!mended.problem.empty())
            problem = mended.problem;
        std::move(mended.polygons.begin(), mended.polygons.end(),
                  std::back_inserter(building.polygons));
    }
    if (building.polygons.empty())
        building.notes.emplace_back(Issue::NoArea, problem);
    else if (repaired)
        building.notes.emplace_back(Issue::FootprintMended, problem);
    layer.heights.read(feature, m_metres, building);
    return building;
}

Result<void> FootprintImport::flush(const JobContext& job) {
    CityPiece piece = pieceOf(m_builder, std::exchange(m_pending, {}), m_metres);
    return m_builder.add(std::move(piece), job);
}

Result<void> FootprintImport::build(const JobContext& job) {
    std::size_t done = 0;
    Result<void> added;
    for (Layer& layer : m_layers) {
        auto read = forEachFeature(layer, true, [&](AreaFeature&& feature) {
            m_pending.push_back(buildingOf(feature, layer));
            ++done;
            if (m_pending.size() == kInAPiece) {
                job.progress(double(done) / double(std::max<std::size_t>(m_features, 1)));
                added = flush(JobContext({}, job.stopToken()));
            }
            return added && !job.cancelled();
        });
        if (!read)
            return read;
        if (!added)
            return added;
    }
    if (job.cancelled())
        return tl::unexpected(JobContext::cancelledError());
    return flush(JobContext({}, job.stopToken()));
}

/// Tells where the heights came from, and for how many there were none.
Result<void> FootprintImport::account(const JobContext& /*job*/) {
    HeightTally all;
    std::string sources;
    for (const Layer& layer : m_layers) {
        all.add(layer.heights.tally());
        if (!layer.heights.described().empty())
            sources += (sources.empty() ? "" : "; ") + layer.heights.described();
    }
    if (!sources.empty())
        note(Severity::Info, "heights-from", "heights come from: " + sources,
             "Choose another attribute with --height-field, or where the window shows the model.");
    if (all.unreadable > 0)
        note(Severity::Warning, "height-unreadable",
             fmt::format("{} heights are no numbers of metres, such as \"{:.40}\"", all.unreadable,
                         all.example),
             "Choose another attribute with --height-field, or where the window shows the model.");
    if (all.assumed == 0)
        return {};
    const std::string text =
        fmt::format("{} of {} buildings say nothing of their height: {:g} m was taken", all.assumed,
                    all.buildings, HeightReader::defaultHeight(m_builder.options()));
    constexpr const char* kRemedy =
        "Name the attribute with --height-field, or give a height with --default-height, or do "
        "so where the window shows the model.";
    if (m_builder.options().strict)
        return fail(ErrorCode::Refused, text + ", which --strict does not allow", m_subject,
                    kRemedy);
    note(Severity::Warning, "height-assumed", text, kRemedy);
    return {};
}

Result<Imported<CityImport>> run(Purpose purpose, Result<VectorFile> file, std::size_t bytes,
                                 const std::filesystem::path& path, const ImportOptions& options,
                                 const JobContext& job) {
    if (!file)
        return tl::unexpected(file.error());
    if (trees::looksLikeRegister(*file))
        return trees::importRegister(purpose, *file, bytes, path, options, job);
    CityBuilder builder(purpose, path, options, bytes);
    FootprintImport import(*file, builder, path.string());
    if (auto done = import.run(job); !done)
        return tl::unexpected(done.error());
    auto result = builder.finish();
    if (result)
        result->value.summary.format = file->format();
    job.progress(1.0);
    return result;
}

Result<Imported<CityImport>> runFile(Purpose purpose, const std::filesystem::path& path,
                                     const ImportOptions& options, const JobContext& job) {
    std::error_code failed;
    const std::uintmax_t size = std::filesystem::file_size(path, failed);
    if (!failed && size > options.maxFileBytes)
        return fail(ErrorCode::ResourceLimit,
                    fmt::format("is larger than the limit of {} bytes", options.maxFileBytes),
                    path.string(), "Cut out the part that you need, e.g. with QGIS.");
    return run(purpose, VectorFile::open(path), failed ? 0 : std::size_t(size), path, options, job);
}

}  // namespace

Result<Imported<CityImport>> importFootprints(const std::filesystem::path& path,
                                              const ImportOptions& options, const JobContext& job) {
    return runFile(Purpose::Import, path, options, job);
}

Result<Imported<CityImport>> importFootprintBytes(std::string_view bytes,
                                                  const std::filesystem::path& name,
                                                  const ImportOptions& options,
                                                  const JobContext& job) {
    return run(Purpose::Import, VectorFile::open(bytes, name.filename().string()), bytes.size(),
               name, options, job);
}

Result<Imported<SourceSummary>> inspectFootprints(const std::filesystem::path& path,
                                                  const ImportOptions& options,
                                                  const JobContext& job) {
    return summaryOnly(runFile(Purpose::Inspect, path, options, job));
}

}  // namespace reflet
