#pragma once
// The calls of the network interface (docs/http.md), free of sockets.

#include "server/answer.h"
#include "server/fit_queue.h"
#include "server/library.h"

#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>

namespace curvewall {

class HttpApi {
public:
    struct Settings {
        std::string token;  // empty: none is asked for
        uint64_t maxSamplesPerFrame = uint64_t{1} << 27;
    };

    // Keeps references to the library and the queue.
    HttpApi(const Library& library, FitQueue& queue, Settings settings);

    // What can be refused without seeing the body.
    std::optional<Answer> refuseHead(const Call& call) const;

    // Replies once, from any thread and possibly before it returns. Does not throw.
    void answer(const Call& call, std::stop_token abandoned, Reply reply) const;

private:
    bool isAuthorized(const Call& call) const;
    void render(const Call& call, std::stop_token abandoned, Reply reply) const;

    const Library& library_;
    FitQueue& queue_;
    const Settings settings_;
};

}  // namespace curvewall
