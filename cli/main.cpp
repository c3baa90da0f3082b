// curvewall: one executable, one subcommand a job.

#include "calibration/errors.h"
#include "cli/commands.h"
#include "renderer/gl/egl_context.h"

#include <CLI/CLI.hpp>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <exception>
#include <malloc.h>
#include <string>

namespace {

constexpr int kUsageExit = 2;

// A software rasterizer allocates megabytes for every draw. By default the C library hands them back to the
// system each time, and a tenth of a frame goes into page faults.
void keepFreedMemory() {
    constexpr int kMebibyte = 1 << 20;
    mallopt(M_MMAP_THRESHOLD, 32 * kMebibyte);
    mallopt(M_TRIM_THRESHOLD, 512 * kMebibyte);
}

// CLI11 would say that a subcommand is required, which is not what went wrong.
void requireKnownSubcommand(const CLI::App& app, const std::string& word) {
    std::string names;
    for (const CLI::App* subcommand : app.get_subcommands([](const CLI::App*) { return true; })) {
        if (subcommand->get_name() == word) return;
        names += (names.empty() ? "" : ", ") + subcommand->get_name();
    }
    throw curvewall::UsageError("there is no subcommand \"" + word + "\"; there are " + names);
}

int runSubcommand(int argc, char** argv) {
    CLI::App app("Renders 3D scenes straight into the image that a curved wall needs.", "curvewall");
    app.require_subcommand(1);
    app.set_version_flag("--version", "curvewall 0.1.0");
    curvewall::addRenderCommand(app);
    curvewall::addInspectCommand(app);
    curvewall::addConvertCommand(app);
    curvewall::addReportCommand(app);
    curvewall::addServeCommand(app);
    if (argc > 1 && argv[1][0] != '-') requireKnownSubcommand(app, argv[1]);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        // Help and version end here too, with success.
        return app.exit(error) == 0 ? 0 : kUsageExit;
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    keepFreedMemory();
    // Pictures and numbers go to stdout, everything that is said about them to stderr.
    spdlog::set_default_logger(spdlog::stderr_color_mt("curvewall"));
    spdlog::set_pattern("curvewall: %^%l%$: %v");
    try {
        return runSubcommand(argc, argv);
    } catch (const curvewall::UsageError& error) {
        spdlog::error(error.what());
        return kUsageExit;
    } catch (const curvewall::InputError& error) {
        spdlog::error(error.what());
        return 3;
    } catch (const curvewall::GlUnavailable& error) {
        spdlog::error(error.what());
        return 4;
    } catch (const std::exception& error) {
        spdlog::error(error.what());
        return 1;
    }
}
