#include "report/machine.h"

#include "renderer/gl/egl_context.h"

#include <fmt/core.h>

#include <fstream>
#include <thread>

namespace curvewall {

std::string processorName() {
    const std::string label = "model name";
    std::string name = "unknown processor";
    std::ifstream facts("/proc/cpuinfo");
    for (std::string line; std::getline(facts, line);)
        if (line.starts_with(label)) {
            name = line.substr(line.find(':') + 2);
            break;
        }
    return fmt::format("{}, {} threads", name, std::thread::hardware_concurrency());
}

GlDriver glDriver() {
    const EglContext context;
    return {context.rendererName(), context.version()};
}

}  // namespace curvewall
