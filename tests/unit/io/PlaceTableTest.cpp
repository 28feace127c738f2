// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/PlaceTable.h"

#include <gtest/gtest.h>

#include <string>

namespace reflet {
namespace {

PlaceTable read(const std::string& text) {
    auto table = readPlaceTable(text, "probes.csv");
    EXPECT_TRUE(table) << table.error().message();
    return table ? *table : PlaceTable{};
}

TEST(PlaceTable, FindsColumnsByTheirNamesInAnyOrder) {
    const PlaceTable table =
        read("Height [m],NAME,note,North,East\n3.5,a,\"x, \"\"y\"\"\",5335000.25,690001\n");
    ASSERT_EQ(table.places.size(), 1U);
    const TablePlace& place = table.places.front();
    EXPECT_EQ(place.id, "a");
    EXPECT_EQ(place.place, glm::dvec2(690001.0, 5335000.25));
    EXPECT_EQ(place.height, 3.5);
    EXPECT_EQ(place.line, 2U);
    EXPECT_EQ(place.crs, "");
}

TEST(PlaceTable, TakesDecimalCommasWhereColumnsAreApartBySemicolonsOrTabs) {
    for (const std::string between : {";", "\t"}) {
        const PlaceTable table =
            read("\xef\xbb\xbfid" + between + "x" + between + "y" + between + "z\r\np1" + between +
                 "690001,5" + between + "+5335000.5" + between + "\r\n");
        ASSERT_EQ(table.places.size(), 1U);
        EXPECT_EQ(table.places.front().place, glm::dvec2(690001.5, 5335000.5));
        EXPECT_FALSE(table.places.front().height);
    }
    const PlaceTable commas = read("x,y\n\"690001,5\",1\n");
    EXPECT_EQ(commas.skipped, 1U) << "with commas between columns it may be thousands";
}

TEST(PlaceTable, TakesTheSystemFromARemarkAColumnOrTheDegrees) {
    EXPECT_EQ(read("# CRS: EPSG:25832\n\nx,y\n1,2\n").places.at(0).crs, "EPSG:25832");
    const PlaceTable mixed = read("x,y,epsg\n1,2,28992\n3,4,EPSG:25833\n5,6,\n");
    EXPECT_EQ(mixed.places.at(0).crs, "EPSG:28992");
    EXPECT_EQ(mixed.places.at(1).crs, "EPSG:25833");
    EXPECT_EQ(mixed.places.at(2).crs, "");
    EXPECT_EQ(read("lat;lon\n48,1;11,5\n").places.at(0).crs, "EPSG:4326");
    EXPECT_EQ(read("lat;lon\n48,1;11,5\n").places.at(0).place, glm::dvec2(11.5, 48.1));
    EXPECT_EQ(read("x,y,lon,lat\n1,2,11.5,48.1\n").places.at(0).place, glm::dvec2(1.0, 2.0))
        << "what the file counts in itself comes first";
}

TEST(PlaceTable, LeavesBadRowsOutAndSaysWhichTheyWere) {
    const PlaceTable table = read(
        "id,x,y,z\n"
        "good,1,2,3\n"
        "word,1,two,3\n"
        "short,1\n"
        "\n"
        "# a remark\n"
        "endless,inf,2,3\n"
        "tall,1,2,nan\n"
        "\"quoted\nname\",5,6,7\n"
        "last,1e400,2,3\n");
    ASSERT_EQ(table.places.size(), 2U);
    EXPECT_EQ(table.places[1].id, "quoted\nname");
    EXPECT_EQ(table.skipped, 5U);
    ASSERT_EQ(table.remarks.size(), 5U);
    EXPECT_EQ(table.remarks[0].object, "line 3");
    EXPECT_EQ(table.remarks[1].object, "line 4");
    EXPECT_EQ(table.remarks[2].object, "line 7");
    EXPECT_EQ(table.remarks[3].object, "line 8");
    EXPECT_EQ(table.remarks[4].object, "line 11");
    EXPECT_EQ(read("lon,lat\n191,2\n1,91\n").skipped, 2U);
}

TEST(PlaceTable, TellsOnlyTheFirstOfManyBadRowsAndCountsTheRest) {
    std::string text = "x,y\n";
    for (int k = 0; k < 50; ++k)
        text += "a,b\n";
    const PlaceTable table = read(text);
    EXPECT_EQ(table.skipped, 50U);
    ASSERT_EQ(table.remarks.size(), PlaceTable::kMostTold + 1);
    EXPECT_EQ(table.remarks.back().text, "30 further rows were left out.");
}

TEST(PlaceTable, RefusesWhatIsNoTableOfPlaces) {
    for (const std::string& text :
         {std::string(), std::string("\n\n"), std::string("1,2\n3,4\n"), std::string("id,x\na,1\n"),
          std::string("# only a remark\n"), std::string("{\"type\": \"Feature\"}")}) {
        const auto table = readPlaceTable(text, "probes.csv");
        ASSERT_FALSE(table) << text;
        EXPECT_EQ(table.error().code, ErrorCode::Unreadable);
        EXPECT_EQ(table.error().subject, "probes.csv");
        EXPECT_NE(table.error().remedy.find("id, x, y, z"), std::string::npos);
    }
    const auto wide = readPlaceTable(std::string("x\0,y", 4), "utf16.csv");
    ASSERT_FALSE(wide);
    EXPECT_NE(wide.error().remedy.find("UTF-8"), std::string::npos);
}

TEST(PlaceTable, HasALimitOnRows) {
    std::string text = "x,y\n";
    for (std::size_t k = 0; k <= PlaceTable::kMostPlaces; ++k)
        text += "1,2\n";
    const auto table = readPlaceTable(text, "large.csv");
    ASSERT_FALSE(table);
    EXPECT_EQ(table.error().code, ErrorCode::ResourceLimit);
}

}  // namespace
}  // namespace reflet
