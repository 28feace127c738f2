// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/ImportReportJson.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <unordered_map>

namespace reflet {

using nlohmann::json;

namespace {

json optionalText(const std::optional<std::string>& text) {
    return text ? json(*text) : json();
}

json triple(const glm::dvec3& v) {
    return json::array({v.x, v.y, v.z});
}

json crsJson(const SourceSummary& summary) {
    const CrsAccount& account = summary.crsAccount;
    json out{{"horizontal", optionalText(summary.crsHorizontal)},
             {"vertical", optionalText(summary.crsVertical)},
             {"written", optionalText(account.written)},
             {"rule", toString(account.rule)},
             {"operation", nullptr}};
    if (!account.operation.empty()) {
        // One that is a mere guess (ballpark) is refused, never used.
        out["operation"] = {{"name", account.operation},
                            {"accuracy", account.accuracy ? json(*account.accuracy) : json()},
                            {"ballpark", false}};
    }
    return out;
}

json remarksJson(const FileReport& report) {
    json out = json::array();
    for (std::size_t i = 0; i < report.diagnostics.size(); ++i) {
        json remark = remarkJson(report.diagnostics[i]);
        if (const ObjectAccount* account = report.accountOf(i)) {
            remark["type"] = account->type;
            remark["lod"] = account->lod.empty() ? json() : json(account->lod);
            remark["result"] = toString(account->result);
        }
        out.push_back(std::move(remark));
    }
    return out;
}

json accountJson(const FileReport& report, const ObjectAccount& account) {
    json remarks = json::array();
    for (std::size_t i = 0; i < account.remarks; ++i)
        remarks.push_back(remarkJson(report.diagnostics[account.firstRemark + i]));
    return {{"id", account.id},
            {"type", account.type},
            {"lod", account.lod.empty() ? json() : json(account.lod)},
            {"result", toString(account.result)},
            {"remarks", std::move(remarks)}};
}

/// One for each object of the file that was asked for.
json accountsJson(const FileReport& report, std::span<const CityObject> objects) {
    std::unordered_map<std::string, const ObjectAccount*> known;
    for (const ObjectAccount& account : report.summary.remarked) {
        if (account.result != ObjectResult::Skipped)
            known.emplace(account.id, &account);
    }
    json out = json::array();
    const std::size_t end =
        std::min(objects.size(), std::size_t(report.firstObject) + report.objectCount);
    for (std::size_t i = report.firstObject; i < end; ++i) {
        const CityObject& object = objects[i];
        const auto found = known.find(object.id);
        out.push_back(found != known.end()
                          ? accountJson(report, *found->second)
                          : accountJson(report, {object.id, object.typeName, object.lod,
                                                 ObjectResult::Loaded, 0, 0}));
    }
    for (const ObjectAccount& account : report.summary.remarked) {
        if (account.result == ObjectResult::Skipped)
            out.push_back(accountJson(report, account));
    }
    return out;
}

}  // namespace

json remarkJson(const Diagnostic& remark) {
    return {{"severity", toString(remark.severity)},
            {"code", remark.code},
            {"object", remark.object},
            {"text", remark.text},
            {"remedy", remark.remedy}};
}

json groundFitJson(const std::optional<GroundFit>& fit) {
    return fit ? json{{"median", fit->median}, {"buildings", fit->buildings}} : json();
}

json fileReportJson(const FileReport& report) {
    const SourceSummary& s = report.summary;
    json out;
    out["file"] = report.file;
    out["format"] = s.format;
    out["version"] = s.version;
    out["crs"] = crsJson(s);
    out["objects"] = s.objects;
    out["byType"] = s.byType;
    out["lods"] = s.lods;
    out["surfaces"] = s.surfaces;
    out["triangles"] = s.triangles;
    out["instances"] = {{"count", s.instances}, {"triangles", s.instanceTriangles}};
    out["vertices"] = s.vertices;
    out["bounds"] = s.bounds.empty()
                        ? json()
                        : json{{"min", triple(s.bounds.min)}, {"max", triple(s.bounds.max)}};
    if (!s.raster.empty()) {
        out["raster"] = json::array();
        for (const RasterSize& raster : s.raster)
            out["raster"].push_back(
                {{"columns", raster.columns}, {"rows", raster.rows}, {"bands", raster.bands}});
    }
    out["textures"] = {{"referenced", s.texturesReferenced},
                       {"resolved", s.texturesResolved},
                       {"missing", s.texturesMissing}};
    out["counts"] = {{"loaded", report.counts.loaded},
                     {"repaired", report.counts.repaired},
                     {"skipped", report.counts.skipped}};
    out["seconds"] = report.seconds;
    out["peakMemory"] = report.peakMemory == 0 ? json() : json(report.peakMemory);
    out["diagnostics"] = remarksJson(report);
    return out;
}

std::string importReportText(const ImportAccount& account) {
    json out;
    out["schema"] = "reflet-import-report";
    out["schemaVersion"] = kImportReportVersion;
    out["project"] = account.project;
    out["crs"] = {{"horizontal", optionalText(account.frame.crs)},
                  {"vertical", optionalText(account.frame.vertical)}};
    out["origin"] = triple(account.frame.origin);
    out["groundFit"] = groundFitJson(account.groundFit);
    out["generatedGround"] = account.generatedGround;
    out["remarks"] = json::array();
    for (const Diagnostic& remark : account.remarks)
        out["remarks"].push_back(remarkJson(remark));
    out["files"] = json::array();
    for (const FileReport& report : account.files) {
        json file = fileReportJson(report);
        file["accounts"] = accountsJson(report, account.objects);
        out["files"].push_back(std::move(file));
    }
    // Ids and names come from strangers: what is no UTF-8 is replaced.
    return out.dump(2, ' ', false, json::error_handler_t::replace) + '\n';
}

}  // namespace reflet
