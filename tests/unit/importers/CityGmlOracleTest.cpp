// SPDX-License-Identifier: GPL-3.0-or-later
// CityGML 2 read by Reflet and by libcitygml has the same objects.
#include "importers/FormatRegistry.h"
#include "tests/support/TestData.h"

#include <gtest/gtest.h>

#include <citygml/citygml.h>
#include <citygml/citymodel.h>
#include <citygml/cityobject.h>
#include <map>
#include <string>

namespace reflet {

using namespace test;

namespace {

using Counts = std::map<std::string, std::size_t>;
using Type = citygml::CityObject::CityObjectsType;

const std::map<Type, std::string>& names() {
    static const std::map<Type, std::string> table{
        {Type::COT_Building, "Building"},
        {Type::COT_BuildingPart, "BuildingPart"},
        {Type::COT_BuildingInstallation, "BuildingInstallation"},
        {Type::COT_WallSurface, "WallSurface"},
        {Type::COT_RoofSurface, "RoofSurface"},
        {Type::COT_GroundSurface, "GroundSurface"},
        {Type::COT_ClosureSurface, "ClosureSurface"},
        {Type::COT_OuterCeilingSurface, "OuterCeilingSurface"},
        {Type::COT_OuterFloorSurface, "OuterFloorSurface"},
        {Type::COT_Window, "Window"},
        {Type::COT_Door, "Door"},
        {Type::COT_ReliefFeature, "ReliefFeature"},
        {Type::COT_TINRelief, "TINRelief"},
    };
    return table;
}

void count(const citygml::CityObject& object, Counts& counts) {
    const auto name = names().find(object.getType());
    ++counts[name == names().end() ? object.getTypeAsString() : name->second];
    for (unsigned int i = 0; i < object.getChildCityObjectsCount(); ++i)
        count(object.getChildCityObject(int(i)), counts);
}

class CityGmlOracle : public testing::TestWithParam<const char*> {};

}  // namespace

TEST_P(CityGmlOracle, CountsTheSameObjectsOfEachType) {
    const auto path = sharedData(GetParam());
    if (!path)
        GTEST_SKIP() << kNoSharedData;
    citygml::ParserParams all;
    all.tesselate = false;
    const auto theirs = citygml::load(path->string(), all);
    ASSERT_TRUE(theirs);
    Counts expected;
    for (const citygml::CityObject* root : theirs->getRootCityObjects())
        count(*root, expected);
    ASSERT_FALSE(expected.empty());

    const auto format = cityFormatOf(*path);
    ASSERT_TRUE(format) << format.error().message();
    const auto ours = (*format)->inspect(*path, {}, {});
    ASSERT_TRUE(ours) << ours.error().message();
    EXPECT_EQ(Counts(ours->value.byType.begin(), ours->value.byType.end()), expected);
}

// libcitygml 2.4.3 gives up on the files of Ingolstadt ("DelayedChoiceElementParser"); their counts
// are those of expected.json (CityGmlSharedDataTest).
INSTANTIATE_TEST_SUITE_P(RealCities, CityGmlOracle,
                         testing::Values("citygml/lyon-house/lyon-house-1.gml",
                                         "citygml/yokosuka/yokosuka-bldg.gml",
                                         "citygml/yokosuka/yokosuka-dem.gml"));

}  // namespace reflet
