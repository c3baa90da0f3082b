#pragma once
// Curves in a plane of two measures, drawn by gnuplot.

#include <glm/vec2.hpp>

#include <string>
#include <vector>

namespace curvewall {

struct Curve {
    std::string name;
    std::vector<glm::dvec2> points;  // in the order of their line; those off a logarithmic axis are left out
    std::vector<std::string> labels{};  // of the points, shown on pointing at one in SVG; none or as many
};

// A height to compare with, as a dashed line across the plot.
struct Level {
    std::string name;
    double y = 0;
};

struct Plot {
    std::string title, xLabel, yLabel;
    bool logarithmicX = true, logarithmicY = true;
    std::vector<Curve> curves{};      // each keeps its colour and mark from plot to plot by its name
    std::vector<glm::dvec2> front{};  // of Pareto, drawn as steps below everything
    std::vector<Level> levels{};
    bool moreIsBetterY = false;  // the front opens upwards
};

// The points that no other point is below or left of (above or left of, where more is better): those worth
// choosing. From left to right; points that are no numbers are left out.
std::vector<glm::dvec2> paretoFront(std::vector<glm::dvec2> points, bool moreIsBetterY = false);

// Whether the axes have a place for the point: a logarithmic one has none for 0.
bool isVisible(const Plot& plot, glm::dvec2 point);

// Both throw std::runtime_error where gnuplot is not there or fails.

// A PNG file, as high as the plot and its legend need it.
inline constexpr int kPlotWidthPx = 1120;
std::string pngOf(const Plot& plot);

// Without a size of its own. All ids begin with `idPrefix` (letters and digits), so that several pictures fit
// into one page. Lines and texts have the colour of the text around, the paper none.
std::string svgOf(const Plot& plot, const std::string& idPrefix);

}  // namespace curvewall
