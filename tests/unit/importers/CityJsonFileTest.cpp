// SPDX-License-Identifier: GPL-3.0-or-later
// What makes a text a CityJSON file, and what is said when it is none.
#include "tests/unit/importers/CityJsonText.h"

#include <atomic>
#include <mutex>

namespace reflet {

using namespace test;

TEST(CityJsonFile, OfEachSupportedVersionIsRead) {
    for (const char* version : {"1.0", "1.1", "2.0", "1.0.3", "1.1.3", "2.0.1"}) {
        json city = boxCity();
        city["version"] = version;
        const auto result = import(city);
        EXPECT_EQ(result.value.summary.version, version);
        EXPECT_EQ(result.value.city.triangles.size(), 12U) << version;
    }
    json city = boxCity();
    city["version"] = 1.1;  // a number, as some writers have it
    EXPECT_EQ(import(city).value.summary.version, "1.1");
}

TEST(CityJsonFile, OfAnotherVersionIsUnreadable) {
    for (const char* version : {"3.0", "0.9", "2", "20.0", "", "1.0x"}) {
        json city = boxCity();
        city["version"] = version;
        const Error error = importError(city.dump());
        EXPECT_EQ(error.code, ErrorCode::Unreadable);
        EXPECT_EQ(error.what,
                  "is CityJSON of version \"" + std::string(version) + "\", which is unknown");
        EXPECT_EQ(error.subject, "city.city.json");
        EXPECT_EQ(error.remedy, "Convert it to 1.0, 1.1 or 2.0, e.g. with cjio's upgrade.");
    }
    json city = boxCity();
    city.erase("version");
    EXPECT_EQ(importError(city.dump()).what, "is no CityJSON: \"version\" is missing at its root");
}

TEST(CityJsonFile, OfAnotherTypeIsUnreadable) {
    json city = boxCity();
    city["type"] = "FeatureCollection";
    EXPECT_EQ(importError(city.dump()).what,
              "is no CityJSON: its \"type\" is \"FeatureCollection\"");
    city["type"] = "CityJSONFeature";
    EXPECT_EQ(importError(city.dump()).what,
              "holds one CityJSONFeature, not a CityJSON city model");
    city["type"] = 7;
    EXPECT_EQ(importError(city.dump()).what, "is no CityJSON: its \"type\" is \"7\"");
    city.erase("type");
    const Error error = importError(city.dump());
    EXPECT_EQ(error.what, "is no CityJSON: \"type\" is missing at its root");
    EXPECT_EQ(error.code, ErrorCode::Unreadable);
    EXPECT_EQ(error.remedy, "Check that this is the right file, e.g. with cjval.");
}

TEST(CityJsonFile, WithoutObjectsOrVerticesIsUnreadable) {
    json city = boxCity();
    city.erase("vertices");
    EXPECT_EQ(importError(city.dump()).what, "has no \"vertices\" array");
    city = boxCity();
    city["City Objects"] = city["CityObjects"];
    city.erase("CityObjects");
    const Error misspelled = importError(city.dump());
    EXPECT_EQ(misspelled.what, "has no \"CityObjects\"; \"City Objects\" stands in its place");
    EXPECT_EQ(misspelled.remedy, "Rename that member to CityObjects.");
    city.erase("City Objects");
    EXPECT_EQ(importError(city.dump()).what, "has no \"CityObjects\" object");
    city["CityObjects"] = json::array();
    EXPECT_EQ(importError(city.dump()).what, "has no \"CityObjects\" object");
}

TEST(CityJsonFile, WithoutAnyObjectGivesAnEmptyCity) {
    const auto result = import(emptyCity());
    EXPECT_TRUE(result.value.city.objects.empty());
    EXPECT_TRUE(result.value.summary.bounds.empty());
    EXPECT_EQ(result.value.city.frame.crs, "EPSG:28992");
}

TEST(CityJsonFile, WithABrokenTransformIsUnreadable) {
    for (const json& transform :
         {json(5), json{{"scale", {1, 1}}, {"translate", {0, 0, 0}}}, json{{"scale", {1, 1, 1}}},
          json{{"scale", {0.001, 0, 1}}, {"translate", {0, 0, 0}}},
          json{{"scale", {"1", 1, 1}}, {"translate", {0, 0, 0}}}}) {
        json city = boxCity();
        city["transform"] = transform;
        const Error error = importError(city.dump());
        EXPECT_EQ(error.code, ErrorCode::Unreadable);
        EXPECT_EQ(error.what,
                  "has a \"transform\" whose scale and translate are not three numbers each");
    }
}

TEST(CityJsonFile, OfVersionTwoWithoutTransformIsTakenAsItIsWithAWarning) {
    json city = boxCity();
    city.erase("transform");
    city["vertices"] = boxVertices(85000, 446000, 0, 10, 8, 6);
    const auto result = import(city);
    EXPECT_NE(findDiagnostic(result, "no-transform"), nullptr);
    EXPECT_NEAR(enclosedVolume(result.value.city), 480.0, 1e-6);
    city["version"] = "1.0";
    EXPECT_EQ(findDiagnostic(import(city), "no-transform"), nullptr);
}

TEST(CityJsonFile, MayHaveItsMembersInAnyOrder) {
    const json city = boxCity();
    const std::string text =
        R"({"vertices":)" + city["vertices"].dump() + R"(,"CityObjects":{"a":{"geometry":[{)" +
        R"("semantics":{"values":[[0,1,2,2,2,2]],"surfaces":[{"type":"GroundSurface"},)" +
        R"({"type":"RoofSurface"},{"type":"WallSurface"}]},"boundaries":)" +
        json::array({boxShell()}).dump() + R"(,"lod":"2","type":"Solid"}],"type":"Building"}},)" +
        R"("transform":)" + city["transform"].dump() + R"(,"version":"2.0","type":"CityJSON"})";
    const auto result = tryImport(text);
    ASSERT_TRUE(result) << result.error().message();
    EXPECT_EQ(result->value.city.triangles.size(), 12U);
    EXPECT_EQ(result->value.city.surfaces[1].type, SurfaceType::Roof);
}

TEST(CityJsonFile, MayStartWithAByteOrderMark) {
    const auto result = tryImport("\xEF\xBB\xBF" + boxCity().dump());
    ASSERT_TRUE(result) << result.error().message();
    EXPECT_EQ(result->value.city.triangles.size(), 12U);
}

TEST(CityJsonFile, CutShortAnywhereIsUnreadable) {
    const std::string text = boxCity().dump();
    for (std::size_t length = 0; length < text.size(); ++length) {
        const auto result = tryImport(text.substr(0, length));
        ASSERT_FALSE(result) << "cut at " << length;
        EXPECT_EQ(result.error().code, ErrorCode::Unreadable);
        if (length > 0) {
            EXPECT_NE(result.error().what.find("is no valid JSON at line 1, column "),
                      std::string::npos)
                << result.error().what;
        }
    }
}

TEST(CityJsonFile, ThatIsNoJsonNamesThePlace) {
    const Error error = importError("{\n  \"type\": \"CityJSON\",\n  \"version\" \"2.0\"\n}");
    EXPECT_EQ(error.code, ErrorCode::Unreadable);
    EXPECT_EQ(error.what,
              "is no valid JSON at line 3, column 17: unexpected string literal; expected ':'");
    EXPECT_EQ(error.remedy,
              "The file is damaged or was cut short: get it again, or check it with a JSON "
              "validator.");
    EXPECT_EQ(importError("").what, "is empty");
    EXPECT_EQ(importError(" \n\t").what, "is empty");
    EXPECT_EQ(importError("[1, 2]").what, "is no CityJSON: its root is not an object");
    EXPECT_EQ(importError("\"CityJSON\"").what, "is no CityJSON: its root is not an object");
    EXPECT_EQ(importError("null").code, ErrorCode::Unreadable);
    EXPECT_EQ(importError("{}{}").code, ErrorCode::Unreadable);
    EXPECT_EQ(importError("{").code, ErrorCode::Unreadable);
    EXPECT_EQ(importError(std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16)).code,
              ErrorCode::Unreadable);
}

