// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/StartOptions.h"

#include "app/pipeline/Version.h"

#include <QCommandLineParser>
#include <QCoreApplication>
#include <QFileInfo>
#include <QStandardPaths>
#include <algorithm>

namespace reflet {
namespace {

QString text(const char* source) {
    return QCoreApplication::translate("reflet::StartOptions", source);
}

}  // namespace

Result<ParsedStart> parseStart(const QStringList& arguments) {
    QCommandLineParser parser;
    parser.setApplicationDescription(
        text("Vehicles that reflect the city they drive through. Without a file, a sample opens."));
    const QCommandLineOption help({QStringLiteral("h"), QStringLiteral("help")},
                                  text("Say this and end."));
    const QCommandLineOption version({QStringLiteral("v"), QStringLiteral("version")},
                                     text("Say the version and end."));
    const QCommandLineOption screenshot(QStringLiteral("screenshot"),
                                        text("Write a picture of the window, then end."),
                                        QStringLiteral("OUT.png"));
    const QCommandLineOption after(QStringLiteral("after"),
                                   text("Seconds until the screenshot is taken (3), or "
                                        "first-picture: as soon as the city is drawn."),
                                   QStringLiteral("SECONDS"), QStringLiteral("3"));
    const QCommandLineOption times(
        QStringLiteral("say-times"),
        text("Say on the standard error how long the first picture of the city took, and whenever "
             "the window did not answer for more than a twentieth of a second."));
    const QCommandLineOption rehearse(
        QStringLiteral("rehearse"),
        text("Do a planner's work on a copy of the project, from a drive to opening another one; "
             "say for each step how long the window did not answer, and after how many pictures a "
             "slider's effect was seen; then end."));
    const QCommandLineOption samples(
        QStringLiteral("samples"),
        text("Where the built-in samples lie or are written (the user's data folder)."),
        QStringLiteral("FOLDER"));
    parser.addOptions({help, version, samples, screenshot, after, times, rehearse});
    parser.addPositionalArgument(QStringLiteral("FILE"),
                                 text("Projects (.reflet) or city models (CityJSON, CityGML)."),
                                 QStringLiteral("[FILE]..."));
    const std::string remedy = text("reflet --help lists the options").toStdString();
    if (!parser.parse(arguments)) {
        return fail(ErrorCode::Usage, parser.errorText().toStdString(), "", remedy);
    }
    ParsedStart parsed;
    if (parser.isSet(help)) {
        parsed.text = parser.helpText();
        return parsed;
    }
    if (parser.isSet(version)) {
        parsed.text = QStringLiteral("reflet %1\n").arg(QLatin1String(kVersion));
        return parsed;
    }
    if (parser.isSet(samples)) {
        parsed.options.samples = QFileInfo(parser.value(samples)).absoluteFilePath();
    }
    parsed.options.screenshot = parser.value(screenshot);
    parsed.options.sayTimes = parser.isSet(times);
    parsed.options.rehearse = parser.isSet(rehearse);
    parsed.options.screenshotAtFirstPicture =
        parser.value(after) == QStringLiteral("first-picture");
    bool number = parsed.options.screenshotAtFirstPicture;
    if (!number) {
        parsed.options.screenshotAfter = parser.value(after).toDouble(&number);
    }
    if (!number || parsed.options.screenshotAfter < 0.0) {
        return fail(ErrorCode::Usage,
                    "the seconds must be a number that is not negative, or first-picture",
                    "--after", remedy);
    }
    for (const QString& file : parser.positionalArguments()) {
        parsed.options.files << QFileInfo(file).absoluteFilePath();
    }
    return parsed;
}

QString sampleFolder(const StartOptions& options) {
    if (!options.samples.isEmpty())
        return options.samples;
    return QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) +
           QStringLiteral("/samples");
}

QString firstProject(const StartOptions& options) {
    QString file = sampleFolder(options) + QStringLiteral("/square.reflet");
    if (!options.files.isEmpty()) {
        const auto project = std::find_if(
            options.files.begin(), options.files.end(),
            [](const QString& path) { return path.endsWith(QStringLiteral(".reflet")); });
        file = project != options.files.end() ? *project : QString();
    }
    return QFileInfo(file).isFile() ? file : QString();
}

}  // namespace reflet
