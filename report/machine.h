#pragma once
// What measured: times mean nothing without it.

#include <string>

namespace curvewall {

// "NAME of the processor, N threads".
std::string processorName();

struct GlDriver {
    std::string renderer, version;  // GL_RENDERER, GL_VERSION
};

// Throws GlUnavailable. No context may be current on the thread, for it makes one of its own.
GlDriver glDriver();

}  // namespace curvewall
