// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/geo/Crs.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace reflet {
namespace {

struct Spelling {
    const char* text;
    const char* horizontal;
    std::optional<std::string> vertical;
};

class CrsSpellings : public testing::TestWithParam<Spelling> {};

TEST_P(CrsSpellings, AreReadAsTheirTwoParts) {
    const auto crs = Crs::parse(GetParam().text);
    ASSERT_TRUE(crs) << crs.error().message();
    EXPECT_EQ(crs->horizontal(), GetParam().horizontal);
    EXPECT_EQ(crs->vertical(), GetParam().vertical);
}

INSTANTIATE_TEST_SUITE_P(
    OfRealFiles, CrsSpellings,
    testing::Values(
        Spelling{"EPSG:28992", "EPSG:28992", {}}, Spelling{"epsg:28992", "EPSG:28992", {}},
        Spelling{"  EPSG:28992\n", "EPSG:28992", {}}, Spelling{"EPSG::28992", "EPSG:28992", {}},
        Spelling{"EPSG:7415", "EPSG:28992", "EPSG:5709"},
        Spelling{"EPSG:28992+5709", "EPSG:28992", "EPSG:5709"},
        Spelling{"EPSG:28992 + EPSG:5709", "EPSG:28992", "EPSG:5709"},
        Spelling{"EPSG:25832+7837", "EPSG:25832", "EPSG:7837"},
        Spelling{"EPSG:25833, EPSG:5783", "EPSG:25833", "EPSG:5783"},
        Spelling{"https://www.opengis.net/def/crs/EPSG/0/7415", "EPSG:28992", "EPSG:5709"},
        Spelling{"http://www.opengis.net/def/crs/EPSG/0/2056", "EPSG:2056", {}},
        Spelling{"urn:ogc:def:crs:EPSG::7415", "EPSG:28992", "EPSG:5709"},
        Spelling{"urn:ogc:def:crs:EPSG:9.9:3879", "EPSG:3879", {}},
        Spelling{"urn:ogc:drf:crs:EPSG::3879", "EPSG:3879", {}},
        Spelling{"urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783", "EPSG:25832", "EPSG:5783"},
        Spelling{"urn:ogc:def:crs,crs:EPSG:6.12:25832,crs:EPSG:6.12:5783", "EPSG:25832",
                 "EPSG:5783"},
        Spelling{"http://www.opengis.net/def/crs-compound?1=http://www.opengis.net/def/crs/EPSG/0/"
                 "25832&2=http://www.opengis.net/def/crs/EPSG/0/7837",
                 "EPSG:25832", "EPSG:7837"},
        Spelling{"urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH", "EPSG:25832", "EPSG:7837"},
        Spelling{"urn:adv:crs:ETRS89_UTM33", "EPSG:25833", {}},
        Spelling{"urn:adv:crs:DE_DHDN_3GK4*DE_DHHN92_NH", "EPSG:31468", "EPSG:5783"},
        Spelling{"http://www.opengis.net/gml/srs/epsg.xml#25832", "EPSG:25832", {}},
        Spelling{"EPSG:6697", "EPSG:6668", "EPSG:6695"}, Spelling{"EPSG:4979", "EPSG:4326", {}},
        Spelling{"urn:ogc:def:crs:OGC:1.3:CRS84", "EPSG:4326", {}},
        Spelling{"OGC:CRS84", "EPSG:4326", {}}, Spelling{"EPSG:4978", "EPSG:4978", {}}));

constexpr const char* kEsriUtm32 =
    "PROJCS[\"ETRS_1989_UTM_Zone_32N\",GEOGCS[\"GCS_ETRS_1989\",DATUM[\"D_ETRS_1989\","
    "SPHEROID[\"GRS_1980\",6378137.0,298.257222101]],PRIMEM[\"Greenwich\",0.0],"
    "UNIT[\"Degree\",0.0174532925199433]],PROJECTION[\"Transverse_Mercator\"],"
    "PARAMETER[\"False_Easting\",500000.0],PARAMETER[\"False_Northing\",0.0],"
    "PARAMETER[\"Central_Meridian\",9.0],PARAMETER[\"Scale_Factor\",0.9996],"
    "PARAMETER[\"Latitude_Of_Origin\",0.0],UNIT[\"Meter\",1.0]]";

TEST(Crs, RecognisesTheCodeOfWktThatCarriesNone) {
    const auto crs = Crs::parse(kEsriUtm32);
    ASSERT_TRUE(crs) << crs.error().message();
    EXPECT_EQ(crs->horizontal(), "EPSG:25832");
}

TEST(Crs, KeepsTheWktOfASystemWithoutACode) {
    std::string wkt = kEsriUtm32;
    wkt.replace(wkt.find("9.0]"), 3, "9.5");
    const auto crs = Crs::parse(wkt);
    ASSERT_TRUE(crs) << crs.error().message();
    EXPECT_EQ(crs->horizontal().substr(0, 8), "PROJCRS[");
    const auto again = Crs::parse(crs->horizontal());
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_EQ(again->horizontal(), crs->horizontal());
}

TEST(Crs, ReadsItsOwnWktBack) {
    for (const char* text : {"EPSG:7415", "EPSG:25832", "EPSG:25832+7837", "EPSG:31256"}) {
        const auto crs = Crs::parse(text);
        ASSERT_TRUE(crs);
        const auto again = Crs::parse(crs->wkt());
        ASSERT_TRUE(again) << again.error().message();
        EXPECT_EQ(again->horizontal(), crs->horizontal());
        EXPECT_EQ(again->vertical(), crs->vertical());
    }
}

TEST(Crs, DropsADatumShiftBoundIntoWktWhenTheSystemHasACode) {
    const auto crs = Crs::parse(
        "PROJCS[\"DHDN / 3-degree Gauss-Kruger zone 4\",GEOGCS[\"DHDN\",DATUM[\"Deutsches_"
        "Hauptdreiecksnetz\",SPHEROID[\"Bessel 1841\",6377397.155,299.1528128],TOWGS84[598.1,73.7,"
        "418.2,0.202,0.045,-2.455,6.7]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\","
        "0.0174532925199433],AUTHORITY[\"EPSG\",\"4314\"]],PROJECTION[\"Transverse_Mercator\"],"
        "PARAMETER[\"latitude_of_origin\",0],PARAMETER[\"central_meridian\",12],PARAMETER[\"scale_"
        "factor\",1],PARAMETER[\"false_easting\",4500000],PARAMETER[\"false_northing\",0],UNIT["
        "\"metre\",1],AUTHORITY[\"EPSG\",\"31468\"]]");
    ASSERT_TRUE(crs) << crs.error().message();
    EXPECT_EQ(crs->horizontal(), "EPSG:31468");
    EXPECT_TRUE(crs->isProjected());
}

TEST(Crs, TellsTheKindAndTheUnit) {
    const auto projected = Crs::parse("EPSG:28992");
    EXPECT_TRUE(projected->isProjected());
    EXPECT_FALSE(projected->isGeographic());
    EXPECT_EQ(projected->metresPerUnit(), 1.0);
    const auto geographic = Crs::parse("EPSG:6697");
    EXPECT_TRUE(geographic->isGeographic());
    EXPECT_EQ(geographic->metresPerUnit(), 0.0);
    EXPECT_TRUE(Crs::parse("EPSG:4978")->isGeocentric());
    EXPECT_NEAR(Crs::parse("EPSG:2263")->metresPerUnit(), 1200.0 / 3937.0, 1e-12);  // survey feet
}

TEST(Crs, HasANameForPeople) {
    EXPECT_EQ(Crs::parse("EPSG:7415")->name(), "Amersfoort / RD New + NAP height");
}

TEST(Crs, RefusesWhatNamesNoSystemAndSaysWhatWouldWork) {
    const auto number = Crs::parse("28992");
    ASSERT_FALSE(number);
    EXPECT_EQ(number.error().code, ErrorCode::Refused);
    EXPECT_EQ(number.error().remedy, "Write EPSG:28992.");

    const auto unknown = Crs::parse("EPSG:999999");
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().code, ErrorCode::Refused);
    EXPECT_EQ(unknown.error().subject, "EPSG:999999");
    EXPECT_NE(unknown.error().remedy.find("epsg.org"), std::string::npos);

