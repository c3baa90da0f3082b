#pragma once
// What a client asks and what it gets, free of sockets.

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace curvewall {

struct Call {
    std::string method;
    std::string target;
    std::string contentType;    // empty: not given
    std::string authorization;  // empty: not given
    std::string body;
};

struct Answer {
    unsigned status = 200;
    std::string contentType;
    std::string body;
    std::vector<std::pair<std::string, std::string>> headers;  // beyond type and length
};

using Reply = std::function<void(Answer)>;

// RFC 7807.
Answer problem(unsigned status, std::string_view detail);

}  // namespace curvewall
