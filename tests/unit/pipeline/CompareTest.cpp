// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/CaptionedPictures.h"
#include "app/pipeline/CompareSpacings.h"
#include "app/pipeline/ContactSheet.h"
#include "app/pipeline/Edit.h"
#include "app/pipeline/PaperFigures.h"
#include "app/pipeline/Pop.h"
#include "core/base/Files.h"
#include "core/io/ImageFile.h"
#include "core/project/ProjectFile.h"
#include "tests/support/StreetProject.h"
#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace reflet {
namespace {

/// A street with a car and a probe every 15 m, imported into a folder of its own.
class Comparison : public testing::Test {
protected:
    void SetUp() override {
        const auto imported = test::importStreetWithCar(folder, file);
        ASSERT_TRUE(imported.has_value()) << imported.error().message();
        EditRequest edit;
        edit.probesEvery = 15.0;
        edit.settings = {{"bake.resolution", "32"}, {"tuning.resolution", "32"}};
        const auto edited = editProject(file, edit, {});
        ASSERT_TRUE(edited.has_value()) << edited.error().message();
        auto prepared = PreparedCity::prepare(*loadProject(file), file, {});
        ASSERT_TRUE(prepared.has_value());
        city.emplace(std::move(*prepared));
        options.poses = 2;
        options.width = 64;
        options.height = 36;
        options.samplesPerEdge = 1;
    }

