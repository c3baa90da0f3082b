#include "report/axis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace curvewall {
namespace {

constexpr double kRoom = 0.07;  // of the range, on either side
constexpr int kFewestNumbers = 3;
constexpr int kMostNumbers = 8;

std::pair<double, double> rangeOf(const std::vector<double>& values) {
    const auto [least, most] = std::ranges::minmax(values);
    return {least, most};
}

// Multiples of 1, 2 or 5 times a power of ten.
std::vector<double> evenNumbers(double least, double most) {
    const double largest = (most - least) / 4;
    const double power = std::pow(10, std::floor(std::log10(largest)));
    double step = power;
    for (const double factor : {2.0, 5.0})
        if (factor * power <= largest) step = factor * power;
    std::vector<double> numbers;
    // Adding 0 makes +0 of -0, which would be written so.
    for (double k = std::ceil(least / step); k * step <= most; ++k) numbers.push_back(k * step + 0.0);
    return numbers;
}

std::vector<double> multiplesOfPowers(double least, double most, const std::vector<int>& factors) {
    std::vector<double> numbers;
    for (int power = static_cast<int>(std::floor(std::log10(least))); std::pow(10, power) <= most; ++power)
        for (const int factor : factors) {
            // Dividing by an exact power is rounded once: 0.3 rather than 0.30000000000000004.
            const double number = power < 0 ? factor / std::pow(10, -power) : factor * std::pow(10, power);
            if (number >= least && number <= most) numbers.push_back(number);
        }
    return numbers;
}

}  // namespace

Axis logarithmicAxis(const std::vector<double>& values) {
    Axis axis;
    if (!values.empty()) {
        const auto [least, most] = rangeOf(values);
        const double room = std::pow(std::max(most / least, 2.0), kRoom);
        axis.least = least / room;
        axis.most = most * room;
    }
    axis.ticks = multiplesOfPowers(axis.least, axis.most, {1, 2, 3, 4, 5, 6, 7, 8, 9});
    static const std::array<std::vector<int>, 4> kFactors{
        {{1, 2, 3, 4, 5, 6, 7, 8, 9}, {1, 2, 3, 5, 7}, {1, 2, 5}, {1, 3}}};
    for (const std::vector<int>& factors : kFactors) {
        axis.numbers = multiplesOfPowers(axis.least, axis.most, factors);
        if (axis.numbers.size() <= kMostNumbers) break;
    }
    if (axis.numbers.size() > kMostNumbers) axis.numbers = multiplesOfPowers(axis.least, axis.most, {1});
    if (axis.numbers.size() < kFewestNumbers) axis.numbers = evenNumbers(axis.least, axis.most);
    return axis;
}

Axis linearAxis(const std::vector<double>& values) {
    Axis axis{0, 1, {}, {}};
    if (!values.empty()) {
        const auto [least, most] = rangeOf(values);
        const double room = most > least ? kRoom * (most - least) : std::max(0.1 * std::abs(most), 0.1);
        axis.least = least - room;
        axis.most = most + room;
    }
    axis.numbers = evenNumbers(axis.least, axis.most);
    return axis;
}

}  // namespace curvewall
