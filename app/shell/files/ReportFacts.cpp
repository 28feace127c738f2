// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/files/ReportFacts.h"

#include <QCoreApplication>
#include <QFileInfo>
#include <QLocale>
#include <algorithm>
#include <cmath>

namespace reflet {

namespace {

struct Words {
    Q_DECLARE_TR_FUNCTIONS(reflet::ReportFacts)
};

QString nameOf(const FileReport& report) {
    return QFileInfo(QString::fromStdString(report.file)).fileName();
}

QString resultText(ObjectResult result) {
    switch (result) {
        case ObjectResult::Loaded:
            return Words::tr("loaded");
        case ObjectResult::Repaired:
            return Words::tr("mended");
        case ObjectResult::Skipped:
            break;
    }
    return Words::tr("left out");
}

QString ruleText(CrsRule rule) {
    switch (rule) {
        case CrsRule::Declared:
            return Words::tr("as the file says");
        case CrsRule::Format:
            return Words::tr("as the format has it");
        case CrsRule::Given:
            return Words::tr("as you said");
        case CrsRule::Replaced:
            return Words::tr("as you said, in place of what the file says");
        case CrsRule::Assumed:
            break;
    }
    return Words::tr("nobody said");
}

QString crsText(const SourceSummary& summary) {
    const QString crs = summary.crsHorizontal ? QString::fromStdString(*summary.crsHorizontal)
                                              : Words::tr("local metres");
    return Words::tr("%1, %2").arg(crs, ruleText(summary.crsAccount.rule));
}

QString operationText(const CrsAccount& account) {
    if (account.operation.empty())
        return Words::tr("none: the coordinates were taken as they are");
    const QString accuracy =
        account.accuracy ? Words::tr("accurate to %1 m").arg(QLocale().toString(*account.accuracy))
                         : Words::tr("accuracy unknown");
    return Words::tr("%1 (%2)").arg(QString::fromStdString(account.operation), accuracy);
}

QString listed(const std::vector<std::string>& texts) {
    constexpr std::size_t kShown = 100;
    QStringList list;
    for (std::size_t i = 0; i < std::min(texts.size(), kShown); ++i)
        list << QString::fromStdString(texts[i]);
    if (texts.size() > kShown)
        list << QStringLiteral("…");
    return list.join(QStringLiteral(", "));
}

QString countsText(const ImportCounts& counts) {
    const QLocale locale;
    return Words::tr("%1 loaded, %2 mended, %3 left out")
        .arg(locale.toString(qulonglong(counts.loaded)),
             locale.toString(qulonglong(counts.repaired)),
             locale.toString(qulonglong(counts.skipped)));
}

FileFacts factsOf(const FileReport& report, const LoadedCity& city) {
    const QLocale locale;
    const SourceSummary& s = report.summary;
    FileFacts out{nameOf(report), {}};
    const auto add = [&](const QString& name, const QString& value) {
        if (!value.isEmpty())
            out.facts.emplace_back(name, value);
    };
    add(Words::tr("Format"), QString::fromStdString(s.format + ' ' + s.version).trimmed());
    add(Words::tr("Objects"), countsText(report.counts));
    add(Words::tr("Levels of detail"), listed(s.lods));
    add(Words::tr("Coordinates"), crsText(s));
    if (s.crsAccount.written)
        add(Words::tr("In the file"), QString::fromStdString(*s.crsAccount.written).left(400));
    add(Words::tr("Heights"),
        s.crsVertical ? QString::fromStdString(*s.crsVertical) : Words::tr("in an unknown datum"));
    add(Words::tr("Transformation"), operationText(s.crsAccount));
    const glm::dvec3& origin = city.city.frame.origin;
    add(Words::tr("Origin subtracted"),
        Words::tr("%1 east, %2 north")
            .arg(locale.toString(origin.x, 'f', 0), locale.toString(origin.y, 'f', 0)));
    if (s.texturesReferenced > 0)
        add(Words::tr("Textures"), Words::tr("%1 of %2 found")
                                       .arg(locale.toString(qulonglong(s.texturesResolved)),
                                            locale.toString(qulonglong(s.texturesReferenced))));
    add(Words::tr("Missing textures"), listed(s.texturesMissing));
    add(Words::tr("Reading took"), Words::tr("%1 s").arg(locale.toString(report.seconds, 'f', 2)));
    if (report.peakMemory > 0)
        add(Words::tr("Most memory"),
            Words::tr("%1, of the whole program")
                .arg(locale.formattedDataSize(qint64(report.peakMemory))));
    return out;
}

bool isPartOf(const CityModel& city, std::uint32_t object, std::uint32_t whole) {
    constexpr int kDeepest = 64;
    for (int i = 0; i < kDeepest && object != whole; ++i) {
        if (!city.objects[object].parent)
            return false;
        object = *city.objects[object].parent;
    }
    return object == whole;
}

}  // namespace

QString reportSummary(const LoadedCity& city) {
    ImportCounts all;
    for (const FileReport& report : city.files) {
        all.loaded += report.counts.loaded;
        all.repaired += report.counts.repaired;
        all.skipped += report.counts.skipped;
    }
    QString text = Words::tr("Objects: %1.").arg(countsText(all));
    constexpr double kOnIt = 0.05;  // metres
    if (city.groundFit && std::abs(city.groundFit->median) < kOnIt)
        text += QLatin1Char(' ') + Words::tr("The buildings stand on the terrain.");
    else if (city.groundFit)
        text += QLatin1Char(' ') +
                (city.groundFit->median > 0.0
                     ? Words::tr("The buildings stand %1 m above the terrain (median).")
                     : Words::tr("The buildings reach %1 m into the terrain (median)."))
                    .arg(QLocale().toString(std::abs(city.groundFit->median), 'f', 2));
    else if (city.generatedGround)
        text += QLatin1Char(' ') + Words::tr("The ground is generated from the buildings.");
    return text;
}

bool isWorthTelling(const LoadedCity& city) {
    return std::any_of(city.files.begin(), city.files.end(), [](const FileReport& report) {
        return report.counts.repaired + report.counts.skipped > 0 ||
               std::any_of(report.diagnostics.begin(), report.diagnostics.end(),
                           [](const Diagnostic& d) { return d.severity != Severity::Info; });
    });
}

std::vector<FileRemark> reportRemarks(const LoadedCity& city) {
    std::vector<FileRemark> remarks;
    for (const FileReport& report : city.files) {
        const QString file = nameOf(report);
        for (std::size_t i = 0; i < report.diagnostics.size(); ++i) {
            FileRemark remark{file, report.diagnostics[i]};
            if (const ObjectAccount* account = report.accountOf(i)) {
                remark.type = QString::fromStdString(account->type);
                remark.lod = QString::fromStdString(account->lod);
                remark.result = resultText(account->result);
            }
            remarks.push_back(std::move(remark));
        }
    }
    for (const Diagnostic& remark : city.remarks)
        remarks.push_back({{}, remark});
    return remarks;
}

std::vector<FileFacts> reportFacts(const LoadedCity& city) {
    std::vector<FileFacts> facts;
    for (const FileReport& report : city.files)
        facts.push_back(factsOf(report, city));
    return facts;
}

Box boxOfObject(const LoadedCity& loaded, const QString& fileName, const std::string& object) {
    const CityModel& city = loaded.city;
    std::uint32_t whole = kNone;
    for (const FileReport& report : loaded.files) {
        if (nameOf(report) != fileName)
            continue;
        for (std::uint32_t i = 0; i < report.objectCount && whole == kNone; ++i) {
            const std::uint32_t index = report.firstObject + i;
            if (index < city.objects.size() && city.objects[index].id == object)
                whole = index;
        }
    }
    Box box;
    if (whole == kNone)
        return box;
    std::vector<bool> inside(city.objects.size());
    for (std::uint32_t i = 0; i < inside.size(); ++i)
        inside[i] = isPartOf(city, i, whole);
    for (const CityTriangle& triangle : city.triangles) {
        if (!inside[city.surfaces[triangle.surface].object])
            continue;
        for (const std::uint32_t vertex : triangle.vertex)
            box.add(glm::dvec3(city.vertices[vertex]));
    }
    return box;
}

}  // namespace reflet
