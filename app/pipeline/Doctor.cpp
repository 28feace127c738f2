// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Doctor.h"

#include "app/pipeline/Version.h"
#include "core/baking/EmbreeVersion.h"
#include "core/base/ParallelFor.h"
#include "core/geo/Crs.h"
#include "core/gpu/GlContext.h"
#include "core/io/GeoFile.h"
#include "core/io/ImageFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace reflet {

namespace {

DoctorItem projItem() {
    const ProjStatus status = projStatus();
    const auto crs = Crs::parse("EPSG:25832");
    return {"PROJ", status.databaseOpens && crs.has_value(),
            status.version + (status.databasePath.empty() ? ", no database"
                                                          : ", database " + status.databasePath),
            "Install the package proj-data, or point PROJ_DATA at the folder that holds proj.db."};
}

DoctorItem glItem() {
    const auto context = GlContext::createHeadless();
    if (context) {
        return {"OpenGL", true,
                (*context)->renderer() + ", " + (*context)->version() + ", " + (*context)->path(),
                ""};
    }
    return {"OpenGL", false, context.error().what, context.error().remedy};
}

/// The first folder of PATH that holds the program.
std::string findProgram(const std::string& name) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path != nullptr ? path : "");
    std::string folder;
    while (std::getline(folders, folder, ':')) {
        const std::filesystem::path candidate = std::filesystem::path(folder) / name;
        std::error_code error;
        if (!folder.empty() && std::filesystem::is_regular_file(candidate, error))
            return candidate.string();
    }
    return {};
}

DoctorItem ffmpegItem() {
    const std::string path = findProgram("ffmpeg");
    return {"ffmpeg", !path.empty(), path.empty() ? "not found; only needed for films" : path,
            "Install the package ffmpeg to save films."};
}

}  // namespace

bool DoctorReport::healthy() const {
    return std::all_of(items.begin(), items.end(),
                       [](const DoctorItem& item) { return item.ok || item.name == "ffmpeg"; });
}

DoctorReport runDoctor() {
    DoctorReport report;
    report.version = kVersion;
    report.items.push_back({"threads", true, fmt::format("{}", threadLimit()), ""});
    report.items.push_back(projItem());
    report.items.push_back({"GDAL", true, gdalVersion(), ""});
    report.items.push_back({"OpenImageIO", true, openImageIoVersion(), ""});
    report.items.push_back({"Embree", true, embreeVersion(), ""});
    report.items.push_back(glItem());
    report.items.push_back(ffmpegItem());
    for (auto& item : report.items) {
        if (item.ok)
            item.remedy.clear();
    }
    return report;
}

}  // namespace reflet
