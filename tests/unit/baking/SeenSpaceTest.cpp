// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/baking/EnvironmentBaker.h"
#include "core/baking/SceneParts.h"
#include "core/baking/SeenSpace.h"
#include "tests/unit/baking/BakingScenes.h"

#include <algorithm>
#include <cstring>
#include <random>

namespace reflet::testing {
namespace {

struct Block {
    std::string id;
    glm::vec3 low, high;
    std::uint32_t material = 0;
};
using Town = std::vector<Block>;

constexpr float kPitch = 40.0F, kStreet = 14.0F, kHalf = 200.0F;

/// Ten by ten blocks between streets, heights as the seed says.
Town townOf(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> height(7.0F, 19.0F);
    Town town;
    for (int i = 0; i < 10; ++i) {
        for (int j = 0; j < 10; ++j) {
            const glm::vec3 low(-kHalf + kPitch * float(i) + 0.5F * kStreet,
                                -kHalf + kPitch * float(j) + 0.5F * kStreet, 0.0F);
            town.push_back({"b" + std::to_string(10 * i + j), low,
                            low + glm::vec3(kPitch - kStreet, kPitch - kStreet, height(random)),
                            std::uint32_t(random() % 3)});
        }
    }
    return town;
}

CityModel modelOf(const Town& town) {
    SceneBuilder b;
    const std::array<std::uint32_t, 3> materials{b.material("", {0.7F, 0.6F, 0.5F}),
                                                 b.material("plain", {0.3F, 0.5F, 0.6F}),
                                                 b.material("", {0.8F, 0.8F, 0.7F})};
    b.level(b.surface(b.object("ground", CityObjectType::Road)), -260, -260, 260, 260, 0);
    for (const Block& block : town)
        b.box(b.object(block.id, CityObjectType::Building), block.low, block.high,
              materials[block.material], false, false);
    return b.city;
}

struct Baked {
    ReferenceEnvironmentMap map;
    SeenSpace seen;
    std::uint64_t content = 0;
};

/// A town made ready to be baked and to be compared with others.
class Stage {
public:
    Stage(const Town& town, const Lighting& lighting)
        : m_lighting(lighting),
          m_model(modelOf(town)),
          m_looks(m_model),
          m_contents(m_model, m_looks, {}),
          m_scene(sceneOf(m_model, lighting)),
          m_own(m_contents.in(cellsOver(m_model.bounds()))) {}

