// curvewall serve

#include "cli/commands.h"
#include "server/daemon.h"
#include "server/daemon_config.h"

#include <CLI/CLI.hpp>

#include <memory>
#include <optional>
#include <string>

namespace curvewall {
namespace {

struct ServeCommand {
    std::string config;
    std::optional<uint16_t> port;
};

}  // namespace

void addServeCommand(CLI::App& app) {
    auto command = std::make_shared<ServeCommand>();
    CLI::App* serve = app.add_subcommand("serve", "Render over HTTP until SIGTERM");
    serve->add_option("CONFIG", command->config, "Daemon configuration, JSON; defaults without it");
    serve->add_option("--port", command->port, "Port to listen on; 0 takes any free one");
    serve->callback([command] {
        DaemonConfig config = command->config.empty() ? DaemonConfig{} : readDaemonConfig(command->config);
        if (command->port) config.port = *command->port;
        runDaemon(config);
    });
}

}  // namespace curvewall
