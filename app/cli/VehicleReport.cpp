// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/VehicleReport.h"

#include "app/cli/Commands.h"
#include "app/cli/Reports.h"
#include "core/project/VehicleJson.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace reflet::cli {

namespace {

using nlohmann::json;

constexpr std::size_t kMaterialsShown = 12;

const char* roleText(PaintRole role) {
    switch (role) {
        case PaintRole::Paint:
            return "paint";
        case PaintRole::Glass:
            return "glass";
        case PaintRole::Dull:
            return "dull";
        case PaintRole::AsInFile:
            break;
    }
    return "as in file";
}

json toJson(const VehicleOffer& offer) {
    const GltfModel& model = *offer.model;
    const VehicleProposal& p = offer.proposal;
    const auto list = [](const glm::dvec3& v) { return json::array({v.x, v.y, v.z}); };
    json materials = json::array();
    for (const auto& paint : p.paint) {
        materials.push_back({{"name", paint.material},
                             {"role", roleText(paint.guess.role)},
                             {"share", paint.guess.share},
                             {"reason", paint.guess.reason}});
    }
    json vehicle{{"kind", toString(p.kind)},
                 {"length", p.length},
                 {"width", p.width},
                 {"height", p.height},
                 {"front", p.front},
                 {"frontCertain", p.frontCertain},
                 {"up", upText(p.model.up)},
                 {"scale", p.model.scale},
                 {"heading", p.model.heading * 180.0 / kPi},
                 {"offset", list(p.model.offset)},
                 {"coat", p.model.coat},
                 {"reflecting", {{"before", p.reflectingBefore}, {"after", p.reflectingAfter}}},
                 {"reasons",
                  {{"up", p.upReason},
                   {"size", p.sizeReason},
                   {"front", p.frontReason},
                   {"ground", p.groundReason},
                   {"paint", p.paintReason}}},
                 {"concerns", p.concerns}};
    return {{"format", "glTF"},
            {"version", "2.0"},
            {"file", p.model.path},
            {"triangles", model.fileTriangles},
            {"nodes", model.nodes},
            {"materials", materials},
            {"fileMaterials", model.fileMaterials},
            {"bounds", {{"min", list(model.bounds.min)}, {"max", list(model.bounds.max)}}},
            {"textures", {{"referenced", model.images}, {"resolved", model.imagesRead}}},
            {"vehicle", vehicle},
            {"diagnostics", cli::toJson(offer.remarks)}};
}

void print(const VehicleOffer& offer, const Console& console) {
    const GltfModel& model = *offer.model;
    const VehicleProposal& p = offer.proposal;
    console.text(fmt::format("{}: glTF 2.0, {} triangles, {} materials, {} nodes", p.model.path,
                             model.fileTriangles, model.fileMaterials, model.nodes));
    console.text(
        fmt::format("  a {}, {:.2f} m long, {:.2f} m wide, {:.2f} m high; drives towards "
                    "{} of the file",
                    toString(p.kind), p.length, p.width, p.height, p.front));
    for (const std::string* reason :
         {&p.sizeReason, &p.upReason, &p.frontReason, &p.groundReason, &p.paintReason})
        console.text("  " + *reason);
    for (std::size_t i = 0; i < p.paint.size() && i < kMaterialsShown; ++i) {
        const PaintProposal& paint = p.paint[i];
        console.text(fmt::format("    {:5.1f} %  {:<10}  {} ({})", 100.0 * paint.guess.share,
                                 roleText(paint.guess.role), paint.material, paint.guess.reason));
    }
    for (const auto& concern : p.concerns)
        console.note("Look: " + concern);
    for (const auto& remark : offer.remarks)
        console.note(remark);
}

}  // namespace

int reportVehicles(const std::vector<std::string>& files, const Console& console) {
    json reports = json::array();
    for (const auto& file : files) {
        const auto offer = proposeVehicle(file, console.job());
        if (!offer)
            return console.failed(offer.error());
        if (console.json()) {
            reports.push_back(toJson(*offer));
        } else {
            print(*offer, console);
        }
    }
    if (console.json())
        console.data(files.size() == 1 ? reports.front() : json{{"files", reports}});
    return kDone;
}

}  // namespace reflet::cli
