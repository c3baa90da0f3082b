#include "server/daemon_config.h"

#include "calibration/files/json_file.h"

#include <boost/asio/ip/address.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace curvewall {
namespace {

namespace fs = std::filesystem;

std::string readToken(const std::string& path) {
    std::string token = readFile(path, "a file that holds the token").bytes;
    const auto isBlank = [](char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; };
    while (!token.empty() && isBlank(token.back())) token.pop_back();
    return token;
}

// A header can carry no others (RFC 6750 allows fewer still).
void checkToken(const std::string& token, const std::string& path, const std::string& field) {
    bool visible = !token.empty();
    for (const char c : token) visible = visible && c > ' ' && c <= '~';
    if (!visible)
        throw InputError(path, field, "a token of visible ASCII characters",
                         token.empty() ? "nothing" : "others");
}

void readQueue(JsonFields& fields, DaemonConfig& config) {
    std::optional<JsonFields> queue = fields.object("queue");
    if (!queue) return;
    if (const auto length = queue->wholeNumber("length", 1, 10'000))
        config.queueLength = static_cast<size_t>(*length);
    if (const auto seconds = queue->number("deadline_s", {0.001, 86'400}))
        config.queueDeadline = std::chrono::duration<double>(*seconds);
    queue->refuseUnknownKeys();
}

void readFolder(JsonFields& fields, const char* key, const fs::path& base, std::string& folder) {
    folder = (base / fields.text(key).value_or(folder)).lexically_normal().string();
}

template <class Whole>
void readLimit(JsonFields& fields, const char* key, int64_t max, Whole& limit) {
    if (const auto value = fields.wholeNumber(key, 1, max)) limit = static_cast<Whole>(*value);
}

DaemonConfig configFrom(JsonFields fields, const std::string& path) {
    const fs::path base = fs::path(path).parent_path();
    DaemonConfig config;
    config.bindAddress = fields.text("bind").value_or(config.bindAddress);
    if (const auto port = fields.wholeNumber("port", 0, 65'535)) config.port = static_cast<uint16_t>(*port);
    readFolder(fields, "walls", base, config.wallsFolder);
    readFolder(fields, "scenes", base, config.scenesFolder);
    readQueue(fields, config);
    readLimit(fields, "max_body_bytes", int64_t{1} << 30, config.maxBodyBytes);
    readLimit(fields, "max_connections", 65'536, config.maxConnections);
    readLimit(fields, "max_city_triangles", 100'000'000, config.maxCityTriangles);
    readLimit(fields, "max_loaded_scenes", 1'000, config.maxLoadedScenes);
    readLimit(fields, "max_samples_per_frame", int64_t{1} << 40, config.maxSamplesPerFrame);
    const std::optional<std::string> token = fields.text("token");
    const std::optional<std::string> tokenFile = fields.text("token_file");
    fields.refuseUnknownKeys();

    if (token && tokenFile) throw InputError(path, "token_file", "nothing beside token", "both");
    if (token) checkToken(config.token = *token, path, "token");
    if (tokenFile) checkToken(config.token = readToken((base / *tokenFile).string()), path, "token_file");
    return config;
}

void checkExposure(const DaemonConfig& config, const std::string& path) {
    boost::system::error_code error;
    const auto address = boost::asio::ip::make_address(config.bindAddress, error);
    if (error) throw InputError(path, "bind", "an IP address", describe(config.bindAddress));
    if (!address.is_loopback() && config.token.empty())
        throw InputError(path, "token", "a token, because bind " + config.bindAddress + " is not loopback",
                         "none");
}

}  // namespace

DaemonConfig readDaemonConfig(const std::string& path) {
    return readJsonFile(path, "the daemon's configuration", [&](const JsonFields& root) {
        DaemonConfig config = configFrom(root, path);
        checkExposure(config, path);
        return config;
    });
}

}  // namespace curvewall
