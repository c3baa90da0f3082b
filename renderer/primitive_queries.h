#pragma once
// Counts what geometry stages bring forth, whether or not there was room for it.

#include "renderer/gl/gl_handle.h"

#include <cstdint>
#include <vector>

namespace curvewall {

class PrimitiveQueries {
public:
    void begin();
    void end();

    // Puts what the query that ended last counts into a buffer, without the CPU waiting for it.
    void writeLast(const GlBuffer& buffer) const;

    // What the queries since the last call counted, in order. Waits for the GPU.
    std::vector<uint64_t> take();

private:
    std::vector<GlQuery> queries_;
    size_t used_ = 0;
};

}  // namespace curvewall
