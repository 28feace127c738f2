// SPDX-License-Identifier: GPL-3.0-or-later
// A new delivery of a city in the place of the old one.
#include "app/pipeline/Bake.h"
#include "app/pipeline/Edit.h"
#include "app/pipeline/Import.h"
#include "app/pipeline/UpdateSource.h"
#include "core/project/ProjectFile.h"
#include "tests/support/StreetCity.h"
#include "tests/support/TemporaryFolder.h"
#include "tests/unit/importers/CityJsonText.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

namespace reflet {
namespace {

using test::json;
using enum ObjectChange::Kind;

/// Three boxes "a", "b", "c" in a row, 50 m apart.
json town() {
    json city = test::emptyCity();
    for (int i = 0; i < 3; ++i) {
        const json corners = test::boxVertices(50'000 * i);
        city["vertices"].insert(city["vertices"].end(), corners.begin(), corners.end());
        city["CityObjects"][std::string(1, char('a' + i))] =
            test::object("Building", json::array({test::solid("2", test::boxShell(8 * i))}));
    }
    return city;
}

CityChanges changes(const json& before, const json& after) {
    ImportOptions options;
    options.frame = ProjectFrame{"EPSG:28992", {}, {85000.0, 446000.0, 0.0}};
    return changesBetween(test::import(before, options).value.city,
                          test::import(after, options).value.city);
}

TEST(CityChangesTest, ACityIsAsItselfWhateverTheOrderOfItsParts) {
    const json before = town();
    json after = test::emptyCity();
    // Objects, vertices, surfaces and the first point of each ring in another order; and another
    // transform.
    after["transform"] = {{"scale", {0.01, 0.01, 0.01}}, {"translate", {84000.0, 445000.0, -10.0}}};
    const auto count = int(before["vertices"].size());
    for (int v = count - 1; v >= 0; --v) {
        const json& p = before["vertices"][std::size_t(v)];
        after["vertices"].push_back({p[0].get<int>() / 10 + 100'000, p[1].get<int>() / 10 + 100'000,
                                     p[2].get<int>() / 10 + 1000});
    }
    for (const auto& [id, object] : before["CityObjects"].items()) {
        json turned = object;
        json& shell = turned["geometry"][0]["boundaries"][0];
        std::reverse(shell.begin(), shell.end());
        for (json& surface : shell) {
            std::rotate(surface[0].begin(), surface[0].begin() + 1, surface[0].end());
            for (json& index : surface[0])
                index = count - 1 - index.get<int>();
        }
        after["CityObjects"][id] = turned;
    }
    const CityChanges none = changes(before, after);
    EXPECT_EQ(none.unchanged, 3U);
    EXPECT_TRUE(none.objects.empty()) << none.objects.front().id;
}

TEST(CityChangesTest, TellsWhatWasAddedRemovedAndChangedAndHow) {
    const json before = town();
    json after = before;
    after["CityObjects"].erase("a");
    after["CityObjects"]["d"] = before["CityObjects"]["a"];
    after["vertices"][8 + 4][2] = 6500;  // a corner of the roof of "b", half a metre up
    json& c = after["CityObjects"]["c"];
    c["geometry"][0]["semantics"] = {
        {"surfaces", {{{"type", "RoofSurface"}}}},
        {"values", {{nullptr, 0, nullptr, nullptr, nullptr, nullptr}}}};
    const CityChanges found = changes(before, after);
    ASSERT_EQ(found.objects.size(), 4U);
    EXPECT_EQ(found.common, 2U);
    EXPECT_EQ(found.unchanged, 0U);
    EXPECT_EQ(found.objects[0].kind, Added);
    EXPECT_EQ(found.objects[0].id, "d");
    EXPECT_EQ(found.objects[1].kind, Removed);
    EXPECT_EQ(found.objects[1].id, "a");
    EXPECT_TRUE(found.objects[1].after.empty());
    EXPECT_EQ(found.objects[2].id, "b");
    EXPECT_TRUE(found.objects[2].geometry);
    EXPECT_NEAR(found.objects[2].after.max.z, 6.5, 1e-4);
    EXPECT_EQ(found.objects[3].id, "c");
    EXPECT_FALSE(found.objects[3].geometry);
    EXPECT_TRUE(found.objects[3].appearance);
}

TEST(CityChangesTest, TwoMillimetresAreAChangeAndSoIsAnotherClass) {
    const json before = town();
    json after = before;
    after["CityObjects"]["b"]["type"] = "OtherConstruction";
    const CityChanges renamed = changes(before, after);
    ASSERT_EQ(renamed.objects.size(), 1U);
    EXPECT_TRUE(renamed.objects[0].description);
    EXPECT_FALSE(renamed.objects[0].geometry);
    after = before;
    after["vertices"][0][0] = 2;
    EXPECT_EQ(changes(before, after).count(Changed), 1U);
}

class UpdateSourceTest : public testing::Test {
protected:
    std::filesystem::path write(const std::string& name, const std::string& text) const {
        std::ofstream(folder / name) << text;
        return folder / name;
    }
    /// A project of a street with a route, a car and probes every 15 m.
    void makeProject() {
        ImportRequest request;
        request.files = {write("street.city.json", street.cityJson())};
        request.output = project;
        request.routes = write("route.geojson", street.routeGeoJson());
        request.vehicle = "car";
        const auto imported = importProject(request, {});
        ASSERT_TRUE(imported) << imported.error().message();
        EditRequest edit;
        edit.probesEvery = 15.0;
        edit.settings = {{"bake.resolution", "32"}};
        const auto edited = editProject(project, edit, {});
        ASSERT_TRUE(edited) << edited.error().message();
    }
    [[nodiscard]] Result<SourceUpdate> update(const std::filesystem::path& file,
                                              const std::string& model = "") const {
        const auto before = PreparedCity::open(project, {});
        if (!before)
            return tl::unexpected(before.error());
        return updateSource(*before, model, file, {});
    }
    /// The street with one object changed by `edit`.
    template <class Edit>
    [[nodiscard]] std::filesystem::path delivery(const Edit& edit) const {
        json city = json::parse(street.cityJson());
        edit(city);
        return write("new.city.json", city.dump());
    }
    static std::string aBuilding(const json& city) {
        for (const auto& [id, object] : city["CityObjects"].items())
            if (object["type"] == "Building")
                return id;
        return {};
    }

    test::TemporaryFolder folder;
    mutable test::StreetCity street;
    std::filesystem::path project = folder / "town.reflet";
};

TEST_F(UpdateSourceTest, KeepsProbesAndRoutesAndTellsWhichProbesAreTouched) {
    makeProject();
    std::string gone;
    const auto file = delivery([&](json& city) {
        gone = aBuilding(city);
        city["CityObjects"].erase(gone);
    });
    const auto updated = update(file);
    ASSERT_TRUE(updated) << updated.error().message();
    ASSERT_EQ(updated->changes.objects.size(), 1U);
    EXPECT_EQ(updated->changes.objects[0].id, gone);
    EXPECT_EQ(updated->changes.objects[0].kind, Removed);
    const auto before = loadProject(project);
    ASSERT_TRUE(before);
    EXPECT_EQ(updated->project.models[0].path, "new.city.json");
    EXPECT_EQ(updated->project.models[0].hash, *fileHash(file));
    EXPECT_TRUE(updated->project.probes == before->probes);
    EXPECT_TRUE(updated->project.routes == before->routes);
    EXPECT_TRUE(updated->project.reflectors == before->reflectors);
    ASSERT_FALSE(updated->probes.empty()) << "the street is shorter than the reach";
    for (const AffectedProbe& probe : updated->probes)
        EXPECT_EQ(probe.why, AffectedProbe::Why::Near) << "nothing is baked yet";
    // The project with the new delivery is a project as any other.
    ASSERT_TRUE(saveProject(updated->project, project));
    const auto after = PreparedCity::open(project, {});
    ASSERT_TRUE(after) << after.error().message();
    const auto& objects = after->city().objects;
    EXPECT_TRUE(std::none_of(objects.begin(), objects.end(),
                             [&](const CityObject& o) { return o.id == gone; }));
}

TEST_F(UpdateSourceTest, AProbeThatHasItsMapIsTouchedByWhatItSeesAlone) {
    makeProject();
    const auto before = PreparedCity::open(project, {});
    ASSERT_TRUE(before);
    const auto& probes = before->project().probes;
    ASSERT_GE(probes.size(), 2U);
    for (const Probe& probe : probes)
        ASSERT_TRUE(bakeProbe(*before, probe, {}));
    const glm::dvec3 at = before->inFrame(probes[0].position);
    // What lies deep under the street is seen by nobody, what stands before the probe is.
    ObjectChange hidden{Added, "hidden", "Building", false, false, false, false, {}, {}};
    hidden.after.add(at - glm::dvec3(3.0, 3.0, 30.0));
    hidden.after.add(at - glm::dvec3(-3.0, -3.0, 20.0));
    const auto lit = affectedProbes(*before, {hidden}, {});
    EXPECT_EQ(lit.size(), probes.size());
    for (const AffectedProbe& probe : lit)
        EXPECT_EQ(probe.why, AffectedProbe::Why::Lit) << probe.id;
    ObjectChange kiosk = hidden;
    kiosk.id = "kiosk";
    kiosk.after = {};
    kiosk.after.add(at + glm::dvec3(0.8, -0.5, -1.0));
    kiosk.after.add(at + glm::dvec3(1.8, 0.5, 1.0));
    const auto touched = affectedProbes(*before, {hidden, kiosk}, {});
    const auto first = std::find_if(touched.begin(), touched.end(),
                                    [&](const AffectedProbe& p) { return p.id == probes[0].id; });
    ASSERT_NE(first, touched.end());
    EXPECT_EQ(first->why, AffectedProbe::Why::Sees);
    EXPECT_EQ(first->object, "kiosk");
    // Another parent changes nothing that can be seen.
    kiosk.kind = Changed;
    kiosk.description = true;
    EXPECT_TRUE(affectedProbes(*before, {kiosk}, {}).empty());
}

TEST_F(UpdateSourceTest, TellsOfAttributesThatChangedWhateverTheirOrder) {
    const auto old = [](json& city, const std::string& one, const std::string& two) {
        city["CityObjects"][one]["attributes"] = {{"use", "shop"}, {"floors", {1, 2}}};
        city["CityObjects"][two]["attributes"] = {{"a", "x y"}, {"b", 2}};
    };
    json city = json::parse(street.cityJson());
    const std::string one = "north-0", two = "south-0";
    old(city, one, two);
    write("street.city.json", city.dump());
    ImportRequest request;
    request.files = {folder / "street.city.json"};
    request.output = project;
    ASSERT_TRUE(importProject(request, {}));
    city["CityObjects"][one]["attributes"]["use"] = "flats";
    const auto file = write("new.city.json", city.dump(2));  // with blanks and new lines
    const auto updated = update(file);
    ASSERT_TRUE(updated) << updated.error().message();
    EXPECT_TRUE(updated->attributesCompared);
    ASSERT_EQ(updated->changes.objects.size(), 1U);
    EXPECT_EQ(updated->changes.objects[0].id, one);
    EXPECT_TRUE(updated->changes.objects[0].attributes);
    EXPECT_FALSE(updated->changes.objects[0].geometry);
    EXPECT_TRUE(updated->probes.empty()) << "attributes are not seen";
    EXPECT_EQ(updated->changes.unchanged, std::size_t(street.objects()) - 1);
    // The order of keys is no change.
    std::string text = city.dump();
    const std::string from = R"({"a":"x y","b":2})";
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, from.size(), R"({"b":2,"a":"x y"})");
    const auto turned = update(write("turned.city.json", text));
    ASSERT_TRUE(turned) << turned.error().message();
    EXPECT_EQ(turned->changes.objects.size(), 1U);
}

TEST_F(UpdateSourceTest, TheSameFileChangesNothing) {
    makeProject();
    for (const auto& file :
         {folder / "street.city.json", write("copy.city.json", street.cityJson())}) {
        const auto updated = update(file);
        ASSERT_TRUE(updated) << updated.error().message();
        EXPECT_TRUE(updated->sameFile);
        const auto before = loadProject(project);
        EXPECT_EQ(projectToJson(updated->project), projectToJson(*before));
        EXPECT_EQ(updateJson(*updated)["sameFile"], true);
    }
}

TEST_F(UpdateSourceTest, RefusesAnotherCityAndAnotherCrsWithARemedy) {
    makeProject();
    const auto other = update(delivery([](json& city) {
        json renamed = json::object();
        for (const auto& [id, object] : city["CityObjects"].items())
            renamed["other-" + id] = object;
        city["CityObjects"] = renamed;
    }));
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().code, ErrorCode::Refused);
    EXPECT_NE(other.error().what.find("no object in common"), std::string::npos);
    EXPECT_FALSE(other.error().remedy.empty());
    const auto elsewhere = update(delivery([](json& city) {
        city["metadata"]["referenceSystem"] = "https://www.opengis.net/def/crs/EPSG/0/25833";
    }));
    ASSERT_FALSE(elsewhere);
    EXPECT_EQ(elsewhere.error().code, ErrorCode::Refused);
    EXPECT_NE(elsewhere.error().what.find("EPSG:25833"), std::string::npos)
        << elsewhere.error().what;
    const auto silent = update(delivery([](json& city) { city.erase("metadata"); }));
    ASSERT_FALSE(silent) << "coordinates of an unknown system are no new delivery";
    EXPECT_EQ(silent.error().code, ErrorCode::Refused);
}

TEST_F(UpdateSourceTest, SaysWhatIsWrongWithItsFiles) {
    makeProject();
    const auto missing = update(folder / "nowhere.json");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, ErrorCode::Unreadable);
    const auto broken = update(write("broken.city.json", R"({"type": "CityJSON", "ver)"));
    ASSERT_FALSE(broken);
    EXPECT_EQ(broken.error().code, ErrorCode::Unreadable);
    const auto unknown = update(folder / "street.city.json", "river.city.json");
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().code, ErrorCode::Usage);
    EXPECT_NE(unknown.error().remedy.find("street.city.json"), std::string::npos);
    // Written over: what was there is gone.
    json city = json::parse(street.cityJson());
    city["CityObjects"].erase(aBuilding(city));
    write("street.city.json", city.dump());
    const auto over = update(folder / "street.city.json");
    ASSERT_FALSE(over);
    EXPECT_EQ(over.error().code, ErrorCode::Refused);
    EXPECT_NE(over.error().what.find("written over"), std::string::npos);
}

}  // namespace
}  // namespace reflet
