#include "server/http_api.h"

#include "server/render_api.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

namespace curvewall {
namespace {

constexpr std::string_view kRenderPath = "/v1/render";
constexpr std::string_view kWallsPath = "/v1/walls";
constexpr std::string_view kScenesPath = "/v1/scenes";
constexpr std::string_view kHealthPath = "/healthz";

// Without the query, and without "http://host" where a client sends the absolute form (RFC 9112, 3.2.2).
std::string_view pathOf(std::string_view target) {
    constexpr std::string_view kScheme = "http://";
    if (target.starts_with(kScheme)) {
        const size_t slash = target.find('/', kScheme.size());
        target = slash == std::string_view::npos ? "/" : target.substr(slash);
    }
    return target.substr(0, target.find('?'));
}

std::string_view allowedMethods(std::string_view path) {
    if (path == kRenderPath) return "POST";
    if (path == kWallsPath || path == kScenesPath || path == kHealthPath) return "GET, HEAD";
    return {};
}

bool isAllowed(std::string_view method, std::string_view allowed) {
    return allowed == "POST" ? method == "POST" : method == "GET" || method == "HEAD";
}

std::string lowerCase(std::string_view text) {
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return lower;
}

bool isJson(std::string_view contentType) {
    std::string_view mediaType = contentType.substr(0, contentType.find(';'));
    while (mediaType.ends_with(' ') || mediaType.ends_with('\t')) mediaType.remove_suffix(1);
    return mediaType.empty() || lowerCase(mediaType) == "application/json";
}

// Takes the same time wherever the first difference is, so that a token cannot be guessed byte by byte.
bool equalInConstantTime(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    unsigned difference = 0;
    for (size_t i = 0; i < a.size(); ++i)
        difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
    return difference == 0;
}

Answer jsonAnswer(const nlohmann::json& value) {
    return {200,
            "application/json",
            value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n",
            {}};
}

}  // namespace

HttpApi::HttpApi(const Library& library, FitQueue& queue, Settings settings)
    : library_(library), queue_(queue), settings_(std::move(settings)) {}

std::optional<Answer> HttpApi::refuseHead(const Call& call) const {
    const std::string_view path = pathOf(call.target);
    if (path != kHealthPath && !isAuthorized(call)) {
        Answer answer = problem(401, "this daemon asks for a bearer token");
        answer.headers.emplace_back("WWW-Authenticate", "Bearer");
        return answer;
    }
    const std::string_view allowed = allowedMethods(path);
    if (allowed.empty()) return problem(404, "there is nothing at this path");
    if (!isAllowed(call.method, allowed)) {
        Answer answer = problem(405, "this path takes " + std::string(allowed));
        answer.headers.emplace_back("Allow", allowed);
        return answer;
    }
    if (path == kRenderPath && !isJson(call.contentType))
        return problem(415, "expected the content type application/json");
    return std::nullopt;
}

void HttpApi::answer(const Call& call, std::stop_token abandoned, Reply reply) const {
    if (std::optional<Answer> refusal = refuseHead(call)) return reply(std::move(*refusal));
    const std::string_view path = pathOf(call.target);
    if (path == kRenderPath) return render(call, std::move(abandoned), std::move(reply));
    if (path == kWallsPath) return reply(jsonAnswer({{"walls", wallNames(library_)}}));
    if (path == kScenesPath) return reply(jsonAnswer({{"scenes", sceneNames(library_)}}));
    reply({200, "text/plain", "ok\n", {}});
}

bool HttpApi::isAuthorized(const Call& call) const {
    if (settings_.token.empty()) return true;
    constexpr std::string_view kScheme = "bearer ";
    const std::string_view given = call.authorization;
    return lowerCase(given.substr(0, kScheme.size())) == kScheme &&
           equalInConstantTime(given.substr(kScheme.size()), settings_.token);
}

void HttpApi::render(const Call& call, std::stop_token abandoned, Reply reply) const {
    RenderQueue::Job job;
    try {
        job.call = decodeRenderCall(call.body, library_, settings_.maxSamplesPerFrame);
    } catch (...) {
        return reply(answerToCurrentException());
    }
    job.abandoned = std::move(abandoned);
    job.done = [reply = std::move(reply)](RenderOutcome outcome) { reply(answerTo(std::move(outcome))); };
    queue_.submit(std::move(job));
}

}  // namespace curvewall
