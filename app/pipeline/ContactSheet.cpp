// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/ContactSheet.h"

#include <fmt/format.h>

namespace reflet {

namespace {

constexpr const char* kHead = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>{0}</title>
<style>
body {{ font: 15px/1.45 system-ui, sans-serif; margin: 2em; color: #222; background: #fff }}
table {{ border-collapse: collapse; margin: 0 0 2em }}
th, td {{ padding: .25em .8em; text-align: right; border-bottom: 1px solid #ddd; vertical-align: top }}
th:first-child, td:first-child {{ text-align: left }}
.poses th, .poses td {{ text-align: left; padding: .4em }}
.poses img {{ display: block; width: 320px; height: auto; margin-bottom: 4px }}
.scale {{ width: 320px; height: 10px; margin: .3em 0;
  background: linear-gradient(to right, #000005, #610f7a, #db4d40, #fcb833, #ffffeb) }}
</style></head><body>
<h1>{0}</h1>
)";

constexpr const char* kHelp =
    R"(<p>Each method against the ray-traced reference. <b>PSNR</b>: decibels, more is better.
<b>FLIP</b>: how much change is seen when one picture replaces the other, 0 none to 1 all. <b>Error</b>: mean difference of
display values, 0 to 1. <b>Wrong surface</b>: share of directions that show something else than is there; <b>of what is
seen</b>: where a probe in use sees what is there. <b>Texels</b>: how far off things are shown.</p>
)";

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            default:
                out += c;
        }
    }
    return out;
}

std::string figure(const std::optional<double>& value, int digits) {
    return value ? fmt::format("{:.{}f}", *value, digits) : "same";
}

std::string share(const std::optional<double>& value) {
    return value ? fmt::format("{:.2f}&nbsp;%", 100.0 * *value) : "–";
}

std::string figureRows(const CompareReport& report) {
    std::string out =
        "<table><tr><th>Method</th><th>PSNR</th><th>FLIP</th><th>Error</th>"
        "<th>Wrong surface</th><th>of what is seen</th><th>Texels</th>"
        "<th>PSNR on vehicle</th><th>FLIP on vehicle</th></tr>\n";
    for (const auto& [name, f] : report.methods) {
        const auto& s = f.surfaces;
        out += fmt::format(
            "<tr><td>{}</td><td>{}</td><td>{}</td><td>{:.4f}</td><td>{}</td><td>{}</td><td>{}</td>"
            "<td>{}</td><td>{}</td></tr>\n",
            name, figure(f.map.psnr, 1), figure(f.map.flip, 3), f.map.meanError,
            share(s ? std::optional(s->wrong) : std::nullopt),
            share(s ? s->wrongSeen : std::nullopt),
            s && s->texelError ? fmt::format("{:.2f}", s->texelError->mean) : "–",
            figure(f.vehicle.psnr, 1), figure(f.vehicle.flip, 3));
    }
    return out + "</table>\n";
}

std::string picture(const std::filesystem::path& file, const std::string& says) {
    if (file.empty())
        return {};
    return fmt::format("<img src=\"{}\" alt=\"{}\">", escaped(file.filename().string()),
                       escaped(says));
}

std::string poseRow(const SheetRow& row) {
    const std::string place =
        fmt::format("{}, {:.0f} m along {}", row.reflector, row.station,
                    row.street.empty() ? "its route" : "“" + row.street + "”");
    std::string out = fmt::format("<h2>{}</h2>\n<table class=\"poses\"><tr>", escaped(place));
    out += "<th>reference, ray traced</th>";
    for (const SheetCell& cell : row.methods)
        out += fmt::format("<th>{}</th>", cell.method);
    out += fmt::format("</tr>\n<tr><td>{}</td>", picture(row.reference, place + ": the reference"));
    for (const SheetCell& cell : row.methods) {
        out += fmt::format("<td>{}{}FLIP {} on the vehicle,<br>{:.3f} over its local maps</td>",
                           picture(cell.picture, place + ": " + cell.method),
                           picture(cell.heat, "Differences that are seen"),
                           cell.vehicleFlip ? fmt::format("{:.3f}", *cell.vehicleFlip) : "–",
                           cell.mapFlip);
    }
    out += "</tr></table>\n";
    if (!row.all.empty()) {
        out += fmt::format("<p><a href=\"{}\">All of them in one picture</a></p>\n",
                           escaped(row.all.filename().string()));
    }
    return out;
}

}  // namespace

std::string contactSheet(const CompareReport& report, const std::string& title) {
    std::string out = fmt::format(kHead, escaped(title));
    out += fmt::format("<p>{} local maps at {} places along the routes.</p>\n", report.maps,
                       report.poses);
    out += kHelp;
    out += figureRows(report);
    out +=
        "<p>Below each picture, what an observer sees change on the vehicle: black none, white "
        "all.</p><div class=\"scale\"></div>\n";
    for (const SheetRow& row : report.rows)
        out += poseRow(row);
    for (const Diagnostic& remark : report.remarks)
        out += fmt::format("<p>{}: {}</p>\n", escaped(remark.object), escaped(remark.text));
    return out + "</body></html>\n";
}

}  // namespace reflet
