#pragma once
// Curves in a plane of two measures, drawn by gnuplot.

#include <glm/vec2.hpp>

#include <string>
#include <vector>

namespace curvewall {

struct Curve {
    std::string name;
    std::vector<glm::dvec2> points;  // in the order of their line; those off a logarithmic axis are left out
    bool connected = true;
};

struct Plot {
    std::string title, xLabel, yLabel;
    bool logarithmicX = true, logarithmicY = true;
    std::vector<Curve> curves;        // each keeps its colour and mark from plot to plot by its name
    std::vector<glm::dvec2> front{};  // of Pareto, drawn as steps below everything
};

// The points that no other point is below or left of: those worth choosing where less is better on both axes.
// From left to right.
std::vector<glm::dvec2> paretoFront(std::vector<glm::dvec2> points);

// PNG or SVG by the path's extension. Throws std::runtime_error where gnuplot is not there or fails.
void drawPlot(const Plot& plot, const std::string& path);

}  // namespace curvewall
