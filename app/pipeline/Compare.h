// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/Bake.h"
#include "app/pipeline/Figures.h"
#include "app/pipeline/Render.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

struct CompareOptions {
    int poses = 6;  ///< spread over the routes of the reflectors
    std::vector<Method> methods = {Method::Nearest, Method::Blend, Method::Box, Method::Mem};
    std::optional<std::filesystem::path> output;  ///< folder for pictures; none = figures only
    int width = 640;                              ///< of the vehicle pictures
    int height = 360;
    int samplesPerEdge = 2;
    bool drawVehicle = true;  ///< else whole local maps alone are compared
    /// Metres of each route to drive in small steps, to measure pops; nullopt = none.
    std::optional<double> drive = std::nullopt;
};

/// A method at one pose: a place on the contact sheet.
struct SheetCell {
    std::string method;
    std::filesystem::path picture, heat;  ///< of the vehicle; empty when none was written
    std::optional<double> vehicleFlip;    ///< 0..1, over the vehicle's pixels
    double mapFlip = 0.0;                 ///< 0..1, over its local maps
};
struct SheetRow {
    std::string reflector, street;
    double station = 0.0;             ///< metres along the route
    std::filesystem::path reference;  ///< picture; empty when none was written
    std::filesystem::path all;        ///< reference, methods and FLIP in one picture; may be empty
    std::vector<SheetCell> methods;
};

struct CompareReport {
    std::size_t poses = 0;
    std::size_t maps = 0;  ///< local maps compared: one per body and pose
    std::map<std::string, MethodFigures> methods;
    std::vector<SheetRow> rows;       ///< one for each pose
    std::vector<Diagnostic> remarks;  ///< probes and poses that were left out, with the reason
    std::vector<std::filesystem::path> pictures;
};

/// Compares methods with ray tracing at poses spread along the routes (DESIGN 5.8). Usage when the
/// project has no reflector or no probe.
[[nodiscard]] Result<CompareReport> compareMethods(const PreparedCity& city,
                                                   const CompareOptions& options,
                                                   const JobContext& job);

}  // namespace reflet
