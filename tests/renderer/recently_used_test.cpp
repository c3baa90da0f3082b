#include "renderer/recently_used.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace curvewall {
namespace {

using ::testing::ElementsAre;

TEST(RecentlyUsed, KeepsTheLastUsedAndMakesTheOthersAgain) {
    RecentlyUsed<int, int> cache(2);
    std::vector<int> made;
    const auto get = [&](int key) {
        return *cache.get(key, [&] {
            made.push_back(key);
            return std::make_shared<int>(10 * key);
        });
    };
    EXPECT_EQ(get(1), 10);
    EXPECT_EQ(get(2), 20);
    EXPECT_EQ(get(1), 10);
    EXPECT_EQ(get(3), 30);  // 2 goes
    EXPECT_EQ(get(1), 10);
    EXPECT_EQ(get(2), 20);  // 3 goes
    EXPECT_EQ(get(1), 10);
    EXPECT_THAT(made, ElementsAre(1, 2, 3, 2));
}

TEST(RecentlyUsed, FindingIsUsingToo) {
    RecentlyUsed<int, int> cache(2);
    const auto put = [&](int key) { cache.get(key, [&] { return std::make_shared<int>(10 * key); }); };
    EXPECT_EQ(cache.find(1), nullptr);
    put(1);
    put(2);
    ASSERT_NE(cache.find(1), nullptr);
    EXPECT_EQ(*cache.find(1), 10);
    put(3);  // 2 goes
    EXPECT_EQ(cache.find(2), nullptr);
    EXPECT_NE(cache.find(1), nullptr);
}

TEST(RecentlyUsed, WhatCannotBeMadeIsTriedAgain) {
    RecentlyUsed<int, int> cache(1);
    EXPECT_THROW(cache.get(1, []() -> std::shared_ptr<int> { throw std::runtime_error("no"); }),
                 std::runtime_error);
    EXPECT_EQ(*cache.get(1, [] { return std::make_shared<int>(7); }), 7);
}

}  // namespace
}  // namespace curvewall
