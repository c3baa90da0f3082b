#include "report/plot.h"

#include "report/axis.h"
#include "report/curve_style.h"
#include "report/gnuplot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <pugixml.hpp>
#include <sstream>
#include <stdexcept>

namespace curvewall {
namespace {

// As on a phone held upright, whose page is about 360 px wide: letters of 16 of 500 are 11 px there.
constexpr int kLayoutWidthPx = 500;
constexpr int kLayoutHeightPx = 450;  // without the legend
constexpr int kFontPx = 16;
constexpr int kLegendRowPx = 22;
constexpr int kLegendMarkPx = 62;
constexpr double kLetterPx = 0.56 * kFontPx;  // of the usual fonts, on average

bool isOnAxis(double value, bool logarithmic) { return std::isfinite(value) && (!logarithmic || value > 0); }

std::vector<glm::dvec2> visiblePoints(const Plot& plot, std::vector<glm::dvec2> points) {
    std::erase_if(points, [&](glm::dvec2 point) { return !isVisible(plot, point); });
    return points;
}

// The same numbers make marks and lines of text of other sizes in other terminals.
struct Terminal {
    std::string options;
    double markSize, lineSpacing;
};

struct Axes {
    Axis x, y;
};

Axes axesOf(const Plot& plot) {
    std::vector<double> xs, ys;
    const auto add = [&](const std::vector<glm::dvec2>& points) {
        for (const glm::dvec2 point : visiblePoints(plot, points)) {
            xs.push_back(point.x);
            ys.push_back(point.y);
        }
    };
    for (const Curve& curve : plot.curves) add(curve.points);
    add(plot.front);
    for (const Level& level : plot.levels)
        if (isOnAxis(level.y, plot.logarithmicY)) ys.push_back(level.y);
    return {plot.logarithmicX ? logarithmicAxis(xs) : linearAxis(xs),
            plot.logarithmicY ? logarithmicAxis(ys) : linearAxis(ys)};
}

int legendColumns(const Plot& plot) {
    size_t longest = 1;
    for (const Curve& curve : plot.curves) longest = std::max(longest, curve.name.size());
    for (const Level& level : plot.levels) longest = std::max(longest, level.name.size());
    const double columnPx = kLegendMarkPx + kLetterPx * static_cast<double>(longest);
    return std::clamp(static_cast<int>(kLayoutWidthPx / columnPx), 1, 3);
}

int layoutHeightPx(const Plot& plot) {
    const int names = static_cast<int>(plot.curves.size() + plot.levels.size());
    const int columns = legendColumns(plot);
    return kLayoutHeightPx + kLegendRowPx * ((names + columns - 1) / columns);
}

void writePoints(std::ostream& out, const std::string& name, const std::vector<glm::dvec2>& points) {
    out << "$" << name << " << EOD\n";
    for (const glm::dvec2 point : points) out << fmt::format("{} {}\n", point.x, point.y);
    out << "EOD\n";
}

void writeAxis(std::ostream& out, char name, const Axis& axis, bool logarithmic, const std::string& label) {
    if (logarithmic) out << "set logscale " << name << "\n";
    out << fmt::format("set {}range [{}:{}]\nset {}label {} offset 0,0.2\nset {}tics (", name, axis.least,
                       axis.most, name, gnuplotQuoted(label), name);
    for (size_t i = 0; i < axis.numbers.size(); ++i)
        out << fmt::format("{}'{:.4g}' {}", i == 0 ? "" : ", ", axis.numbers[i], axis.numbers[i]);
    for (size_t i = 0; i < axis.ticks.size(); ++i)
        out << fmt::format("{}'' {} 1", i == 0 && axis.numbers.empty() ? "" : ", ", axis.ticks[i]);
    out << ")\n";
}

// From the border that is worst to the one that is slowest, so that what the front bounds is an area.
std::vector<glm::dvec2> extendedFront(const Plot& plot, const Axes& axes) {
    std::vector<glm::dvec2> front = visiblePoints(plot, plot.front);
    if (front.empty()) return front;
    front.insert(front.begin(), {front.front().x, plot.moreIsBetterY ? axes.y.least : axes.y.most});
    front.emplace_back(axes.x.most, front.back().y);
    return front;
}

// After the curves, which svgOf counts.
void writeLevels(std::ostream& out, const Plot& plot) {
    for (const Level& level : plot.levels)
        if (isOnAxis(level.y, plot.logarithmicY))
            out << fmt::format(", {} with lines linewidth 1.5 dashtype 2 linecolor rgb '#808080' title {}",
                               level.y, gnuplotQuoted(level.name));
}

void writeCurves(std::ostream& out, const Plot& plot, const Axes& axes, double markSize) {
    const std::vector<glm::dvec2> front = extendedFront(plot, axes);
    std::vector<std::string> names;
    for (const Curve& curve : plot.curves) names.push_back(curve.name);
    const std::vector<CurveStyle> styles = curveStyles(names);
    writePoints(out, "front", front);
    for (size_t i = 0; i < plot.curves.size(); ++i)
        writePoints(out, fmt::format("curve{}", i), visiblePoints(plot, plot.curves[i].points));
    // What is not there is drawn all the same, for its legend and for a plot that has nothing else.
    out << (front.empty() ? "plot NaN notitle"
                          : "plot $front with steps linewidth 7 linecolor rgb '#90808080' notitle");
    for (size_t i = 0; i < plot.curves.size(); ++i) {
        const bool isEmpty = visiblePoints(plot, plot.curves[i].points).empty();
        out << fmt::format(
            ", {} with linespoints linewidth 2 linecolor rgb '{}' pointtype {} pointsize {} title {}",
            isEmpty ? "NaN" : fmt::format("$curve{} using 1:2", i), styles[i].color, styles[i].mark, markSize,
            gnuplotQuoted(names[i]));
    }
    writeLevels(out, plot);
    out << "\n";
}

std::string scriptOf(const Plot& plot, const Terminal& terminal) {
    const Axes axes = axesOf(plot);
    std::ostringstream out;
    out << "set encoding utf8\nset terminal " << terminal.options << "\n"
        << "set border 3 linecolor rgb '#808080'\nset tics nomirror\n"
        << "set grid linecolor rgb '#909090' linewidth 0.5 dashtype 3\n"
        << "set title " << gnuplotQuoted(plot.title) << "\n"
        << "set key below left Left reverse horizontal samplen 2 spacing " << terminal.lineSpacing
        << " maxcols " << legendColumns(plot) << "\n";
    writeAxis(out, 'x', axes.x, plot.logarithmicX, plot.xLabel);
    writeAxis(out, 'y', axes.y, plot.logarithmicY, plot.yLabel);
    writeCurves(out, plot, axes, terminal.markSize);
    return out.str();
}

void prefixIds(pugi::xml_node node, const std::string& prefix) {
    for (pugi::xml_attribute attribute : node.attributes()) {
        const std::string name = attribute.name(), value = attribute.value();
        if (name == "id") attribute = (prefix + value).c_str();
        if (name == "xlink:href" && value.starts_with('#'))
            attribute = ("#" + prefix + value.substr(1)).c_str();
        // The terminal writes black for what has no colour of its own.
        if (value == "black") attribute = "currentColor";
    }
    for (pugi::xml_node child : node.children()) prefixIds(child, prefix);
}

void setTitle(pugi::xml_node node, const std::string& text) {
    node.remove_child("title");
    node.prepend_child("title").text() = text.c_str();
}

std::string labelOf(const Curve& curve, size_t point) {
    if (point < curve.labels.size()) return curve.labels[point];
    return fmt::format("{}: {:.4g}, {:.4g}", curve.name, curve.points[point].x, curve.points[point].y);
}

// gnuplot writes the marks of a curve in the order of its points, then that of its legend.
void labelPoints(pugi::xml_node group, const Plot& plot, const Curve& curve) {
    std::vector<pugi::xml_node> marks;
    for (const pugi::xpath_node& mark : group.select_nodes(".//use")) marks.push_back(mark.node());
    size_t next = 0;
    for (size_t i = 0; i < curve.points.size(); ++i)
        if (isVisible(plot, curve.points[i]) && next < marks.size())
            setTitle(marks[next++], labelOf(curve, i));
}

}  // namespace

bool isVisible(const Plot& plot, glm::dvec2 point) {
    return isOnAxis(point.x, plot.logarithmicX) && isOnAxis(point.y, plot.logarithmicY);
}

std::vector<glm::dvec2> paretoFront(std::vector<glm::dvec2> points, bool moreIsBetterY) {
    std::erase_if(points, [](glm::dvec2 p) { return std::isnan(p.x) || std::isnan(p.y); });
    const auto isBetterY = [&](double a, double b) { return moreIsBetterY ? a > b : a < b; };
    std::ranges::sort(
        points, [&](glm::dvec2 a, glm::dvec2 b) { return a.x != b.x ? a.x < b.x : isBetterY(a.y, b.y); });
    std::vector<glm::dvec2> front;
    for (const glm::dvec2 point : points)
        if (front.empty() || isBetterY(point.y, front.back().y)) front.push_back(point);
    return front;
}

std::string pngOf(const Plot& plot) {
    constexpr double kScale = static_cast<double>(kPlotWidthPx) / kLayoutWidthPx;
    const int heightPx = static_cast<int>(std::lround(kScale * layoutHeightPx(plot)));
    const std::string options =
        fmt::format("pngcairo noenhanced size {},{} font 'sans,{}' fontscale {} linewidth {} pointscale {}",
                    kPlotWidthPx, heightPx, kFontPx * 3 / 4, kScale, kScale, kScale);
    return gnuplotOutput(scriptOf(plot, {options, 1.1, 1.2}));
}

std::string svgOf(const Plot& plot, const std::string& idPrefix) {
    const std::string options = fmt::format("svg noenhanced dynamic size {},{} font 'sans-serif,{}' name 'p'",
                                            kLayoutWidthPx, layoutHeightPx(plot), kFontPx);
    const std::string drawn = gnuplotOutput(scriptOf(plot, {options, 0.8, 0.85}));
    pugi::xml_document document;
    if (!document.load_string(drawn.c_str(), pugi::parse_default | pugi::parse_ws_pcdata_single))
        throw std::runtime_error("gnuplot wrote an SVG file that is none");
    pugi::xml_node svg = document.child("svg");
    svg.remove_child("desc");
    setTitle(svg, plot.title);
    svg.append_attribute("role") = "img";
    // Group 1 is the front.
    for (size_t i = 0; i < plot.curves.size(); ++i) {
        const std::string id = fmt::format("p_plot_{}", i + 2);
        pugi::xml_node group =
            svg.find_node([&](pugi::xml_node n) { return n.attribute("id").value() == id; });
        if (!group) continue;
        setTitle(group, plot.curves[i].name);
        labelPoints(group, plot, plot.curves[i]);
    }
    prefixIds(svg, idPrefix);
    std::ostringstream out;
    document.save(out, "", pugi::format_raw);
    return out.str();
}

}  // namespace curvewall
