// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/gpu/reflection/RemStore.h"
#include "tests/gpu/GlFixture.h"
#include "tests/unit/reconstruction/BoxCity.h"

#include <string>

namespace reflet {
namespace {

using RemStoreOnGpu = test::GlFixture;

RemSet::Pointer plain(int number, int resolution) {
    return std::make_shared<const ReferenceEnvironmentMap>(
        test::plainMap("p" + std::to_string(number), glm::dvec3(number, 0, 0), resolution,
                       glm::vec3(0.25F * float(number)), 10.0F));
}

/// Red of the first texel of an element of a cube-map array.
float redOf(const RemStore::Place& place) {
    float texel[4] = {};
    glGetTextureSubImage(place.texture, 0, 0, 0, 6 * place.cube, 1, 1, 1, GL_RGBA, GL_FLOAT,
                         sizeof texel, texel);
    return texel[0];
}

TEST_F(RemStoreOnGpu, MapsInCommonAreNotUploadedAgain) {
    RemStore store(RemMemory::Plain);
    RemSet set;
    for (int i = 1; i <= 6; ++i)
        set.add(plain(i, 8));
    store.setRems(set);
    for (const auto& map : set.pointers())
        static_cast<void>(store.places(map, nullptr));
    EXPECT_EQ(store.uploads(), 6U);

    RemSet moved;
    for (std::size_t i = 1; i < 6; ++i)
        moved.add(set.pointers()[i]);
    moved.add(plain(7, 8));
    store.setRems(moved);
    for (std::size_t i = 0; i < 6; ++i) {
        const auto pair = store.places(moved.pointers()[i], nullptr);
        EXPECT_EQ(redOf(pair.a), 0.25F * float(i + 2));
    }
    EXPECT_EQ(store.uploads(), 7U);
}

TEST_F(RemStoreOnGpu, BothOfAPairAreThereAlsoWhenTheArrayGrowsBetweenThem) {
    RemStore store(RemMemory::Plain);
    RemSet set;
    for (int i = 1; i <= 5; ++i)
        set.add(plain(i, 4));
    store.setRems(set);
    for (int i = 0; i < 3; ++i)
        static_cast<void>(store.places(set.pointers()[std::size_t(i)], nullptr));
    const auto pair = store.places(set.pointers()[3], set.pointers()[4]);
    EXPECT_EQ(redOf(pair.a), 1.0F);
    EXPECT_EQ(redOf(pair.b), 1.25F);
    EXPECT_EQ(pair.a.texture, pair.b.texture);
}

TEST_F(RemStoreOnGpu, MapsOfSeveralResolutionsStandSideBySide) {
    RemStore store(RemMemory::Plain);
    const RemSet::Pointer small = plain(1, 4);
    const RemSet::Pointer large = plain(2, 16);
    const auto pair = store.places(small, large);
    EXPECT_NE(pair.a.texture, pair.b.texture);
    EXPECT_EQ(redOf(pair.a), 0.25F);
    EXPECT_EQ(redOf(pair.b), 0.5F);
}

TEST_F(RemStoreOnGpu, WhatWasLongestUnusedGivesWayToTheBudget) {
    const std::size_t one = 6 * 8 * 8 * 8;
    RemStore store(RemMemory::Plain, 3 * one);
    RemSet set;
    for (int i = 1; i <= 5; ++i)
        set.add(plain(i, 8));
    store.setRems(set);
    for (int round = 0; round < 3; ++round) {
        for (std::size_t i = 0; i < 5; ++i) {
            const auto pair = store.places(set.pointers()[i], set.pointers()[(i + 1) % 5]);
            EXPECT_EQ(redOf(pair.a), 0.25F * float(i + 1));
            EXPECT_EQ(redOf(pair.b), 0.25F * float((i + 1) % 5 + 1));
            EXPECT_LE(store.bytes(), 3 * one);
        }
    }
}

}  // namespace
}  // namespace reflet
