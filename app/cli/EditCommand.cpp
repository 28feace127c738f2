// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Commands.h"
#include "app/pipeline/Edit.h"

#include <fmt/format.h>

namespace reflet::cli {

namespace {

/// "ID=REST" split at the first '='.
Result<std::pair<std::string, std::string>> splitAssignment(const std::string& text,
                                                            const std::string& option,
                                                            const std::string& form) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
        return fail(ErrorCode::Usage, "\"" + text + "\" is not understood", option,
                    "Write it as " + form + ".");
    }
    return std::pair(text.substr(0, equals), text.substr(equals + 1));
}

Result<ProbeRequest> probeOf(const std::string& text) {
    const auto parts = splitAssignment(text, "--probe", "ID=E,N or ID=E,N,U");
    if (!parts)
        return tl::unexpected(parts.error());
    const auto numbers = parseNumbers(parts->second, 2, 3, "--probe");
    if (!numbers)
        return tl::unexpected(numbers.error());
    ProbeRequest probe{parts->first, (*numbers)[0], (*numbers)[1], std::nullopt};
    if (numbers->size() == 3)
        probe.up = (*numbers)[2];
    return probe;
}

Result<VehicleRequest> vehicleOf(const std::string& text) {
    const auto parts = splitAssignment(text, "--vehicle", "ID=tram,ROUTE");
    if (!parts)
        return tl::unexpected(parts.error());
    const auto comma = parts->second.find(',');
    if (comma == std::string::npos) {
        return fail(ErrorCode::Usage, "the vehicle has no route", "--vehicle",
                    "Write it as ID=tram,ROUTE.");
    }
    return VehicleRequest{parts->first, parts->second.substr(0, comma),
                          parts->second.substr(comma + 1)};
}

Result<std::pair<std::string, double>> interestOf(const std::string& text) {
    const auto parts = splitAssignment(text, "--interest", "ID=2");
    if (!parts)
        return tl::unexpected(parts.error());
    const auto numbers = parseNumbers(parts->second, 1, 1, "--interest");
    if (!numbers)
        return tl::unexpected(numbers.error());
    return std::pair(parts->first, numbers->front());
}

Result<NoProbeArea> noProbesOf(const std::string& text) {
    const auto parts = splitAssignment(text, "--no-probes", "ID=E,N,RADIUS");
    if (!parts)
        return tl::unexpected(parts.error());
    const auto numbers = parseNumbers(parts->second, 3, 3, "--no-probes");
    if (!numbers)
        return tl::unexpected(numbers.error());
    if (!((*numbers)[2] > 0.0)) {
        return fail(ErrorCode::Usage, "the radius must be above 0", "--no-probes " + parts->first,
                    "Write it as ID=E,N,RADIUS, in metres.");
    }
    return NoProbeArea{parts->first, {(*numbers)[0], (*numbers)[1]}, (*numbers)[2]};
}

Result<EditRequest> requestOf(const EditArguments& arguments) {
    EditRequest request;
    for (const auto& text : arguments.probes) {
        const auto probe = probeOf(text);
        if (!probe)
            return tl::unexpected(probe.error());
        request.probes.push_back(*probe);
    }
    for (const auto& text : arguments.vehicles) {
        const auto vehicle = vehicleOf(text);
        if (!vehicle)
            return tl::unexpected(vehicle.error());
        request.vehicles.push_back(*vehicle);
    }
    for (const auto& text : arguments.interests) {
        const auto interest = interestOf(text);
        if (!interest)
            return tl::unexpected(interest.error());
        request.interests.push_back(*interest);
    }
    for (const auto& text : arguments.settings) {
        const auto setting = splitAssignment(text, "--set", "KEY=VALUE");
        if (!setting)
            return tl::unexpected(setting.error());
        request.settings.push_back(*setting);
    }
    for (const auto& text : arguments.places) {
        auto place = parsePlace(text);
        if (!place)
            return tl::unexpected(place.error());
        place->crs = arguments.projectCrs;
        request.places.push_back(std::move(*place));
    }
    for (const auto& text : arguments.axes) {
        const std::size_t equals = text.rfind('=');
        const bool alone = equals == std::string::npos;
        request.axes.emplace_back(alone ? "" : text.substr(0, equals),
                                  alone ? text : text.substr(equals + 1));
    }
    for (const auto& text : arguments.noProbes) {
        auto area = noProbesOf(text);
        if (!area)
            return tl::unexpected(area.error());
        request.noProbes.push_back(std::move(*area));
    }
    request.lock = arguments.lock;
    request.unlock = arguments.unlock;
    request.probesEvery = arguments.probesEvery;
    request.remove = arguments.remove;
    request.routes.assign(arguments.routes.begin(), arguments.routes.end());
    return request;
}

}  // namespace

int run(const EditArguments& arguments, const Console& console) {
    const auto request = requestOf(arguments);
    if (!request)
        return console.failed(request.error());
    const auto report = editProject(arguments.project, *request, console.job());
    if (!report)
        return console.failed(report.error());
    const Project& project = report->project;
    if (console.json()) {
        nlohmann::json routes = nlohmann::json::array();
        for (const auto& route : project.routes)
            routes.push_back(route.id);
        console.data({{"project", arguments.project},
                      {"probes", project.probes.size()},
                      {"probesAdded", report->probesAdded},
                      {"routes", routes},
                      {"reflectors", project.reflectors.size()}});
    }
    for (const auto& remark : report->remarks)
        console.note(remark);
    std::string routes;
    for (const auto& route : project.routes)
        routes += (routes.empty() ? "" : ", ") + route.id;
    console.text(fmt::format("{}: {} probes ({} placed now), routes: {}, {} vehicles",
                             arguments.project, project.probes.size(), report->probesAdded,
                             routes.empty() ? "none" : routes, project.reflectors.size()));
    return kDone;
}

}  // namespace reflet::cli
