// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/PaperFigures.h"

#include "app/pipeline/Bake.h"
#include "app/pipeline/ComparedPose.h"
#include "app/pipeline/Render.h"
#include "core/environment/CubeDirection.h"
#include "core/io/ImageFile.h"
#include "core/reconstruction/Reconstruction.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet {

namespace {

constexpr int kPlanEdge = 600;  ///< pixels
constexpr int kMeshEdge = 560;
constexpr int kViewWidth = 560, kViewHeight = 315;
constexpr glm::vec3 kRouteColor{0.15F, 0.45F, 1.0F};
constexpr glm::vec3 kProbeColor{1.0F, 0.2F, 0.15F};
constexpr glm::vec3 kMeshColor{1.0F, 0.85F, 0.1F};

int blockOf(const GridSpec& grid, int most) {
    return std::max(1, (std::max(grid.columns, grid.rows) + most - 1) / most);
}

/// A plan with north up, drawn on in frame coordinates.
class PlanPicture {
public:
    explicit PlanPicture(const Heightfield& field)
        : m_image(heightPicture(field, kPlanEdge)),
          m_grid(field.grid),
          m_pixel(field.grid.cellSize * blockOf(field.grid, kPlanEdge)) {}

    void dim() {
        for (glm::vec3& pixel : m_image.pixels)
            pixel = 0.25F + 0.6F * pixel;
    }
    void disc(double x, double y, double radius, const glm::vec3& color) {
        const double column = (x - m_grid.x0) / m_pixel;
        const double row = (m_grid.yMax() - y) / m_pixel;
        for (int j = int(std::floor(row - radius)); j <= int(std::ceil(row + radius)); ++j) {
            for (int i = int(std::floor(column - radius)); i <= int(std::ceil(column + radius));
                 ++i) {
                const bool inside = i >= 0 && j >= 0 && i < m_image.width && j < m_image.height;
                if (inside && std::hypot(i + 0.5 - column, j + 0.5 - row) <= radius)
                    m_image.pixels[std::size_t(j * m_image.width + i)] = color;
            }
        }
    }
    void line(const Route& route, double radius, const glm::vec3& color) {
        for (const double station : route.stations(0.5 * m_pixel)) {
            const glm::dvec3 at = route.at(station);
            disc(at.x, at.y, radius, color);
        }
    }
    [[nodiscard]] const DisplayImage& image() const { return m_image; }

private:
    DisplayImage m_image;
    GridSpec m_grid;
    double m_pixel;  ///< metres
};

/// Where the borders of a face's leaves run, in pixels of face space.
std::vector<bool> borders(const MemFace& face, int edge) {
    std::vector<bool> mask(std::size_t(edge) * std::size_t(edge), false);
    const auto pixel = [edge](double coordinate) {
        return std::clamp(int(0.5 * (coordinate + 1.0) * edge), 0, edge - 1);
    };
    const auto mark = [&](int column, int row) {
        mask[std::size_t(row) * std::size_t(edge) + std::size_t(column)] = true;
    };
    for (const MemQuad& quad : face.quads) {
        for (int column = pixel(quad.s0); column <= pixel(quad.s1); ++column)
            mark(column, pixel(quad.t0));
        for (int row = pixel(quad.t0); row <= pixel(quad.t1); ++row)
            mark(pixel(quad.s0), row);
    }
    return mask;
}

/// The view of 90 degrees along the axis of the frame that is nearest to where the vehicle goes,
/// with the mesh over it: a face of the cube, upright.
DisplayImage meshPicture(const PreparedCity& city, const RemSet& rems, const glm::dvec3& position,
                         const glm::dvec3& heading) {
    const MemSettings& settings = city.project().tuning;
    const auto prepared = city.preparedRems(rems);
    const ReconstructionInput input{&city.tracer(), rems, city.diameter(), prepared.get()};
    const LocalEnvironmentMap map = reconstructMem(input, position, settings);
    const std::vector<MemFace> faces =
        buildMemFaces(input, input.candidates(position, settings), position, settings);
    const bool alongX = std::abs(heading.x) >= std::abs(heading.y);
    const glm::dvec3 ahead = alongX ? glm::dvec3(heading.x < 0.0 ? -1.0 : 1.0, 0.0, 0.0)
                                    : glm::dvec3(0.0, heading.y < 0.0 ? -1.0 : 1.0, 0.0);
    const glm::dvec3 right(ahead.y, -ahead.x, 0.0);
    const std::vector<bool> mask = borders(faces[std::size_t(facePoint(ahead).face)], kMeshEdge);
    DisplayImage image{kMeshEdge, kMeshEdge, {}};
    for (int row = 0; row < kMeshEdge; ++row) {
        for (int column = 0; column < kMeshEdge; ++column) {
            const glm::dvec3 direction = ahead + texelCoordinate(kMeshEdge, column) * right -
                                         texelCoordinate(kMeshEdge, row) * glm::dvec3(0, 0, 1);
            const FacePoint at = facePoint(direction);
            const auto s = std::size_t(0.5 * (at.st.x + 1.0) * kMeshEdge);
            const auto t = std::size_t(0.5 * (at.st.y + 1.0) * kMeshEdge);
            const glm::vec3 seen =
                toDisplay(sampleBilinear(map.radiance, direction), city.project().exposure);
            image.pixels.push_back(mask[t * kMeshEdge + s] ? glm::mix(seen, kMeshColor, 0.65F)
                                                           : seen);
        }
    }
    return image;
}

/// Writes pictures into one folder and keeps their names.
class Folder {
public:
    Folder(const std::filesystem::path& folder, PaperFigures& figures)
        : m_folder(folder), m_figures(figures) {}
    Result<void> write(const DisplayImage& image, const char* name) {
        auto written = writePng(image, m_folder / name);
        if (written)
            m_figures.pictures.push_back(m_folder / name);
        return written;
    }

private:
    const std::filesystem::path& m_folder;
    PaperFigures& m_figures;
};

Result<void> drawPlans(const PreparedCity& city, Folder& folder) {
    PlanPicture plan(city.heightfield());
    if (auto written = folder.write(plan.image(), "figure-4-heightfield.png"); !written)
        return written;
    plan.dim();
    for (const RouteSpec& route : city.project().routes)
        plan.line(routeInFrame(route, city.project().frame), 1.2, kRouteColor);
    for (const Probe& probe : city.project().probes) {
        const glm::dvec3 at = city.inFrame(probe.position);
        plan.disc(at.x, at.y, 3.5, kProbeColor);
    }
    return folder.write(plan.image(), "figure-8-placement.png");
}

/// All vehicles of a pose, but for another one in the place of the first.
std::vector<PlacedReflector> inPlaceOf(const ComparedPose& pose, const Traffic& traffic,
                                       Vehicle vehicle) {
    std::vector<PlacedReflector> all = pose.withOthers(traffic);
    PlacedReflector& first = all.front();
    first.poses = bodyPoses(vehicle, traffic.route(pose.reflector), first.station);
    first.vehicle = std::make_shared<const Vehicle>(std::move(vehicle));
    return all;
}

/// A mirror ball, as in the paper: what a car's paint would forgive, it shows.
Result<void> drawBall(const PreparedCity& city, const RemSet& rems,
                      const std::vector<PlacedReflector>& vehicles, Folder& folder,
                      PaperFigures& figures, const JobContext& job) {
    const Camera camera = streetCamera(city, vehicles.front());
    RenderOptions options;
    options.width = kViewWidth;
    options.height = kViewHeight;
    const std::array<std::pair<Method, const char*>, 3> kinds{
        {{Method::Blend, "figure-9a-blend.png"},
         {Method::Rerender, "figure-9b-rerender.png"},
         {Method::Mem, "figure-9c-mem.png"}}};
    for (const auto& [method, name] : kinds) {
        options.method = method;
        auto view = renderPicture(city, rems, vehicles, camera, options, job);
        if (!view && method == Method::Rerender && view.error().code != ErrorCode::Cancelled) {
            figures.remarks.push_back({Severity::Warning, "figure-without-opengl", name,
                                       "It is ray traced: " + view.error().what,
                                       view.error().remedy});
            options.method = Method::RayTrace;
            view = renderPicture(city, rems, vehicles, camera, options, job);
        }
        if (!view)
            return tl::unexpected(view.error());
        auto written = folder.write(toDisplayImage(*view, city.project().exposure), name);
        if (!written)
            return written;
    }
    return {};
}

}  // namespace

