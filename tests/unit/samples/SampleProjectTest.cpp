// SPDX-License-Identifier: GPL-3.0-or-later
// What the projects of both samples refer to, and where they put cameras and probes.
#include "SampleUnderTest.h"
#include "core/project/ProjectFile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace reflet::test {
namespace {

class SampleProject : public ::testing::TestWithParam<std::string> {};

TEST_P(SampleProject, SurvivesBeingWrittenAndRead) {
    const Project& project = sampleUnderTest(GetParam()).sample.project;
    const std::string text = projectToJson(project);
    const Result<Project> read = projectFromJson(text, "sample");
    ASSERT_TRUE(read.has_value()) << read.error().message();
    EXPECT_EQ(projectToJson(*read), text);
    EXPECT_EQ(read->probes, project.probes);
    EXPECT_EQ(read->routes, project.routes);
    EXPECT_EQ(read->frame, project.frame);
}

TEST_P(SampleProject, RefersToItsModelAndToRoutesThatExist) {
    const Sample& sample = sampleUnderTest(GetParam()).sample;
    ASSERT_EQ(sample.project.models.size(), 1U);
    EXPECT_EQ(sample.project.models[0].path, sample.modelFileName);
    ASSERT_FALSE(sample.project.reflectors.empty());
    for (const Reflector& reflector : sample.project.reflectors) {
        EXPECT_TRUE(
            std::any_of(sample.project.routes.begin(), sample.project.routes.end(),
                        [&](const RouteSpec& route) { return route.id == reflector.route; }))
            << reflector.id;
    }
}

TEST_P(SampleProject, NamesFourOrMoreViewsEachWithACaption) {
    const Project& project = sampleUnderTest(GetParam()).sample.project;
    EXPECT_EQ(project.views.size(), GetParam() == "square" ? 5U : 4U);
    std::set<std::string> names;
    for (const View& view : project.views) {
        EXPECT_TRUE(names.insert(view.name).second) << view.name;
        EXPECT_FALSE(view.caption.empty());
    }
}

TEST_P(SampleProject, PutsProbesAndCamerasInTheOpen) {
    const SampleUnderTest& city = sampleUnderTest(GetParam());
    for (const Probe& probe : city.sample.project.probes) {
        const std::vector<std::string> names = intruders(city, probe.position, 1.0, -1.0, 80.0);
        EXPECT_TRUE(names.empty()) << probe.id << " is next to " << names.front();
        if (probe.id.starts_with("air-"))
            continue;  // the whale's
        EXPECT_FALSE(intruders(city, probe.position, 0.0, -2.2, -1.0).empty())
            << probe.id << " stands on nothing";
    }
    for (const View& view : city.sample.project.views) {
        const std::vector<std::string> names = intruders(city, view.position, 0.25, -0.4, 0.4);
        EXPECT_TRUE(names.empty()) << view.name << " is next to " << names.front();
    }
}

INSTANTIATE_TEST_SUITE_P(Both, SampleProject, ::testing::ValuesIn(sampleNames()),
                         [](const auto& which) { return which.param; });

}  // namespace
}  // namespace reflet::test
