#pragma once
// `curvewall serve`: one network thread, one render thread, a few threads that fit pieces.

#include "server/daemon_config.h"
#include "server/fit_queue.h"
#include "server/http_api.h"
#include "server/http_server.h"
#include "server/library.h"
#include "server/render_queue.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>

#include <string>

namespace curvewall {

class Daemon {
public:
    // Listens when it is constructed. Throws std::runtime_error when it cannot.
    Daemon(const DaemonConfig& config, MakeRenderFunction makeRender, FitFunction fit, RefitFunction refit);

    std::string url() const { return server_.url(); }
    uint16_t port() const { return server_.port(); }

    void stopOnSignals();  // SIGTERM and SIGINT

    // Serves, on the calling thread, until it was told to stop and the last answer is delivered.
    void run();

    // From any thread: no new clients, the render in hand is finished, fits are stopped, those that wait are
    // refused.
    void stop();

private:
    void sweepLater();

    boost::asio::io_context context_;  // first, because everything below may use it until its own end
    const Library library_;
    RenderQueue renders_;
    FitQueue fits_;
    HttpApi api_;
    HttpServer server_;
    boost::asio::steady_timer sweepTimer_;
    bool stopping_ = false;  // network thread
    boost::asio::signal_set signals_;
};

// Prints "listening on URL" as the first line of stdout, where nothing else may be written before it: the log
// is the caller's to send elsewhere. Returns the exit code.
int runDaemon(const DaemonConfig& config);

}  // namespace curvewall
