#include "calibration/files/json_fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace curvewall {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

std::string complaint(const std::function<void()>& action) {
    try {
        action();
    } catch (const std::exception& error) {
        return error.what();
    }
    return "no complaint";
}

class BadJson : public ::testing::TestWithParam<std::string> {};

TEST_P(BadJson, IsRefused) { EXPECT_THROW(parseJson(GetParam()), JsonSyntaxError); }

INSTANTIATE_TEST_SUITE_P(JsonFields, BadJson,
                         ::testing::Values("", "{", "{\"a\":}", "{\"a\":1,}", "[1] x", "NaN", "{\"a\":NaN}",
                                           "{\"a\":1e999}", "{\"a\":-1e999}", "\"\xff\"", "{\"a\":\"\xc3\"}",
                                           R"({"a":1,"a":1})", R"({"a":{"b":1,"c":{},"b":2}})",
                                           std::string(1'000'000, '['),
                                           std::string(17, '[') + std::string(17, ']'),
                                           std::string("{\"a\":1}\0", 8), "'a'", "\xef\xbb"));

TEST(JsonFields, SixteenLevelsAreNotTooDeep) {
    EXPECT_NO_THROW(parseJson(std::string(16, '[') + "1" + std::string(16, ']')));
}

TEST(JsonFields, TheSameKeyInDifferentObjectsIsNoRepetition) {
    EXPECT_EQ(parseJson(R"({"a":{"a":1},"b":{"a":2}})")["b"]["a"], 2);
}

TEST(JsonFields, ComplaintsNameTheFieldAndQuoteWhatWasFound) {
    const json object{{"yaw_deg", "abc"}, {"list", {1, "two", 3}}, {"samples", 1.5}, {"name", nullptr}};
    JsonFields fields(object, "camera");
    EXPECT_EQ(complaint([&] {
                  fields.number("yaw_deg", {-1, 1});
              }),
              "camera.yaw_deg: expected a number, found \"abc\"");
    EXPECT_EQ(complaint([&] {
                  fields.numbers("list", 3, {0, 9});
              }),
              "camera.list[1]: expected a number, found \"two\"");
    EXPECT_EQ(complaint([&] { fields.wholeNumber("samples", 1, 9); }),
              "camera.samples: expected a whole number, found 1.5");
    EXPECT_EQ(complaint([&] { fields.text("name"); }), "camera.name: expected a string, found null");
    EXPECT_EQ(complaint([&] { fields.require("position"); }),
              "camera.position: expected a value, found nothing");
    EXPECT_EQ(complaint([&] { fields.object("list"); }), "camera.list: expected an object, found a list");
}

TEST(JsonFields, KeysThatNobodyReadAreUnknown) {
    const json object{{"known", 1}, {"unknown", 2}};
    JsonFields fields(object, "");
    fields.number("known", {0, 9});
    fields.number("absent", {0, 9});
    EXPECT_EQ(complaint([&] { fields.refuseUnknownKeys(); }),
              "expected only the keys known, absent, found the key \"unknown\"");
}

TEST(JsonFields, RangesIncludeTheirEnds) {
    const json object{{"min", 2}, {"max", 5}, {"below", 1.999}, {"above", 5.001}, {"huge", 1e300}};
    JsonFields fields(object, "");
    EXPECT_EQ(fields.number("min", {2, 5}), 2);
    EXPECT_EQ(fields.number("max", {2, 5}), 5);
    EXPECT_EQ(fields.wholeNumber("max", 2, 5), 5);
    EXPECT_THROW(fields.number("below", {2, 5}), FieldError);
    EXPECT_THROW(fields.number("above", {2, 5}), FieldError);
    EXPECT_THROW(fields.wholeNumber("huge", 2, 5), FieldError);
}

TEST(JsonFields, EndsOfRangesMayBeExcluded) {
    const json object{{"min", 2}, {"max", 5}};
    JsonFields fields(object, "");
    EXPECT_EQ(complaint([&] {
                  fields.number("min", {2, 5, true});
              }),
              "min: expected a number above 2, at most 5, found 2");
    EXPECT_EQ(complaint([&] {
                  fields.number("max", {2, 5, true, true});
              }),
              "max: expected a number above 2, below 5, found 5");
    EXPECT_EQ(fields.number("max", {2, 5, true}), 5);
    EXPECT_EQ(fields.number("min", {2, 5, false, true}), 2);
}

TEST(JsonFields, ListsMayHaveOneOfSeveralLengths) {
    const json object{{"list", {1, 2, 3, 4}}};
    JsonFields fields(object, "");
    EXPECT_EQ(fields.numbers("list", {0, 4}, {0, 9})->size(), 4u);
    EXPECT_EQ(complaint([&] {
                  fields.numbers("list", {0, 3, 5}, {0, 9});
              }),
              "list: expected a list of 0, 3 or 5 numbers, found a list of 4");
}

TEST(JsonFields, LargestNumbersDoNotOverflow) {
    const json object = parseJson(R"({"max":18446744073709551615,"min":-9223372036854775808,"float":16.0})");
    JsonFields fields(object, "");
    EXPECT_THROW(fields.wholeNumber("max", 0, 100), FieldError);
    EXPECT_THROW(fields.wholeNumber("min", 0, 100), FieldError);
    EXPECT_EQ(fields.wholeNumber("float", 0, 100), 16);
}

TEST(JsonFields, LongStringsAreCutInMessages) {
    EXPECT_LT(describe(json(std::string(100'000, 'x'))).size(), 60U);
    EXPECT_LT(describe(json("\xe2\x82\xac" + std::string(90, '\xff'))).size(), 60U);
}

}  // namespace
}  // namespace curvewall
