#pragma once
// One client's connection: reads requests, one after the other, and writes an answer to each. Everything here
// runs on the network thread.
//
// One loop reads whatever arrives, also while a render is in progress, so that a client that hangs up is
// noticed at once; what a pipelining client sends ahead waits in the buffer, up to a limit.

#include "server/answer.h"

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>

#include <array>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>

namespace curvewall {

namespace net = boost::asio;

struct HttpLimits {
    size_t maxBodyBytes = size_t{1} << 20;
    size_t maxConnections = 256;
    std::chrono::steady_clock::duration idle = std::chrono::seconds(60);     // between requests
    std::chrono::steady_clock::duration request = std::chrono::seconds(20);  // first byte to last
    std::chrono::steady_clock::duration write = std::chrono::seconds(20);    // for each part sent
    std::chrono::steady_clock::duration linger = std::chrono::seconds(2);    // after the last answer
};

struct HttpHandler {
    std::function<std::optional<Answer>(const Call&)> refuseHead;
    std::function<void(const Call&, std::stop_token, Reply)> answer;
};

class HttpSession : public std::enable_shared_from_this<HttpSession> {
public:
    using Finished = std::function<void(const std::shared_ptr<HttpSession>&)>;

    // Keeps references to the limits and the handler. Calls `finished` once, when the connection is closed.
    HttpSession(net::ip::tcp::socket socket, const HttpLimits& limits, const HttpHandler& handler,
                Finished finished);

    void start();
    void refuse(Answer answer);  // instead of start()
    void stop();                 // delivers the answer that is under way, then closes

private:
    enum class State { reading, answering, writing, lingering, finished };
    using Parser = boost::beast::http::request_parser<boost::beast::http::string_body>;
    using Response = boost::beast::http::response<boost::beast::http::string_body>;
    using Serializer = boost::beast::http::response_serializer<boost::beast::http::string_body>;

    void readMore();
    void onRead(boost::beast::error_code error, size_t bytes);
    void expectRequest();
    void parse();
    bool refuseExpectation();
    void dispatch();
    void refuseMalformed(boost::beast::error_code error);
    Call headFromParser() const;
    Reply replyLater();
    void write(Answer answer);
    void writeSome();
    void onWritten();
    void linger();
    void finish();
    void setDeadline(std::chrono::steady_clock::duration duration);
    void onDeadline();

    net::ip::tcp::socket socket_;
    const HttpLimits& limits_;
    const HttpHandler& handler_;
    Finished finished_;

    State state_ = State::reading;
    bool stopping_ = false;
    bool peerGone_ = false;  // it will send no more; it may still read
    bool readPending_ = false;
    bool requestBegun_ = false;
    bool expectationMet_ = false;
    bool keepAlive_ = false;
    bool headOnly_ = false;
    unsigned version_ = 11;
    std::array<char, size_t{16} * 1024> chunk_;
    boost::beast::flat_buffer buffer_;
    std::optional<Parser> parser_;
    std::optional<Response> response_;
    std::optional<Serializer> serializer_;
    std::stop_source abandoned_;
    net::steady_timer deadline_;
};

}  // namespace curvewall
