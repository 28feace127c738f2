// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/osm/OsmHeights.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reflet::osm {
namespace {

using extrusion::RoofShape;

const PlanPolygon kBox{{{{0, 0}, {20, 0}, {20, 10}, {0, 10}}}};

OsmShape shape(std::initializer_list<std::pair<const char*, const char*>> tags) {
    Tags all;
    for (const auto& [key, value] : tags)
        all.add(key, value);
    return shapeOf(all, kBox, 9.0);
}

TEST(OsmHeights, ComeFromHeightThenLevelsThenTheDefault) {
    EXPECT_EQ(shape({{"building", "yes"}, {"height", "12"}, {"building:levels", "9"}}).levels.top,
              12.0);
    EXPECT_NEAR(shape({{"building", "yes"}, {"building:levels", "4"}}).levels.top, 12.4, 1e-12);
    const OsmShape unknown = shape({{"building", "yes"}});
    EXPECT_EQ(unknown.levels.top, 9.0);
    EXPECT_TRUE(unknown.assumed);
    EXPECT_NEAR(shape({{"building", "garage"}}).levels.top, 3.1, 1e-12);
    EXPECT_FALSE(shape({{"building", "yes"}, {"height", "40'"}}).assumed);
    const OsmShape odd = shape({{"building", "yes"}, {"height", "high"}});
    EXPECT_TRUE(odd.unreadable);
    EXPECT_TRUE(odd.assumed);
}

TEST(OsmHeights, BeginWhereMinHeightSays) {
    EXPECT_EQ(
        shape({{"building:part", "yes"}, {"height", "12"}, {"min_height", "4"}}).levels.bottom,
        4.0);
    EXPECT_NEAR(shape({{"building:part", "yes"}, {"height", "12"}, {"building:min_level", "2"}})
                    .levels.bottom,
                6.2, 1e-12);
    const OsmShape wrong =
        shape({{"building:part", "yes"}, {"height", "12"}, {"min_height", "15"}});
    EXPECT_EQ(wrong.levels.bottom, 0.0);
    EXPECT_TRUE(wrong.unreadable);
}

TEST(OsmHeights, OfRoofsAreWithinTheHeightAndOnTopOfLevels) {
    const OsmShape within = shape(
        {{"building", "yes"}, {"height", "10"}, {"roof:shape", "gabled"}, {"roof:height", "4"}});
    EXPECT_EQ(within.roof.shape, RoofShape::Gabled);
    EXPECT_EQ(within.levels.eaves, 6.0);
    EXPECT_EQ(within.levels.top, 10.0);
    const OsmShape onTop = shape({{"building", "yes"},
                                  {"building:levels", "2"},
                                  {"roof:shape", "hipped"},
                                  {"roof:levels", "1"}});
    EXPECT_NEAR(onTop.levels.eaves, 6.2, 1e-12);
    EXPECT_NEAR(onTop.levels.top, 9.3, 1e-12);
    const OsmShape angle = shape({{"building", "yes"},
                                  {"building:levels", "2"},
                                  {"roof:shape", "gabled"},
                                  {"roof:angle", "45"}});
    EXPECT_NEAR(angle.levels.top - angle.levels.eaves, 5.0, 1e-9);  // half of the 10 m
    const OsmShape guessed =
        shape({{"building", "yes"}, {"building:levels", "2"}, {"roof:shape", "gabled"}});
    EXPECT_NEAR(guessed.levels.top - guessed.levels.eaves, 5.0 * std::tan(std::acos(-1.0) / 6.0),
                1e-9);
    EXPECT_TRUE(shape({{"building", "yes"}, {"roof:shape", "zollinger"}}).unknownRoof);
}

TEST(OsmHeights, OfACanopyAreThoseOfASlab) {
    const OsmShape roof = shape({{"building", "roof"}, {"height", "5"}});
    EXPECT_EQ(roof.levels.top, 5.0);
    EXPECT_NEAR(roof.levels.bottom, 4.7, 1e-12);
}

TEST(OsmHeights, KnowWhatIsABuilding) {
    Tags no, part, below;
    no.add("building", "no");
    part.add("building:part", "yes");
    below.add("building", "yes");
    below.add("location", "underground");
    EXPECT_FALSE(isBuilding(no));
    EXPECT_FALSE(isBuilding(part));
    EXPECT_TRUE(isBuildingPart(part));
    EXPECT_TRUE(isUnderground(below));
    EXPECT_FALSE(isUnderground(part));
}

}  // namespace
}  // namespace reflet::osm
