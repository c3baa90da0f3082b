#include "server/answer.h"

#include <nlohmann/json.hpp>

namespace curvewall {
namespace {

std::string_view titleOf(unsigned status) {
    switch (status) {
        case 400:
            return "Bad Request";
        case 401:
            return "Unauthorized";
        case 404:
            return "Not Found";
        case 405:
            return "Method Not Allowed";
        case 408:
            return "Request Timeout";
        case 413:
            return "Content Too Large";
        case 415:
            return "Unsupported Media Type";
        case 422:
            return "Unprocessable Content";
        case 431:
            return "Request Header Fields Too Large";
        case 503:
            return "Service Unavailable";
        case 505:
            return "HTTP Version Not Supported";
        default:
            return "Internal Server Error";
    }
}

}  // namespace

Answer problem(unsigned status, std::string_view detail) {
    const nlohmann::ordered_json body{
        {"type", "about:blank"}, {"title", titleOf(status)}, {"status", status}, {"detail", detail}};
    // A detail may quote bytes of the client's that are not UTF-8.
    return {status,
            "application/problem+json",
            body.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n",
            {}};
}

}  // namespace curvewall
