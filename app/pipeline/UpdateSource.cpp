// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/UpdateSource.h"

#include "app/pipeline/Bake.h"
#include "core/base/ParallelFor.h"
#include "core/environment/BoxesSeen.h"
#include "importers/cityjson/CityJsonAttributes.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

namespace reflet {

namespace {

constexpr double kTouch = 0.5;  // metres around an object: its foot, its contact shadow

const char* toString(AffectedProbe::Why why) {
    switch (why) {
        case AffectedProbe::Why::Sees:
            return "sees";
        case AffectedProbe::Why::Lit:
            return "lit";
        case AffectedProbe::Why::Near:
            break;
    }
    return "near";
}

std::string modelNames(const Project& project) {
    std::string names;
    for (const ModelReference& model : project.models)
        names += (names.empty() ? "" : ", ") + model.path;
    return names;
}

Result<std::size_t> findModel(const Project& project, const std::string& name) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < project.models.size(); ++i) {
        const ModelReference& model = project.models[i];
        const bool only = name.empty() && model.use == ModelUse::City;
        if (model.path == name)
            return i;
        if (only || std::filesystem::path(model.path).filename() == name)
            found.push_back(i);
    }
    if (found.size() == 1)
        return found.front();
    const char* what =
        found.empty() ? "the project has no model of that name" : "several models could be meant";
    return fail(ErrorCode::Usage, what, name,
                fmt::format("Name one of them by its path: {}.", modelNames(project)));
}

/// Why two files cannot be deliveries of one model; nullopt when they can.
std::optional<tl::unexpected<Error>> mismatch(const SourceSummary& was, const SourceSummary& is,
                                              const std::string& subject) {
    if (was.crsHorizontal == is.crsHorizontal)
        return std::nullopt;
    const std::string none = "no coordinate reference system";
    return fail(ErrorCode::Refused,
                fmt::format("is in {:.80}, but the model that it shall replace is in {:.80}",
                            is.crsHorizontal.value_or(none), was.crsHorizontal.value_or(none)),
                subject,
                "Ask for a delivery in the same system, or make a project of its own of the file "
                "with `reflet-cli import`.");
}

/// The places that changes take or have left, and whose they are.
struct ChangedBoxes {
    std::vector<Box> boxes;
    std::vector<const ObjectChange*> changes;
};

ChangedBoxes boxesOf(const std::vector<ObjectChange>& changes) {
    ChangedBoxes out;
    for (const ObjectChange& change : changes) {
        const bool seen =
            change.kind != ObjectChange::Kind::Changed || change.geometry || change.appearance;
        for (const Box* box : {&change.before, &change.after}) {
            if (!seen || box->empty())
                continue;
            out.boxes.push_back(*box);
            out.boxes.back().min -= glm::dvec3(kTouch);
            out.boxes.back().max += glm::dvec3(kTouch);
            out.changes.push_back(&change);
        }
    }
    return out;
}

double distanceInPlan(const glm::dvec3& p, const Box& box) {
    const double x = std::max({box.min.x - p.x, 0.0, p.x - box.max.x});
    const double y = std::max({box.min.y - p.y, 0.0, p.y - box.max.y});
    return std::hypot(x, y);
}

/// The index of the box nearest to a probe without a map, within kNearChange.
std::optional<std::size_t> nearestTo(const glm::dvec3& position, const std::vector<Box>& boxes) {
    std::optional<std::size_t> nearest;
    double least = kNearChange;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const double distance = distanceInPlan(position, boxes[i]);
        if (distance <= least) {
            least = distance;
            nearest = i;
        }
    }
    return nearest;
}

/// The first of the boxes that light comes from to what the probe's map shows.
std::optional<std::size_t> lightOf(const PreparedCity& city, const Probe& probe,
                                   const std::vector<Box>& boxes) {
    const auto sight = sightOf(city, probe);
    const auto touched = std::find_if(boxes.begin(), boxes.end(), [&](const Box& box) {
        return sight && sight->seen.touches(box);
    });
    return touched == boxes.end() ? std::nullopt
                                  : std::optional(std::size_t(touched - boxes.begin()));
}

std::optional<AffectedProbe> affectedBy(const PreparedCity& city, const Probe& probe,
                                        const ChangedBoxes& changed) {
    using enum AffectedProbe::Why;
    AffectedProbe::Why why = Near;
    std::optional<std::size_t> which;
    if (const RemSet::Pointer map = cachedRem(city, probe)) {
        why = Sees;
        which = nearestBoxSeen(*map, changed.boxes);
        if (!which) {
            why = Lit;
            which = lightOf(city, probe, changed.boxes);
        }
    } else {
        which = nearestTo(city.inFrame(probe.position), changed.boxes);
    }
    return which ? std::optional(AffectedProbe{probe.id, why, changed.changes[*which]->id})
                 : std::nullopt;
}

Result<Imported<CityImport>> readAs(const ModelReference& model, const std::filesystem::path& file,
                                    const ProjectFrame& frame, const JobContext& job) {
    return importPlaced(model, importOptionsOf(model, frame), [&](const ImportOptions& options) {
        return importFile(file, options, job);
    });
}

std::optional<AttributeHashes> attributesOf(const std::filesystem::path& file,
                                            const SourceSummary& summary) {
    const bool sequence = summary.format == "CityJSONSeq";
    if (!sequence && summary.format != "CityJSON")
        return std::nullopt;
    auto hashes = cityJsonAttributes(file, sequence, ImportOptions{}.maxFileBytes);
    return hashes ? std::optional(std::move(*hashes)) : std::nullopt;
}

