#pragma once
// Polynomials of one variable, to find where a lens stops being one-to-one.

#include <vector>

namespace curvewall {

using Polynomial = std::vector<double>;  // the coefficients of 1, t, t^2, ...

double valueOf(const Polynomial& p, double t);
Polynomial derivativeOf(const Polynomial& p);
Polynomial operator+(const Polynomial& a, const Polynomial& b);
Polynomial operator-(const Polynomial& a, const Polynomial& b);
Polynomial operator*(const Polynomial& a, const Polynomial& b);

// The real roots above `low` and up to `high`, in order, each once. Where a polynomial touches zero without
// crossing it, rounding decides whether that counts.
std::vector<double> rootsWithin(const Polynomial& p, double low, double high);

}  // namespace curvewall
