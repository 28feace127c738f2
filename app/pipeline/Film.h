// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/Render.h"
#include "core/io/VideoWriter.h"

#include <filesystem>
#include <functional>
#include <string>

namespace reflet {

struct FilmOptions {
    int width = 1280;
    int height = 720;
    int framesPerSecond = 30;
    double seconds = 20.0;
    double start = 0.0;     ///< seconds of the drive at which the film starts
    std::string reflector;  ///< that the camera turns after; empty = the first
    /// The camera at a second of the drive: the drive then goes on without cuts, again from its
    /// start when it has ended. Empty: FilmCamera.
    std::function<Camera(double)> camera;
    Method method = Method::Mem;  ///< everywhere, or left of the wipe; no RayTrace
    std::optional<Method> right;  ///< right of the wipe
    float wipe = 0.5F;            ///< share of the width that is left of it
    int samplesPerEdge = 1;       ///< supersampling
    VideoWriter::Encoder encoder = VideoWriter::Encoder::FfmpegOrPictures;
};

struct FilmReport {
    std::filesystem::path file;  ///< the film, or the folder of its pictures
    std::size_t frames = 0;
};

/// The camera of a film at each moment: stands on the pavement and turns after the vehicle, from a
/// new place every few seconds (a cut).
class FilmCamera {
public:
    /// The traffic and the city must outlive this.
    FilmCamera(const PreparedCity& city, const Traffic& traffic, std::size_t reflector,
               double start, double seconds);
    /// second: of the film, 0 .. seconds.
    [[nodiscard]] Camera at(double second) const;
    /// Seconds of the drive at that moment: a drive that is shorter than the film starts again at
    /// a cut.
    [[nodiscard]] double driveTime(double second) const;

private:
    struct Shot {
        double from = 0.0;   ///< second of the film
        double drive = 0.0;  ///< second of the drive at that moment
        Camera camera;
    };
    [[nodiscard]] const Shot& shotAt(double second) const;

    const Traffic& m_traffic;
    std::size_t m_reflector;
    std::vector<Shot> m_shots;
};

/// Draws a drive as drawFrame() does and writes it as a film. Usage when nothing drives, and for
/// Method::RayTrace; ResourceLimit without OpenGL 4.5. Nothing is left behind on failure or
/// cancellation.
[[nodiscard]] Result<FilmReport> renderFilm(const PreparedCity& city, const RemSet& rems,
                                            const Traffic& traffic, const FilmOptions& options,
                                            const std::filesystem::path& path,
                                            const JobContext& job);

}  // namespace reflet