    test::TemporaryFolder folder;
    std::filesystem::path file = folder / "street.reflet";
    std::optional<PreparedCity> city;
    CompareOptions options;
};

TEST_F(Comparison, FindsTheReferenceWithoutFaultAndTheSkyFullOfIt) {
    options.methods = {Method::RayTrace, Method::Sky, Method::Mem};
    const auto report = compareMethods(*city, options, {});
    ASSERT_TRUE(report.has_value()) << report.error().message();
    const MethodFigures& truth = report->methods.at("raytrace");
    EXPECT_FALSE(truth.map.flip.has_value());
    EXPECT_EQ(truth.map.meanError, 0.0);
    EXPECT_LT(truth.vehicle.meanError, report->methods.at("sky").vehicle.meanError);
    EXPECT_FALSE(truth.surfaces.has_value());
    const MethodFigures& sky = report->methods.at("sky");
    const MethodFigures& mem = report->methods.at("mem");
    EXPECT_GT(*sky.map.flip, *mem.map.flip);
    EXPECT_GT(sky.map.meanError, mem.map.meanError);
    ASSERT_TRUE(mem.surfaces.has_value());
    EXPECT_LT(mem.surfaces->wrong, 0.25);
    EXPECT_LE(*mem.surfaces->wrongSeen, mem.surfaces->wrong + 0.05);
    EXPECT_FALSE(mem.pop.has_value());
}

TEST_F(Comparison, WritesAPageThatNamesItsPicturesAndPlaces) {
    options.output = folder.path();
    options.methods = {Method::Box, Method::Mem};
    const auto report = compareMethods(*city, options, {});
    ASSERT_TRUE(report.has_value()) << report.error().message();
    ASSERT_EQ(report->rows.size(), 2U);
    EXPECT_EQ(report->rows[0].street, "street");
    const std::string page = contactSheet(*report, "A <street> & its car");
    EXPECT_NE(page.find("A &lt;street&gt; &amp; its car"), std::string::npos);
    EXPECT_EQ(page.find("<street>"), std::string::npos);
    for (const auto& picture : report->pictures) {
        EXPECT_TRUE(std::filesystem::exists(picture));
        EXPECT_NE(page.find("\"" + picture.filename().string() + "\""), std::string::npos);
    }
    // Reference, and for two methods a picture and what is seen of its error, and all of these in
    // one, at two poses.
    EXPECT_EQ(report->pictures.size(), 12U);
    for (const SheetRow& row : report->rows) {
        const auto one = textureSize({row.methods[0].picture});
        const auto all = textureSize({row.all});
        ASSERT_TRUE(one && all);
        // A row for each method: reference, picture, FLIP.
        constexpr int kGap = 8, kCaption = 7 + kGap;  // of letters of one pixel a dot
        EXPECT_EQ(all->x, 3 * one->x + 4 * kGap);
        EXPECT_EQ(all->y, 2 * (one->y + kCaption) + 3 * kGap);
    }
}

TEST(CaptionedPictures, StandSideBySideBelowTheirCaptions) {
    const auto plain = [](float grey) {
        return DisplayImage{240, 30, std::vector<glm::vec3>(240 * 30, glm::vec3(grey))};
    };
    const std::vector<std::vector<CaptionedPicture>> rows{{{plain(0.25F), "I"}, {plain(0.5F), " "}},
                                                          {{plain(0.75F), "1.0 dB"}}};
    const DisplayImage sheet = arranged(rows);
    const auto count = [&](float grey) {
        return std::count(sheet.pixels.begin(), sheet.pixels.end(), glm::vec3(grey));
    };
    ASSERT_EQ(sheet.pixels.size(), std::size_t(sheet.width) * std::size_t(sheet.height));
    // Each picture as a whole, none over another.
    EXPECT_EQ(count(0.25F), 240 * 30);
    EXPECT_EQ(count(0.5F), 240 * 30);
    EXPECT_EQ(count(0.75F), 240 * 30);
    EXPECT_GT(sheet.width, 480);
    EXPECT_LT(sheet.width, 530);
    // Ink: an I has 3 + 5 + 3 dots; above the second picture there is none.
    const auto inkAbove = [&](int from, int to, int rowsFromTop) {
        int ink = 0;
        for (int row = 0; row < rowsFromTop; ++row) {
            for (int column = from; column < to; ++column) {
                const glm::vec3& pixel = sheet.pixels[std::size_t(row * sheet.width + column)];
                ink += pixel.r < 0.2F ? 1 : 0;
            }
        }
        return ink;
    };
    EXPECT_EQ(inkAbove(0, sheet.width / 2, 20), 11);
    EXPECT_EQ(inkAbove(sheet.width / 2, sheet.width, 20), 0);
}

TEST(CaptionedPictures, LettersThatDoNotFitAreLeftOut) {
    const DisplayImage small{12, 4, std::vector<glm::vec3>(48, glm::vec3(0.5F))};
    const std::vector<std::vector<CaptionedPicture>> rows{{{small, "IIIIIIIIIIIIIIIIIIII"}}};
    const DisplayImage sheet = arranged(rows);
    int ink = 0;
    for (const glm::vec3& pixel : sheet.pixels)
        ink += pixel.r < 0.2F ? 1 : 0;
    EXPECT_EQ(ink, 22);  // two of them
}

TEST_F(Comparison, OfASpacingIsThatOfAProjectWithTheseProbes) {
    const auto before = readFile(file, 1 << 20);
    ASSERT_TRUE(before.has_value());
    options.methods = {Method::Blend, Method::Mem};
    const auto rows = compareSpacings(*city, file, {15.0, 40.0}, options, {});
    ASSERT_TRUE(rows.has_value()) << rows.error().message();
    ASSERT_EQ(rows->size(), 2U);
    EXPECT_EQ(rows->at(0).probes, 5U);  // 56 m in steps of at most 15 m
    EXPECT_EQ(rows->at(1).probes, 3U);
    const auto direct = compareMethods(*city, options, {});
    ASSERT_TRUE(direct.has_value());
    for (const char* method : {"blend", "mem"}) {
        const MethodFigures& a = rows->at(0).report.methods.at(method);
        const MethodFigures& b = direct->methods.at(method);
        EXPECT_EQ(a.map.psnr, b.map.psnr);
        EXPECT_EQ(a.map.flip, b.map.flip);
        EXPECT_EQ(a.surfaces->wrong, b.surfaces->wrong);
    }
    EXPECT_NE(rows->at(0).report.methods.at("mem").map.psnr,
              rows->at(1).report.methods.at("mem").map.psnr);
    EXPECT_EQ(*readFile(file, 1 << 20), *before) << "the project is not touched";
}

TEST_F(Comparison, RefusesSpacingsAndDrivesOutOfRange) {
    for (const std::vector<double>& spacings : {std::vector<double>{}, {0.0}, {15.0, -1.0}}) {
        const auto rows = compareSpacings(*city, file, spacings, options, {});
        ASSERT_FALSE(rows.has_value());
        EXPECT_EQ(rows.error().code, ErrorCode::Usage);
        EXPECT_FALSE(rows.error().remedy.empty());
    }
    options.drive = 0.1;
    const auto report = compareMethods(*city, options, {});
    ASSERT_FALSE(report.has_value());
    EXPECT_EQ(report.error().code, ErrorCode::Usage);
}

TEST_F(Comparison, SeesTheReferenceDriveWithoutPopsAndTheNearestProbeJump) {
    const auto traffic = trafficOf(city->project(), city->folder());
    const auto rems = loadRems(*city, {});
    ASSERT_TRUE(traffic && rems);
    const auto pops = measurePops(*city, *traffic, rems->rems,
                                  {Method::RayTrace, Method::Nearest, Method::Mem}, 16.0, {});
    ASSERT_TRUE(pops.has_value()) << pops.error().message();
    EXPECT_EQ(pops->at(Method::RayTrace).perMetre, 0.0);
    EXPECT_GT(pops->at(Method::RayTrace).medianStep, 0.0);
    EXPECT_EQ(pops->at(Method::RayTrace).changes, 0U);
    // Probes stand 14 m apart: in 16 m the nearest one changes once or twice, and between these
    // places its map does not change at all.
    const PopFigures& nearest = pops->at(Method::Nearest);
    EXPECT_GE(nearest.changes, 1U);
    EXPECT_LE(nearest.changes, 2U);
    EXPECT_EQ(nearest.medianStep, 0.0);
    EXPECT_FALSE(nearest.atChange.has_value());
    EXPECT_GT(nearest.largestStep, 0.01);
    EXPECT_LT(pops->at(Method::Mem).largestStep, nearest.largestStep);
}

TEST_F(Comparison, DrawsTheFiguresOfThePaper) {
    const auto figures = drawPaperFigures(*city, folder.path(), {});
    ASSERT_TRUE(figures.has_value()) << figures.error().message();
    EXPECT_EQ(figures->pictures.size(), 6U);
    for (const auto& picture : figures->pictures)
        EXPECT_GT(std::filesystem::file_size(picture), 100U) << picture;
    Project bare = city->project();
    bare.probes.clear();
    const auto without = city->updated(bare, file, {});
    ASSERT_TRUE(without.has_value());
    const auto refused = drawPaperFigures(*without, folder.path(), {});
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().code, ErrorCode::Usage);
}