DisplayImage heightPicture(const Heightfield& field, int most) {
    const GridSpec& grid = field.grid;
    const int block = blockOf(grid, most);
    const int width = (grid.columns + block - 1) / block;
    const int height = (grid.rows + block - 1) / block;
    std::vector<float> highest(std::size_t(width) * std::size_t(height), kMissingHeight);
    float low = kInfinity;
    float high = -kInfinity;
    for (int j = 0; j < grid.rows; ++j) {
        for (int i = 0; i < grid.columns; ++i) {
            const float h = field.topCenter[grid.index(i, j)];
            if (isMissing(h))
                continue;
            float& pixel = highest[std::size_t((height - 1 - j / block) * width + i / block)];
            pixel = isMissing(pixel) ? h : std::max(pixel, h);
            low = std::min(low, h);
            high = std::max(high, h);
        }
    }
    DisplayImage image{width, height, {}};
    for (const float h : highest) {
        const float grey = isMissing(h) ? 0.0F : high > low ? (h - low) / (high - low) : 1.0F;
        image.pixels.emplace_back(grey);
    }
    return image;
}

Result<PaperFigures> drawPaperFigures(const PreparedCity& city, const std::filesystem::path& folder,
                                      const JobContext& job) {
    const auto traffic = trafficOf(city.project(), city.folder());
    if (!traffic)
        return tl::unexpected(traffic.error());
    if (traffic->size() == 0 || city.project().probes.empty()) {
        return fail(ErrorCode::Usage, "the project has no vehicle or no probes to draw",
                    city.project().name,
                    "Add some with `reflet-cli edit`, or take `reflet-cli sample paper DIR`.");
    }
    const auto rems = loadRems(city, job.phase("baking", 0.0, 0.7));
    if (!rems)
        return tl::unexpected(rems.error());
    PaperFigures figures;
    figures.remarks = rems->failures;
    Folder out(folder, figures);
    if (auto drawn = drawPlans(city, out); !drawn)
        return tl::unexpected(drawn.error());
    const ComparedPose pose = spreadPoses(*traffic, 1).front();
    const glm::dvec3 heading = traffic->route(pose.reflector).tangent(pose.placed.station);
    const DisplayImage mesh = meshPicture(city, rems->rems, pose.placed.mapCenter(0), heading);
    if (auto written = out.write(mesh, "figure-7-mesh.png"); !written)
        return tl::unexpected(written.error());
    auto ball = builtInVehicle("sphere");
    if (!ball)
        return tl::unexpected(ball.error());
    auto drawn = drawBall(city, rems->rems, inPlaceOf(pose, *traffic, std::move(*ball)), out,
                          figures, job.phase("drawing", 0.7, 1.0));
    if (!drawn)
        return tl::unexpected(drawn.error());
    return figures;
}

}  // namespace reflet
