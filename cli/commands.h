#pragma once
// The subcommands. Each adds its options to the application and runs when it is chosen; errors are
// exceptions.

#include <CLI/App.hpp>

namespace curvewall {

void addRenderCommand(CLI::App& app);
void addInspectCommand(CLI::App& app);
void addConvertCommand(CLI::App& app);
void addReportCommand(CLI::App& app);
void addServeCommand(CLI::App& app);

}  // namespace curvewall
