// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/coverage/CoveragePicture.h"

#include "app/pipeline/coverage/CoverageFiles.h"
#include "core/io/ImageText.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace reflet {

namespace {

constexpr int kLongEdge = 1600;      // pixels of the plan
constexpr int kShortest = 640;       // pixels that the legend needs
constexpr int kLegend = 96;          // pixels of the strip below
constexpr double kMargin = 40.0;     // metres around what is shown
constexpr double kLabelStep = 80.0;  // metres of a route that a number stands for
constexpr glm::vec3 kInk{0.1F};
constexpr glm::vec3 kPaper{1.0F};

/// A plan with pixels of square metres.
class Plan {
public:
    Plan(const Box& box, const Heightfield& field) : m_field(field) {
        const glm::dvec3 size = box.size();
        m_pixel = std::max(size.x, size.y) / kLongEdge;
        m_left = box.min.x;
        m_top = box.max.y;
        m_image.width = std::max(kShortest, int(std::ceil(size.x / m_pixel)));
        m_planHeight = std::max(1, int(std::ceil(size.y / m_pixel)));
        m_image.height = m_planHeight + kLegend;
        m_image.pixels.assign(std::size_t(m_image.width) * std::size_t(m_image.height), kPaper);
        shade();
    }

    [[nodiscard]] glm::dvec2 at(const glm::dvec3& place) const {
        return {(place.x - m_left) / m_pixel, (m_top - place.y) / m_pixel};
    }
    void disc(const glm::dvec2& middle, double radius, const glm::vec3& color) {
        for (int j = int(std::floor(middle.y - radius)); j <= int(std::ceil(middle.y + radius));
             ++j)
            for (int i = int(std::floor(middle.x - radius)); i <= int(std::ceil(middle.x + radius));
                 ++i)
                if (inside(i, j) && std::hypot(i + 0.5 - middle.x, j + 0.5 - middle.y) <= radius)
                    pixel(i, j) = color;
    }
    void box(int x0, int y0, int x1, int y1, const glm::vec3& color) {
        for (int j = std::max(0, y0); j < std::min(m_image.height, y1); ++j)
            for (int i = std::max(0, x0); i < std::min(m_image.width, x1); ++i)
                m_image.pixels[std::size_t(j) * std::size_t(m_image.width) + std::size_t(i)] =
                    color;
    }
    /// Colours the plan where `colorAt` gives one for the middle of a pixel.
    template <class ColorAt>
    void fill(const ColorAt& colorAt) {
        for (int j = 0; j < m_planHeight; ++j)
            for (int i = 0; i < m_image.width; ++i)
                if (const auto color =
                        colorAt(m_left + (i + 0.5) * m_pixel, m_top - (j + 0.5) * m_pixel))
                    pixel(i, j) = glm::mix(pixel(i, j), *color, 0.8F);
    }

    [[nodiscard]] double metresAPixel() const { return m_pixel; }
    [[nodiscard]] int width() const { return m_image.width; }
    [[nodiscard]] int planHeight() const { return m_planHeight; }
    DisplayImage image() && { return std::move(m_image); }
    [[nodiscard]] DisplayImage& pixels() { return m_image; }

private:
    [[nodiscard]] bool inside(int i, int j) const {
        return i >= 0 && j >= 0 && i < m_image.width && j < m_planHeight;
    }
    glm::vec3& pixel(int i, int j) {
        return m_image.pixels[std::size_t(j) * std::size_t(m_image.width) + std::size_t(i)];
    }
    [[nodiscard]] float heightAt(double x, double y) const {
        const GridSpec& grid = m_field.grid;
        const int i = grid.column(x);
        const int j = grid.row(y);
        return grid.contains(i, j) ? m_field.topCenter[grid.index(i, j)] : kMissingHeight;
    }
    /// Light from the north-west, buildings a little darker than the ground.
    void shade() {
        const double step = std::max(m_pixel, m_field.grid.cellSize);
        const glm::dvec3 light = glm::normalize(glm::dvec3(-1.0, 1.0, 1.4));
        for (int j = 0; j < m_planHeight; ++j) {
            for (int i = 0; i < m_image.width; ++i) {
                const double x = m_left + (i + 0.5) * m_pixel;
                const double y = m_top - (j + 0.5) * m_pixel;
                const float height = heightAt(x, y);
                const float east = heightAt(x + step, y);
                const float north = heightAt(x, y + step);
                if (isMissing(height) || isMissing(east) || isMissing(north))
                    continue;
                const glm::dvec3 normal = glm::normalize(
                    glm::dvec3(-double(east - height) / step, -double(north - height) / step, 1.0));
                const double lit = std::clamp(glm::dot(normal, light), 0.0, 1.0);
                const float ground = m_field.groundAt(x, y);
                const bool built = !isMissing(ground) && height > ground + 2.0F;
                pixel(i, j) = glm::vec3(float((built ? 0.42 : 0.66) + 0.32 * lit));
            }
        }
    }

