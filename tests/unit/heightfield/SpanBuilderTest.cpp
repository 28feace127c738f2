// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/unit/heightfield/SpanCities.h"

namespace reflet::test {
namespace {

using Column = std::vector<std::array<float, 2>>;
constexpr float kDown = -kInfinity;

/// 20 m × 20 m of level ground, and a grid of cells of one metre.
class Spans : public testing::Test {
protected:
    Spans() { city.ground(0, 0, 20, 20, 0); }
    TestCity& bridge() { return city.object(CityObjectType::Bridge); }
    [[nodiscard]] Heightfield field(const HeightRules& rules = {}) const {
        return builtField(city.city, grid, rules);
    }
    static void expectColumn(const Heightfield& field, int i, int j, const Column& expected) {
        EXPECT_EQ(solidsAt(field.spans, field.grid, i, j), expected) << i << " " << j;
        EXPECT_EQ(solidsAt(field.centerSpans, field.grid, i, j), expected) << i << " " << j;
    }

    TestCity city;
    GridSpec grid{0.0, 0.0, 1.0, 20, 20};
};

TEST_F(Spans, ABridgeIsASlabAsThickAsItIsFromRimToRim) {
    addBlock(bridge(), {4, 0, 6}, {10, 20, 7});
    const Heightfield field = this->field();
    for (const int i : {4, 5, 7, 9})
        expectColumn(field, i, 10, {{kDown, 0}, {6, 7}});
    // The cell beside is touched by the deck's side, but its centre is not under it.
    EXPECT_EQ(solidsAt(field.spans, grid, 3, 10), (Column{{kDown, 0}, {6, 7}}));
    EXPECT_EQ(solidsAt(field.centerSpans, grid, 3, 10), Column{});
    EXPECT_EQ(solidsAt(field.spans, grid, 2, 10), Column{});
    const std::size_t under = grid.index(7, 10);
    EXPECT_EQ(field.ground[under], 0.0F);
    EXPECT_EQ(field.topMax[under], 7.0F);
    EXPECT_EQ(field.standingTop(under), 0.0F);
    EXPECT_EQ(field.overhead(under), (HeightSpan{6, 7, CityObjectType::Bridge, false}));
    EXPECT_EQ(field.overhead(grid.index(2, 10)), std::nullopt);
}

TEST_F(Spans, APierReachesTheGround) {
    addBlock(bridge(), {4, 0, 6}, {10, 20, 7});
    addBlock(city, {6, 8, -1}, {8, 10, 6});
    const Heightfield field = this->field();
    EXPECT_EQ(solidsAt(field.centerSpans, grid, 7, 9), Column{});
    EXPECT_EQ(field.topCenter[grid.index(7, 9)], 7.0F);
    expectColumn(field, 7, 12, {{kDown, 0}, {6, 7}});
}

TEST_F(Spans, AShellThatIsInsideOutIsTheSameBody) {
    addBlock(bridge(), {4, 0, 6}, {10, 20, 7});
    city.box({12, 4, 0}, {18, 9, 5});
    const Heightfield outward = field();
    const Heightfield inward = builtField(insideOut(city.city), grid);
    EXPECT_FALSE(outward.spans.empty());
    EXPECT_EQ(inward.spans, outward.spans);
    EXPECT_EQ(inward.centerSpans, outward.centerSpans);
}

TEST_F(Spans, ADeckWithoutUndersideIsThinAndMarkedAsHollow) {
    bridge().quad({4, 0, 6}, {10, 0, 6}, {10, 20, 6}, {4, 20, 6});
    const Heightfield field = this->field();
    expectColumn(field, 7, 10, {{kDown, 0}, {6, 6}});
    EXPECT_TRUE(field.centerSpans.at(grid.index(7, 10))[1].hollow);
}

TEST_F(Spans, ARoofWithoutUndersideStandsOnTheGround) {
    city.object(CityObjectType::Building).quad({4, 0, 6}, {10, 0, 6}, {10, 20, 6}, {4, 20, 6});
    const Heightfield field = this->field();
    EXPECT_TRUE(field.spans.empty());
    EXPECT_TRUE(field.centerSpans.empty());
    EXPECT_EQ(field.topCenter[grid.index(7, 10)], 6.0F);
}

TEST_F(Spans, AHouseOverAPassageIsHollowThere) {
    // A closed shell: two legs and a lintel, as one outline turned about.
    city.object(CityObjectType::Building);
    addVault(city, 5, 15, 6, 12, 0, 9, 12);
    const Heightfield field = this->field();
    const Column middle = solidsAt(field.centerSpans, grid, 8, 10);
    ASSERT_EQ(middle.size(), 2U);
    EXPECT_EQ(middle[0], (std::array{kDown, 0.0F}));
    EXPECT_GT(middle[1][0], 7.0F);
    EXPECT_LE(middle[1][0], 8.0F);
    EXPECT_EQ(middle[1][1], 9.0F);
    EXPECT_LE(solidsAt(field.spans, grid, 8, 10)[1][0], middle[1][0]);
    // The arch's foot: the cell at the wall is solid to the ground over its closed square.
    EXPECT_EQ(solidsAt(field.spans, grid, 6, 10), Column{});
}

/// Walls around a square, without floor or ceiling, and a roof that is a slab of its own.
void addHall(TestCity& city, float low, float high, bool withGate) {
    city.object(CityObjectType::Building);
    city.quad({4, 4, 0}, {16, 4, 0}, {16, 4, low}, {4, 4, low});
    city.quad({16, 16, 0}, {4, 16, 0}, {4, 16, low}, {16, 16, low});
    city.quad({4, 16, 0}, {4, 4, 0}, {4, 4, low}, {4, 16, low});
    if (!withGate)
        city.quad({16, 4, 0}, {16, 16, 0}, {16, 16, low}, {16, 4, low});
    addBlock(city, {3, 3, low}, {17, 17, high});
}

TEST_F(Spans, AHouseOfWallsUnderARoofOfItsOwnIsSolid) {
    addHall(city, 6, 7, false);
    const Heightfield field = this->field();
    for (const int k : {4, 5, 10, 15}) {
        EXPECT_EQ(solidsAt(field.centerSpans, grid, k, 10), Column{}) << k;
        EXPECT_EQ(solidsAt(field.spans, grid, k, 10), Column{}) << k;
        EXPECT_EQ(field.topCenter[grid.index(k, 10)], 7.0F);
    }
    // The eaves hang over the open.
    EXPECT_EQ(solidsAt(field.centerSpans, grid, 10, 16), (Column{{kDown, 0}, {6, 7}}));
}

TEST_F(Spans, AHallWithAnOpenSideIsHollow) {
    addHall(city, 6, 7, true);
    const Heightfield field = this->field();
    EXPECT_EQ(solidsAt(field.centerSpans, grid, 10, 10), (Column{{kDown, 0}, {6, 7}}));
    EXPECT_EQ(solidsAt(field.spans, grid, 10, 10), (Column{{kDown, 0}, {6, 7}}));
    EXPECT_EQ(solidsAt(field.spans, grid, 4, 10), Column{}) << "its wall";
}

TEST_F(Spans, HollowsBelowTheClearanceCountAsSolid) {
    city.object(CityObjectType::Building);
    addBlock(city, {4, 4, 0.9F}, {8, 8, 5});
    EXPECT_TRUE(field().centerSpans.empty());
    HeightRules rules;
    rules.clearance = 0.5;
    EXPECT_EQ(solidsAt(field(rules).centerSpans, grid, 5, 5), (Column{{kDown, 0}, {0.9F, 5}}));
}

TEST_F(Spans, SeveralLevelsAreKeptOneAboveTheOther) {
    for (const float level : {4.0F, 8.0F, 12.0F})
        addBlock(bridge(), {4, 4, level}, {10, 10, level + 1});
    expectColumn(field(), 7, 7, {{kDown, 0}, {4, 5}, {8, 9}, {12, 13}});
}

TEST_F(Spans, ACrownIsDenseAboveItsTrunk) {
    city.object(CityObjectType::SolitaryVegetation);
    // Leaves: loose triangles facing anywhere.
    city.triangle({6, 6, 4}, {10, 6, 4}, {8, 10, 4})
        .triangle({6, 6, 8}, {8, 10, 8}, {10, 6, 8})
        .triangle({7, 6, 6}, {9, 7, 6}, {8, 9, 6});
    addBlock(city, {7.9F, 7.2F, 0}, {8.1F, 7.4F, 5});
    const Heightfield field = this->field();
    EXPECT_EQ(solidsAt(field.centerSpans, grid, 8, 8), (Column{{kDown, 0}, {4, 8}}));
    EXPECT_EQ(field.spans.at(grid.index(8, 8))[1].kind, CityObjectType::SolitaryVegetation);
    EXPECT_EQ(solidsAt(field.spans, grid, 8, 7), Column{}) << "the trunk's cell is solid";
    EXPECT_EQ(solidsAt(field.centerSpans, grid, 8, 7), (Column{{kDown, 0}, {4, 8}}))
        << "no centre sees the trunk";
}

TEST_F(Spans, ATunnelIsCutOutOfTheHillAboveIt) {
    TestCity hill;
    hill.ground(0, 0, 20, 20, 10);
    hill.object(CityObjectType::Tunnel);
    addBlock(hill, {6, 0, 2}, {12, 20, 7});
    const Heightfield field = builtField(hill.city, grid);
    EXPECT_EQ(solidsAt(field.centerSpans, grid, 9, 9), (Column{{kDown, 2}, {7, 10}}));
    EXPECT_EQ(solidsAt(field.spans, grid, 9, 9), (Column{{kDown, 2}, {7, 10}}));
    EXPECT_EQ(solidsAt(field.centerSpans, grid, 3, 9), Column{});
    EXPECT_EQ(field.topMax[grid.index(9, 9)], 10.0F);
    EXPECT_EQ(field.ground[grid.index(9, 9)], 10.0F);
}

TEST_F(Spans, ATunnelsShellInTheOpenIsASpanButNotInTheTop) {
    city.object(CityObjectType::Tunnel);
    addBlock(city, {6, 0, 0}, {12, 20, 5});
    const Heightfield field = this->field();
    EXPECT_EQ(field.topCenter[grid.index(9, 9)], 0.0F);
    EXPECT_EQ(solidsAt(field.centerSpans, grid, 9, 9), (Column{{kDown, 0}, {5, 5}}));
}

TEST_F(Spans, ACanopyDoesNotLiftTheGround) {
    const auto quad = [&](float x0, float x1, float z) {
        city.object(CityObjectType::PlantCover)
            .quad({x0, 4, z}, {x1, 4, z}, {x1, 16, z}, {x0, 16, z});
    };
    quad(2, 8, 9);        // a wood
    quad(10, 16, 0.25F);  // a meadow
    const Heightfield field = this->field();
    EXPECT_EQ(field.ground[grid.index(5, 9)], 0.0F);
    EXPECT_EQ(field.topCenter[grid.index(5, 9)], 9.0F);
    EXPECT_EQ(field.ground[grid.index(12, 9)], 0.25F);
    HeightRules rules;
    rules.policies[std::size_t(CityObjectType::PlantCover)] = HeightPolicy::Ground;
    EXPECT_EQ(this->field(rules).ground[grid.index(5, 9)], 9.0F);
}

TEST(SpanPolicies, AMeadowIsTheGroundWhereNothingElseIs) {
    TestCity city;
    city.object(CityObjectType::PlantCover).quad({0, 0, 3}, {20, 0, 3}, {20, 20, 3}, {0, 20, 3});
    const GridSpec grid{0.0, 0.0, 1.0, 20, 20};
    EXPECT_EQ(builtField(city.city, grid).ground[grid.index(9, 9)], 3.0F);
    // Beside it, and not around it.
    city.ground(0, 0, 5, 5, 0);
    EXPECT_EQ(builtField(city.city, grid).ground[grid.index(2, 2)], 0.0F);
    EXPECT_EQ(builtField(city.city, grid).ground[grid.index(9, 9)], 3.0F);
}

TEST_F(Spans, APolicyDecidesWhatAClassIs) {
    addBlock(bridge(), {4, 0, 6}, {10, 20, 7});
    const std::size_t cell = grid.index(7, 10);
    HeightRules rules;
    HeightPolicy& policy = rules.policies[std::size_t(CityObjectType::Bridge)];
    policy = HeightPolicy::Column;
    Heightfield field = this->field(rules);
    EXPECT_TRUE(field.spans.empty() && field.centerSpans.empty());
    EXPECT_EQ(field.topCenter[cell], 7.0F);
    policy = HeightPolicy::None;
    field = this->field(rules);
    EXPECT_EQ(field.topMax[cell], 0.0F);
    policy = HeightPolicy::Ground;
    EXPECT_EQ(this->field(rules).ground[cell], 7.0F);
}

TEST_F(Spans, CentresThatLieExactlyOnWallsSeeTheClosedBody) {
    // Walls through the centres of cells, and a deck whose corner lies on one.
    addBlock(bridge(), {4.5F, 4.5F, 6}, {9.5F, 9.5F, 7});
    const Heightfield field = this->field();
    for (int i = 4; i <= 9; ++i) {
        for (int j = 4; j <= 9; ++j) {
            EXPECT_EQ(solidsAt(field.centerSpans, grid, i, j), (Column{{kDown, 0}, {6, 7}}))
                << i << " " << j;
            EXPECT_EQ(field.topCenter[grid.index(i, j)], 7.0F);
        }
    }
    EXPECT_EQ(solidsAt(field.centerSpans, grid, 3, 6), Column{});
}

TEST(SpanPolicies, CitiesWithoutOverheadHaveNoSpans) {
    TestCity city;
    city.ground(0, 0, 40, 40, 0);
    for (int n = 0; n < 6; ++n)
        city.box({3 + 6 * n, 4, -0.5F}, {7 + 6 * n, 12, 5.0F + float(n)});
    const Heightfield field = builtField(city.city, {0.0, 0.0, 0.5, 80, 80});
    EXPECT_TRUE(field.spans.empty());
    EXPECT_TRUE(field.centerSpans.empty());
}

TEST(SpanPolicies, ColumnsWithoutGroundStaySolid) {
    TestCity city;
    city.object(CityObjectType::Bridge);
    addBlock(city, {4, 4, 6}, {8, 8, 7});
    const Heightfield field = builtField(city.city, {0.0, 0.0, 1.0, 10, 10});
    EXPECT_TRUE(field.spans.empty());
    EXPECT_EQ(field.topCenter[55], 7.0F);
}

TEST(SpanPolicies, NamesAreReadAsTheyAreWritten) {
    for (std::size_t n = 0; n < kHeightPolicyCount; ++n)
        EXPECT_EQ(heightPolicyFromText(toString(HeightPolicy(n))), HeightPolicy(n));
    EXPECT_EQ(heightPolicyFromText("Solid"), std::nullopt);
    EXPECT_EQ(heightPolicyFromText(""), std::nullopt);
}

}  // namespace
}  // namespace reflet::test
