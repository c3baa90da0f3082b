#include "server/http_server.h"

#include <spdlog/spdlog.h>

#include <cctype>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace curvewall {
namespace {

using boost::system::error_code;
using net::ip::tcp;

// Clients above the limit are told so; with this many being told, the others are just closed.
constexpr size_t kRefusalsAtOnce = 64;
constexpr std::chrono::milliseconds kPauseAfterFailure(100);

tcp::acceptor listenOn(net::io_context& context, const std::string& address, uint16_t port) {
    const tcp::endpoint endpoint(net::ip::make_address(address), port);
    tcp::acceptor acceptor(context);
    try {
        acceptor.open(endpoint.protocol());
        acceptor.set_option(tcp::acceptor::reuse_address(true));
        acceptor.bind(endpoint);
        acceptor.listen();
    } catch (const boost::system::system_error& error) {
        std::string reason = error.code().message();
        if (!reason.empty())
            reason.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(reason.front())));
        std::ostringstream message;
        message << endpoint << ": " << reason;
        throw std::runtime_error(message.str());
    }
    return acceptor;
}

}  // namespace

HttpServer::HttpServer(net::io_context& context, const std::string& address, uint16_t port, HttpLimits limits,
                       HttpHandler handler)
    : limits_(limits),
      handler_(std::move(handler)),
      acceptor_(listenOn(context, address, port)),
      retry_(context) {
    accept();
}

std::string HttpServer::url() const {
    std::ostringstream text;
    text << "http://" << acceptor_.local_endpoint();
    return text.str();
}

void HttpServer::stop() {
    error_code ignored;
    acceptor_.close(ignored);
    retry_.cancel();
    const auto sessions = sessions_;  // stopping one may take it out of the set
    for (const auto& session : sessions) session->stop();
}

void HttpServer::accept() {
    acceptor_.async_accept([this](error_code error, tcp::socket socket) {
        if (!acceptor_.is_open()) return;
        if (!error) {
            onAccepted(std::move(socket));
            return accept();
        }
        // Out of file descriptors, most likely; the connections that there are go on.
        spdlog::warn("cannot accept a connection: {}", error.message());
        retry_.expires_after(kPauseAfterFailure);
        retry_.async_wait([this](error_code canceled) {
            if (!canceled && acceptor_.is_open()) accept();
        });
    });
}

void HttpServer::onAccepted(tcp::socket socket) {
    if (sessions_.size() >= limits_.maxConnections + kRefusalsAtOnce) return;
    error_code ignored;
    socket.set_option(tcp::no_delay(true), ignored);
    const auto session = std::make_shared<HttpSession>(
        std::move(socket), limits_, handler_,
        [this](const std::shared_ptr<HttpSession>& finished) { sessions_.erase(finished); });
    sessions_.insert(session);
    if (sessions_.size() <= limits_.maxConnections) return session->start();
    Answer answer = problem(503, "too many connections");
    answer.headers.emplace_back("Retry-After", "1");
    session->refuse(std::move(answer));
}

}  // namespace curvewall
