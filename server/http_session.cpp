#include "server/http_session.h"

#include <boost/asio/buffer.hpp>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>

#include <cstdio>
#include <ctime>
#include <string>
#include <utility>

namespace curvewall {
namespace {

namespace http = boost::beast::http;
using boost::beast::error_code;

constexpr std::uint32_t kMaxHeaderBytes = 16 * 1024;
constexpr size_t kReadAheadBytes = size_t{64} * 1024;
static_assert(kReadAheadBytes > kMaxHeaderBytes);

// RFC 9110, 5.6.7: English names whatever the locale.
std::string httpDate() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    static constexpr const char* kDays[] = {"Sun", "Mon", "Tue", "Wed", "Thu", "Fri", "Sat"};
    static constexpr const char* kMonths[] = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                              "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
    std::array<char, 64> text{};
    const int length = std::snprintf(text.data(), text.size(), "%s, %02d %s %d %02d:%02d:%02d GMT",
                                     kDays[utc.tm_wday], utc.tm_mday, kMonths[utc.tm_mon], 1900 + utc.tm_year,
                                     utc.tm_hour, utc.tm_min, utc.tm_sec);
    return {text.data(), static_cast<size_t>(length)};
}

std::string toString(boost::beast::string_view text) { return {text.data(), text.size()}; }

}  // namespace

HttpSession::HttpSession(net::ip::tcp::socket socket, const HttpLimits& limits, const HttpHandler& handler,
                         Finished finished)
    : socket_(std::move(socket)),
      limits_(limits),
      handler_(handler),
      finished_(std::move(finished)),
      deadline_(socket_.get_executor()) {}

void HttpSession::start() { expectRequest(); }

void HttpSession::refuse(Answer answer) {
    keepAlive_ = false;
    write(std::move(answer));
}

void HttpSession::stop() {
    stopping_ = true;
    if (state_ == State::reading) finish();
}

void HttpSession::readMore() {
    if (readPending_ || peerGone_ || buffer_.size() >= kReadAheadBytes) return;
    readPending_ = true;
    socket_.async_read_some(net::buffer(chunk_), [self = shared_from_this()](error_code error, size_t bytes) {
        self->onRead(error, bytes);
    });
}

void HttpSession::onRead(error_code error, size_t bytes) {
    readPending_ = false;
    if (state_ == State::finished) return;
    if (error) {
        peerGone_ = true;
        abandoned_.request_stop();
        if (state_ == State::reading || state_ == State::lingering) finish();
        return;
    }
    if (state_ != State::lingering)
        buffer_.commit(net::buffer_copy(buffer_.prepare(bytes), net::buffer(chunk_, bytes)));
    if (state_ == State::reading)
        parse();
    else
        readMore();
}

void HttpSession::expectRequest() {
    state_ = State::reading;
    requestBegun_ = false;
    expectationMet_ = false;
    abandoned_ = std::stop_source();
    parser_.emplace();
    parser_->eager(true);
    parser_->header_limit(kMaxHeaderBytes);
    parser_->body_limit(limits_.maxBodyBytes);
    setDeadline(limits_.idle);
    parse();
}

void HttpSession::parse() {
    if (buffer_.size() > 0) {
        if (!std::exchange(requestBegun_, true)) setDeadline(limits_.request);
        error_code error;
        buffer_.consume(parser_->put(buffer_.data(), error));
        if (error && error != http::error::need_more) return refuseMalformed(error);
        if (parser_->is_done()) return dispatch();
        if (buffer_.size() >= kReadAheadBytes) return refuseMalformed(http::error::header_limit);
        if (parser_->is_header_done() && refuseExpectation()) return;
    }
    if (peerGone_) return finish();
    readMore();
}

// A client that waits for "100 Continue" is told of a refusal before it sends the body.
bool HttpSession::refuseExpectation() {
    const auto& message = parser_->get();
    if (expectationMet_ || message.version() < 11 ||
        !boost::beast::iequals(message[http::field::expect], "100-continue"))
        return false;
    expectationMet_ = true;
    if (std::optional<Answer> refusal = handler_.refuseHead(headFromParser())) {
        keepAlive_ = false;
        headOnly_ = message.method() == http::verb::head;
        write(std::move(*refusal));
        return true;
    }
    static constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";
    error_code error;
    // 25 bytes always fit into the send buffer of a connection on which nothing else is being sent.
    socket_.non_blocking(true, error);
    net::write(socket_, net::buffer(kContinue), error);
    if (error) finish();
    return static_cast<bool>(error);
}

