// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace reflet::cli {

/// Flags that every command takes.
struct GlobalOptions {
    bool json = false;
    bool quiet = false;
    bool progressJson = false;
    int jobs = 0;  ///< threads; 0 = all cores
};

struct SampleArguments {
    std::string name, folder;
    std::uint64_t seed = 1;
};
/// How the heights of footprints are read.
struct FootprintArguments {
    std::string heightField, baseField, crownField;
    std::optional<double> defaultHeight;
};
/// How meshes (OBJ, glTF, 3D Tiles) and the axes of coordinates are read.
struct AxesArguments {
    std::string up, unit;  ///< of OBJ and glTF
    std::string order;
    std::optional<double> geometricError;
};
struct InfoArguments {
    std::vector<std::string> files;
    std::string crs;
    FootprintArguments footprints;
    AxesArguments axes;
    bool strict = false;
};
struct ImportArguments {
    std::vector<std::string> files, terrain, orthophotos;
    std::vector<std::string> places;
    std::string output, crs, projectCrs, vertical, lod = "highest", bbox, types, routes, vehicle,
                                                   date, projectTemplate, report;
    FootprintArguments footprints;
    AxesArguments axes;
    bool strict = false;
};
struct EditArguments {
    std::string project;
    std::vector<std::string> probes, remove, routes, vehicles, settings, places, axes, interests;
    std::vector<std::string> noProbes, lock, unlock;
    std::string projectCrs;
    std::optional<double> probesEvery;
};
struct ProbesArguments {
    std::string action, project, file;
    std::vector<std::string> outputs;
    bool dryRun = false, movable = false;
};
/// What `coverage` and `suggest` share.
struct DemandArguments {
    std::string on, vehicle;
    std::uint64_t seed = 0;
    double error = 0.005;
};
struct CoverageArguments {
    std::string project, thumbnails;
    std::vector<std::string> outputs;
    DemandArguments demand;
};
struct SuggestArguments {
    std::string project;
    std::vector<std::string> outputs;
    DemandArguments demand;
    std::optional<double> coverage;
    std::optional<std::size_t> count;
    double spacing = 5.0, leastGain = 0.0;
    bool write = false, afresh = false, noBaselines = false;
};
struct UpdateArguments {
    std::string project, file, model;
    bool dryRun = false;
};
struct ValidateArguments {
    std::string project;
};
struct HeightfieldArguments {
    std::string project, output;
    std::optional<double> cell;
    std::string layers = "2";
};
struct BakeArguments {
    std::string project, backend = "cpu", only, shard = "1/1";
    std::optional<int> resolution;
};
struct ReconstructArguments {
    std::string project, at, reflector, method = "mem", output;
    double time = 0.0;
};
struct CompareArguments {
    std::string project, methods = "nearest,blend,box,mem", output, spacings;
    int poses = 6;
    std::optional<double> drive;
};
struct FiguresArguments {
    std::string project, output;
};
struct RenderArguments {
    std::string project, view, size = "1280x720", method = "mem", wipe, output;
    double wipeAt = 0.5;
    bool all = false;
    bool gl = false;
    int samples = 3;
    bool film = false;
    double seconds = 20.0;
    int framesPerSecond = 30;
    std::string reflector;
};
struct BenchArguments {
    std::string what, size = "1280x720";
    std::vector<std::string> files;
    std::size_t triangles = 2'000'000;
    double cellSize = 1.0;
    std::optional<double> scale;
    std::optional<int> frames;
    double framesPerSecond = 30.0;
    std::optional<double> budget;
    int cancels = 0;
    std::size_t checkedRays = 0;
    int poses = 64;
    std::size_t candidates = 10'000, samples = 1'000'000;
    std::size_t count = 100;
};
struct DoctorArguments {};

using CommandArguments =
    std::variant<DoctorArguments, SampleArguments, InfoArguments, ImportArguments, EditArguments,
                 ProbesArguments, CoverageArguments, SuggestArguments, UpdateArguments,
                 ValidateArguments, HeightfieldArguments, BakeArguments, ReconstructArguments,
                 CompareArguments, FiguresArguments, RenderArguments, BenchArguments>;

struct Arguments {
    GlobalOptions global;
    CommandArguments command;
};

/// Parses the command line. When the program should end at once (help, version, a mistake), the
/// text has been printed and the exit code comes back instead.
[[nodiscard]] std::variant<Arguments, int> parseArguments(int argc, const char* const* argv);

}  // namespace reflet::cli
