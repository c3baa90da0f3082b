#pragma once
// The range of an axis and where its numbers stand.

#include <vector>

namespace curvewall {

struct Axis {
    double least = 1, most = 10;
    std::vector<double> numbers;  // that are written
    std::vector<double> ticks;    // that are not
};

// Around values, with some room; of a logarithmic axis they are positive.
Axis logarithmicAxis(const std::vector<double>& values);
Axis linearAxis(const std::vector<double>& values);

}  // namespace curvewall
