// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/VehicleComparison.h"

#include "app/pipeline/Render.h"
#include "core/io/ImageFile.h"

#include <fmt/format.h>

namespace reflet {

Result<void> VehicleComparison::begin(const ComparedPose& pose, std::size_t number,
                                      const JobContext& job) {
    m_number = number;
    m_rows.clear();
    auto maps = TrafficMaps::create(m_city, m_rems, pose.withOthers(m_traffic), job);
    if (!maps)
        return tl::unexpected(maps.error());
    m_maps = std::make_unique<TrafficMaps>(std::move(*maps));
    if (!m_options.drawVehicle)
        return {};
    m_camera = streetCamera(m_city, pose.placed);
    auto truth = draw({}, job);
    if (!truth)
        return tl::unexpected(truth.error());
    m_mask = std::move(truth->reflector);
    m_truth = toDisplayImage(*truth, m_city.project().exposure);
    auto written = write(m_truth, "raytrace");
    if (!written)
        return tl::unexpected(written.error());
    m_reference = std::move(*written);
    return {};
}

Result<void> VehicleComparison::add(Method method, const std::vector<LocalEnvironmentMap>& maps,
                                    FigureTally& tally, SheetCell& cell, const JobContext& job) {
    if (!m_options.drawVehicle)
        return {};
    auto view = method == Method::PerPixel ? drawPixels(job) : draw(maps, job);
    if (!view)
        return tl::unexpected(view.error());
    const DisplayImage image = toDisplayImage(*view, m_city.project().exposure);
    std::vector<float> errors = tally.vehicle.add(image, m_truth, m_mask);
    FlipAccumulator pool;
    pool.add(errors, m_mask);
    cell.vehicleFlip = pool.mean().value_or(0.0);
    for (std::size_t i = 0; i < errors.size(); ++i)
        errors[i] = m_mask[i] != 0 ? errors[i] : 0.0F;
    auto picture = write(image, toString(method));
    if (!picture)
        return tl::unexpected(picture.error());
    auto heat = write(heatImage(errors, image.width), std::string(toString(method)) + "-flip");
    if (!heat)
        return tl::unexpected(heat.error());
    cell.picture = std::move(*picture);
    cell.heat = std::move(*heat);
    if (m_options.output) {
        PsnrAccumulator likeness;
        likeness.add(image, m_truth, m_mask);
        const auto decibels = likeness.decibels();
        const std::string psnr = decibels ? fmt::format("{:.1f} dB", *decibels) : "the same";
        m_rows.push_back(
            {{m_truth, "reference, ray traced"},
             {image, fmt::format("{}: {}", toString(method), psnr)},
             {heatImage(errors, image.width), fmt::format("flip {:.3f}", *cell.vehicleFlip)}});
    }
    return {};
}

Result<std::filesystem::path> VehicleComparison::finish() {
    return m_rows.empty() ? std::filesystem::path() : write(arranged(m_rows), "all");
}

Result<RenderedView> VehicleComparison::draw(const std::vector<LocalEnvironmentMap>& maps,
                                             const JobContext& job) {
    std::vector<PlacedBody> bodies = m_maps->bodies();
    for (std::size_t i = 0; i < maps.size(); ++i)
        bodies[i].map = maps[i].radiance.empty() ? nullptr : &maps[i];
    return draw(bodies, job);
}

Result<RenderedView> VehicleComparison::drawPixels(const JobContext& job) {
    std::vector<PlacedBody> bodies = m_maps->bodies();
    m_maps->lookUpPixels(bodies);
    return draw(bodies, job);
}

Result<RenderedView> VehicleComparison::draw(std::span<const PlacedBody> bodies,
                                             const JobContext& job) const {
    return renderView(m_maps->scene(), bodies, m_camera,
                      {m_options.width, m_options.height, m_options.samplesPerEdge}, job);
}

/// The path of the picture; empty without an output folder.
Result<std::filesystem::path> VehicleComparison::write(const DisplayImage& image,
                                                       const std::string& name) {
    if (!m_options.output)
        return std::filesystem::path();
    auto path = *m_options.output / fmt::format("pose-{:02}-{}.png", m_number, name);
    if (auto written = writePng(image, path); !written)
        return tl::unexpected(written.error());
    pictures.push_back(path);
    return path;
}

}  // namespace reflet
