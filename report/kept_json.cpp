#include "report/kept_json.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace curvewall {

std::optional<nlohmann::json> keptJson(const std::string& path) {
    std::ifstream file(path);
    if (!file) return std::nullopt;
    nlohmann::json json = nlohmann::json::parse(file, nullptr, false);
    if (json.is_discarded()) return std::nullopt;
    return json;
}

void keepJson(const std::string& path, const nlohmann::json& json) {
    if (const auto folder = std::filesystem::path(path).parent_path(); !folder.empty())
        std::filesystem::create_directories(folder);
    const std::string unfinished = path + ".unfinished";
    {
        std::ofstream file(unfinished);
        file << json.dump(2) << '\n';
        if (!file.flush()) throw std::runtime_error(unfinished + ": cannot be written");
    }
    std::filesystem::rename(unfinished, path);
}

}  // namespace curvewall
