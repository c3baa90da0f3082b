#pragma once
// What `curvewall serve` is told by its configuration file.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

namespace curvewall {

struct DaemonConfig {
    std::string bindAddress = "127.0.0.1";
    uint16_t port = 8650;  // 0: any free one
    std::string wallsFolder = ".";
    std::string scenesFolder = "scenes";  // may be missing
    size_t queueLength = 32;
    std::chrono::duration<double> queueDeadline{30};
    size_t maxBodyBytes = size_t{1} << 20;
    size_t maxConnections = 256;
    uint64_t maxCityTriangles = 200'000;
    size_t maxLoadedScenes = 4;
    uint64_t maxSamplesPerFrame = uint64_t{1} << 27;
    std::string token;  // empty: none is asked for

    bool operator==(const DaemonConfig&) const = default;
};

// Relative paths are relative to the file. Throws InputError; also when the daemon would listen to more than
// this computer without a token.
DaemonConfig readDaemonConfig(const std::string& path);

}  // namespace curvewall
