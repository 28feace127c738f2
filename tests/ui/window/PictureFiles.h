// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QImage>
#include <QProcess>
#include <QStandardPaths>
#include <QString>
#include <cmath>
#include <filesystem>
#include <limits>

// Saved pictures and films, looked at by others than Reflet.

namespace reflet::test {

[[nodiscard]] inline QImage loaded(const std::filesystem::path& file) {
    return QImage(QString::fromStdString(file.string()));
}

/// Mean absolute difference of all channels, of 255; infinite for pictures of unlike size or none.
[[nodiscard]] inline double difference(const QImage& a, const QImage& b) {
    // Films and pictures leave out the last row or column of odd sizes.
    if (a.isNull() || b.isNull() || std::abs(a.width() - b.width()) > 1 ||
        std::abs(a.height() - b.height()) > 1)
        return std::numeric_limits<double>::infinity();
    double sum = 0.0;
    const int width = std::min(a.width(), b.width());
    const int height = std::min(a.height(), b.height());
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const QRgb p = a.pixel(x, y);
            const QRgb q = b.pixel(x, y);
            sum += std::abs(qRed(p) - qRed(q)) + std::abs(qGreen(p) - qGreen(q)) +
                   std::abs(qBlue(p) - qBlue(q));
        }
    }
    return sum / (3.0 * width * height);
}

[[nodiscard]] inline bool hasProgram(const char* name) {
    return !QStandardPaths::findExecutable(QString::fromLatin1(name)).isEmpty();
}

/// "codec,width,height,pixel format,frames" as ffprobe tells; empty when it cannot read the film.
[[nodiscard]] inline QString probed(const std::filesystem::path& film) {
    QProcess probe;
    probe.start(
        QStringLiteral("ffprobe"),
        {QStringLiteral("-v"), QStringLiteral("error"), QStringLiteral("-select_streams"),
         QStringLiteral("v:0"), QStringLiteral("-show_entries"),
         QStringLiteral("stream=codec_name,width,height,pix_fmt,nb_frames"), QStringLiteral("-of"),
         QStringLiteral("csv=p=0"), QString::fromStdString(film.string())});
    probe.waitForFinished();
    return QString::fromUtf8(probe.readAllStandardOutput()).trimmed();
}

/// One picture of a film, decoded by ffmpeg; null when there is none.
[[nodiscard]] inline QImage frameOf(const std::filesystem::path& film, int number,
                                    const std::filesystem::path& scratch) {
    QProcess::execute(
        QStringLiteral("ffmpeg"),
        {QStringLiteral("-v"), QStringLiteral("error"), QStringLiteral("-y"), QStringLiteral("-i"),
         QString::fromStdString(film.string()), QStringLiteral("-vf"),
         QStringLiteral("select=eq(n\\,%1)").arg(number), QStringLiteral("-frames:v"),
         QStringLiteral("1"), QString::fromStdString(scratch.string())});
    return loaded(scratch);
}

}  // namespace reflet::test
