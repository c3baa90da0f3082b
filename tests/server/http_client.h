#pragma once
// A blocking HTTP client that can also misbehave. A read that gets nothing for a minute fails.

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>
#include <sys/socket.h>
#include <sys/time.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace curvewall {

namespace http = boost::beast::http;

class HttpClient {
public:
    using Response = http::response<http::string_body>;

    explicit HttpClient(uint16_t port) : socket_(context_) {
        socket_.connect({boost::asio::ip::make_address("127.0.0.1"), port});
        const timeval limit{60, 0};
        setsockopt(socket_.native_handle(), SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof(limit));
    }

    void send(std::string_view bytes) {
        boost::asio::write(socket_, boost::asio::buffer(bytes.data(), bytes.size()));
    }

    // False when the server does not take them any more.
    bool trySend(std::string_view bytes) {
        boost::system::error_code error;
        boost::asio::write(socket_, boost::asio::buffer(bytes.data(), bytes.size()), error);
        return !error;
    }

    Response read(bool toHead = false) {
        http::response_parser<http::string_body> parser;
        parser.body_limit(uint64_t{1} << 30);
        parser.skip(toHead);
        http::read(socket_, buffer_, parser);
        return parser.release();
    }

    Response call(std::string_view method, std::string_view path, std::string_view body = "",
                  std::string_view headers = "") {
        send(request(method, path, body, headers));
        return read(method == "HEAD");
    }

    Response render(std::string_view body) { return call("POST", "/v1/render", body); }

    // True when the server ends the connection without another byte.
    bool isClosedByServer() {
        char byte = 0;
        boost::system::error_code error;
        return socket_.read_some(boost::asio::buffer(&byte, 1), error) == 0 &&
               (error == boost::asio::error::eof || error == boost::asio::error::connection_reset);
    }

    void finishSending() { socket_.shutdown(boost::asio::ip::tcp::socket::shutdown_send); }

    static std::string request(std::string_view method, std::string_view path, std::string_view body = "",
                               std::string_view headers = "") {
        std::string text;
        text.append(method).append(" ").append(path).append(" HTTP/1.1\r\nHost: test\r\n").append(headers);
        if (!body.empty()) text += "Content-Length: " + std::to_string(body.size()) + "\r\n";
        return text.append("\r\n").append(body);
    }

private:
    boost::asio::io_context context_;
    boost::asio::ip::tcp::socket socket_;
    boost::beast::flat_buffer buffer_;
};

inline std::string header(const HttpClient::Response& response, std::string_view name) {
    const auto value = response[boost::beast::string_view(name.data(), name.size())];
    return {value.data(), value.size()};
}

}  // namespace curvewall
