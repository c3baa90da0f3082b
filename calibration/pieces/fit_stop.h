#pragma once
// How a fit that nobody wants any more ends.

#include <exception>
#include <stop_token>

namespace curvewall {

class FitStopped : public std::exception {
public:
    const char* what() const noexcept override { return "the fit was stopped"; }
};

inline void throwIfStopped(const std::stop_token& stop) {
    if (stop.stop_requested()) throw FitStopped();
}

}  // namespace curvewall
