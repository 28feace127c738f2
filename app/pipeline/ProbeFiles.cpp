// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/ProbeFiles.h"

#include "core/base/Files.h"
#include "core/geo/Crs.h"
#include "core/io/PlaceTable.h"
#include "core/io/VectorFile.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

namespace reflet {

namespace {

using nlohmann::json;

constexpr std::size_t kLargestFile = std::size_t(64) << 20U;
constexpr std::size_t kMostProbes = PlaceTable::kMostPlaces;
constexpr unsigned kSmallestMap = 32, kLargestMap = 2048;  // texels, as in a project
constexpr std::size_t kMostSystems = 16;  // making a transformation takes some 10 ms

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

/// Probes of a file, and the CRS that each is in; "" = the project's.
struct Read {
    std::vector<ImportedProbe> probes;
    std::vector<std::string> systems;

    void add(ImportedProbe probe, std::string system) {
        probes.push_back(std::move(probe));
        systems.push_back(std::move(system));
    }
};

tl::unexpected<Error> tooMany(const std::string& subject) {
    return fail(ErrorCode::ResourceLimit, fmt::format("it has more than {} probes", kMostProbes),
                subject, "Keep only those that belong to the project.");
}

Result<Read> fromTable(const std::string& text, const std::string& subject,
                       std::vector<Diagnostic>& remarks) {
    auto table = readPlaceTable(text, subject);
    if (!table)
        return tl::unexpected(table.error());
    remarks.insert(remarks.end(), table->remarks.begin(), table->remarks.end());
    Read read;
    for (const TablePlace& row : table->places)
        read.add({row.id, glm::dvec3(row.place, row.height.value_or(std::nan(""))), std::nullopt,
                  fmt::format("line {}", row.line)},
                 row.crs);
    return read;
}

/// The fields of a layer that tell of probes.
struct Fields {
    std::vector<std::size_t> indices;              ///< to be read
    std::optional<std::size_t> id, height, layer;  ///< into indices

