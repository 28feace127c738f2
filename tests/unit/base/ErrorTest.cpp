// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/Diagnostic.h"
#include "core/base/Error.h"

#include <gtest/gtest.h>

namespace reflet {
namespace {

TEST(Error, SaysWhatIsWrongWithWhichThingAndWhatToDo) {
    const Error error{ErrorCode::Unreadable, "is not JSON", "a.city.json", "Export it again."};
    EXPECT_EQ(error.message(), "a.city.json: is not JSON. Export it again.");
}

TEST(Error, OmitsWhatIsNotKnown) {
    EXPECT_EQ((Error{ErrorCode::Internal, "out of luck", "", ""}.message()), "out of luck.");
    EXPECT_EQ((Error{ErrorCode::Internal, "out of luck.", "", ""}.message()), "out of luck.");
    EXPECT_EQ((Error{ErrorCode::Internal, "", "", ""}.message()), "");
}

TEST(Error, TellsItsOuterContextsFromTheInsideOut) {
    const Error inner{ErrorCode::Refused, "has no CRS", "tile 7", ""};
    const Error outer = inner.in("while importing a.city.json").in("while making city.reflet");
    EXPECT_EQ(outer.message(),
              "tile 7: has no CRS. (while importing a.city.json) (while making city.reflet)");
    EXPECT_EQ(outer.code, ErrorCode::Refused);
    EXPECT_TRUE(inner.trail.empty()) << "the original stays as it was";
}

TEST(Error, TravelsThroughAResult) {
    const auto half = [](int number) -> Result<int> {
        if (number % 2 != 0)
            return fail(ErrorCode::Usage, "is odd", std::to_string(number), "Give an even one.");
        return number / 2;
    };
    EXPECT_EQ(half(8).and_then(half).value(), 2);
    const auto odd = half(6).and_then(half);
    ASSERT_FALSE(odd);
    EXPECT_EQ(odd.error().code, ErrorCode::Usage);
    EXPECT_EQ(odd.error().message(), "3: is odd. Give an even one.");
}

TEST(Diagnostic, NamesItsSeverityAsInTheReports) {
    EXPECT_STREQ(toString(Severity::Info), "info");
    EXPECT_STREQ(toString(Severity::Warning), "warning");
    EXPECT_STREQ(toString(Severity::Error), "error");
}

}  // namespace
}  // namespace reflet
