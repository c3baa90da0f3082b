#pragma once
// How curves look: colours that colour-blind people tell apart, and a mark for each as well.

#include <string>
#include <vector>

namespace curvewall {

struct CurveStyle {
    std::string color;  // "#0072b2"
    int mark = 0;       // point type of gnuplot

    bool operator==(const CurveStyle&) const = default;
};

// One for each name. The methods' curves have their own, whatever is drawn beside them; others get what is
// left, in their order.
std::vector<CurveStyle> curveStyles(const std::vector<std::string>& names);

}  // namespace curvewall