void HttpSession::dispatch() {
    const auto& message = parser_->get();
    version_ = message.version();
    keepAlive_ = message.keep_alive();
    headOnly_ = message.method() == http::verb::head;
    if (message.version() >= 11 && message.find(http::field::host) == message.end())
        return write(problem(400, "a request of HTTP/1.1 needs a Host header"));
    state_ = State::answering;
    deadline_.cancel();
    Call call = headFromParser();
    call.body = std::move(parser_->get().body());
    handler_.answer(call, abandoned_.get_token(), replyLater());
    readMore();
}

void HttpSession::refuseMalformed(error_code error) {
    keepAlive_ = false;
    if (error == http::error::body_limit)
        write(problem(413, "the body is larger than " + std::to_string(limits_.maxBodyBytes) + " bytes"));
    else if (error == http::error::header_limit)
        write(problem(431, "the header is too large"));
    else if (error == http::error::bad_version)
        write(problem(505, "expected HTTP/1.1"));
    else
        write(problem(400, "this is not HTTP: " + error.message()));
}

Call HttpSession::headFromParser() const {
    const auto& message = parser_->get();
    return {toString(message.method_string()),
            toString(message.target()),
            toString(message[http::field::content_type]),
            toString(message[http::field::authorization]),
            {}};
}

// The reply may come from the render thread, when the session is gone already. Until then the network thread
// has something to wait for.
Reply HttpSession::replyLater() {
    const auto executor = socket_.get_executor();
    return [weak = weak_from_this(), executor, work = net::make_work_guard(executor)](Answer answer) {
        net::post(executor, [weak, answer = std::move(answer)]() mutable {
            if (const auto self = weak.lock(); self && self->state_ == State::answering)
                self->write(std::move(answer));
        });
    };
}

void HttpSession::write(Answer answer) {
    state_ = State::writing;
    keepAlive_ = keepAlive_ && !stopping_;
    response_.emplace();
    response_->version(version_);
    response_->result(answer.status);
    response_->set(http::field::server, "curvewall");
    response_->set(http::field::date, httpDate());
    response_->set(http::field::content_type, answer.contentType);
    for (const auto& [name, value] : answer.headers) response_->set(name, value);
    response_->content_length(answer.body.size());
    response_->keep_alive(keepAlive_);
    if (!headOnly_) response_->body() = std::move(answer.body);
    serializer_.emplace(*response_);
    writeSome();
}

// Part by part, so that the deadline is for standing still, not for a large image over a slow line.
void HttpSession::writeSome() {
    setDeadline(limits_.write);
    http::async_write_some(socket_, *serializer_, [self = shared_from_this()](error_code error, size_t) {
        if (self->state_ != State::writing) return;
        if (error) return self->finish();
        if (!self->serializer_->is_done()) return self->writeSome();
        self->onWritten();
    });
}

void HttpSession::onWritten() {
    serializer_.reset();
    response_.reset();
    if (keepAlive_ && !stopping_)
        expectRequest();
    else
        linger();
}

// Closing with unread bytes resets the connection, and the client may lose the answer (RFC 9112, 9.6).
void HttpSession::linger() {
    state_ = State::lingering;
    error_code ignored;
    socket_.shutdown(net::ip::tcp::socket::shutdown_send, ignored);
    if (peerGone_) return finish();
    buffer_.clear();
    setDeadline(limits_.linger);
    readMore();
}

void HttpSession::finish() {
    if (std::exchange(state_, State::finished) == State::finished) return;
    abandoned_.request_stop();
    deadline_.cancel();
    error_code ignored;
    socket_.close(ignored);
    finished_(shared_from_this());
}

void HttpSession::setDeadline(std::chrono::steady_clock::duration duration) {
    deadline_.expires_after(duration);
    deadline_.async_wait([weak = weak_from_this()](error_code error) {
        const auto self = weak.lock();
        // The deadline may have been moved while this was on its way.
        if (error || !self || self->deadline_.expiry() > std::chrono::steady_clock::now()) return;
        self->onDeadline();
    });
}

void HttpSession::onDeadline() {
    switch (state_) {
        case State::reading:
            if (!requestBegun_) return finish();
            keepAlive_ = false;
            return write(problem(408, "the request took too long to arrive"));
        case State::writing:
        case State::lingering:
            return finish();
        case State::answering:
        case State::finished:
            return;
    }
}

}  // namespace curvewall