    const auto vertical = Crs::parse("EPSG:5709");
    ASSERT_FALSE(vertical);
    EXPECT_NE(vertical.error().remedy.find("EPSG:25832+7837"), std::string::npos);
}

TEST(Crs, RefusesNamesAndBrokenTextsInsteadOfGuessing) {
    for (const char* text : {"",
                             " ",
                             "WGS 84",
                             "RD New",
                             "EPSG:",
                             "EPSG:28992+",
                             "EPSG:28992+x",
                             "EPSG:28992,",
                             "EPSG:1234567890123",
                             "urn:adv:crs:UNKNOWN",
                             "urn:adv:crs:ETRS89_UTM32*X",
                             "http://www.opengis.net/gml/srs/epsg.xml#",
                             "urn:ogc:def:crs:EPSG::",
                             "PROJCS[",
                             "{}",
                             "PROJCS[\"x\"]",
                             "+proj=utm +zone=32",
                             "LOCAL_CS[\"x\",UNIT[\"metre\",1]]",
                             "EPSG:28992+28992",
                             "EPSG:5709+28992"}) {
        const auto crs = Crs::parse(text);
        ASSERT_FALSE(crs) << text;
        EXPECT_EQ(crs.error().code, ErrorCode::Refused) << text;
        EXPECT_FALSE(crs.error().remedy.empty()) << text;
    }
}

