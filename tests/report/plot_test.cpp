#include "report/plot.h"

#include "renderer/image_file.h"
#include "report/text_file.h"
#include "tests/support/random_numbers.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <pugixml.hpp>
#include <set>

namespace curvewall {
namespace {

using ::testing::HasSubstr;

constexpr const char* kHostileName = "it's \\ \"q\" @{}_^ $x `ls` %d \\\nnext <b>&amp; \\";

Plot threeCurves() {
    Plot plot{"time against error", "ms", "px"};
    plot.curves = {{"piecewise", {{10, 1}, {20, 0.5}, {40, 0.25}}},
                   {"image-based, cube, linear", {{30, 2}, {60, 1}}},
                   {"mine", {{5, 7}}}};
    return plot;
}

std::vector<std::string> titlesOfMarks(const std::string& svg) {
    pugi::xml_document document;
    EXPECT_TRUE(document.load_string(svg.c_str()));
    std::vector<std::string> titles;
    for (const pugi::xpath_node& title : document.select_nodes("//use/title"))
        titles.emplace_back(title.node().text().get());
    return titles;
}

TEST(ParetoFront, IsWhatNoOtherPointBeats) {
    test::Random random(1);
    for (int round = 0; round < 200; ++round) {
        std::vector<glm::dvec2> points(1 + static_cast<size_t>(random.uniform(0, 30)));
        // Few places, so that points coincide and lie beside each other.
        for (glm::dvec2& p : points) p = glm::floor(random.pixel({8, 8}));
        for (const bool more : {false, true}) {
            const auto beats = [&](glm::dvec2 a, glm::dvec2 b) {
                return a != b && a.x <= b.x && (more ? a.y >= b.y : a.y <= b.y);
            };
            std::set<std::pair<double, double>> expected, found;
            for (const glm::dvec2 p : points)
                if (std::ranges::none_of(points, [&](glm::dvec2 q) { return beats(q, p); }))
                    expected.emplace(p.x, p.y);
            const std::vector<glm::dvec2> front = paretoFront(points, more);
            for (const glm::dvec2 p : front) found.emplace(p.x, p.y);
            EXPECT_EQ(found, expected);
            EXPECT_EQ(front.size(), found.size());
            EXPECT_TRUE(std::ranges::is_sorted(front, {}, &glm::dvec2::x));
        }
    }
}

TEST(ParetoFront, LeavesOutWhatIsNoNumber) {
    const double nan = std::nan("");
    EXPECT_TRUE(paretoFront({}).empty());
    EXPECT_EQ(paretoFront({{nan, 0}, {1, nan}, {2, 3}}), (std::vector<glm::dvec2>{{2, 3}}));
}

class PlotPng : public ::testing::Test {
protected:
    Frame png(const Plot& plot) const {
        writeTextFile(folder_.path("plot.png"), pngOf(plot));
        return readFrame(folder_.path("plot.png"));
    }
    test::TemporaryFolder folder_;
};

TEST_F(PlotPng, IsHigherWithALongerLegend) {
    Plot longer = threeCurves();
    for (int i = 0; i < 9; ++i) longer.curves.push_back({"another " + std::to_string(i), {{20, 1}}});
    const Frame few = png(threeCurves()), many = png(longer);
    EXPECT_EQ(few.sizePx.x, kPlotWidthPx);
    EXPECT_EQ(many.sizePx.x, kPlotWidthPx);
    EXPECT_GT(many.sizePx.y, few.sizePx.y);
}

TEST_F(PlotPng, ShowsTheData) {
    Plot other = threeCurves();
    EXPECT_EQ(png(threeCurves()).texels, png(other).texels);
    other.curves[1].points[0].y = 1.5;
    EXPECT_NE(png(threeCurves()).texels, png(other).texels);
}

TEST_F(PlotPng, ShowsFrontAndLevels) {
    Plot other = threeCurves();
    const Frame plain = png(other);
    other.front = {{10, 1}, {20, 0.5}};
    const Frame withFront = png(other);
    EXPECT_NE(plain.texels, withFront.texels);
    other.levels = {{"tolerance", 0.5}};
    EXPECT_NE(withFront.texels, png(other).texels);
}

TEST(PlotSvg, HasAMarkForEveryPointThatSaysWhatItIs) {
    Plot plot = threeCurves();
    plot.curves[1].labels = {"faces of 512 px", "faces of 1024 px"};
    EXPECT_THAT(titlesOfMarks(svgOf(plot, "a")),
                ::testing::ElementsAre("piecewise: 10, 1", "piecewise: 20, 0.5", "piecewise: 40, 0.25",
                                       "faces of 512 px", "faces of 1024 px", "mine: 5, 7"));
}

TEST(PlotSvg, MarksLieWhereTheirPointsAre) {
    Plot plot{"", "", "", false, false, {{"line", {{0, 0}, {1, 1}, {3, 2}}}}};
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(svgOf(plot, "a").c_str()));
    std::vector<glm::dvec2> places;
    for (const pugi::xpath_node& mark : document.select_nodes("//use[title]")) {
        glm::dvec2 place;
        ASSERT_EQ(
            std::sscanf(mark.node().attribute("transform").value(), "translate(%lf,%lf)", &place.x, &place.y),
            2);
        places.push_back(place);
    }
    ASSERT_EQ(places.size(), 3u);
    EXPECT_NEAR((places[2].x - places[0].x) / (places[1].x - places[0].x), 3, 0.01);
    EXPECT_NEAR((places[2].y - places[0].y) / (places[1].y - places[0].y), 2, 0.01);
    EXPECT_LT(places[1].y, places[0].y);
}

TEST(PlotSvg, WhatIsOffALogarithmicAxisIsLeftOut) {
    const double infinity = std::numeric_limits<double>::infinity();
    Plot plot = threeCurves();
    plot.curves[0].points = {{10, 0}, {20, infinity}, {std::nan(""), 1}, {-1, 1}, {40, 0.25}};
    plot.curves[2].points.clear();
    plot.front = {{1, 0}, {2, infinity}};
    plot.levels = {{"nothing", 0}};
    EXPECT_THAT(titlesOfMarks(svgOf(plot, "a")),
                ::testing::ElementsAre("piecewise: 40, 0.25", "image-based, cube, linear: 30, 2",
                                       "image-based, cube, linear: 60, 1"));
}

TEST(PlotSvg, NothingAtAllCanBeDrawn) { EXPECT_TRUE(titlesOfMarks(svgOf({}, "a")).empty()); }

TEST(PlotSvg, IdsAreOfThePictureAlone) {
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(svgOf(threeCurves(), "seventh").c_str()));
    std::set<std::string> ids;
    for (const pugi::xpath_node& found : document.select_nodes("//*[@id]")) {
        const std::string id = found.node().attribute("id").value();
        EXPECT_TRUE(id.starts_with("seventh")) << id;
        EXPECT_TRUE(ids.insert("#" + id).second) << id;
    }
    for (const pugi::xpath_node& use : document.select_nodes("//use"))
        EXPECT_TRUE(ids.contains(use.node().attribute("xlink:href").value()));
}

