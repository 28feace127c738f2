// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Validate.h"

#include "app/pipeline/LoadedCity.h"
#include "app/pipeline/Traffic.h"
#include "core/base/Files.h"
#include "core/project/ProjectFile.h"

#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include <algorithm>

namespace reflet {

namespace {

using nlohmann::json;
using Adapter = valijson::adapters::NlohmannJsonAdapter;

constexpr std::size_t kLargestProject = std::size_t(256) << 20;
constexpr std::size_t kMostFindings = 100;

/// "/probes/0/position" of valijson's "<root>[probes][0][position]".
std::string pointerOf(const std::vector<std::string>& context) {
    std::string pointer;
    for (std::size_t i = 1; i < context.size(); ++i) {
        std::string part = context[i];
        std::erase_if(part, [](char c) { return c == '[' || c == ']'; });
        pointer += "/" + part;
    }
    return pointer.empty() ? "/" : pointer;
}

void checkSchema(const json& document, std::vector<Diagnostic>& findings) {
    const json schemaDocument = json::parse(projectSchema());
    valijson::Schema schema;
    valijson::SchemaParser().populateSchema(Adapter(schemaDocument), schema);
    valijson::ValidationResults results;
    valijson::Validator(valijson::Validator::kStrongTypes)
        .validate(schema, Adapter(document), &results);
    valijson::ValidationResults::Error error;
    while (findings.size() < kMostFindings && results.popError(error)) {
        findings.push_back({Severity::Error, "schema", pointerOf(error.context), error.description,
                            "See resources/schema/reflet-project-1.schema.json."});
    }
}

void checkFiles(const Project& project, const std::filesystem::path& folder,
                std::vector<Diagnostic>& findings) {
    for (const auto& model : project.models) {
        const auto path = modelPath(model, folder);
        const auto hash = fileHash(path);
        if (!hash) {
            findings.push_back({Severity::Error, "model-missing", path.string(), hash.error().what,
                                "Put the file back, or import it anew."});
        } else if (!model.hash.empty() && *hash != model.hash) {
            findings.push_back(
                {Severity::Warning, "model-changed", path.string(),
                 "The file is not the one that was imported; probes will be baked again.",
                 "Import it anew to accept the change."});
        }
    }
    for (const auto& vehicle : project.vehicles) {
        const auto path = vehiclePath(vehicle, folder);
        const auto hash = fileHash(path);
        if (!hash) {
            findings.push_back({Severity::Error, "vehicle-missing", path.string(),
                                hash.error().what, "Put the file back, or bring it in again."});
        } else if (!vehicle.hash.empty() && *hash != vehicle.hash) {
            findings.push_back({Severity::Error, "vehicle-changed", path.string(),
                                "The file is not the one that was brought in.",
                                "Bring it in again to accept the change."});
        }
    }
}

}  // namespace

Result<ValidationReport> validateProject(const std::filesystem::path& path) {
    const auto text = readFile(path, kLargestProject);
    if (!text)
        return tl::unexpected(text.error());
    const json document = json::parse(*text, nullptr, false);
    if (document.is_discarded()) {
        return fail(ErrorCode::Unreadable, "this is not JSON, or it is cut off", path.string(),
                    "Take the file from a backup.");
    }
    ValidationReport report;
    try {
        checkSchema(document, report.findings);
    } catch (const std::exception& e) {
        return fail(ErrorCode::Internal,
                    std::string("the schema could not be applied: ") + e.what(), path.string());
    }
    const auto project = projectFromJson(*text, path.string());
    if (project) {
        checkFiles(*project, std::filesystem::absolute(path).parent_path(), report.findings);
    } else {
        report.findings.push_back(
            {Severity::Error, "project", "", project.error().what, project.error().remedy});
    }
    report.valid =
        std::none_of(report.findings.begin(), report.findings.end(),
                     [](const Diagnostic& finding) { return finding.severity == Severity::Error; });
    return report;
}

}  // namespace reflet
