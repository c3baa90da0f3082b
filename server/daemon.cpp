#include "server/daemon.h"

#include "calibration/pieces/piece_refit.h"
#include "server/frame_maker.h"

#include <boost/asio/post.hpp>
#include <spdlog/spdlog.h>

#include <chrono>
#include <csignal>
#include <iostream>
#include <utility>

namespace curvewall {
namespace {

constexpr std::chrono::milliseconds kSweepPeriod(250);

HttpLimits limitsFrom(const DaemonConfig& config) {
    HttpLimits limits;
    limits.maxBodyBytes = config.maxBodyBytes;
    limits.maxConnections = config.maxConnections;
    return limits;
}

RenderQueue::Settings queueSettingsFrom(const DaemonConfig& config) {
    RenderQueue::Settings settings;
    settings.length = config.queueLength;
    settings.deadline = config.queueDeadline;
    return settings;
}

HttpHandler handlerFor(const HttpApi& api) {
    return {[&api](const Call& call) { return api.refuseHead(call); },
            [&api](const Call& call, std::stop_token abandoned, Reply reply) {
                api.answer(call, std::move(abandoned), std::move(reply));
            }};
}

}  // namespace

Daemon::Daemon(const DaemonConfig& config, MakeRenderFunction makeRender, FitFunction fit,
               RefitFunction refit)
    : library_(openLibrary(config.wallsFolder, config.scenesFolder, config.maxCityTriangles)),
      renders_(queueSettingsFrom(config), std::move(makeRender)),
      fits_(queueSettingsFrom(config), renders_, std::move(fit), std::move(refit)),
      api_(library_, fits_, {config.token, config.maxSamplesPerFrame}),
      server_(context_, config.bindAddress, config.port, limitsFrom(config), handlerFor(api_)),
      sweepTimer_(context_),
      signals_(context_) {
    sweepLater();
}

void Daemon::stopOnSignals() {
    signals_.add(SIGTERM);
    signals_.add(SIGINT);
    signals_.async_wait([this](boost::system::error_code error, int) {
        if (!error) stop();
    });
}

void Daemon::run() {
    for (;;) {
        try {
            context_.run();
            return;
        } catch (const std::exception& error) {  // out of memory for one client; the others go on
            spdlog::error("a connection failed: {}", error.what());
        }
    }
}

void Daemon::stop() {
    boost::asio::post(context_, [this] {
        stopping_ = true;
        server_.stop();
        sweepTimer_.cancel();
        signals_.cancel();
        fits_.stop();
        renders_.stop();
    });
}

void Daemon::sweepLater() {
    sweepTimer_.expires_after(kSweepPeriod);
    sweepTimer_.async_wait([this](boost::system::error_code error) {
        if (error || stopping_) return;
        fits_.sweep();
        renders_.sweep();
        sweepLater();
    });
}

int runDaemon(const DaemonConfig& config) {
    Daemon daemon(
        config, [count = config.maxLoadedScenes] { return makeFrameMaker(count); },
        [](const Display& display, double tolerancePx, const std::stop_token& stop) {
            return fitPieces(display, tolerancePx, stop);
        },
        [](const FittedPieces& before, const Display& now, double tolerancePx, int every,
           const std::stop_token& stop) { return refitPieces(before, now, tolerancePx, every, stop); });
    daemon.stopOnSignals();
    std::cout << "listening on " << daemon.url() << std::endl;
    daemon.run();
    return 0;
}

}  // namespace curvewall
