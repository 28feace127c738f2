// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/pipeline/Edit.h"
#include "app/pipeline/WithoutTrees.h"
#include "tests/support/StreetProject.h"
#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>

namespace reflet {
namespace {

class WithoutTrees : public testing::Test {
protected:
    [[nodiscard]] DrivenCity open(const test::StreetCity& street) {
        EXPECT_TRUE(test::importStreetWithCar(folder, file, street));
        EditRequest edit;
        edit.probesEvery = 30.0;
        edit.settings = {{"bake.resolution", "32"}};
        EXPECT_TRUE(editProject(file, edit, {}));
        auto driven = openDriven(file, {});
        EXPECT_TRUE(driven) << driven.error().message();
        return std::move(*driven);
    }

    test::TemporaryFolder folder;
    std::filesystem::path file = folder / "street.reflet";
};

TEST_F(WithoutTrees, ACityLosesTheTrianglesOfItsTreesAndNothingElse) {
    const DrivenCity driven = open(test::StreetCity()
                                       .withTree({22.0, 3.5, 0.0}, {25.0, 5.5, 6.0})
                                       .withHouse({62.0, 20.0, 0.0}, {66.0, 24.0, 5.0})
                                       .withTree({32.0, 3.5, 0.0}, {34.0, 5.5, 7.0}));
    const CityModel& city = driven.city.city();
    const TreeCount trees = treesOf(city);
    EXPECT_EQ(trees.objects, 2U);
    EXPECT_EQ(trees.triangles, 24U);
    const LoadedCity bare = withoutTrees(driven.city.loaded());
    EXPECT_EQ(treesOf(bare.city).triangles, 0U);
    EXPECT_EQ(bare.city.triangles.size(), city.triangles.size() - 24);
    EXPECT_EQ(bare.city.objects.size(), city.objects.size());
    EXPECT_NE(bare.contentHash, driven.city.loaded().contentHash);
    // What is left is in its order.
    std::size_t at = 0;
    for (const CityTriangle& triangle : city.triangles) {
        if (city.objects[city.surfaces[triangle.surface].object].type ==
            CityObjectType::SolitaryVegetation)
            continue;
        ASSERT_LT(at, bare.city.triangles.size());
        EXPECT_EQ(bare.city.triangles[at].vertex, triangle.vertex);
        EXPECT_EQ(bare.city.triangles[at++].surface, triangle.surface);
    }
}

TEST_F(WithoutTrees, HeightfieldAndProbesAreThoseOfTheBareCity) {
    const DrivenCity driven = open(test::StreetCity().withTree({22, 3.5, 0}, {25, 5.5, 6}));
    const auto bare = drivenWithoutTrees(driven, file, {});
    ASSERT_TRUE(bare) << bare.error().message();
    ASSERT_TRUE(*bare);
    const glm::dvec3 tree = driven.city.inFrame({690'023.5, 5'335'004.5, 0.0});
    const auto topAt = [&](const PreparedCity& city) {
        const GridSpec& grid = city.heightfield().grid;
        return city.heightfield().standingTop(grid.index(grid.column(tree.x), grid.row(tree.y)));
    };
    EXPECT_NEAR(topAt(driven.city) - topAt((*bare)->city), 6.0, 0.01);
    ASSERT_EQ((*bare)->rems.rems.size(), driven.rems.rems.size());
    bool differ = false;
    for (std::size_t i = 0; i < driven.rems.rems.size(); ++i)
        differ = differ ||
                 driven.rems.rems[i].distance.texels() != (*bare)->rems.rems[i].distance.texels();
    EXPECT_TRUE(differ);
}

TEST_F(WithoutTrees, ACityWithoutTreesHasNoOther) {
    const DrivenCity driven = open(test::StreetCity());
    const auto bare = drivenWithoutTrees(driven, file, {});
    ASSERT_TRUE(bare) << bare.error().message();
    EXPECT_FALSE(bare->has_value());
}

}  // namespace
}  // namespace reflet
