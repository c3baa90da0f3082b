#include "calibration/formats/decisions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace curvewall {
namespace {

using nlohmann::json;
using testing::HasSubstr;

enum class Order { bottomFirst, topFirst };

Order rowOrder(Decisions& decisions) {
    return decisions.choose("row_order",
                            {{"bottom_first", Order::bottomFirst}, {"top_first", Order::topFirst}},
                            Order::bottomFirst, "the format says so");
}

std::string complaint(const std::function<void()>& act) {
    try {
        act();
    } catch (const FieldError& error) {
        return error.field + ": expected " + error.expected + ", found " + error.found;
    }
    return "";
}

TEST(Decisions, GuessesAreTakenAndListedWithTheirEvidence) {
    Decisions decisions;
    EXPECT_EQ(rowOrder(decisions), Order::bottomFirst);
    EXPECT_EQ(decisions.number("fov", {0, 360}, 180, "usual"), 180);
    EXPECT_EQ(decisions.text("frustum_file", "a.csv", "it lies beside"), "a.csv");
    ASSERT_EQ(decisions.taken().size(), 3U);
    EXPECT_EQ(decisions.taken()[0].key, "row_order");
    EXPECT_EQ(decisions.taken()[0].value, "bottom_first");
    EXPECT_EQ(decisions.taken()[0].evidence, "the format says so");
    EXPECT_FALSE(decisions.taken()[0].isGiven);
    EXPECT_EQ(decisions.taken()[1].value, "180");
}

TEST(Decisions, WhatTheWallFileGivesOverrulesEveryKindOfGuess) {
    Decisions decisions(json{{"row_order", "top_first"}, {"fov", 170.5}, {"frustum_file", "b.csv"}});
    EXPECT_EQ(rowOrder(decisions), Order::topFirst);
    EXPECT_EQ(decisions.number("fov", {0, 360}, 180, "usual"), 170.5);
    EXPECT_EQ(decisions.text("frustum_file", "a.csv", "it lies beside"), "b.csv");
    for (const Assumption& a : decisions.taken()) EXPECT_TRUE(a.isGiven) << a.key;
    EXPECT_EQ(decisions.taken()[1].value, "170.5");
    EXPECT_EQ(complaint([&] { decisions.refuseUnusedKeys(); }), "");
}

TEST(Decisions, WrongValuesNameTheKeyAndTheOptions) {
    const json given{{"row_order", "sideways"}, {"fov", 400}, {"frustum_file", 7}};
    Decisions decisions(given, "displays[0].calibration.assume");
    EXPECT_EQ(complaint([&] { rowOrder(decisions); }),
              "displays[0].calibration.assume.row_order: expected one of bottom_first, top_first, found "
              "\"sideways\"");
    EXPECT_THAT(complaint([&] { decisions.number("fov", {0, 360}, 180, ""); }), HasSubstr("assume.fov"));
    EXPECT_THAT(complaint([&] { decisions.text("frustum_file", "", ""); }), HasSubstr("a string"));
}

TEST(Decisions, KeysThatNothingAskedForAreRefusedWithThoseThatWere) {
    Decisions decisions(json{{"row_odour", "top_first"}});
    rowOrder(decisions);
    EXPECT_THAT(complaint([&] { decisions.refuseUnusedKeys(); }),
                testing::AllOf(HasSubstr("row_order"), HasSubstr("\"row_odour\"")));
    EXPECT_THAT(complaint([&] {
                    Decisions(json{{"any", 1}}).refuseUnusedKeys();
                }),
                HasSubstr("leaves nothing open"));
}

TEST(Decisions, ACopyGoesOnForOneDisplayAndTellsTheOthersWhatItAsked) {
    Decisions file(json{{"fov", 90}});
    rowOrder(file);
    Decisions display = file;
    display.number("fov", {0, 360}, 180, "usual");
    display.warn("here");
    display.warn("here");
    EXPECT_EQ(display.taken().size(), 2U);
    EXPECT_EQ(display.warnings(), std::vector<std::string>{"here"});
    EXPECT_EQ(file.taken().size(), 1U);
    EXPECT_TRUE(file.warnings().empty());
    EXPECT_EQ(complaint([&] { file.refuseUnusedKeys(); }), "");
}

TEST(Decisions, OfManyWarningsTheLastOneCountsTheRest) {
    Decisions decisions;
    for (int i = 0; i < 100; ++i) decisions.warn("line " + std::to_string(i));
    EXPECT_EQ(decisions.warnings().size(), 100U);
    EXPECT_EQ(decisions.warnings().back(), "line 99");
    for (int i = 100; i < 5000; ++i) decisions.warn("line " + std::to_string(i));
    ASSERT_EQ(decisions.warnings().size(), 101U);
    EXPECT_EQ(decisions.warnings()[99], "line 99");
    EXPECT_EQ(decisions.warnings().back(), "and 4900 more");
}

TEST(Decisions, OfOneKeyTheLaterDecisionIsListed) {
    Decisions decisions;
    decisions.number("fov", {0, 360}, 180, "first");
    decisions.number("fov", {0, 360}, 170, "second");
    ASSERT_EQ(decisions.taken().size(), 1U);
    EXPECT_EQ(decisions.taken()[0].value, "170");
}

}  // namespace
}  // namespace curvewall
