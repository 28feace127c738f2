// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/shell/FirstPicture.h"

#include "widgets/viewport/Viewport.h"

#include <QByteArray>
#include <QFile>
#include <algorithm>
#include <ctime>
#include <unistd.h>

namespace reflet {

int millisecondsSinceStart() {
    // proc(5): the 22nd field, in clock ticks since the system started. The second is the program's
    // name in brackets, which may hold anything.
    constexpr int kFieldAfterName = 22 - 3;
    constexpr double kMilliseconds = 1000.0;
    QFile file(QStringLiteral("/proc/self/stat"));
    timespec now{};
    if (!file.open(QIODevice::ReadOnly) || clock_gettime(CLOCK_BOOTTIME, &now) != 0)
        return 0;
    const QByteArray text = file.readAll();
    const QList<QByteArray> fields = text.mid(text.lastIndexOf(')') + 2).split(' ');
    const long ticks = sysconf(_SC_CLK_TCK);
    if (fields.size() <= kFieldAfterName || ticks <= 0)
        return 0;
    const double started = fields[kFieldAfterName].toDouble() / double(ticks);
    const double seconds = double(now.tv_sec) + double(now.tv_nsec) * 1e-9;
    return std::max(0, int((seconds - started) * kMilliseconds));
}

FirstPicture::FirstPicture(Viewport& viewport, QObject* parent) : QObject(parent) {
    connect(&viewport, &Viewport::frameDrawn, this, [this](const FrameStatistics& statistics) {
        // Without a city there is only the sky: no triangles.
        if (!m_seen && statistics.triangles > 0) {
            m_seen = true;
            Q_EMIT shown(millisecondsSinceStart());
        }
    });
}

}  // namespace reflet