    explicit Fields(const VectorLayer& source) {
        find(source, {"id", "name", "probe"}, id);
        find(source, {"height", "up", "z"}, height);
        find(source, {"layer"}, layer);
    }
    [[nodiscard]] static std::string value(const PointFeature& feature,
                                           std::optional<std::size_t> field) {
        return field ? feature.values[*field] : std::string();
    }

private:
    void find(const VectorLayer& source, std::initializer_list<const char*> names,
              std::optional<std::size_t>& out) {
        for (const char* name : names) {
            for (std::size_t k = 0; k < source.fields.size() && !out; ++k) {
                if (lower(source.fields[k]) != name)
                    continue;
                out = indices.size();
                indices.push_back(k);
            }
        }
    }
};

bool plainlyNoDegrees(const std::vector<ImportedProbe>& probes, std::size_t first) {
    return std::any_of(probes.begin() + std::ptrdiff_t(first), probes.end(), [](const auto& p) {
        return std::abs(p.position.x) > 180.0 || std::abs(p.position.y) > 90.0;
    });
}

/// Height by the point, else by the attribute.
double heightOf(const glm::dvec3& place, const std::string& attribute) {
    if (!std::isnan(place.z))
        return place.z;
    char* end = nullptr;
    const double height = std::strtod(attribute.c_str(), &end);
    const bool known = !attribute.empty() && *end == '\0' && std::isfinite(height);
    return known ? height : std::nan("");
}

Result<void> takeLayer(VectorFile& file, std::size_t index, const ProjectFrame& frame, Read& read,
                       const std::string& subject, std::vector<Diagnostic>& remarks) {
    const VectorLayer& layer = file.layers()[index];
    const Fields fields(layer);
    const std::size_t first = read.probes.size();
    std::size_t others = 0;
    const auto said = file.readPoints(index, fields.indices, [&](const PointFeature& feature) {
        const std::string own = Fields::value(feature, fields.layer);
        const bool wanted = own.empty() || own == "probes";
        others += wanted && !feature.places.empty() ? 0 : 1;
        for (const glm::dvec3& place : feature.places) {
            if (!wanted)
                break;
            const double z = heightOf(place, Fields::value(feature, fields.height));
            read.add({Fields::value(feature, fields.id), glm::dvec3(place.x, place.y, z),
                      std::nullopt, fmt::format("feature {}", feature.number)},
                     {});
        }
        return read.probes.size() <= kMostProbes;
    });
    if (!said)
        return tl::unexpected(said.error());
    if (read.probes.size() > kMostProbes)
        return tooMany(subject);
    if (!said->empty())
        remarks.push_back({Severity::Warning, "file-damaged", layer.name, *said,
                           "Write the file anew, e.g. with QGIS."});
    if (others > 0)
        remarks.push_back({Severity::Warning, "shapes-skipped", layer.name,
                           fmt::format("{} shapes are no points, or of another layer; they were "
                                       "left out.",
                                       others),
                           "Save probes as points."});
    const bool own =
        !layer.crs || (layer.assumedCrs && (!frame.crs || plainlyNoDegrees(read.probes, first)));
    if (!own)
        std::fill(read.systems.begin() + std::ptrdiff_t(first), read.systems.end(), *layer.crs);
    return {};
}

Result<Read> fromVectors(Result<VectorFile> file, const ProjectFrame& frame,
                         const std::string& subject, std::vector<Diagnostic>& remarks) {
    if (!file)
        return tl::unexpected(file.error());
    const auto& layers = file->layers();
    const bool named = std::any_of(layers.begin(), layers.end(),
                                   [](const VectorLayer& l) { return l.name == "probes"; });
    Read read;
    for (std::size_t k = 0; k < layers.size(); ++k) {
        if (named ? layers[k].name != "probes" : !(layers[k].points || layers[k].mayHaveAreas))
            continue;
        if (auto taken = takeLayer(*file, k, frame, read, subject, remarks); !taken)
            return tl::unexpected(taken.error());
    }
    return read;
}

Result<Read> fromProject(const std::string& text, const std::string& subject) {
    const auto project = projectFromJson(text, subject);
    if (!project)
        return tl::unexpected(project.error());
    Read read;
    for (const Probe& probe : project->probes)
        read.add({probe.id, probe.position, probe.resolution, probe.id},
                 project->frame.crs.value_or(""));
    return read;
}

/// The probes of `suggest --json` or `probes export`.
Result<Read> fromOwnJson(const json& root, const std::string& subject,
                         std::vector<Diagnostic>& remarks) {
    const json crs = root.value("crs", json());
    Read read;
    std::size_t number = 0;
    for (const json& item : root.at("probes")) {
        const std::string where = fmt::format("probes/{}", number++);
        const json place = item.is_object() ? item.value("position", json()) : json();
        const bool numbers =
            place.is_array() && (place.size() == 2 || place.size() == 3) &&
            std::all_of(place.begin(), place.end(), [](const json& v) { return v.is_number(); });
        if (!numbers) {
            remarks.push_back({Severity::Warning, "probe-skipped", where,
                               "It has no position of three numbers; it was left out.", ""});
            continue;
        }
        const json id = item.value("id", json());
        const double z = place.size() == 3 ? place[2].get<double>() : std::nan("");
        const json edge = item.value("resolution", json());
        std::optional<int> resolution;
        if (edge.is_number_unsigned() && edge >= kSmallestMap && edge <= kLargestMap)
            resolution = edge.get<int>();
        read.add({id.is_string() ? id.get<std::string>() : "",
                  glm::dvec3(place[0].get<double>(), place[1].get<double>(), z), resolution, where},
                 crs.is_string() ? crs.get<std::string>() : "");
        if (read.probes.size() > kMostProbes)
            return tooMany(subject);
    }
    return read;
}

Result<Read> readAny(const std::filesystem::path& path, const ProjectFrame& frame,
                     std::vector<Diagnostic>& remarks) {
    const std::string subject = path.string();
    const std::string suffix = lower(path.extension().string());
    const bool table = suffix == ".csv" || suffix == ".txt" || suffix == ".tsv";
    const bool text = table || suffix == ".json" || suffix == ".reflet" || suffix == ".geojson";
    if (!text)
        return fromVectors(VectorFile::open(path), frame, subject, remarks);
    const auto bytes = readFile(path, kLargestFile);
    if (!bytes)
        return tl::unexpected(bytes.error());
    if (table)
        return fromTable(*bytes, subject, remarks);
    const json root = json::parse(*bytes, nullptr, false);
    const bool own = root.is_object() && root.contains("probes") && root["probes"].is_array();
    if (suffix == ".reflet" || (own && root.contains("models")))
        return fromProject(*bytes, subject);
    if (own)
        return fromOwnJson(root, subject, remarks);
    return fromVectors(VectorFile::open(*bytes, path.stem().string() + ".geojson"), frame, subject,
                       remarks);
}

/// Brings the probes of one system into the frame's; what has no image there is marked by NaN.
Result<void> transform(Read& read, const std::vector<std::size_t>& which, const std::string& system,
                       const ProjectFrame& frame) {
    if (!frame.crs)
        return fail(ErrorCode::Refused,
                    "its probes have a place on the Earth, and the project is in local metres", {},
                    "Give the project a coordinate reference system, or the probes the project's "
                    "own coordinates.");
    const auto from = Crs::parse(system);
    const auto to = Crs::parse(*frame.crs);
    if (!from || !to)
        return tl::unexpected(from ? to.error() : from.error());
    const auto transform = CrsTransform::create(*from, *to);
    if (!transform)
        return tl::unexpected(transform.error());
    std::vector<glm::dvec3> places;
    for (const std::size_t k : which)
        places.push_back(read.probes[k].position);
    for (glm::dvec3& place : places)  // heights are passed through, and need not be there
        place.z = 0.0;
    const bool all = transform->apply(places).has_value();
    for (std::size_t n = 0; n < which.size(); ++n) {
        glm::dvec3& position = read.probes[which[n]].position;
        if (!all) {
            const auto one = transform->apply(places[n]);
            places[n] = one ? *one : glm::dvec3(std::nan(""));
        }
        position = glm::dvec3(places[n].x, places[n].y, position.z);
    }
    return {};
}

Result<void> bringInto(Read& read, const ProjectFrame& frame, std::vector<Diagnostic>& remarks) {
    std::map<std::string, std::vector<std::size_t>> bySystem;
    for (std::size_t k = 0; k < read.probes.size(); ++k)
        if (!read.systems[k].empty())
            bySystem[read.systems[k]].push_back(k);
    if (bySystem.size() > kMostSystems)
        return fail(
            ErrorCode::ResourceLimit,
            fmt::format("its probes are in {} coordinate reference systems", bySystem.size()), {},
            "Bring them into one.");
    for (const auto& [system, which] : bySystem)
        if (auto done = transform(read, which, system, frame); !done)
            return done;
    std::erase_if(read.probes, [&](const ImportedProbe& probe) {
        const bool placed = std::isfinite(probe.position.x) && std::isfinite(probe.position.y);
        if (!placed)
            remarks.push_back({Severity::Warning, "probe-skipped", probe.where,
                               "It has no place in the project's system; it was left out.",
                               "Check its coordinates, and which system they are in."});
        return !placed;
    });
    return {};
}

}  // namespace

Result<std::vector<ImportedProbe>> readProbes(const std::filesystem::path& path,
                                              const ProjectFrame& frame,
                                              std::vector<Diagnostic>& remarks) {
    std::error_code failed;
    const auto size = std::filesystem::file_size(path, failed);
    if (!failed && size > kLargestFile)
        return fail(ErrorCode::ResourceLimit, "is larger than 64 MB", path.string(),
                    "Keep only the probes.");
    auto read = readAny(path, frame, remarks);
    if (!read)
        return tl::unexpected(read.error());
    if (read->probes.empty())
        return fail(ErrorCode::Unreadable, "it holds no place of a probe", path.string(),
                    "Give it a row or a point for each.");
    if (auto placed = bringInto(*read, frame, remarks); !placed) {
        Error error = placed.error();
        error.what = error.subject.empty() ? error.what : error.what + " (" + error.subject + ")";
        error.subject = path.string();
        return tl::unexpected(error);
    }
    return std::move(read->probes);
}

}  // namespace reflet
