#include "renderer/gl/stage_timer.h"

#include <algorithm>

namespace curvewall {
namespace {

GLuint64 nanosecondsAt(const GlQuery& timestamp) {
    GLuint64 ns = 0;
    glGetQueryObjectui64v(timestamp.id(), GL_QUERY_RESULT, &ns);
    return ns;
}

}  // namespace

void StageTimer::begin(std::string_view stage) {
    if (!isOn_) return;
    if (used_ == marks_.size()) {
        GLuint id = 0;
        glCreateQueries(GL_TIMESTAMP, 1, &id);
        marks_.push_back({{}, GlQuery(id)});
    }
    Mark& mark = marks_[used_++];
    mark.stage = stage;
    // A software renderer takes the times of a batch when it has come through all of it: each has its own.
    glFlush();
    glQueryCounter(mark.timestamp.id(), GL_TIMESTAMP);
    glFlush();
}

std::vector<StageTime> StageTimer::take() {
    std::vector<StageTime> times;
    for (size_t i = 0; i + 1 < used_; ++i) {
        const std::string_view stage = marks_[i].stage;
        if (stage.empty()) continue;
        const double ms =
            static_cast<double>(nanosecondsAt(marks_[i + 1].timestamp) - nanosecondsAt(marks_[i].timestamp)) /
            1e6;
        const auto known = std::ranges::find(times, stage, &StageTime::stage);
        if (known == times.end())
            times.push_back({stage, ms});
        else
            known->ms += ms;
    }
    used_ = 0;
    return times;
}

}  // namespace curvewall
