#pragma once
// How long the GPU takes for the stages of a frame, by timestamps that nobody waits for.

#include "renderer/gl/gl_handle.h"

#include <string_view>
#include <vector>

namespace curvewall {

struct StageTime {
    std::string_view stage;
    double ms = 0;
};

class StageTimer {
public:
    // Off at first: on llvmpipe the batches that timestamps need make a frame 5 % longer.
    void turn(bool on) { isOn_ = on; }

    // A stage lasts until the next one begins, or the end. Names must be literals. One that begins several
    // times within a frame is summed up.
    void begin(std::string_view stage);
    void end() { begin({}); }

    // Of everything recorded since it was asked last, in the order of first appearance. Call it after the GPU
    // has finished.
    std::vector<StageTime> take();

private:
    struct Mark {
        std::string_view stage;  // empty: none
        GlQuery timestamp;
    };
    std::vector<Mark> marks_;  // they are used again
    size_t used_ = 0;
    bool isOn_ = false;
};

}  // namespace curvewall
