// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/document/HeadStart.h"
#include "app/document/LiveCity.h"
#include "app/shell/FirstPicture.h"
#include "app/shell/Icons.h"
#include "app/shell/MainWindow.h"
#include "app/shell/PauseWatch.h"
#include "app/shell/StartOptions.h"
#include "app/shell/Theme.h"
#include "app/shell/rehearsal/Rehearsal.h"
#include "core/base/Files.h"
#include "core/gpu/GlContext.h"

#include <QApplication>
#include <QFileInfo>
#include <QPixmap>
#include <QScreen>
#include <QSettings>
#include <QSurfaceFormat>
#include <QTemporaryDir>
#include <QTimer>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

namespace {

using namespace reflet;

constexpr int kUsage = 2;
constexpr int kNoDisplay = 3;
constexpr int kTakeScreenshot = -1;  // of the event loop: the window stays as it is meanwhile
constexpr double kMillisecondsPerSecond = 1000.0;
constexpr double kLongPause = 50.0;  // milliseconds: longer ones are felt

void sayPause(const PauseWatch::Pause& pause) {
    std::fprintf(stderr, "reflet: the interface paused for %.0f ms, %.0f of them at work: %s\n",
                 pause.milliseconds, pause.work, pause.what.toLocal8Bit().constData());
}

/// Read without any display, so that --help works everywhere.
std::optional<int> answerAtOnce(int argc, char** argv, StartOptions& options) {
    QStringList arguments;
    for (int i = 0; i < argc; ++i) {
        arguments << QString::fromLocal8Bit(argv[i]);
    }
    int count = 1;
    const QCoreApplication core(count, argv);
    const auto parsed = parseStart(arguments);
    if (!parsed) {
        std::fprintf(stderr, "reflet: %s\n", parsed.error().message().c_str());
        return kUsage;
    }
    if (parsed->text) {
        std::fputs(parsed->text->toLocal8Bit().constData(), stdout);
        return EXIT_SUCCESS;
    }
    options = parsed->options;
    return std::nullopt;
}

bool hasDisplay() {
    return qEnvironmentVariableIsSet("DISPLAY") || qEnvironmentVariableIsSet("WAYLAND_DISPLAY") ||
           qEnvironmentVariableIsSet("QT_QPA_PLATFORM");
}

/// Without a session bus, D-Bus's library forks to launch one. A fork waits for ever while another
/// thread is inside PROJ, which locks a mutex in the child, and the window waits for the fork.
void keepBusFromBeingLaunched() {
    constexpr const char* kAddress = "DBUS_SESSION_BUS_ADDRESS";
    const QString runtime = qEnvironmentVariable("XDG_RUNTIME_DIR");
    const bool usersBus = !runtime.isEmpty() && QFileInfo::exists(runtime + QStringLiteral("/bus"));
    if (!qEnvironmentVariableIsSet(kAddress) && !usersBus) {
        qputenv(kAddress, "disabled:");
    }
}

int takeScreenshot(const QWidget& window, const QString& path) {
    const QPixmap picture = window.screen()->grabWindow(window.winId());
    const bool saved = picture.save(path);
    if (!saved) {
        std::fprintf(stderr, "reflet: cannot write %s\n", path.toLocal8Bit().constData());
    }
    return saved ? EXIT_SUCCESS : EXIT_FAILURE;
}

int rehearse(MainWindow& window, PauseWatch& watch, const QTemporaryDir& folder) {
    const std::filesystem::path copies = std::filesystem::path(folder.path().toStdString()) / "p";
    if (const auto made = makeFolder(copies); !made) {
        std::fprintf(stderr, "reflet: %s\n", made.error().message().c_str());
        return EXIT_FAILURE;
    }
    const auto actions = Rehearsal(window, watch, copies).run();
    std::fputs(rehearsalText(actions).toLocal8Bit().constData(), stdout);
    const bool done = std::all_of(actions.begin(), actions.end(),
                                  [](const RehearsedAction& action) { return action.done; });
    return done ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
    QCoreApplication::setApplicationName(QStringLiteral("reflet"));
    QCoreApplication::setApplicationVersion(QStringLiteral(REFLET_VERSION));
    QGuiApplication::setDesktopFileName(QStringLiteral("reflet"));
    StartOptions options;
    if (const auto exitCode = answerAtOnce(argc, argv, options)) {
        return *exitCode;
    }
    if (!hasDisplay()) {
        std::fputs(
            "reflet: there is no display to open a window on. Start it on a desktop, or use "
            "reflet-cli, which needs none.\n",
            stderr);
        return kNoDisplay;
    }
    keepBusFromBeingLaunched();  // before there is any other thread
    // What a rehearsal leaves behind is none of the user's doing.
    std::optional<QTemporaryDir> rehearsed;
    if (options.rehearse) {
        rehearsed.emplace();
        QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, rehearsed->path());
    }
    // Who draws is found out, and the city is read, while the window is made.
    const std::jthread asking([] { static_cast<void>(drawsInSoftware()); });
    const QString first = firstProject(options);
    auto ahead =
        first.isEmpty()
            ? nullptr
            : std::make_shared<const HeadStart>(std::filesystem::path(first.toStdString()));
    QSurfaceFormat format;
    format.setVersion(4, 5);
    format.setProfile(QSurfaceFormat::CoreProfile);
    QSurfaceFormat::setDefaultFormat(format);
    QApplication::setAttribute(Qt::AA_ShareOpenGLContexts);
    PauseWatch watch(kLongPause, options.sayTimes ? sayPause : PauseWatch::Report());
    std::unique_ptr<QApplication> application;
    if (options.sayTimes || options.rehearse) {
        application = std::make_unique<WatchedApplication>(argc, argv, watch);
    } else {
        application = std::make_unique<QApplication>(argc, argv);
    }
    applyTheme(*application, savedTheme());
    QApplication::setWindowIcon(programIcon());

    MainWindow window;
    window.bench().live->setHeadStart(std::move(ahead));
    window.show();
    window.start(options);
    const FirstPicture firstPicture(*window.bench().viewport);
    QObject::connect(&firstPicture, &FirstPicture::shown, &window, [&](int milliseconds) {
        if (options.sayTimes) {
            std::fprintf(stderr, "reflet: first picture of the city after %d ms\n", milliseconds);
        }
        if (options.screenshotAtFirstPicture && !options.screenshot.isEmpty()) {
            QCoreApplication::exit(kTakeScreenshot);
        }
    });
    if (!options.screenshot.isEmpty() && !options.screenshotAtFirstPicture) {
        QTimer::singleShot(int(options.screenshotAfter * kMillisecondsPerSecond), &window,
                           [] { QCoreApplication::exit(kTakeScreenshot); });
    }
    int result = options.rehearse ? rehearse(window, watch, *rehearsed) : QApplication::exec();
    if (result == kTakeScreenshot) {
        result = takeScreenshot(window, options.screenshot);
    }
    if (options.sayTimes) {
        std::fputs("reflet: the longest of all pauses:\n", stderr);
        sayPause(watch.longest());
    }
    return result;
}