TEST(Crs, RefusesWktOfUnboundedLength) {
    const auto crs = Crs::parse("PROJCS[\"" + std::string(200'000, 'x') + "\"]");
    ASSERT_FALSE(crs);
    EXPECT_EQ(crs.error().code, ErrorCode::ResourceLimit);
    EXPECT_LE(crs.error().subject.size(), 80U);
}

TEST(Crs, TheAreaOfUseTellsSwappedAxes) {
    struct Place {
        const char* crs;
        double east, north;
    };
    for (const Place& p : {Place{"EPSG:28992", 85000, 446500}, Place{"EPSG:2056", 2683000, 1247000},
                           Place{"EPSG:3879", 25496700, 6673000}, Place{"EPSG:31256", 2500, 340000},
                           Place{"EPSG:25832", 691000, 5334000}, Place{"EPSG:4326", 139.7, 35.7}}) {
        const auto crs = Crs::parse(p.crs);
        ASSERT_TRUE(crs);
        EXPECT_TRUE(crs->areaContains(p.east, p.north)) << p.crs;
        EXPECT_FALSE(crs->areaContains(p.north, p.east)) << p.crs;
        EXPECT_FALSE(crs->areaContains(0.0, 1e8)) << p.crs;
    }
}

TEST(Crs, TheAreaOfUseIsKnownForOtherPrimeMeridiansUnitsAndAcrossTheDateLine) {
    const auto paris = Crs::parse("EPSG:27572");  // NTF (Paris) / Lambert zone II, in grads below
    ASSERT_TRUE(paris);
    EXPECT_TRUE(paris->areaContains(600000, 2428000));  // Paris
    EXPECT_FALSE(paris->areaContains(4500000, 2428000));
    const auto newYork = Crs::parse("EPSG:2263");  // feet
    ASSERT_TRUE(newYork);
    EXPECT_TRUE(newYork->areaContains(980000, 200000));
    EXPECT_FALSE(newYork->areaContains(298700, 61000));  // the same place in metres
    const auto zealand = Crs::parse("EPSG:4167");        // NZGD2000: 160.6 E to 171.2 W
    ASSERT_TRUE(zealand);
    EXPECT_TRUE(zealand->areaContains(174.8, -36.9));
    EXPECT_TRUE(zealand->areaContains(-176.5, -44.0));  // Chatham Islands
    EXPECT_FALSE(zealand->areaContains(10.0, -44.0));
}

TEST(Crs, ParsesInManyThreadsAtOnce) {
    std::vector<std::thread> threads;
    std::vector<std::string> found(8);
    for (std::size_t t = 0; t < found.size(); ++t)
        threads.emplace_back([&found, t] {
            for (int k = 0; k < 5; ++k)
                found[t] = Crs::parse("EPSG:7415")->horizontal();
        });
    for (auto& thread : threads)
        thread.join();
    for (const auto& name : found)
        EXPECT_EQ(name, "EPSG:28992");
}

TEST(Crs, TheStatusOfProjTellsVersionAndDatabase) {
    const ProjStatus status = projStatus();
    EXPECT_TRUE(status.databaseOpens);
    EXPECT_NE(status.databasePath.find("proj.db"), std::string::npos);
    EXPECT_FALSE(status.version.empty());
}

}  // namespace
}  // namespace reflet
