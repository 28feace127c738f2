// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Pop.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>

namespace reflet {

namespace {

/// A method's local map at one place of the drive.
struct Moment {
    DisplayImage image;
    std::set<std::int32_t> rems;  ///< in use
};

std::set<std::int32_t> remsOf(const TexelSources& sources) {
    std::set<std::int32_t> rems;
    for (const auto& pair : sources.texels()) {
        for (const TexelSource& source : pair) {
            if (source.rem >= 0 && source.weight > 0.0F)
                rems.insert(source.rem);
        }
    }
    return rems;
}

struct Steps {
    std::vector<double> own, against;
    std::vector<bool> changed;

    void add(const Moment& before, const Moment& now, const DisplayImage& truthBefore,
             const DisplayImage& truthNow) {
        double ownSum = 0.0;
        double againstSum = 0.0;
        for (std::size_t i = 0; i < now.image.pixels.size(); ++i) {
            const glm::vec3 step = now.image.pixels[i] - before.image.pixels[i];
            const glm::vec3 truly = truthNow.pixels[i] - truthBefore.pixels[i];
            const glm::vec3 a = glm::abs(step);
            const glm::vec3 b = glm::abs(step - truly);
            ownSum += double(a.x) + double(a.y) + double(a.z);
            againstSum += double(b.x) + double(b.y) + double(b.z);
        }
        const double values = 3.0 * double(now.image.pixels.size());
        own.push_back(ownSum / values);
        against.push_back(againstSum / values);
        changed.push_back(before.rems != now.rems);
    }
};

/// All that is seen at one place; nullopt where the reference is refused.
struct Place {
    DisplayImage truth;
    std::map<Method, Moment> methods;
};

Result<std::optional<Place>> look(const PreparedCity& city, const RemSet& rems,
                                  const RadianceScene& scene, const std::vector<Method>& methods,
                                  const glm::dvec3& position, const JobContext& job) {
    const float exposure = city.project().exposure;
    const auto truth = reconstruct(city, rems, &scene, Method::RayTrace, position, job);
    if (!truth && truth.error().code == ErrorCode::Refused)
        return std::optional<Place>();
    if (!truth)
        return tl::unexpected(truth.error());
    Place place{displayStrip(truth->radiance, exposure), {}};
    for (const Method method : methods) {
        if (method == Method::RayTrace) {
            place.methods[method] = {place.truth, {}};
            continue;
        }
        TexelSources sources;
        const auto map = reconstruct(city, rems, nullptr, method, position, job, &sources);
        if (!map)
            return tl::unexpected(map.error());
        place.methods[method] = {displayStrip(map->radiance, exposure), remsOf(sources)};
    }
    return std::optional<Place>(std::move(place));
}

}  // namespace

PopFigures popFigures(const std::vector<double>& steps, const std::vector<bool>& changed,
                      const std::vector<double>& against) {
    PopFigures out;
    if (steps.empty())
        return out;
    std::vector<double> sorted = steps;
    std::sort(sorted.begin(), sorted.end());
    out.medianStep = sorted[(sorted.size() - 1) / 2];
    out.largestStep = sorted.back();
    out.perMetre =
        std::accumulate(against.begin(), against.end(), 0.0) / (double(against.size()) * kPopStep);
    double atChange = 0.0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (!changed[i])
            continue;
        ++out.changes;
        atChange = std::max(atChange, steps[i]);
    }
    if (out.changes > 0 && out.medianStep > 0.0)
        out.atChange = atChange / out.medianStep;
    return out;
}

Result<std::map<Method, PopFigures>> measurePops(const PreparedCity& city, const Traffic& traffic,
                                                 const RemSet& rems,
                                                 const std::vector<Method>& methods, double metres,
                                                 const JobContext& job) {
    const auto scene = city.scene(job);
    if (!scene)
        return tl::unexpected(scene.error());
    std::map<Method, Steps> steps;
    for (std::size_t reflector = 0; reflector < traffic.size(); ++reflector) {
        const double length = traffic.route(reflector).length();
        const double driven = std::min(metres, length);
        const int places = int(std::floor(driven / kPopStep)) + 1;
        std::optional<Place> before;
        for (int k = 0; k < places; ++k) {
            if (job.cancelled())
                return tl::unexpected(JobContext::cancelledError());
            job.progress((double(reflector) + double(k) / double(places)) / double(traffic.size()));
            const double station = 0.5 * (length - driven) + kPopStep * double(k);
            const glm::dvec3 position = traffic.atStation(reflector, station).mapCenter(0);
            auto place = look(city, rems, **scene, methods, position, job);
            if (!place)
                return tl::unexpected(place.error());
            if (before && *place) {
                for (const Method method : methods) {
                    steps[method].add(before->methods[method], (*place)->methods[method],
                                      before->truth, (*place)->truth);
                }
            }
            before = std::move(*place);
        }
    }
    std::map<Method, PopFigures> out;
    for (const auto& [method, measured] : steps)
        out[method] = popFigures(measured.own, measured.changed, measured.against);
    return out;
}

}  // namespace reflet