TEST(PlotSvg, NamesAreTakenLiterally) {
    Plot plot = threeCurves();
    plot.title = plot.xLabel = plot.yLabel = plot.curves[0].name = plot.curves[2].name = kHostileName;
    plot.levels = {{kHostileName, 1}};
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(svgOf(plot, "a").c_str()));
    std::string expected = kHostileName;
    std::ranges::replace(expected, '\n', ' ');
    int times = 0;
    for (const pugi::xpath_node& text : document.select_nodes("//text"))
        times += text.node().text().get() == expected;
    EXPECT_EQ(times, 6);
}

TEST(PlotSvg, CurvesKeepTheirColourAndMark) {
    const auto colorOf = [](const Plot& plot, const std::string& label) {
        pugi::xml_document document;
        document.load_string(svgOf(plot, "a").c_str());
        const pugi::xml_node mark = document.select_node(("//use[title='" + label + "']").c_str()).node();
        return std::string(mark.attribute("color").value()) + mark.attribute("xlink:href").value();
    };
    Plot alone = threeCurves();
    std::swap(alone.curves[0], alone.curves[1]);
    alone.curves.erase(alone.curves.begin() + 2);
    EXPECT_EQ(colorOf(threeCurves(), "piecewise: 10, 1"), colorOf(alone, "piecewise: 10, 1"));
    EXPECT_NE(colorOf(alone, "piecewise: 10, 1"), colorOf(alone, "image-based, cube, linear: 30, 2"));
}

TEST(Gnuplot, ThatIsMissingIsNamedWithItsPackage) {
    const std::string path = std::getenv("PATH");
    const test::TemporaryFolder empty;
    setenv("PATH", empty.path().c_str(), 1);
    std::optional<std::string> message;
    try {
        svgOf(threeCurves(), "a");
    } catch (const std::runtime_error& error) {
        message = error.what();
    }
    setenv("PATH", path.c_str(), 1);
    ASSERT_TRUE(message);
    EXPECT_THAT(*message, HasSubstr("gnuplot-nox"));
}

}  // namespace
}  // namespace curvewall