    const Heightfield& m_field;
    DisplayImage m_image;
    double m_pixel = 1.0, m_left = 0.0, m_top = 0.0;
    int m_planHeight = 0;
};

Box boxOf(const CoverageReport& report, const PreparedCity& city) {
    Box box;
    for (const DemandLine& line : report.plan.lines)
        for (const glm::dvec3& point : line.route->points())
            box.add(point);
    if (report.plan.ground)
        for (const glm::dvec3& place : report.plan.ground->places)
            box.add(place);
    for (const Probe& probe : city.project().probes)
        box.add(city.inFrame(probe.position));
    box.add(box.min - glm::dvec3(kMargin));
    box.add(box.max + glm::dvec3(kMargin));
    return box;
}

std::string percent(double share) {
    return fmt::format("{:.0f} %", 100.0 * share);
}

/// Words with a light box behind them, none over another.
class Labels {
public:
    explicit Labels(Plan& plan) : m_plan(plan) {}

    Result<void> add(const glm::dvec2& at, const std::string& text, int size, bool always) {
        const auto width = textWidth(text, size);
        if (!width)
            return tl::unexpected(width.error());
        const glm::ivec2 low(int(at.x) - *width / 2 - 3, int(at.y) - size);
        const glm::ivec2 high(low.x + *width + 6, int(at.y) + 4);
        if (low.x < 0 || low.y < 0 || high.x >= m_plan.width() || high.y >= m_plan.planHeight())
            return {};
        for (const auto& [l, h] : m_taken)
            if (!always && low.x < h.x && l.x < high.x && low.y < h.y && l.y < high.y)
                return {};
        m_taken.emplace_back(low, high);
        m_plan.box(low.x, low.y, high.x, high.y, kPaper);
        m_texts.push_back({text, {int(at.x), int(at.y)}, size, kInk, ImageText::Align::Middle});
        return {};
    }
    [[nodiscard]] const std::vector<ImageText>& texts() const { return m_texts; }

private:
    Plan& m_plan;
    std::vector<std::pair<glm::ivec2, glm::ivec2>> m_taken;
    std::vector<ImageText> m_texts;
};

void drawStretches(Plan& plan, const CoverageReport& report) {
    const double radius = std::clamp(2.5 / plan.metresAPixel(), 3.0, 9.0);
    for (const bool edge : {true, false}) {
        for (const CoveredStretch& stretch : report.stretches) {
            if (stretch.samples == 0)
                continue;
            const Route& route = *report.plan.lines[stretch.line].route;
            const double step = 0.5 * plan.metresAPixel();
            for (double s = stretch.from; s < stretch.to; s += step)
                plan.disc(plan.at(route.at(s)), edge ? radius + 1.5 : radius,
                          edge ? kInk : coverageColor(stretch.coverage));
        }
    }
}

void drawGround(Plan& plan, const CoverageReport& report) {
    const CoverageRaster raster = coverageRaster(report);
    plan.fill([&](double x, double y) -> std::optional<glm::vec3> {
        const int i = raster.grid.column(x);
        const int j = raster.grid.row(y);
        if (!raster.grid.contains(i, j) || std::isnan(raster.coverage[raster.grid.index(i, j)]))
            return std::nullopt;
        return coverageColor(double(raster.coverage[raster.grid.index(i, j)]));
    });
}

void drawProbes(Plan& plan, const PreparedCity& city) {
    for (const Probe& probe : city.project().probes) {
        const glm::dvec2 at = plan.at(city.inFrame(probe.position));
        plan.disc(at, 5.0, kInk);
        plan.disc(at, 3.5, kPaper);
    }
}

/// The worst places by their rank, then a number every kLabelStep metres beside each route.
Result<void> label(Plan& plan, Labels& labels, const CoverageReport& report,
                   const PreparedCity& city) {
    constexpr int kSize = 15;
    for (std::size_t k = 0; k < report.worst.size(); ++k) {
        const glm::dvec2 at = plan.at(city.inFrame(report.worst[k].position));
        const std::string text =
            fmt::format("worst {}: {}", k + 1, percent(report.worst[k].coverage));
        if (auto done = labels.add(at + glm::dvec2(0.0, -14.0), text, kSize, true); !done)
            return done;
    }
    for (std::size_t k = 0; k < report.stretches.size();) {
        const CoveredStretch& first = report.stretches[k];
        double sum = 0.0, samples = 0.0, to = first.to;
        for (; k < report.stretches.size() && report.stretches[k].line == first.line &&
               report.stretches[k].from < first.from + kLabelStep - 1e-6;
             ++k) {
            sum += report.stretches[k].coverage * double(report.stretches[k].samples);
            samples += double(report.stretches[k].samples);
            to = report.stretches[k].to;
        }
        if (samples == 0.0)
            continue;
        const Route& route = *report.plan.lines[first.line].route;
        const double middle = 0.5 * (first.from + to);
        const glm::dvec3 along = route.tangent(middle);
        const glm::dvec2 at = plan.at(route.at(middle)) + 26.0 * glm::dvec2(along.y, along.x);
        if (auto done = labels.add(at + glm::dvec2(0.0, 6.0), percent(sum / samples), kSize, false);
            !done)
            return done;
    }
    return {};
}

/// 1, 2 or 5 times a power of ten, at most.
double roundMetres(double most) {
    const double power = std::pow(10.0, std::floor(std::log10(most)));
    return most >= 5.0 * power ? 5.0 * power : most >= 2.0 * power ? 2.0 * power : power;
}

void drawRamp(Plan& plan, std::vector<ImageText>& texts, int left, int top) {
    constexpr int kWide = 260, kHigh = 16;
    plan.box(left - 1, top - 1, left + kWide + 1, top + kHigh + 1, kInk);
    for (int i = 0; i < kWide; ++i)
        plan.box(left + i, top, left + i + 1, top + kHigh, coverageColor((i + 0.5) / kWide));
    for (int k = 0; k <= 4; ++k)
        texts.push_back({percent(0.25 * k),
                         {left + k * kWide / 4, top + kHigh + 17},
                         13,
                         kInk,
                         ImageText::Align::Middle});
}

void drawScaleBar(Plan& plan, std::vector<ImageText>& texts, int right, int top) {
    const double metres = roundMetres(160.0 * plan.metresAPixel());
    const int wide = int(std::lround(metres / plan.metresAPixel()));
    for (int k = 0; k < 4; ++k)
        plan.box(right - wide + k * wide / 4, top, right - wide + (k + 1) * wide / 4, top + 8,
                 k % 2 == 0 ? kInk : glm::vec3(0.75F));
    texts.push_back(
        {fmt::format("{:g} m", metres), {right, top + 24}, 13, kInk, ImageText::Align::Right});
}

void drawNorth(Plan& plan, std::vector<ImageText>& texts, int middle, int top) {
    for (int row = 0; row < 30; ++row)
        plan.box(middle - row / 3, top + row, middle + row / 3 + 1, top + row + 1, kInk);
    texts.push_back({"N", {middle, top + 46}, 14, kInk, ImageText::Align::Middle});
}

void drawLegend(Plan& plan, std::vector<ImageText>& texts, const CoverageReport& report,
                const PreparedCity& city) {
    const int top = plan.planHeight();
    const std::size_t probes = city.project().probes.size();
    texts.push_back(
        {fmt::format("Coverage {:.1f} % ± {:.1f} % with {} probe{}", 100.0 * report.coverage.mean,
                     100.0 * report.coverage.error, probes, probes == 1 ? "" : "s"),
         {16, top + 26},
         18,
         kInk,
         ImageText::Align::Left});
    drawRamp(plan, texts, 30, top + 42);
    texts.push_back({"circles: probes", {330, top + 56}, 13, kInk, ImageText::Align::Left});
    drawScaleBar(plan, texts, plan.width() - 60, top + 36);
    drawNorth(plan, texts, plan.width() - 28, top + 20);
}

}  // namespace

Result<DisplayImage> coveragePicture(const CoverageReport& report, const PreparedCity& city) {
    Plan plan(boxOf(report, city), city.heightfield());
    if (report.plan.ground)
        drawGround(plan, report);
    drawStretches(plan, report);
    drawProbes(plan, city);
    Labels labels(plan);
    if (auto done = label(plan, labels, report, city); !done)
        return tl::unexpected(done.error());
    std::vector<ImageText> texts = labels.texts();
    drawLegend(plan, texts, report, city);
    if (auto done = drawTexts(plan.pixels(), texts); !done)
        return tl::unexpected(done.error());
    return std::move(plan).image();
}

}  // namespace reflet
