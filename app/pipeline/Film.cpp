// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Film.h"

#include "app/pipeline/GlStage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace reflet {

namespace {

constexpr double kShotSeconds = 5.0;  ///< about as long as one looks before one wants to move on
/// Where in a shot the vehicle stands as a good picture shows it.
constexpr double kBestMoment = 0.55;
constexpr double kAim = 0.4;         // metres above the body's centre
constexpr double kLongest = 3600.0;  // seconds of film
constexpr double kNarrowest = 0.55;  // radians

void toBytes(const DisplayImage& image, std::vector<std::uint8_t>& rgb) {
    rgb.clear();
    for (const glm::vec3& pixel : image.pixels) {
        for (int c = 0; c < 3; ++c)
            rgb.push_back(std::uint8_t(std::lround(std::clamp(pixel[c], 0.0F, 1.0F) * 255.0F)));
    }
}

Result<std::size_t> followed(const Traffic& traffic, const FilmOptions& options) {
    if (traffic.size() == 0) {
        return fail(ErrorCode::Usage, "there is no vehicle to film", "",
                    "Draw a route and let a vehicle drive it.");
    }
    if (!(options.seconds > 0.0) || options.seconds > kLongest) {
        return fail(ErrorCode::Usage, "a film cannot be that long", "--seconds",
                    fmt::format("Take up to {:.0f} seconds.", kLongest));
    }
    if (options.method == Method::RayTrace || options.right == Method::RayTrace) {
        return fail(ErrorCode::Usage, "films are drawn with OpenGL, not ray traced", "--method",
                    "Take another method, or draw views without --film.");
    }
    return options.reflector.empty() ? Result<std::size_t>(0) : traffic.find(options.reflector);
}

FrameRequest requestOf(const PreparedCity& city, const FilmOptions& options) {
    FrameRequest frame;
    frame.width = options.width;
    frame.height = options.height;
    frame.samplesPerEdge = options.samplesPerEdge;
    frame.moving = true;
    frame.exposure = city.project().exposure;
    frame.tuning = city.project().tuning;
    // A film waits for what is due: it must not differ from machine to machine.
    frame.tuning.lod.frameBudget = std::numeric_limits<double>::infinity();
    frame.method = options.method;
    frame.right = options.right;
    frame.wipe = options.wipe;
    return frame;
}

/// Camera and moment of the drive at each second of the film, as the options want them.
class Course {
public:
    Course(const PreparedCity& city, const Traffic& traffic, std::size_t reflector,
           const FilmOptions& options)
        : m_options(options), m_duration(traffic.duration()) {
        if (!options.camera)
            m_pavement.emplace(city, traffic, reflector, options.start, options.seconds);
    }
    [[nodiscard]] double driveTime(double second) const {
        if (m_pavement)
            return m_pavement->driveTime(second);
        const double time = m_options.start + second;
        return m_duration > 0.0 ? std::fmod(time, m_duration) : m_options.start;
    }
    [[nodiscard]] Camera camera(double second) const {
        return m_pavement ? m_pavement->at(second) : m_options.camera(driveTime(second));
    }

private:
    const FilmOptions& m_options;
    double m_duration;
    std::optional<FilmCamera> m_pavement;
};

}  // namespace

FilmCamera::FilmCamera(const PreparedCity& city, const Traffic& traffic, std::size_t reflector,
                       double start, double seconds)
    : m_traffic(traffic), m_reflector(reflector) {
    const double end = traffic.secondsAt(reflector, traffic.route(reflector).length());
    const int shots = std::max(1, int(std::lround(seconds / kShotSeconds)));
    const double duration = seconds / shots;
    double time = start;
    for (int i = 0; i < shots; ++i) {
        if (time + duration > end)  // the drive starts again, or stands still when it is that short
            time = end > duration ? 0.0 : std::max(0.0, end - duration);
        Shot shot{i * duration, time, {}};
        shot.camera =
            reflet::streetCamera(city, traffic.at(reflector, time + kBestMoment * duration));
        shot.camera.verticalFov = std::max(shot.camera.verticalFov, kNarrowest);
        m_shots.push_back(shot);
        time += duration;
    }
}

const FilmCamera::Shot& FilmCamera::shotAt(double second) const {
    const auto next = std::find_if(m_shots.begin() + 1, m_shots.end(),
                                   [&](const Shot& shot) { return shot.from > second + 1e-9; });
    return *(next - 1);
}

double FilmCamera::driveTime(double second) const {
    const Shot& shot = shotAt(second);
    return shot.drive + second - shot.from;
}

Camera FilmCamera::at(double second) const {
    Camera camera = shotAt(second).camera;
    const PlacedReflector placed = m_traffic.at(m_reflector, driveTime(second));
    camera.target = placed.middle() + glm::dvec3(0.0, 0.0, kAim);
    return camera;
}

Result<FilmReport> renderFilm(const PreparedCity& city, const RemSet& rems, const Traffic& traffic,
                              const FilmOptions& options, const std::filesystem::path& path,
                              const JobContext& job) {
    const auto reflector = followed(traffic, options);
    if (!reflector)
        return tl::unexpected(reflector.error());
    auto writer = VideoWriter::open(path, {options.width, options.height, options.framesPerSecond},
                                    options.encoder);
    if (!writer)
        return tl::unexpected(writer.error());
    const auto renderer = glStage(city, job.phase("preparing", 0.0, 0.1));
    if (!renderer)
        return tl::unexpected(renderer.error());
    (*renderer)->setRems(rems);
    const Course course(city, traffic, *reflector, options);
    FrameRequest frame = requestOf(city, options);
    FilmReport report;
    report.frames =
        std::size_t(std::max(1L, std::lround(options.seconds * options.framesPerSecond)));
    const JobContext phase = job.phase("filming", 0.1, 1.0);
    std::vector<std::uint8_t> rgb;
    for (std::size_t i = 0; i < report.frames; ++i) {
        if (job.cancelled())
            return tl::unexpected(JobContext::cancelledError());
        phase.progress(double(i) / double(report.frames));
        const double second = double(i) / options.framesPerSecond;
        frame.camera = course.camera(second);
        frame.reflectors = traffic.at(course.driveTime(second));
        toBytes((*renderer)->drawImage(frame), rgb);
        if (auto added = (*writer)->add(rgb); !added)
            return tl::unexpected(added.error());
    }
    auto file = (*writer)->finish();
    if (!file)
        return tl::unexpected(file.error());
    report.file = std::move(*file);
    return report;
}

}  // namespace reflet
