// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Bake.h"
#include "app/pipeline/Edit.h"
#include "app/pipeline/Import.h"
#include "app/pipeline/Render.h"
#include "core/environment/ImageMetrics.h"
#include "core/io/ImageFile.h"
#include "core/project/ProjectFile.h"
#include "tests/support/StreetCity.h"
#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace reflet {
namespace {

/// A picture that was looked at and accepted: one reference, its own metric and tolerance.
struct GoldenCase {
    const char* name;
    Method method;
    double leastPsnr;  ///< dB over the whole picture; vector units differ between processors
};

std::ostream& operator<<(std::ostream& stream, const GoldenCase& golden) {
    return stream << golden.name;
}

DisplayImage asDisplay(const TextureImage& image) {
    DisplayImage out{image.width, image.height, {}};
    for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4) {
        out.pixels.emplace_back(float(image.rgba[i]) / 255.0F, float(image.rgba[i + 1]) / 255.0F,
                                float(image.rgba[i + 2]) / 255.0F);
    }
    return out;
}

/// Differences made four times as strong, about middle grey.
DisplayImage difference(const DisplayImage& a, const DisplayImage& b) {
    DisplayImage out = a;
    for (std::size_t i = 0; i < out.pixels.size(); ++i) {
        out.pixels[i] = glm::clamp(0.5F + 4.0F * (a.pixels[i] - b.pixels[i]), 0.0F, 1.0F);
    }
    return out;
}

/// A car on the street city, drawn from the pavement.
Result<DisplayImage> drawStreet(Method method) {
    const test::TemporaryFolder folder;
    test::StreetCity street;
    ImportRequest request;
    request.files = {folder.write("street.city.json", street.cityJson())};
    request.routes = folder.write("route.geojson", street.routeGeoJson());
    request.vehicle = "car";
    request.output = folder / "street.reflet";
    if (auto done = importProject(request, {}); !done)
        return tl::unexpected(done.error());
    EditRequest edit;
    edit.probesEvery = 15.0;
    if (auto done = editProject(request.output, edit, {}); !done)
        return tl::unexpected(done.error());
    auto project = loadProject(request.output);
    if (!project)
        return tl::unexpected(project.error());
    auto city = PreparedCity::prepare(*project, request.output, {});
    if (!city)
        return tl::unexpected(city.error());
    const auto rems = loadRems(*city, {});
    if (!rems)
        return tl::unexpected(rems.error());
    const auto traffic = trafficOf(*project, city->folder());
    if (!traffic)
        return tl::unexpected(traffic.error());
    const std::vector<PlacedReflector> placed{traffic->atStation(0, 28.0)};
    RenderOptions options;
    options.width = 320;
    options.height = 180;
    options.method = method;
    const auto view =
        renderPicture(*city, rems->rems, placed, streetCamera(*city, placed.front()), options, {});
    if (!view)
        return tl::unexpected(view.error());
    return toDisplayImage(*view, project->exposure);
}

class Golden : public testing::TestWithParam<GoldenCase> {};

TEST_P(Golden, PictureIsTheOneThatWasAccepted) {
    const GoldenCase& golden = GetParam();
    const auto image = drawStreet(golden.method);
    ASSERT_TRUE(image.has_value()) << image.error().message();
    const std::string file = std::string(golden.name) + ".png";
    const std::filesystem::path reference =
        std::filesystem::path(REFLET_SOURCE_DIR "/tests/golden/references") / file;
    if (std::getenv("REFLET_GOLDEN_UPDATE") != nullptr) {
        ASSERT_TRUE(writePng(*image, reference).has_value());
        return;
    }
    const auto accepted = readTexture(reference);
    ASSERT_TRUE(accepted.has_value()) << accepted.error().message();
    const DisplayImage expected = asDisplay(*accepted);
    ASSERT_EQ(expected.width, image->width);
    ASSERT_EQ(expected.height, image->height);
    PsnrAccumulator psnr;
    psnr.add(*image, expected);
    if (psnr.decibels().value_or(100.0) >= golden.leastPsnr)
        return;
    std::filesystem::create_directories(REFLET_ARTEFACTS);
    const std::filesystem::path artefacts(REFLET_ARTEFACTS);
    ASSERT_TRUE(writePng(*image, artefacts / file).has_value());
    ASSERT_TRUE(
        writePng(difference(*image, expected), artefacts / ("difference-" + file)).has_value());
    FAIL() << "PSNR " << *psnr.decibels() << " dB is below " << golden.leastPsnr << "; see "
           << artefacts;
}

INSTANTIATE_TEST_SUITE_P(Street, Golden,
                         testing::Values(GoldenCase{"street-mem", Method::Mem, 42.0},
                                         GoldenCase{"street-raytrace", Method::RayTrace, 42.0}),
                         [](const auto& golden) {
                             std::string name = golden.param.name;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

}  // namespace
}  // namespace reflet
