#pragma once
// Results as CSV on standard output: part,case,quantity,value.

#include "renderer/stats.h"

#include <string>
#include <string_view>

namespace curvewall {

struct Row {
    std::string part, name;  // what is measured, and of which case
};

void printHeader();
void print(const Row& row, std::string_view quantity, double value);
void print(const Row& row, std::string_view quantity, std::string_view text);

// Times, counts and memory of a render.
void print(const Row& row, const RenderStats& stats);

}  // namespace curvewall