    [[nodiscard]] Baked bake(const glm::dvec3& at) const {
        SightRecorder sight(m_own, at, m_lighting);
        auto map = bakeEnvironmentMap(*m_scene, nullptr, "rem", at, {32, 2}, {}, &sight);
        EXPECT_TRUE(map.has_value());
        Baked out{std::move(*map), sight.seen(), 0};
        out.content = contentOf(out.seen, m_own);
        return out;
    }
    [[nodiscard]] CellContents in(const CellGrid& grid) const { return m_contents.in(grid); }

private:
    Lighting m_lighting;
    CityModel m_model;
    SurfaceLooks m_looks;
    CityContents m_contents;
    std::unique_ptr<RadianceScene> m_scene;
    CellContents m_own;
};

bool sameBits(const ReferenceEnvironmentMap& a, const ReferenceEnvironmentMap& b) {
    const auto& ra = a.radiance.texels();
    const auto& rb = b.radiance.texels();
    const auto& da = a.distance.texels();
    const auto& db = b.distance.texels();
    return std::memcmp(ra.data(), rb.data(), ra.size() * sizeof(ra[0])) == 0 &&
           std::memcmp(da.data(), db.data(), da.size() * sizeof(da[0])) == 0;
}

bool keeps(const Baked& before, const Stage& after) {
    return contentOf(before.seen, after.in(before.seen.grid)) == before.content;
}

/// Something a town may suffer, anywhere.
void edit(Town& town, std::mt19937& random) {
    const auto any = [&](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    };
    Block& block = town[random() % town.size()];
    switch (random() % 6) {
        case 0:
            town.erase(town.begin() + std::ptrdiff_t(random() % town.size()));
            break;
        case 1: {  // a kiosk, or a tower, wherever it falls
            const glm::vec3 low(any(-kHalf, kHalf), any(-kHalf, kHalf), 0.0F);
            const float width = any(2.0F, 9.0F);
            town.push_back({"new", low, low + glm::vec3(width, width, any(3.0F, 60.0F)), 1});
            break;
        }
        case 2:
            block.high.z += any(-4.0F, 6.0F);
            break;
        case 3: {
            const glm::vec3 way(any(-3.0F, 3.0F), any(-3.0F, 3.0F), 0.0F);
            block.low += way;
            block.high += way;
            break;
        }
        case 4:
            block.material = (block.material + 1) % 3;
            break;
        default:
            block.id += "'";  // another façade of the same colour
            break;
    }
    std::shuffle(town.begin(), town.end(), random);  // the order of a file says nothing
}

TEST(SeenSpace, NoMapIsKeptThatAFullBakeWouldChange) {
    const Lighting light = sunAt(50, 200);
    const Town town = townOf(1);
    const Stage before(town, light);
    // Off all round numbers: where a ray meets an edge exactly, Embree may say either side, and
    // which one depends on all that is in its hierarchy.
    const std::array<glm::dvec3, 3> places{glm::dvec3(0.137, 0.291, 1.613),
                                           glm::dvec3(-120.411, 82.093, 1.577),
                                           glm::dvec3(158.173, -149.729, 12.031)};
    std::vector<Baked> baked;
    for (const glm::dvec3& place : places)
        baked.push_back(before.bake(place));
    std::mt19937 random(7);
    int kept = 0, changed = 0;
    for (int round = 0; round < 14; ++round) {
        Town edited = town;
        edit(edited, random);
        const Stage after(edited, light);
        for (std::size_t i = 0; i < baked.size(); ++i) {
            const bool same = sameBits(baked[i].map, after.bake(places[i]).map);
            const bool keep = keeps(baked[i], after);
            EXPECT_TRUE(same || !keep) << "round " << round << ", place " << i;
            kept += keep ? 1 : 0;
            changed += same ? 0 : 1;
        }
    }
    // Some of both, or nothing was shown.
    EXPECT_GE(kept, 14);
    EXPECT_GE(changed, 5);
}

TEST(SeenSpace, KeepsAMapWhenNothingButTheOrderOfTheFileChanges) {
    Town town = townOf(2);
    const Stage before(town, sunAt(40));
    const Baked baked = before.bake({0, 0, 2});
    std::reverse(town.begin(), town.end());
    EXPECT_TRUE(keeps(baked, Stage(town, sunAt(40))));
}

/// A street from west to east whose south side is one long wall, the sun in the south.
Town walledStreet() {
    return {{"north", {-60, 6, 0}, {60, 16, 12}, 0},
            {"south", {-60, -16, 0}, {60, -6, 12}, 0},
            {"west", {-70, -16, 0}, {-60, 16, 12}, 0},
            {"east", {60, -16, 0}, {70, 16, 12}, 0},
            {"far", {-250, 240, 0}, {250, 250, 40}, 0}};
}

TEST(SeenSpace, BakesAgainForAShadowOfWhatIsNotSeen) {
    Town town = walledStreet();
    const glm::dvec3 place(0, 0, 1.6);
    const Baked day = Stage(town, sunAt(60)).bake(place);
    const Baked night = Stage(town, sunAt(-20)).bake(place);
    // 38 m behind the wall, out of reach of soft light, too low to be seen over it; its shadow
    // would fall on the roof at best, but a tall one's falls into the street.
    town.push_back({"tower", {-3, -60, 0}, {3, -54, 39}, 0});
    EXPECT_FALSE(keeps(day, Stage(town, sunAt(60))));
    EXPECT_TRUE(keeps(night, Stage(town, sunAt(-20))));
}

TEST(SeenSpace, BakesAgainForWhatTakesSoftLightUnseen) {
    Town town = walledStreet();
    town[0].high.z = 2.0F;  // the north is low: its roof is seen from above
    const glm::dvec3 place(0, 0, 9);
    const Lighting light = sunAt(60);
    const Baked baked = Stage(town, light).bake(place);
    town.push_back({"shed", {-3, 17, 0}, {3, 19, 1.5F}, 0});  // behind the roof, beside it
    const Stage after(town, light);
    EXPECT_FALSE(keeps(baked, after));
}

TEST(SeenSpace, KeepsWhatIsBlindToAChange) {
    Town town = walledStreet();
    const Lighting light = sunAt(60);
    const glm::dvec3 place(0, 0, 1.6);
    const Baked baked = Stage(town, light).bake(place);
    town.push_back({"house", {100, -120, 0}, {112, -110, 20}, 0});
    const Stage after(town, light);
    EXPECT_TRUE(keeps(baked, after));
    EXPECT_TRUE(sameBits(baked.map, after.bake(place).map));
}

TEST(SeenSpace, TellsWhichPlacesItDependsOn) {
    const Baked baked = Stage(walledStreet(), sunAt(60)).bake({0, 0, 1.6});
    Box street, house, beyond;
    street.add({-50, -1, 0});
    street.add({-49, 1, 1});
    house.add({100, -120, 0});
    house.add({112, -110, 5});
    beyond.add({9000, 0, 0});
    EXPECT_TRUE(baked.seen.touches(street));
    EXPECT_FALSE(baked.seen.touches(house));
    EXPECT_FALSE(baked.seen.touches(beyond));
    EXPECT_FALSE(baked.seen.touches(Box()));
}

TEST(SeenSpace, GridsStaySmallForAnyCity) {
    Box box;
    box.add({-1e6, -1e6, -10});
    box.add({1e6, 1e6, 3000});
    EXPECT_LE(cellsOver(box).cells(), kMostCells);
    const CellGrid none = cellsOver(Box());
    EXPECT_EQ(none.cellAt({1e9, -1e9, 0}).x, none.count.x - 1);
    EXPECT_EQ(none.cellAt({1e9, -1e9, 0}).y, 0);
}

TEST(SeenSpace, CountsTrianglesWithoutAPlaceEverywhere) {
    CityModel model = modelOf(walledStreet());
    const CellGrid grid = cellsOver(model.bounds());
    const SurfaceLooks looks(model);
    const CellContents sound = CityContents(model, looks, {}).in(grid);
    EXPECT_EQ(sound.everywhere, 0U);
    model.vertices[model.triangles.back().vertex[1]].x = kInfinity;
    const CellContents broken = CityContents(model, looks, {}).in(grid);
    EXPECT_NE(broken.everywhere, 0U);
}

}  // namespace
}  // namespace reflet::testing
