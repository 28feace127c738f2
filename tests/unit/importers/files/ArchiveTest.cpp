// SPDX-License-Identifier: GPL-3.0-or-later
// Cities in ZIP archives: the same as unpacked, and nothing gets out of their folder.
#include "importers/FormatRegistry.h"
#include "importers/archive/UnpackedArchive.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/support/TestData.h"
#include "tests/unit/importers/CityJsonText.h"
#include "tests/unit/importers/files/ZipText.h"

#include <algorithm>
#include <cstdlib>

namespace reflet {
namespace {

using namespace test;
using namespace importers;
namespace fs = std::filesystem;

std::string boxCity(const std::string& id, int x) {
    json city = emptyCity();
    city["vertices"] = boxVertices(x);
    city["CityObjects"][id] = {{"type", "Building"}, {"geometry", {solid("1")}}};
    return city.dump();
}

class Archive : public testing::Test {
protected:
    Archive() { ::setenv("XDG_CACHE_HOME", (m_folder / "cache").c_str(), 1); }

    fs::path write(const ZipText& zip) { return m_folder.write("town.zip", zip.text()); }
    Result<Imported<CityImport>> read(const ZipText& zip, const ImportOptions& options = {}) {
        const fs::path path = write(zip);
        const auto format = cityFormatOf(path);
        if (!format)
            return tl::unexpected<Error>(format.error());
        EXPECT_EQ((*format)->name, "ZIP archive");
        return (*format)->read(path, options, {});
    }
    static bool has(const std::vector<Diagnostic>& list, const std::string& code) {
        return std::any_of(list.begin(), list.end(),
                           [&](const Diagnostic& d) { return d.code == code; });
    }
    const TemporaryFolder& folder() const { return m_folder; }

private:
    TemporaryFolder m_folder;
};

TEST_F(Archive, AllModelsInItAreOneCityInOneFrame) {
    const auto city = read(ZipText()
                               .add("town/", "")
                               .add("town/b.city.json", boxCity("b", 20000))
                               .add("town/a.city.json", boxCity("a", 0))
                               .add("readme.txt", "a town"));
    ASSERT_TRUE(city) << city.error().message();
    const CityModel& model = city->value.city;
    ASSERT_EQ(model.objects.size(), 2U);
    EXPECT_EQ(model.objects[0].id, "a");
    EXPECT_EQ(model.objects[1].id, "b");
    EXPECT_EQ(model.triangles.size(), 24U);
    EXPECT_EQ(city->counts.loaded, 2U);
    // Boxes of 10 m by 8 m by 6 m from x = 0 and x = 20 m.
    EXPECT_EQ(model.bounds().size(), glm::dvec3(30.0, 8.0, 6.0));
    EXPECT_EQ(city->value.summary.format, "ZIP archive of CityJSON");
    EXPECT_EQ(city->value.summary.crsHorizontal, "EPSG:28992");
    EXPECT_TRUE(has(city->diagnostics, "files-passed-over"));
}

TEST_F(Archive, TexturesOfTheModelsAreFoundAndStay) {
    json city = json::parse(boxCity("a", 0));
    city["appearance"] = {{"textures", {{{"type", "PNG"}, {"image", "pictures/wall.png"}}}},
                          {"vertices-texture", {{0, 0}, {1, 0}, {1, 1}, {0, 1}}}};
    city["CityObjects"]["a"]["geometry"][0]["texture"]["t"]["values"] =
        json::array({json::array({json::array({json::array({0, 0, 1, 2, 3})}), json::array(),
                                  json::array(), json::array(), json::array(), json::array()})});
    const ZipText zip = ZipText().add("a.city.json", city.dump()).add("pictures/wall.png", "png");
    const auto first = read(zip);
    ASSERT_TRUE(first) << first.error().message();
    ASSERT_EQ(first->value.city.textures.size(), 1U);
    const fs::path wall = first->value.city.textures.front().path;
    EXPECT_EQ(bytesOf(wall), "png");
    // The cache may be deleted: it is made again, in the same place.
    fs::remove_all(folder() / "cache");
    const auto again = read(zip);
    ASSERT_TRUE(again);
    EXPECT_EQ(again->value.city.textures.front().path, wall.string());
    EXPECT_EQ(bytesOf(wall), "png");
    // What was changed in it by others is made anew.
    fs::remove(wall);
    ASSERT_TRUE(read(zip));
    EXPECT_EQ(bytesOf(wall), "png");
}

TEST_F(Archive, PathsThatLeadOutOfItAreLeftOut) {
    ZipText::Entry link{.name = "link.city.json", .bytes = "/etc/passwd"};
    link.mode = 0120777;
    const auto city = read(ZipText()
                               .add("a.city.json", boxCity("a", 0))
                               .add("../out.city.json", boxCity("b", 0))
                               .add("/abs.city.json", boxCity("c", 0))
                               .add("x\\..\\..\\win.city.json", boxCity("d", 0))
                               .add("C:/drive.city.json", boxCity("e", 0))
                               .add("a.city.json/below.city.json", boxCity("f", 0))
                               .add("a.city.json", boxCity("twice", 0))
                               .add(link));
    ASSERT_TRUE(city) << city.error().message();
    EXPECT_EQ(city->value.city.objects.size(), 1U);
    EXPECT_TRUE(has(city->diagnostics, "archive-link"));
    const auto outside =
        std::find_if(city->diagnostics.begin(), city->diagnostics.end(),
                     [](const Diagnostic& d) { return d.code == "archive-outside"; });
    ASSERT_NE(outside, city->diagnostics.end());
    EXPECT_EQ(outside->text.substr(0, 14), "6 of its files");
    EXPECT_FALSE(fs::exists(folder() / "out.city.json"));
    EXPECT_FALSE(fs::exists(folder() / "cache/reflet/unpacked/out.city.json"));
}

TEST_F(Archive, BombsAreRefusedBeforeAnythingIsWritten) {
    const std::string zeros(std::size_t(80) << 20, ' ');
    const auto bomb = read(ZipText().add("a.city.json", zeros));
    ASSERT_FALSE(bomb);
    EXPECT_EQ(bomb.error().code, ErrorCode::ResourceLimit);
    EXPECT_NE(bomb.error().what.find("times its size"), std::string::npos);
    EXPECT_FALSE(bomb.error().remedy.empty());
    EXPECT_FALSE(fs::exists(folder() / "cache"));

    ArchiveLimits few;
    few.maxEntries = 1;
    const fs::path two = write(ZipText().add("a.json", "1").add("b.json", "2"));
    const auto many = ZipArchive::open(two, few);
    ASSERT_FALSE(many);
    EXPECT_EQ(many.error().what, "holds 2 files, more than the limit of 1");
    ArchiveLimits small;
    small.maxBytes = 1;
    EXPECT_EQ(ZipArchive::open(two, small).error().code, ErrorCode::ResourceLimit);
    ArchiveLimits tiny;
    tiny.maxEntryBytes = 0;
    const auto large = ZipArchive::open(two, tiny);
    ASSERT_TRUE(large);
    EXPECT_TRUE(large->entries().empty());
    EXPECT_TRUE(has(large->remarks(), "archive-large"));
}

TEST_F(Archive, AFileThatHoldsMoreOrLessThanItSaysIsDamaged) {
    for (const std::int64_t said : {3, 5000}) {
        ZipText::Entry liar{.name = "liar.city.json", .bytes = boxCity("b", 0)};
        liar.saidSize = said;
        const auto city = read(ZipText().add("a.city.json", boxCity("a", 0)).add(liar));
        if (city) {
            EXPECT_EQ(city->value.city.objects.size(), 1U) << said;
            EXPECT_TRUE(has(city->diagnostics, "archive-damaged")) << said;
        } else {
            EXPECT_EQ(city.error().code, ErrorCode::ResourceLimit) << said;
        }
    }
}

TEST_F(Archive, DamageCostsTheFileAloneAndIsTold) {
    ZipText::Entry wrong{.name = "wrong.city.json", .bytes = boxCity("b", 0)};
    wrong.wrongCheck = true;
    ZipText::Entry secret{.name = "secret.city.json", .bytes = boxCity("c", 0)};
    secret.flags |= 1;
    const ZipText sound = ZipText().add("a.city.json", boxCity("a", 0));
    const auto city = read(ZipText(sound)
                               .add(wrong)
                               .add(secret)
                               .add("bad.city.json", "{\"type\": \"CityJSON\"")
                               .add("inner.zip", sound.text()));
    ASSERT_TRUE(city) << city.error().message();
    EXPECT_EQ(city->value.city.objects.size(), 1U);
    for (const char* code :
         {"archive-damaged", "archive-encrypted", "file-skipped", "archive-nested"})
        EXPECT_TRUE(has(city->diagnostics, code)) << code;
    // Alone, it is an error, named as the user knows it.
    const auto alone = read(ZipText().add("x/bad.city.json", "{\"type\": \"CityJSON\""));
    ASSERT_FALSE(alone);
    EXPECT_EQ(alone.error().subject, (folder() / "town.zip").string() + ": x/bad.city.json");
    const auto locked = read(ZipText().add(secret));
    ASSERT_FALSE(locked);
    EXPECT_NE(locked.error().remedy.find("encrypted"), std::string::npos);
    ImportOptions strict;
    strict.strict = true;
    EXPECT_FALSE(read(ZipText(sound).add("bad.city.json", "{\"type\": \"CityJSON\""), strict));
}

TEST_F(Archive, WhatIsNoArchiveIsToldSo) {
    const std::string whole = ZipText().add("a.city.json", boxCity("a", 0)).text();
    const fs::path cut = folder().write("cut.zip", whole.substr(0, whole.size() / 2));
    const auto format = cityFormatOf(cut);
    ASSERT_TRUE(format);
    const auto broken = (*format)->read(cut, {}, {});
    ASSERT_FALSE(broken);
    EXPECT_EQ(broken.error().code, ErrorCode::Unreadable);
    EXPECT_EQ(broken.error().subject, cut.string());
    const auto empty = read(ZipText());
    ASSERT_FALSE(empty);
    EXPECT_EQ(empty.error().what, "has no city models in it");
    EXPECT_EQ(cityFormatOf(folder().write("a.kmz", whole)).error().what,
              "is a file of the format KML, which Reflet does not read");
}

TEST_F(Archive, UnpackingCanBeCancelledAndLeavesNothing) {
    const fs::path path = write(ZipText().add("a.city.json", boxCity("a", 0)));
    std::stop_source stop;
    stop.request_stop();
    const auto cancelled = unpackArchive(path, {}, JobContext({}, stop.get_token()));
    ASSERT_FALSE(cancelled);
    EXPECT_EQ(cancelled.error().code, ErrorCode::Cancelled);
    EXPECT_TRUE(fs::is_empty(folder() / "cache/reflet/unpacked"));
}

TEST_F(Archive, ARealCityIsTheSameAsUnpacked) {
    const auto source = sharedData("citygml");
    if (!source)
        GTEST_SKIP() << kNoSharedData;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(*source)) {
        if (entry.path().extension() == ".gml" && fs::file_size(entry.path()) < 3'000'000)
            files.push_back(entry.path());
    }
    ASSERT_FALSE(files.empty());
    const fs::path file = *std::min_element(files.begin(), files.end());
    const auto plain = (*cityFormatOf(file))->read(file, {}, {});
    ASSERT_TRUE(plain) << plain.error().message();
    const auto zipped = read(ZipText().add("udx/" + file.filename().string(), bytesOf(file)));
    ASSERT_TRUE(zipped) << zipped.error().message();
    EXPECT_EQ(zipped->value.city.vertices, plain->value.city.vertices);
    EXPECT_EQ(zipped->value.city.triangles.size(), plain->value.city.triangles.size());
    EXPECT_EQ(zipped->counts.loaded, plain->counts.loaded);
}

}  // namespace
}  // namespace reflet
