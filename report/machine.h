#pragma once
// What measured: times mean nothing without it.

#include <string>

namespace curvewall {

// "NAME of the processor, N threads".
std::string processorName();

}  // namespace curvewall
