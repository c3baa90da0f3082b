#pragma once
// How far a long measurement is.

#include <cstddef>
#include <functional>
#include <string>

namespace curvewall {

struct Progress {
    size_t done = 0, all = 0;  // steps
    double leftMs = 0;         // as steps of the same kind took so far
    std::string doing;
};

// Called before every step.
using OnProgress = std::function<void(const Progress&)>;

}  // namespace curvewall
