// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Arguments.h"

#include "app/pipeline/Version.h"
#include "core/reconstruction/LodSettings.h"

#include <CLI/CLI.hpp>

namespace reflet::cli {

namespace {

constexpr int kUsageExit = 2;

template <class T, class Declare>
void command(CLI::App& app, Arguments& out, const std::string& name, const std::string& what,
             const std::string& example, const Declare& declare) {
    auto values = std::make_shared<T>();
    CLI::App* sub = app.add_subcommand(name, what);
    sub->footer("Example: reflet-cli " + example);
    declare(*sub, *values);
    sub->callback([values, &out] { out.command = *values; });
}

void addFootprintOptions(CLI::App& sub, FootprintArguments& v) {
    sub.add_option("--height-field", v.heightField,
                   "attribute of footprints or trees with the height above the ground");
    sub.add_option("--base-field", v.baseField,
                   "attribute of footprints with the elevation of the ground");
    sub.add_option("--crown-field", v.crownField,
                   "attribute of trees with the diameter of the crown");
    sub.add_option("--default-height", v.defaultHeight,
                   "metres of a building (9) or tree (10) of unknown height")
        ->check(CLI::Range(0.1, 2000.0));
}

void addAxesOptions(CLI::App& sub, AxesArguments& v) {
    sub.add_option("--up", v.up, "axis of OBJ and glTF that points up: y or z (as the file has it)")
        ->check(CLI::IsMember({"y", "z"}));
    sub.add_option("--unit", v.unit,
                   "unit of OBJ and glTF: m, cm, mm, km, ft, us-ft, in or metres");
    sub.add_option("--geometric-error", v.geometricError,
                   "3D Tiles: metres of error that are good enough (as few as fit a city)")
        ->check(CLI::Range(0.0, 1e6));
    sub.add_option("--axes", v.order,
                   "which coordinate comes first in the files: en (east) or ne (north); else as it "
                   "seems")
        ->check(CLI::IsMember({"en", "ne"}));
}

void declareSources(CLI::App& app, Arguments& out) {
    command<SampleArguments>(
        app, out, "sample", "Write a built-in sample city and project", "sample square demo",
        [](CLI::App& sub, SampleArguments& v) {
            sub.add_option("NAME", v.name, "square, paper or whale")->required();
            sub.add_option("DIR", v.folder, "folder to write into")->required();
            sub.add_option("--seed", v.seed, "another number gives another city");
        });
    command<InfoArguments>(
        app, out, "info", "Tell what is in city model files; changes nothing",
        "info city.city.json --json", [](CLI::App& sub, InfoArguments& v) {
            sub.add_option("FILE", v.files,
                           "city models: CityJSON, CityGML, footprints, OpenStreetMap; folders and "
                           "ZIP archives of them, patterns, @LIST")
                ->required();
            sub.add_option("--crs", v.crs, "CRS of files that declare none: EPSG:n, WKT or local");
            addFootprintOptions(sub, v.footprints);
            addAxesOptions(sub, v.axes);
            sub.add_flag("--strict", v.strict, "refuse what would be guessed");
        });
    command<ImportArguments>(
        app, out, "import", "Make a project of city model files",
        "import city.city.json -o city.reflet --routes tram.geojson",
        [](CLI::App& sub, ImportArguments& v) {
            sub.add_option("FILE", v.files,
                           "city models: CityJSON, CityGML, footprints, OpenStreetMap; GeoTIFF and "
                           "other rasters; folders and ZIP archives of them, patterns, @LIST");
            sub.add_option("--terrain", v.terrain,
                           "raster of heights, a folder of them, or @LIST with a path a line");
            sub.add_option("--ortho", v.orthophotos, "orthophoto to lay on the ground, likewise");
            sub.add_option("-o,--output", v.output, "project to write")->required();
            sub.add_option("--crs", v.crs, "CRS of files that declare none: EPSG:n, WKT or local");
            sub.add_option("--project-crs", v.projectCrs,
                           "CRS of the project, projected in metres: EPSG:n");
            sub.add_option(
                   "--place", v.places,
                   "[MODEL=]lonlat:LON,LAT[,HEADING[,U]], points:X1,Y1,E1,N1,X2,Y2,E2,N2[,U] "
                   "or offset:E,N[,U[,HEADING]]: place a model in local coordinates")
                ->take_all();
            sub.add_option("--vertical", v.vertical, "vertical datum: EPSG:n");
            sub.add_option("--lod", v.lod, "level of detail to load, or highest (of each object)");
            sub.add_option("--bbox", v.bbox,
                           "E0,N0,E1,N1 in the project's CRS: load only what touches it");
            sub.add_option("--types", v.types,
                           "load only these types (as CityJSON names them), with commas");
            addFootprintOptions(sub, v.footprints);
            addAxesOptions(sub, v.axes);
            sub.add_option("--routes", v.routes,
                           "vector file whose lines become routes; of OpenStreetMap data tram "
                           "lines, else the longest streets");
            sub.add_option(
                "--vehicle", v.vehicle,
                "vehicle on each route: tram, bus, car, sphere, woman, man, child, whale or "
                "mirror-tree");
            sub.add_option("--date", v.date, "date and time of the sun, ISO 8601");
            sub.add_option("--template", v.projectTemplate,
                           "project whose tuning, light and bake settings to take");
            sub.add_option("--report", v.report,
                           "file to write the import report to: JSON, with each object");
            sub.add_flag("--strict", v.strict, "refuse what would be guessed or repaired");
        });
}

void declareProbes(CLI::App& app, Arguments& out) {
    command<ProbesArguments>(
        app, out, "probes", "Bring in probes that exist already, or write them to a file",
        "probes import city.reflet probes.csv --dry-run", [](CLI::App& sub, ProbesArguments& v) {
            sub.add_option("ACTION", v.action, "import or export")
                ->required()
                ->check(CLI::IsMember({"import", "export"}));
            sub.add_option("PROJECT", v.project, "project file")->required();
            sub.add_option("FILE", v.file,
                           "import: CSV, GeoJSON, GeoPackage, a project, or JSON of suggest");
            sub.add_option("-o,--output", v.outputs,
                           "export: file to write, .csv, .geojson, .gpkg or .json")
                ->take_all();
            sub.add_flag("--dry-run", v.dryRun, "import: tell what would be added; write nothing");
            sub.add_flag("--movable", v.movable,
                         "import: not locked, so that `suggest --afresh` may leave them out");
        });
}

void addDemandOptions(CLI::App& sub, DemandArguments& v) {
    sub.add_option("--on", v.on,
                   "routes or ground: where vehicles may be (routes where there are any)")
        ->check(CLI::IsMember({"routes", "ground"}));
    sub.add_option("--vehicle", v.vehicle, "what drives where the project has put nothing");
    sub.add_option("--seed", v.seed, "another number takes other samples");
    sub.add_option("--error", v.error, "half-width of the coverage's 95 % interval, e.g. 0.005")
        ->check(CLI::Range(0.0005, 0.1));
}

void declareCoverage(CLI::App& app, Arguments& out) {
    command<CoverageArguments>(
        app, out, "coverage", "Tell how much of what vehicles reflect the probes serve",
        "coverage city.reflet -o coverage.gpkg -o coverage.png",
        [](CLI::App& sub, CoverageArguments& v) {
            sub.add_option("PROJECT", v.project, "project file")->required();
            sub.add_option("-o,--output", v.outputs,
                           "file to write: .json, .csv, .geojson, .gpkg, .tif or .png")
                ->take_all();
            sub.add_option("--thumbnails", v.thumbnails,
                           "PNG with pictures of the worst places, beside the reference");
            addDemandOptions(sub, v.demand);
        });
    command<SuggestArguments>(
        app, out, "suggest", "Suggest probes for what the routes ask for, with a certificate",
        "suggest city.reflet --coverage 0.95 --write", [](CLI::App& sub, SuggestArguments& v) {
            sub.add_option("PROJECT", v.project, "project file")->required();
            sub.add_option("--coverage", v.coverage, "coverage to reach, 0 to 1")
                ->check(CLI::Range(0.0, 1.0));
            sub.add_option("--count", v.count, "number of new probes")
                ->check(CLI::Range(1, 10'000));
            sub.add_option("--spacing", v.spacing, "metres between candidates")
                ->check(CLI::Range(0.5, 100.0));
            sub.add_option("--least-gain", v.leastGain,
                           "share of all that a probe has to bring, e.g. 0.002")
                ->check(CLI::Range(0.0, 1.0));
            sub.add_flag("--afresh", v.afresh,
                         "in place of the project's probes, but for locked ones");
            sub.add_flag("--no-baselines", v.noBaselines,
                         "do without even spacing, junctions and chance beside it");
            sub.add_flag("--write", v.write, "put the probes into the project");
            sub.add_option("-o,--output", v.outputs,
                           "file for the new probes: .csv, .geojson, .gpkg or .json")
                ->take_all();
            addDemandOptions(sub, v.demand);
        });
}

void declareProject(CLI::App& app, Arguments& out) {
    command<EditArguments>(
        app, out, "edit", "Change a project",
        "edit city.reflet --route tram.geojson --vehicle t1=tram,route --probes-every 15",
        [](CLI::App& sub, EditArguments& v) {
            sub.add_option("PROJECT", v.project, "project file")->required();
            sub.add_option("--probe", v.probes, "ID=E,N[,U]: add or move a reflection probe")
                ->take_all();
            sub.add_option("--probes-every", v.probesEvery,
                           "add probes every M metres along the routes");
            sub.add_option("--lock", v.lock,
                           "ID of a probe that suggestions shall leave where it is")
                ->take_all();
            sub.add_option("--unlock", v.unlock, "ID of a probe that suggestions may move")
                ->take_all();
            sub.add_option("--no-probes", v.noProbes,
                           "ID=E,N,RADIUS: a circle in which no probe is suggested")
                ->take_all();
            sub.add_option("--remove", v.remove,
                           "remove a probe, vehicle, route, view or circle without probes")
                ->take_all();
            sub.add_option("--route", v.routes, "vector file whose lines become routes")
                ->take_all();
            sub.add_option(
                   "--vehicle", v.vehicles,
                   "ID=tram|bus|car|sphere|woman|man|child|whale|mirror-tree,ROUTE: put a vehicle "
                   "or somebody on foot on a route")
                ->take_all();
            sub.add_option("--interest", v.interests,
                           "ID=0..10: how much a vehicle's reflection matters when not all can be "
                           "drawn in time; 1 is usual")
                ->take_all();
            sub.add_option(
                   "--place", v.places,
                   "[MODEL=]lonlat:LON,LAT[,HEADING[,U]], points:X1,Y1,E1,N1,X2,Y2,E2,N2[,U] "
                   "or offset:E,N[,U[,HEADING]]: place a model in local coordinates")
                ->take_all();
            sub.add_option("--axes", v.axes,
                           "[MODEL=]en|ne: which coordinate comes first in a model's file")
                ->take_all();
            sub.add_option("--project-crs", v.projectCrs,
                           "CRS that a project in local metres gets by --place");
            sub.add_option("--set", v.settings, "KEY=VALUE, e.g. tuning.depthRatio=0.1")
                ->take_all();
        });
    command<UpdateArguments>(
        app, out, "update", "Put a new delivery of a city model in the place of the old one",
        "update city.reflet 2026/city.city.json --dry-run", [](CLI::App& sub, UpdateArguments& v) {
            sub.add_option("PROJECT", v.project, "project file")->required();
            sub.add_option("FILE", v.file, "the new delivery")->required();
            sub.add_option("--model", v.model,
                           "which model of the project it replaces: its path or file name; "
                           "needed where there are several");
            sub.add_flag("--dry-run", v.dryRun, "tell what would change; write nothing");
        });
    command<ValidateArguments>(app, out, "validate",
                               "Check a project against its schema and its files",
                               "validate city.reflet", [](CLI::App& sub, ValidateArguments& v) {
                                   sub.add_option("PROJECT", v.project, "project file")->required();
                               });
    command<HeightfieldArguments>(
        app, out, "heightfield", "Write the heightfield as a GeoTIFF",
        "heightfield city.reflet -o heights.tif --cell 0.5",
        [](CLI::App& sub, HeightfieldArguments& v) {
            sub.add_option("PROJECT", v.project, "project file")->required();
            sub.add_option("-o,--output", v.output, "GeoTIFF to write")->required();
            sub.add_option("--cell", v.cell, "cell size in metres (default: the project's)");
            sub.add_option("--layers", v.layers,
                           "1 = top; 2 = ground, top, overhead slab; n = all that is known")
                ->check(CLI::IsMember({"1", "2", "3", "n"}));
        });
}

void declareWork(CLI::App& app, Arguments& out) {
    command<BakeArguments>(
        app, out, "bake", "Bake the reflection probes into the cache",
        "bake city.reflet --shard 1/4", [](CLI::App& sub, BakeArguments& v) {
            sub.add_option("PROJECT", v.project, "project file")->required();
            sub.add_option("--backend", v.backend, "cpu: traced; gl: drawn with OpenGL")
                ->check(CLI::IsMember({"cpu", "gl"}));
            sub.add_option("--resolution", v.resolution, "texels along an edge of a face");
            sub.add_option("--only", v.only, "ids of probes, with commas");
            sub.add_option("--shard", v.shard, "I/N: the I-th of N equal parts");
        });
    command<ReconstructArguments>(
        app, out, "reconstruct", "Write the local environment map of a place",
        "reconstruct city.reflet --reflector tram1 --time 12 --method mem -o map.exr",
        [](CLI::App& sub, ReconstructArguments& v) {
            sub.add_option("PROJECT", v.project, "project file")->required();
            auto* at = sub.add_option("--at", v.at, "E,N,U in the project's CRS and datum");
            sub.add_option("--reflector", v.reflector, "id of a vehicle")->excludes(at);
            sub.add_option("--time", v.time, "seconds after the start, with --reflector");
            sub.add_option("--method", v.method,
                           "sky, nearest, blend, box, mem, dense, raytrace or rerender");
            sub.add_option("-o,--output", v.output, "OpenEXR to write")->required();
        });
    command<CompareArguments>(
        app, out, "compare", "Compare methods with ray tracing, in figures and pictures",
        "compare city.reflet --poses 12 -o comparison", [](CLI::App& sub, CompareArguments& v) {
            sub.add_option("PROJECT", v.project, "project file")->required();
            sub.add_option("--poses", v.poses, "places along the routes");
            sub.add_option("--methods", v.methods,
                           "with commas: sky, nearest, blend, box, mem, dense, per-pixel, "
                           "raytrace, rerender");
            sub.add_option("-o,--output", v.output,
                           "folder for pictures, the contact sheet index.html and compare.json");
            sub.add_option("--drive", v.drive,
                           "drive so many metres of each route, to measure how steady maps are");
            sub.add_option("--spacings", v.spacings,
                           "with probes every so many metres in place of the project's, e.g. "
                           "10,15,25,40,80,140");
        });
    command<FiguresArguments>(
        app, out, "figures", "Draw the figures of the paper of 2003 for a project",
        "figures paper.reflet -o figures", [](CLI::App& sub, FiguresArguments& v) {
            sub.add_option("PROJECT", v.project, "project file")->required();
            sub.add_option("-o,--output", v.output, "folder for the pictures")->required();
        });
    command<RenderArguments>(
        app, out, "render", "Draw views with the vehicles in them",
        "render city.reflet --all -o pictures", [](CLI::App& sub, RenderArguments& v) {
            sub.add_option("PROJECT", v.project, "project file")->required();
            auto* view = sub.add_option("--view", v.view, "name of a view");
            auto* all = sub.add_flag("--all", v.all, "all views, into a folder")->excludes(view);
            sub.add_flag("--film", v.film, "a film of a drive, an MP4 by ffmpeg, with OpenGL")
                ->excludes(view)
                ->excludes(all);
            sub.add_option("--seconds", v.seconds, "length of the film");
            sub.add_option("--fps", v.framesPerSecond, "pictures of the film a second");
            sub.add_option("--follow", v.reflector, "vehicle that the film follows");
            sub.add_option("--size", v.size, "WIDTHxHEIGHT in pixels");
            auto* method = sub.add_option(
                "--method", v.method,
                "reflections by sky, nearest, blend, box, mem, dense, per-pixel, raytrace or "
                "rerender");
            sub.add_option("--wipe", v.wipe, "two methods, A,B: left and right of a bar")
                ->excludes(method);
            sub.add_option("--wipe-at", v.wipeAt, "share of the width left of the bar")
                ->check(CLI::Range(0.0, 1.0));
            sub.add_flag("--gl", v.gl, "draw with OpenGL as the window does, in place of rays");
            sub.add_option("--samples", v.samples, "this squared samples a pixel")
                ->check(CLI::Range(1, 16));
            sub.add_option("-o,--output", v.output,
                           "PNG file; a folder with --all; MP4 with --film")
                ->required();
        });
    command<BenchArguments>(
        app, out, "bench", "Measure speed, beside a reference in the same run",
        "bench frames city.reflet --json", [](CLI::App& sub, BenchArguments& v) {
            sub.add_option("NAME", v.what,
                           "bake, frames, heightfield, import, memory, reconstruct, suggest, "
                           "table1 or trace")
                ->required()
                ->check(CLI::IsMember({"bake", "frames", "heightfield", "import", "memory",
                                       "reconstruct", "suggest", "table1", "trace"}));
            sub.add_option(
                "FILE", v.files,
                "project (bake, frames, memory, reconstruct, suggest), projects (table1), city "
                "model (import), any of both (trace)");
            sub.add_option("--candidates", v.candidates, "places that suggest chooses from, about")
                ->check(CLI::Range(100, 1'000'000));
            sub.add_option("--samples", v.samples, "of what is asked for, of suggest")
                ->check(CLI::Range(1'000, 16'000'000));
            sub.add_option("--count", v.count, "probes that suggest places")
                ->check(CLI::Range(1, 10'000));
            sub.add_option("--check", v.checkedRays,
                           "random rays of each city of trace to compare with the plain walk")
                ->check(CLI::Range(0.0, 1e10));
            sub.add_option("--poses", v.poses, "positions of vehicles, of trace in each city")
                ->check(CLI::Range(1, 1000));
            sub.add_option("--triangles", v.triangles, "of the city generated for heightfield")
                ->check(CLI::Range(1'000, 20'000'000));
            sub.add_option("--cell", v.cellSize, "metres of a cell of heightfield")
                ->check(CLI::Range(0.1, 100.0));
            sub.add_option("--cancels", v.cancels, "begin an import again and cancel it, N times")
                ->check(CLI::Range(0, 1000));
            sub.add_option("--size", v.size, "WIDTHxHEIGHT in pixels");
            sub.add_option("--scale", v.scale, "measure at this share of the size too")
                ->check(CLI::Range(0.1, 1.0));
            sub.add_option("--frames", v.frames, "pictures in each row")
                ->check(CLI::Range(1, 10000));
            sub.add_option("--budget", v.budget,
                           "milliseconds a picture, in place of the project's frame budget")
                ->check(CLI::Range(LodSettings::kLeastBudget, LodSettings::kMostBudget));
            sub.add_option("--fps", v.framesPerSecond, "pace that the adaptive size aims at")
                ->check(CLI::Range(5.0, 120.0));
        });
    command<DoctorArguments>(app, out, "doctor",
                             "Tell versions, the GPU, PROJ's data and what is missing", "doctor",
                             [](CLI::App&, DoctorArguments&) {});
}

void declareGlobals(CLI::App& app, Arguments& out) {
    app.fallthrough();
    app.require_subcommand(1);
    app.set_version_flag("--version", std::string("reflet-cli ") + kVersion);
    app.add_flag("--json", out.global.json, "data as JSON on standard output");
    app.add_flag("--quiet", out.global.quiet, "no messages but errors");
    app.add_option_function<std::string>(
           "--progress", [&out](const std::string&) { out.global.progressJson = true; },
           "json: progress as lines of JSON on standard error")
        ->check(CLI::IsMember({"json"}));
    app.add_option("-j,--jobs", out.global.jobs, "threads (default: all cores)")
        ->check(CLI::Range(1, 1024));
    app.footer(
        "Exit codes: 0 done, 1 some items failed, 2 usage, 3 input unreadable, 4 refused, 5 "
        "resource limit, 130 interrupted.");
}

}  // namespace

std::variant<Arguments, int> parseArguments(int argc, const char* const* argv) {
    Arguments out;
    CLI::App app("Reflet: believable reflections of real cities on moving vehicles", "reflet-cli");
    declareGlobals(app, out);
    declareSources(app, out);
    declareProject(app, out);
    declareProbes(app, out);
    declareCoverage(app, out);
    declareWork(app, out);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? 0 : kUsageExit;
    }
    return out;
}

}  // namespace reflet::cli
