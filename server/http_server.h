#pragma once
// Listens on one address and keeps the sessions of its clients.

#include "server/http_session.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>

#include <cstdint>
#include <memory>
#include <set>
#include <string>

namespace curvewall {

class HttpServer {
public:
    // Throws std::runtime_error "ADDRESS:PORT: REASON" when it cannot listen there.
    HttpServer(net::io_context& context, const std::string& address, uint16_t port, HttpLimits limits,
               HttpHandler handler);
    HttpServer(const HttpServer&) = delete;
    HttpServer& operator=(const HttpServer&) = delete;

    // With the port that was taken when any free one was asked for: "http://127.0.0.1:8650".
    std::string url() const;
    uint16_t port() const { return acceptor_.local_endpoint().port(); }

    // On the network thread. The context runs out of work when the last answer is delivered.
    void stop();

private:
    void accept();
    void onAccepted(net::ip::tcp::socket socket);

    const HttpLimits limits_;
    const HttpHandler handler_;
    net::ip::tcp::acceptor acceptor_;
    net::steady_timer retry_;
    std::set<std::shared_ptr<HttpSession>> sessions_;
};

}  // namespace curvewall
