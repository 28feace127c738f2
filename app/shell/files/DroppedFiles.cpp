// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/files/DroppedFiles.h"

#include "app/pipeline/VehicleFile.h"
#include "importers/CityFiles.h"
#include "importers/FormatRegistry.h"

#include <QDir>
#include <QFileInfo>

namespace reflet {
namespace {

void sortFile(const QFileInfo& file, DroppedFiles& sorted) {
    const QString suffix = file.suffix().toLower();
    const QString path = file.absoluteFilePath();
    if (suffix == QLatin1String("reflet")) {
        sorted.projects << path;
    } else if (suffix == QLatin1String("glb") || suffix == QLatin1String("gltf")) {
        const GltfKind kind = guessGltf(path.toStdString()).kind;
        (kind == GltfKind::City      ? sorted.cities
         : kind == GltfKind::Vehicle ? sorted.vehicles
                                     : sorted.unclear)
            << path;
    } else if (hasCitySuffix(path.toStdString()) || cityFormatOf(path.toStdString())) {
        sorted.cities << path;
    } else {
        sorted.unknown << path;
    }
}

void sortFolder(const QDir& folder, DroppedFiles& sorted) {
    DroppedFiles inside;
    for (const QFileInfo& file : folder.entryInfoList(
             {QStringLiteral("*.reflet"), QStringLiteral("*.glb"), QStringLiteral("*.gltf")},
             QDir::Files | QDir::Readable, QDir::Name))
        sortFile(file, inside);
    if (!inside.projects.isEmpty()) {
        sorted.projects << inside.projects;
        return;
    }
    const auto found = cityFilesIn(folder.absolutePath().toStdString(), {});
    if (found) {
        for (const auto& file : found->files)
            sorted.cities << QString::fromStdString(file.string());
        sorted.remarks.insert(sorted.remarks.end(), found->remarks.begin(), found->remarks.end());
    } else if (!inside.cities.isEmpty() || !inside.vehicles.isEmpty() ||
               !inside.unclear.isEmpty()) {
        sorted.cities << inside.cities;
        sorted.vehicles << inside.vehicles;
        sorted.unclear << inside.unclear;
    } else {
        sorted.unknown << folder.absolutePath();
    }
}

}  // namespace

DroppedFiles sortDropped(const QStringList& paths) {
    DroppedFiles sorted;
    for (const QString& path : paths) {
        const QFileInfo file(path);
        if (file.isDir()) {
            sortFolder(QDir(path), sorted);
        } else {
            sortFile(file, sorted);
        }
    }
    return sorted;
}

QString cityPatterns() {
    QStringList patterns;
    for (const std::string& suffix : citySuffixes())
        patterns << QStringLiteral("*.") + QString::fromStdString(suffix);
    return patterns.join(QLatin1Char(' '));
}

QString cityFormatNames() {
    QStringList names;
    for (const CityFormat& format : cityFormats())
        names << QString::fromUtf8(format.name.data(), qsizetype(format.name.size()));
    return names.join(QStringLiteral(", "));
}

}  // namespace reflet