TEST(PaperFigures, ShowHeightsWithNorthUpAndTheHighestOfABlock) {
    Heightfield field;
    field.grid = {0.0, 0.0, 1.0, 4, 3};
    field.topCenter = {0,  1,
                       2,  3,  // south
                       4,  5,
                       6,  7,  //
                       8,  kMissingHeight,
                       10, 9};  // north
    const DisplayImage all = heightPicture(field, 4);
    ASSERT_EQ(all.width, 4);
    ASSERT_EQ(all.height, 3);
    EXPECT_FLOAT_EQ(all.pixels[0].x, 0.8F);
    EXPECT_EQ(all.pixels[1], glm::vec3(0.0F));
    EXPECT_FLOAT_EQ(all.pixels[11].x, 0.3F);
    const DisplayImage halved = heightPicture(field, 2);
    ASSERT_EQ(halved.width, 2);
    ASSERT_EQ(halved.height, 2);
    EXPECT_FLOAT_EQ(halved.pixels[0].x, 0.8F);
    EXPECT_FLOAT_EQ(halved.pixels[1].x, 1.0F);
    EXPECT_FLOAT_EQ(halved.pixels[2].x, 0.5F);
    EXPECT_FLOAT_EQ(halved.pixels[3].x, 0.7F);
}

TEST(Pop, GivesTheFiguresOfKnownSteps) {
    const PopFigures pop = popFigures({0.1, 0.3, 0.2, 0.9, 0.4}, {false, true, false, false, true},
                                      {0.01, 0.02, 0.03, 0.0, 0.04});
    EXPECT_DOUBLE_EQ(pop.medianStep, 0.3);
    EXPECT_DOUBLE_EQ(pop.largestStep, 0.9);
    EXPECT_EQ(pop.changes, 2U);
    ASSERT_TRUE(pop.atChange);
    EXPECT_DOUBLE_EQ(*pop.atChange, 0.4 / 0.3);
    EXPECT_DOUBLE_EQ(pop.perMetre, 0.1 / (5 * kPopStep));
    EXPECT_EQ(popFigures({}, {}, {}).changes, 0U);
}

}  // namespace
}  // namespace reflet
