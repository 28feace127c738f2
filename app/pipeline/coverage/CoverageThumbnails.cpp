// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/coverage/CoverageThumbnails.h"

#include "app/pipeline/Bake.h"
#include "app/pipeline/ComparedPose.h"
#include "app/pipeline/Render.h"
#include "core/io/ImageText.h"

#include <fmt/format.h>

#include <algorithm>

namespace reflet {

namespace {

constexpr int kGap = 8;       // pixels between pictures
constexpr int kCaption = 28;  // pixels of a line of words
constexpr glm::vec3 kInk{0.1F};
constexpr glm::vec3 kPaper{1.0F};

/// The maps of the probes that can be baked; Refused where one is not baked yet.
Result<RemSet> bakedRems(const PreparedCity& city, const JobContext& job) {
    const auto& probes = city.project().probes;
    RemSet rems;
    std::size_t missing = 0;
    for (const RemSet::Pointer& map : cachedRems(city, probes, job)) {
        if (map)
            rems.add(map);
        else
            ++missing;
    }
    if (missing == probes.size())
        return fail(ErrorCode::Refused, "no probe is baked: there is nothing to show",
                    city.project().name, "Bake them first: `reflet-cli bake P.reflet`.");
    if (missing > 0)
        return fail(ErrorCode::Refused,
                    fmt::format("{} of {} probes are not baked", missing, probes.size()),
                    city.project().name,
                    "Bake them first, `reflet-cli bake P.reflet`; move those that it refuses.");
    return rems;
}

/// The first vehicle that drives the route and mirrors, put there where there is none.
Result<std::size_t> driverOf(Traffic& traffic, const WorstPlace& place, const PreparedCity& city,
                             const std::string& vehicle) {
    for (const std::size_t k : mirrorsOf(traffic))
        if (traffic.drive(k).routeId == place.route)
            return k;
    const auto& routes = city.project().routes;
    const auto spec = std::find_if(routes.begin(), routes.end(),
                                   [&](const RouteSpec& r) { return r.id == place.route; });
    if (spec == routes.end())
        return fail(ErrorCode::Usage, "the project has no route of that name", place.route);
    auto made = vehicleOf(city.project(), vehicle.empty() ? "tram" : vehicle, city.folder());
    if (!made)
        return tl::unexpected(made.error());
    traffic.add({"worst-" + place.route, place.route, std::move(*made),
                 std::make_shared<const Route>(routeInFrame(*spec, city.project().frame))});
    traffic.settle();
    return traffic.size() - 1;
}

void paste(DisplayImage& sheet, const DisplayImage& picture, int x, int y) {
    for (int row = 0; row < picture.height; ++row) {
        const auto from = picture.pixels.begin() + std::ptrdiff_t(row) * picture.width;
        std::copy(from, from + picture.width,
                  sheet.pixels.begin() + std::ptrdiff_t(y + row) * sheet.width + x);
    }
}

/// The sheet as it grows.
class Sheet {
public:
    Sheet(const PreparedCity& city, const ThumbnailOptions& options, std::size_t rows)
        : m_city(city), m_options(options) {
        m_image.width = 2 * options.width + 3 * kGap;
        m_image.height = kCaption + int(rows) * (kCaption + options.height + kGap);
        m_image.pixels.assign(std::size_t(m_image.width) * std::size_t(m_image.height), kPaper);
        write("reflections from the probes", kGap, kCaption - 10);
        write("reference, ray traced", 2 * kGap + options.width, kCaption - 10);
    }

    Result<void> addRow(std::size_t row, const WorstPlace& place, const PlacedReflector& placed,
                        const RemSet& rems, const JobContext& job) {
        const int top = kCaption + int(row) * (kCaption + m_options.height + kGap);
        write(fmt::format("{}. {}, {:.0f} to {:.0f} m: {:.1f} % covered", row + 1, place.name,
                          place.from, place.to, 100.0 * place.coverage),
              kGap, top + kCaption - 9);
        RenderOptions options;
        options.width = m_options.width;
        options.height = m_options.height;
        options.samplesPerEdge = m_options.samplesPerEdge;
        const Camera camera = streetCamera(m_city, placed);
        int left = kGap;
        for (const Method method : {Method::Mem, Method::RayTrace}) {
            options.method = method;
            const auto view = renderPicture(m_city, rems, {placed}, camera, options, job);
            if (!view)
                return tl::unexpected(view.error());
            paste(m_image, toDisplayImage(*view, m_city.project().exposure), left, top + kCaption);
            left += m_options.width + kGap;
        }
        return {};
    }

    Result<DisplayImage> take() && {
        if (auto done = drawTexts(m_image, m_texts); !done)
            return tl::unexpected(done.error());
        return std::move(m_image);
    }

private:
    void write(std::string text, int x, int baseline) {
        m_texts.push_back({std::move(text), {x, baseline}, 16, kInk, ImageText::Align::Left});
    }

    const PreparedCity& m_city;
    const ThumbnailOptions& m_options;
    DisplayImage m_image;
    std::vector<ImageText> m_texts;
};

}  // namespace

Result<DisplayImage> worstPlaces(const CoverageReport& report, const PreparedCity& city,
                                 const ThumbnailOptions& options, const JobContext& job) {
    if (report.worst.empty())
        return fail(ErrorCode::Usage, "there are no worst places to show", city.project().name,
                    "They are those of routes: draw one, or take --on routes.");
    const auto rems = bakedRems(city, job);
    if (!rems)
        return tl::unexpected(rems.error());
    auto traffic = trafficOf(city.project(), city.folder());
    if (!traffic)
        return tl::unexpected(traffic.error());
    Sheet sheet(city, options, report.worst.size());
    for (std::size_t k = 0; k < report.worst.size(); ++k) {
        job.progress(double(k) / double(report.worst.size()));
        const WorstPlace& place = report.worst[k];
        const auto driver = driverOf(*traffic, place, city, options.vehicle);
        if (!driver)
            return tl::unexpected(driver.error());
        const PlacedReflector placed = traffic->atStation(*driver, 0.5 * (place.from + place.to));
        if (auto added = sheet.addRow(k, place, placed, *rems, job); !added)
            return tl::unexpected(added.error());
    }
    return std::move(sheet).take();
}

}  // namespace reflet
