// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/cli/Benches.h"
#include "app/cli/PictureArguments.h"
#include "app/pipeline/DrivenCity.h"
#include "app/pipeline/Table1.h"

#include <fmt/format.h>

#include <filesystem>

namespace reflet::cli {

namespace {

double over(double a, double b) {
    return b > 0.0 ? a / b : 0.0;
}

nlohmann::json toJson(const Table1Cells& cells) {
    nlohmann::json out;
    for (std::size_t i = 0; i < kTable1Columns; ++i) {
        const char* name = toString(Table1Column(i));
        const Table1Cell& cell = cells[i];
        out[name] = cell.median;
        out["worst"][name] = cell.worst;
        out["maps"][name] = cell.maps;
        out["rays"][name] = cell.rays;
    }
    return out;
}

nlohmann::json toJson(const Table1Row& row) {
    nlohmann::json out = toJson(row.cells);
    out["displayed"] = row.displayed;
    const double mem = row.at(Table1Column::MemLod).median;
    out["ratio"] = {{"rerenderLod", over(row.at(Table1Column::RerenderLod).median, mem)},
                    {"raytraceLod", over(row.at(Table1Column::RayTraceLod).median, mem)},
                    {"memLodToNone", over(mem, row.at(Table1Column::None).median)}};
    return out;
}

nlohmann::json toJson(const Table1TreeRow& row) {
    nlohmann::json out{{"without", toJson(row.without)}};
    for (std::size_t i = 0; i < kTable1Columns; ++i)
        out[toString(Table1Column(i))] = row.cost[i];
    return out;
}

nlohmann::json toJson(const Table1Maps& map) {
    nlohmann::json out{{"places", map.places},
                       {"rerender", map.rerender},
                       {"rerenderThinned", map.rerenderThinned},
                       {"raytrace", map.raytrace},
                       {"mem", map.mem},
                       {"psnr", nullptr},
                       {"ratio",
                        {{"rerender", over(map.rerender, map.mem)},
                         {"rerenderThinned", over(map.rerenderThinned, map.mem)},
                         {"raytrace", over(map.raytrace, map.mem)}}}};
    if (map.psnr)
        out["psnr"] = *map.psnr;
    return out;
}

nlohmann::json toJson(const Table1Report& report) {
    nlohmann::json out{{"renderer", report.renderer},     {"threads", report.threads},
                       {"resolution", report.resolution}, {"probes", report.probes},
                       {"triangles", report.triangles},   {"map", toJson(report.map)}};
    for (const Table1Row& row : report.rows) {
        out[fmt::format("cars{}", row.cars)] = toJson(row);
        if (row.trees)
            out[fmt::format("trees{}", row.cars)] = toJson(*row.trees);
    }
    if (report.trees) {
        out["trees"] = {{"objects", report.trees->count.objects},
                        {"triangles", report.trees->count.triangles}};
        out["map"]["without"] = toJson(report.trees->without);
    }
    return out;
}

void tellMap(const Console& console, const char* what, const Table1Maps& map) {
    console.text(fmt::format(
        "{}, medians of {} places: ours {:.2f} ms, drawn anew {:.1f} ms ({:.1f} x), "
        "without what is smaller than a texel {:.1f} ms ({:.1f} x), traced anew {:.1f} ms ({:.1f} "
        "x); ours against traced {}",
        what, map.places, map.mem, map.rerender, over(map.rerender, map.mem), map.rerenderThinned,
        over(map.rerenderThinned, map.mem), map.raytrace, over(map.raytrace, map.mem),
        map.psnr ? fmt::format("{:.1f} dB", *map.psnr) : std::string("the same")));
}

std::string lineOf(const Table1Cells& cells) {
    std::string line;
    for (const Table1Cell& cell : cells)
        line += fmt::format(" {:>18}", fmt::format("{:.1f} ({:.1f})", cell.median, cell.worst));
    return line;
}

void tellTrees(const Console& console, const Table1TreeRow& row) {
    console.text(fmt::format("{:>12}", "no trees") + lineOf(row.without));
    std::string line = fmt::format("{:>12}", "trees cost");
    for (const double cost : row.cost)
        line += fmt::format(" {:>18}", fmt::format("{:+.1f}", cost));
    console.text(line);
}

void tell(const Console& console, const std::string& name, const Table1Report& report) {
    console.text(
        fmt::format("{}: {} triangles, {} probes, local maps of {} x {} texels a face; {} "
                    "threads",
                    name, report.triangles, report.probes, report.resolution, report.resolution,
                    report.threads));
    console.text(report.renderer);
    tellMap(console, "one local map", report.map);
    if (report.trees) {
        console.text(fmt::format("of all triangles {} make up {} trees",
                                 report.trees->count.triangles, report.trees->count.objects));
        tellMap(console, "one local map without them", report.trees->without);
    }
    console.text("milliseconds a picture, median (worst):");
    std::string head = fmt::format("{:>5} {:>6}", "cars", "shown");
    for (std::size_t i = 0; i < kTable1Columns; ++i)
        head += fmt::format(" {:>18}", toString(Table1Column(i)));
    console.text(head);
    for (const Table1Row& row : report.rows) {
        console.text(fmt::format("{:>5} {:>6.1f}", row.cars, row.displayed) + lineOf(row.cells));
        std::string line = fmt::format("{:>12}", "maps");
        for (const Table1Cell& cell : row.cells)
            line += fmt::format(" {:>18.1f}", cell.maps);
        console.text(line);
        if (row.trees)
            tellTrees(console, *row.trees);
    }
    for (const Table1Row& row : report.rows) {
        const double mem = row.at(Table1Column::MemLod).median;
        console.text(fmt::format(
            "{} cars with levels of detail: {:.1f} x as fast as drawing anew, {:.1f} x as tracing "
            "anew; {:.2f} x the time without reflections",
            row.cars, over(row.at(Table1Column::RerenderLod).median, mem),
            over(row.at(Table1Column::RayTraceLod).median, mem),
            over(mem, row.at(Table1Column::None).median)));
    }
}

}  // namespace

int runTable1(const BenchArguments& arguments, const Console& console) {
    const auto size = pictureSize(arguments.size);
    if (!size)
        return console.failed(size.error());
    Table1Options options;
    options.width = size->x;
    options.height = size->y;
    options.frames = arguments.frames.value_or(options.frames);
    nlohmann::json cities = nlohmann::json::object();
    nlohmann::json out;
    bool whole = true;
    for (const std::string& file : arguments.files) {
        const auto driven = openDriven(file, console.job());
        if (!driven)
            return console.failed(driven.error());
        for (const auto& failure : driven->rems.failures)
            console.note(failure);
        whole = whole && driven->rems.failures.empty();
        const auto bare = drivenWithoutTrees(*driven, file, console.job());
        if (!bare)
            return console.failed(bare.error());
        const auto report = measureTable1(driven->city, driven->rems.rems, options, console.job(),
                                          *bare ? &**bare : nullptr);
        if (!report)
            return console.failed(report.error());
        const std::string name = std::filesystem::path(file).stem().string();
        if (out.is_null())
            out = toJson(*report);
        else
            cities[name] = toJson(*report);
        tell(console, name, *report);
    }
    out["size"] = {options.width, options.height};
    out["frames"] = options.frames;
    out["cities"] = std::move(cities);
    if (console.json())
        console.data(out);
    return whole ? kDone : kSomeFailed;
}

}  // namespace reflet::cli