/// Marks the objects that both cities have and whose attributes differ.
void compareAttributes(const AttributeHashes& was, const AttributeHashes& is, const CityModel& city,
                       CityChanges& changes) {
    const auto valueIn = [](const AttributeHashes& hashes, const std::string& id) {
        const auto found = hashes.find(id);
        return found == hashes.end() ? 0 : found->second;
    };
    std::unordered_map<std::string, ObjectChange*> known;
    for (ObjectChange& change : changes.objects)
        known.emplace(change.id, &change);
    std::vector<ObjectChange> more;
    for (const CityObject& object : city.objects) {
        if (valueIn(was, object.id) == valueIn(is, object.id))
            continue;
        const auto found = known.find(object.id);
        if (found == known.end()) {
            more.push_back({ObjectChange::Kind::Changed,
                            object.id,
                            object.typeName,
                            false,
                            false,
                            false,
                            true,
                            {},
                            {}});
            --changes.unchanged;
        } else if (found->second->kind == ObjectChange::Kind::Changed) {
            found->second->attributes = true;
        }
    }
    changes.objects.insert(changes.objects.end(), more.begin(), more.end());
    changes.sort();
}

}  // namespace

std::vector<AffectedProbe> affectedProbes(const PreparedCity& before,
                                          const std::vector<ObjectChange>& changes,
                                          const JobContext& job) {
    const ChangedBoxes changed = boxesOf(changes);
    const auto& probes = before.project().probes;
    std::vector<std::optional<AffectedProbe>> found(probes.size());
    parallelFor(0, probes.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last && !job.cancelled(); ++i) {
            found[i] = affectedBy(before, probes[i], changed);
        }
    });
    std::vector<AffectedProbe> affected;
    for (auto& one : found) {
        if (one)
            affected.push_back(std::move(*one));
    }
    return affected;
}

Result<SourceUpdate> updateSource(const PreparedCity& before, const std::string& name,
                                  const std::filesystem::path& file, const JobContext& job) {
    const Project& project = before.project();
    const auto index = findModel(project, name);
    if (!index)
        return tl::unexpected(index.error());
    const ModelReference& model = project.models[*index];
    if (model.use != ModelUse::City)
        return fail(ErrorCode::Refused, "has no city objects that could be compared", model.path,
                    "Replace terrain and orthophotos by locating the file anew, or import again.");
    const auto hash = fileHash(file);
    if (!hash)
        return tl::unexpected(hash.error());
    const std::filesystem::path old = modelPath(model, before.folder());
    SourceUpdate update;
    update.project = project;
    update.model = update.file = model.path;
    std::error_code failed;
    if (std::filesystem::equivalent(old, file, failed) && !model.hash.empty() &&
        model.hash != *hash)
        return fail(ErrorCode::Refused,
                    "was written over the delivery that the project had: what has changed cannot "
                    "be told any more",
                    file.string(),
                    "Put the new delivery beside the old one and name it here, or open the project "
                    "and use the file as it is.");
    const auto oldHash = fileHash(old);
    if (oldHash && *oldHash == *hash) {
        update.sameFile = true;
        return update;
    }
    const auto was = readAs(model, old, project.frame, job.phase("the old delivery", 0.0, 0.4));
    if (!was)
        return tl::unexpected(was.error());
    auto is = readAs(model, file, project.frame, job.phase("the new delivery", 0.4, 0.8));
    if (!is)
        return tl::unexpected(is.error());
    if (auto no = mismatch(was->value.summary, is->value.summary, file.string()))
        return *no;
    update.changes = changesBetween(was->value.city, is->value.city);
    if (update.changes.common == 0)
        return fail(ErrorCode::Refused,
                    "has no object in common with the model that it shall replace: it is another "
                    "city, or its objects have other ids",
                    file.string(), "Add it to the project, or make a project of its own of it.");
    const auto wasTold = attributesOf(old, was->value.summary);
    const auto isTold = attributesOf(file, is->value.summary);
    if (wasTold && isTold) {
        update.attributesCompared = true;
        compareAttributes(*wasTold, *isTold, is->value.city, update.changes);
    }
    auto relocated = relocateModel(update.project, model.path, file, before.folder());
    if (!relocated)
        return tl::unexpected(relocated.error());
    update.project = std::move(*relocated);
    update.file = update.project.models[*index].path;
    update.diagnostics = std::move(is->diagnostics);
    update.probes =
        affectedProbes(before, update.changes.objects, job.phase("looking at probes", 0.8, 1.0));
    if (job.cancelled())
        return tl::unexpected(JobContext::cancelledError());
    return update;
}

nlohmann::json updateJson(const SourceUpdate& update) {
    using nlohmann::json;
    json out{{"model", update.model},
             {"file", update.file},
             {"sameFile", update.sameFile},
             {"unchanged", update.changes.unchanged},
             {"attributesCompared", update.attributesCompared},
             {"added", json::array()},
             {"removed", json::array()},
             {"changed", json::array()},
             {"probes", json::array()}};
    for (const ObjectChange& change : update.changes.objects) {
        json item{{"id", change.id}, {"type", change.type}};
        if (change.kind == ObjectChange::Kind::Changed) {
            item["geometry"] = change.geometry;
            item["appearance"] = change.appearance;
            item["description"] = change.description;
            item["attributes"] = change.attributes;
        }
        out[toString(change.kind)].push_back(std::move(item));
    }
    for (const AffectedProbe& probe : update.probes)
        out["probes"].push_back(
            {{"id", probe.id}, {"why", toString(probe.why)}, {"object", probe.object}});
    return out;
}

}  // namespace reflet
