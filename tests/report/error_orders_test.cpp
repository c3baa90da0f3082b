#include "report/error_orders.h"

#include "tests/report/made_up_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace curvewall {
namespace {

ErrorOrder find(const std::vector<ErrorOrder>& orders, const std::string& curve, const std::string& error) {
    const auto found = std::ranges::find_if(
        orders, [&](const ErrorOrder& order) { return order.curve == curve && order.error == error; });
    return found == orders.end() ? ErrorOrder{} : *found;
}

TEST(ErrorOrders, AreTheExponentsOfTheFormulas) {
    const std::vector<ErrorOrder> orders = errorOrders(test::madeUpReport().views[0]);
    for (const char* error : {"geometric, largest", "geometric, 99 in 100"}) {
        const ErrorOrder pieces = find(orders, "piecewise", error);
        EXPECT_NEAR(pieces.order, 1, 1e-9);
        EXPECT_EQ(pieces.expected, 1);
        EXPECT_EQ(pieces.points, 6);
        const ErrorOrder faces = find(orders, "image-based, cube, linear", error);
        EXPECT_NEAR(faces.order, -1, 1e-9);
        EXPECT_EQ(faces.expected, -1);
        const ErrorOrder edges = find(orders, "vertex-warp", error);
        EXPECT_NEAR(edges.order, 2, 1e-9);
        EXPECT_EQ(edges.expected, 2);
    }
}

TEST(ErrorOrders, OfWrongEdgesLeaveOutTheFloor) {
    ViewReport view = test::madeUpReport().views[0];
    view.floors[0].edgesOff = 0.01;
    for (SettingResult& result : view.settings) {
        result.edges.emplace();
        result.edges->shareOff = 0.01 + 0.2 * result.setting.value * result.setting.value;
    }
    const ErrorOrder order = find(errorOrders(view), "piecewise", "wrong edges");
    EXPECT_NEAR(order.order, 2, 1e-9);
    EXPECT_EQ(order.points, 5);  // at 0.05 px hardly anything lies above the floor
}

TEST(ErrorOrders, LeaveOutPointsAtTheFloor) {
    ViewReport view = test::madeUpReport().views[0];
    for (SettingResult& result : view.settings)
        if (result.setting.method == "piecewise" && result.setting.value < 0.3) {
            result.errors.geometric.maxPx = 0.001;
        }
    const std::vector<ErrorOrder> orders = errorOrders(view);
    EXPECT_EQ(find(orders, "piecewise", "geometric, largest").points, 3);
    EXPECT_NEAR(find(orders, "piecewise", "geometric, largest").order, 1, 1e-9);
}

TEST(ErrorOrders, NeedTwoValuesOfAKnob) {
    ViewReport view;
    view.settings = {test::madeUpSetting("piecewise", "", "tolerance_px", 1, 1, 50),
                     test::madeUpSetting("piecewise", "", "tolerance_px", 1, 2, 50),
                     test::madeUpSetting("reference", "", "samples", 1, 1, 50),
                     test::madeUpSetting("reference", "", "samples", 2, 2, 50)};
    EXPECT_TRUE(errorOrders(view).empty());
    SettingResult refused;
    refused.setting = {"piecewise", "", "tolerance_px", 2, 1};
    refused.refusal = "no";
    view.settings.push_back(refused);
    EXPECT_TRUE(errorOrders(view).empty());
}

}  // namespace
}  // namespace curvewall
