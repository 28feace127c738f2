// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/pipeline/Render.h"
#include "core/baking/AmbientVolume.h"
#include "core/io/VideoWriter.h"

#include <filesystem>
#include <memory>
#include <string>

namespace reflet {

struct FilmOptions {
    int width = 1280;
    int height = 720;
    int framesPerSecond = 30;
    double seconds = 20.0;
    double start = 0.0;     ///< seconds of the drive at which the film starts
    std::string reflector;  ///< that the camera follows; empty = the first
    Method method = Method::Mem;
    int samplesPerEdge = 1;  ///< supersampling
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

/// Draws a drive with OpenGL (a context of its own, in the calling thread) and writes it as a
/// film. Usage when nothing drives; ResourceLimit without OpenGL 4.5. `ambient` may be null.
/// Nothing is left behind on failure or cancellation.
[[nodiscard]] Result<FilmReport> renderFilm(const PreparedCity& city, const RemSet& rems,
                                            const Traffic& traffic,
                                            std::shared_ptr<const AmbientVolume> ambient,
                                            const FilmOptions& options,
                                            const std::filesystem::path& path,
                                            const JobContext& job);

}  // namespace reflet
