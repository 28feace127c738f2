// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/Error.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace reflet {

/// Whether an `ffmpeg` can be found in PATH: without one, films become folders of pictures.
[[nodiscard]] bool isFfmpegThere();

/// Writes pictures as a film, one after the other: an MP4 (H.264, yuv420p, crf 20, faststart: plays
/// everywhere) by the ffmpeg found in PATH, else numbered PNG files in a folder. What is written
/// has a temporary name until finish(); without finish() nothing is left behind.
class VideoWriter {
public:
    struct Format {
        int width = 1280;  ///< of the pictures; the film's is the next even number below
        int height = 720;
        int framesPerSecond = 30;
    };
    enum class Encoder { FfmpegOrPictures, Pictures };

    /// path: of the film; pictures go into a folder of the same name without its extension. Usage
    /// for sizes below 2 or rates outside 1..240; WriteFailed when the place cannot be written.
    [[nodiscard]] static Result<std::unique_ptr<VideoWriter>> open(
        const std::filesystem::path& path, const Format& format,
        Encoder encoder = Encoder::FfmpegOrPictures);
    virtual ~VideoWriter() = default;
    VideoWriter(const VideoWriter&) = delete;
    VideoWriter& operator=(const VideoWriter&) = delete;

    /// Adds a picture: 8-bit sRGB, three bytes a pixel, rows from the top, of the format's size.
    /// WriteFailed with the words of ffmpeg when it gave up.
    [[nodiscard]] virtual Result<void> add(std::span<const std::uint8_t> rgb) = 0;
    /// Completes the film and gives it its name; returns the file, or the folder of pictures.
    [[nodiscard]] virtual Result<std::filesystem::path> finish() = 0;

protected:
    VideoWriter() = default;
};

}  // namespace reflet
