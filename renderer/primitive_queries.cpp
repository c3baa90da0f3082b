#include "renderer/primitive_queries.h"

namespace curvewall {

void PrimitiveQueries::begin() {
    if (used_ == queries_.size()) {
        GLuint id = 0;
        glGenQueries(1, &id);
        queries_.emplace_back(id);
    }
    glBeginQuery(GL_PRIMITIVES_GENERATED, queries_[used_].id());
    ++used_;
}

void PrimitiveQueries::end() { glEndQuery(GL_PRIMITIVES_GENERATED); }

void PrimitiveQueries::writeLast(const GlBuffer& buffer) const {
    glBindBuffer(GL_QUERY_BUFFER, buffer.id());
    glGetQueryObjectuiv(queries_[used_ - 1].id(), GL_QUERY_RESULT, nullptr);
    glBindBuffer(GL_QUERY_BUFFER, 0);
}

std::vector<uint64_t> PrimitiveQueries::take() {
    std::vector<uint64_t> counts;
    for (size_t i = 0; i < used_; ++i)
        glGetQueryObjectui64v(queries_[i].id(), GL_QUERY_RESULT, &counts.emplace_back());
    used_ = 0;
    return counts;
}

}  // namespace curvewall
