// SPDX-License-Identifier: GPL-3.0-or-later
// Cities whose file has north before east.
#include "app/pipeline/AxisOrder.h"
#include "app/pipeline/Edit.h"
#include "app/pipeline/Import.h"
#include "core/project/ProjectFile.h"
#include "tests/support/StreetCity.h"
#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace reflet {
namespace {

class AxisOrderTest : public testing::Test {
protected:
    [[nodiscard]] ImportReport imported(const std::string& name, const std::string& content,
                                        const std::string& axes = {}) const {
        ImportRequest request;
        request.files = {folder.write(name + ".city.json", content)};
        request.output = folder / (name + ".reflet");
        request.axisOrder = axes;
        auto report = importProject(request, {});
        EXPECT_TRUE(report.has_value()) << report.error().message();
        return report ? std::move(*report) : ImportReport{};
    }
    [[nodiscard]] static bool offered(const ImportReport& report) {
        const auto& remarks = report.city->files.at(0).diagnostics;
        return std::any_of(remarks.begin(), remarks.end(),
                           [](const Diagnostic& d) { return d.code == kAxesExchanged; });
    }
    [[nodiscard]] Result<Project> turned(const Project& project, const std::string& order) const {
        return withAxisOrder(project, {""}, order, folder.path(), {});
    }
    void expectTheRightCity(const Project& project) const {
        const auto city = loadCity(project, folder.path(), {});
        ASSERT_TRUE(city.has_value()) << city.error().message();
        EXPECT_EQ(city->city.frame.origin, right.project.frame.origin);
        EXPECT_EQ(city->city.vertices, right.city->city.vertices) << "to the last bit";
    }

    test::TemporaryFolder folder;
    std::string text = test::StreetCity().cityJson();
    std::string exchanged = test::withAxesExchanged(text);
    ImportReport right = imported("right", text);
};

TEST_F(AxisOrderTest, IsOfferedWhereTheCityThenLiesInTheAreaOfItsCrs) {
    EXPECT_FALSE(offered(right));
    EXPECT_TRUE(offered(imported("wrong", exchanged)));
    const ImportReport asked = imported("asked", exchanged, "ne");
    EXPECT_FALSE(offered(asked));
    EXPECT_EQ(asked.project.models[0].axisOrder, "ne");
    expectTheRightCity(asked.project);
    const auto saved = loadProject(folder / "asked.reflet");
    ASSERT_TRUE(saved.has_value());
    EXPECT_EQ(saved->models[0].axisOrder, "ne") << "the project remembers";
    expectTheRightCity(*saved);
}

TEST_F(AxisOrderTest, AProjectComesToItsPlaceWithAllThatStandsInIt) {
    Project wrong = imported("wrong", exchanged).project;
    const glm::dvec3 probe(690'010.0, 5'335'002.0, 2.0);
    wrong.probes.push_back({"p1", {probe.y, probe.x, probe.z}, std::nullopt, false});
    wrong.routes.push_back(
        {"r1", "", {{5'335'000.0, 690'002.0, 0.0}, {5'335'000.0, 690'058.0, 0.0}}, 0.0});
    const auto there = turned(wrong, "ne");
    ASSERT_TRUE(there.has_value()) << there.error().message();
    expectTheRightCity(*there);
    EXPECT_EQ(there->probes[0].position, probe);
    EXPECT_EQ(there->routes[0].points[1], glm::dvec3(690'058.0, 5'335'000.0, 0.0));
    const auto back = turned(*there, "en");
    ASSERT_TRUE(back.has_value());
    EXPECT_EQ(back->frame.origin, wrong.frame.origin);
    EXPECT_EQ(back->probes, wrong.probes);
    // What is right already stays where it is.
    const auto same = turned(*there, "ne");
    ASSERT_TRUE(same.has_value());
    EXPECT_EQ(same->probes, there->probes);
}

TEST_F(AxisOrderTest, IsEditedByTheNameOfTheModel) {
    static_cast<void>(imported("wrong", exchanged));
    EditRequest edit;
    edit.axes = {{"wrong.city.json", "ne"}};
    const auto edited = editProject(folder / "wrong.reflet", edit, {});
    ASSERT_TRUE(edited.has_value()) << edited.error().message();
    expectTheRightCity(*loadProject(folder / "wrong.reflet"));
    edit.axes = {{"nothing.json", "ne"}};
    const auto unknown = editProject(folder / "wrong.reflet", edit, {});
    ASSERT_FALSE(unknown.has_value());
    EXPECT_EQ(unknown.error().code, ErrorCode::Usage);
    EXPECT_NE(unknown.error().remedy.find("wrong.city.json"), std::string::npos);
    const auto odd = turned(right.project, "yx");
    ASSERT_FALSE(odd.has_value());
    EXPECT_EQ(odd.error().code, ErrorCode::Usage);
}

}  // namespace
}  // namespace reflet
