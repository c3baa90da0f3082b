#pragma once
// POST /v1/render as pure functions: a JSON body to a render call, an outcome to an answer.

#include "server/answer.h"
#include "server/library.h"
#include "server/render_call.h"
#include "server/render_queue.h"

#include <cstdint>
#include <stdexcept>
#include <string_view>

namespace curvewall {

// The body is not what the call takes: not JSON, a key unknown or missing, a value of the wrong type. 400.
class MalformedRequest : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// Throws MalformedRequest, or UsageError for what is well formed and impossible. `maxSamplesPerFrame` bounds
// what one client can cost the others: the rays, pixels or cube texels of a frame times its samples.
RenderCall decodeRenderCall(std::string_view body, const Library& library, uint64_t maxSamplesPerFrame);

Answer answerTo(RenderOutcome outcome);

// From within a catch block: what the exception in flight means to the client.
Answer answerToCurrentException();

}  // namespace curvewall
