#include "calibration/projections/polynomial.h"

#include <algorithm>
#include <cmath>

namespace curvewall {
namespace {

// The sign changes exactly once between the two.
double rootBetween(const Polynomial& p, double low, double high) {
    const bool lowIsNegative = std::signbit(valueOf(p, low));
    for (;;) {
        const double middle = 0.5 * (low + high);
        if (!(middle > low && middle < high)) return middle;
        (std::signbit(valueOf(p, middle)) == lowIsNegative ? low : high) = middle;
    }
}

}  // namespace

double valueOf(const Polynomial& p, double t) {
    double sum = 0;
    for (auto coefficient = p.rbegin(); coefficient != p.rend(); ++coefficient) sum = sum * t + *coefficient;
    return sum;
}

Polynomial derivativeOf(const Polynomial& p) {
    Polynomial slope;
    for (size_t i = 1; i < p.size(); ++i) slope.push_back(static_cast<double>(i) * p[i]);
    return slope;
}

Polynomial operator+(const Polynomial& a, const Polynomial& b) {
    Polynomial sum(std::max(a.size(), b.size()), 0.0);
    for (size_t i = 0; i < a.size(); ++i) sum[i] += a[i];
    for (size_t i = 0; i < b.size(); ++i) sum[i] += b[i];
    return sum;
}

Polynomial operator-(const Polynomial& a, const Polynomial& b) { return a + Polynomial{-1} * b; }

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
    Polynomial product(a.size() + b.size(), 0.0);
    for (size_t i = 0; i < a.size(); ++i)
        for (size_t j = 0; j < b.size(); ++j) product[i + j] += a[i] * b[j];
    return product;
}

std::vector<double> rootsWithin(const Polynomial& p, double low, double high) {
    Polynomial trimmed = p;
    while (!trimmed.empty() && trimmed.back() == 0) trimmed.pop_back();
    if (trimmed.size() < 2) return {};
    // Between two turning points there is one root at most.
    std::vector<double> ends = rootsWithin(derivativeOf(trimmed), low, high);
    ends.push_back(high);
    std::vector<double> roots;
    for (const double end : ends) {
        const double atLow = valueOf(trimmed, low), atEnd = valueOf(trimmed, end);
        if (end > low && atEnd == 0) {
            roots.push_back(end);
        } else if (atLow != 0 && std::signbit(atLow) != std::signbit(atEnd)) {
            roots.push_back(rootBetween(trimmed, low, end));
        }
        low = end;
    }
    return roots;
}

}  // namespace curvewall