TEST(CityJsonFile, WithSomethingBehindItsEndIsUnreadable) {
    const std::string city = boxCity().dump();
    for (const char* more : {" 1", "]", "}", ","}) {
        const Error error = importError(city + more);
        EXPECT_EQ(error.code, ErrorCode::Unreadable) << more;
        EXPECT_NE(error.what.find("is no valid JSON at line "), std::string::npos) << error.what;
    }
    EXPECT_TRUE(tryImport(city + "\n\n"));
    const Error sequence = importError(city + "\n{\"type\":\"CityJSONFeature\"}");
    EXPECT_EQ(sequence.code, ErrorCode::Unreadable);
    EXPECT_EQ(sequence.what, "is a CityJSON text sequence (one object a line), not a single city");
    EXPECT_EQ(sequence.remedy, "Collect its features into one file, e.g. with cjseq.");
}

TEST(CityJsonFile, NestedAHundredThousandDeepDoesNotOverflowTheStack) {
    const std::string arrays(100'000, '[');
    EXPECT_EQ(importError(arrays).code, ErrorCode::Unreadable);
    const std::string closed = arrays + std::string(100'000, ']');
    std::string objects;
    for (int i = 0; i < 100'000; ++i)
        objects += "{\"a\":";
    EXPECT_EQ(importError(objects).code, ErrorCode::Unreadable);
    // As boundaries, semantics, attributes and at the root of a file that is otherwise sound.
    const std::string head =
        R"({"type":"CityJSON","version":"2.0","vertices":[[0,0,0]],"CityObjects":{)";
    for (const std::string& inside :
         {R"("a":{"type":"Building","geometry":[{"type":"Solid","lod":"1","boundaries":)" + closed +
              "}]}}}",
          R"("a":{"type":"Building","geometry":[{"type":"GeometryInstance","boundaries":[0],)"
          R"("semantics":{"values":)" +
              closed + "}}]}}}",
          R"("a":{"type":"Building","attributes":)" + closed + "}}}",
          R"(},"extra":)" + closed + "}"}) {
        const auto result = tryImport(head + inside);
        if (!result) {
            EXPECT_EQ(result.error().code, ErrorCode::Unreadable);
        } else {
            EXPECT_TRUE(result->value.city.triangles.empty());
        }
    }
}

TEST(CityJsonFile, LargerThanTheLimitIsRefusedBeforeItIsRead) {
    ImportOptions options;
    options.maxFileBytes = 100;
    const Error error = importError(boxCity().dump(), options);
    EXPECT_EQ(error.code, ErrorCode::ResourceLimit);
    EXPECT_EQ(error.what, "is larger than the limit of 100 bytes");
}

TEST(CityJsonFile, ThatDoesNotExistIsUnreadable) {
    const auto result = importCityJson("/nonexistent/a.city.json", {}, {});
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::Unreadable);
    EXPECT_EQ(result.error().subject, "/nonexistent/a.city.json");
    EXPECT_FALSE(inspectCityJson("/nonexistent/a.city.json", {}, {}));
}

namespace {

/// A row of boxes, enough work to be interrupted.
std::string manyBoxes(int count) {
    json city = emptyCity();
    for (int i = 0; i < count; ++i) {
        for (const json& vertex : boxVertices(i * 12000))
            city["vertices"].push_back(vertex);
        city["CityObjects"]["box " + std::to_string(i)] =
            object("Building", json::array({solid("2", boxShell(8 * i))}));
    }
    return city.dump();
}

}  // namespace

TEST(CityJsonFile, IsReadWithProgressFromZeroToOne) {
    double last = 0.0;
    bool within = true;
    int reports = 0;
    std::mutex mutex;
    const JobContext job(
        [&](double fraction, const std::string&) {
            const std::scoped_lock lock(mutex);
            within = within && fraction >= 0.0 && fraction <= 1.0;
            last = std::max(last, fraction);
            ++reports;
        },
        {});
    const auto result = importCityJsonText(manyBoxes(3000), "city.json", {}, job);
    ASSERT_TRUE(result);
    EXPECT_TRUE(within);
    EXPECT_EQ(last, 1.0);
    EXPECT_GT(reports, 5);
}

TEST(CityJsonFile, CanBeCancelledAtEveryReportOfProgress) {
    const std::string text = manyBoxes(2500);
    int total = 0;
    std::mutex mutex;
    const JobContext counting(
        [&](double, const std::string&) {
            const std::scoped_lock lock(mutex);
            ++total;
        },
        {});
    ASSERT_TRUE(importCityJsonText(text, "city.json", {}, counting));
    ASSERT_GT(total, 5);
    for (int at = 0; at + 1 < total; ++at) {
        std::stop_source stop;
        std::atomic<int> reports{0};
        const JobContext job(
            [&](double, const std::string&) {
                if (reports++ == at)
                    stop.request_stop();
            },
            stop.get_token());
        const auto result = importCityJsonText(text, "city.json", {}, job);
        ASSERT_FALSE(result) << "report " << at << " of " << total;
        EXPECT_EQ(result.error().code, ErrorCode::Cancelled);
    }
}

}  // namespace reflet
