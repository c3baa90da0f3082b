#pragma once
// What a calibration file leaves open, and what was taken.

#include <string>

namespace curvewall {

struct Assumption {
    std::string key;       // as a wall file's "assume" names it: "row_order"
    std::string value;     // the word or number that was taken: "bottom_first"
    std::string evidence;  // what speaks for it
    bool isGiven = false;  // the wall file says so, and the evidence was not weighed
};

}  // namespace curvewall
