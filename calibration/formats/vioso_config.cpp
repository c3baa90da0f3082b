#include "calibration/formats/vioso_config.h"

#include "calibration/errors.h"
#include "calibration/files/xml_document.h"

#include <map>
#include <string_view>
#include <utility>
#include <vector>

namespace curvewall {
namespace {

using Section = std::map<std::string, std::string>;  // keys in lower case

constexpr const char* kDefault = "default";

std::string_view withoutComment(std::string_view line) {
    // A list holds semicolons between its rows; what follows it is a comment.
    const size_t bracket = line.find('['), semicolon = line.find(';');
    if (bracket != std::string_view::npos && bracket < semicolon && trimmed(line).front() != '[')
        return line.substr(0, std::min(line.find(']'), line.size() - 1) + 1);
    return line.substr(0, semicolon);
}

std::vector<std::pair<std::string, Section>> sectionsOf(std::string_view bytes) {
    std::vector<std::pair<std::string, Section>> sections;
    while (!bytes.empty()) {
        const size_t end = bytes.find('\n');
        const std::string_view line = trimmed(withoutComment(bytes.substr(0, end)));
        bytes.remove_prefix(end == std::string_view::npos ? bytes.size() : end + 1);
        if (line.starts_with('[')) {
            sections.emplace_back(std::string(line.substr(1, line.find(']') - 1)), Section{});
        } else if (const size_t equals = line.find('=');
                   equals != std::string_view::npos && !sections.empty()) {
            sections.back().second[lowerCase(std::string(trimmed(line.substr(0, equals))))] =
                std::string(trimmed(line.substr(equals + 1)));
        }
    }
    return sections;
}

std::vector<double> listOf(const FileBytes& ini, const std::string& key, const std::string& text,
                           size_t count) {
    const auto fail = [&] {
        return InputError(ini.path, key, "a list of " + std::to_string(count) + " numbers",
                          "\"" + text + "\"");
    };
    std::string_view rest = text;
    if (!rest.starts_with('[') || !rest.ends_with(']')) throw fail();
    rest = rest.substr(1, rest.size() - 2);
    std::vector<double> numbers;
    while (true) {
        const size_t end = rest.find_first_of(",;");
        const auto number = finiteNumberFrom(rest.substr(0, end));
        if (!number || numbers.size() == count) throw fail();
        numbers.push_back(*number);
        if (end == std::string_view::npos) break;
        rest.remove_prefix(end + 1);
    }
    if (numbers.size() != count) throw fail();
    return numbers;
}

// A channel's own values, and else the defaults.
class Channel {
public:
    Channel(const FileBytes& ini, const Section& defaults, const Section& own)
        : ini_(ini), defaults_(defaults), own_(own) {}

    std::optional<std::string> text(const std::string& key) const {
        for (const Section* section : {&own_, &defaults_})
            if (const auto found = section->find(key); found != section->end()) return found->second;
        return std::nullopt;
    }
    std::optional<std::vector<double>> list(const std::string& key, size_t count) const {
        const auto value = text(key);
        if (!value) return std::nullopt;
        return listOf(ini_, key, *value, count);
    }

private:
    const FileBytes& ini_;
    const Section& defaults_;
    const Section& own_;
};

bool uses(const Channel& channel, const std::string& warpFile, int index) {
    const auto file = channel.text("calibfile");
    if (!file || lowerCase(bareName(*file)) != lowerCase(warpFile)) return false;
    const auto number = finiteNumberFrom(channel.text("calibindex").value_or("0"));
    return number && *number == index;
}

ViosoView viewOf(const Channel& channel, std::string name) {
    ViosoView view;
    view.channel = std::move(name);
    if (const auto v = channel.list("dir", 3)) view.directionDeg = glm::dvec3((*v)[0], (*v)[1], (*v)[2]);
    if (const auto v = channel.list("fov", 4)) view.fovDeg = glm::dvec4((*v)[0], (*v)[1], (*v)[2], (*v)[3]);
    if (const auto v = channel.list("eye", 3)) view.eye = glm::dvec3((*v)[0], (*v)[1], (*v)[2]);
    // Both spellings list the columns of the matrix, the last four numbers being the translation.
    for (const char* key : {"trans", "base"})
        if (const auto v = channel.list(key, 16)) {
            glm::dmat4 matrix;
            for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = (*v)[static_cast<size_t>(i)];
            view.viosoFromHost = matrix;
        }
    const auto automatic = channel.text("bautoview");
    view.isAutomatic = automatic && finiteNumberFrom(*automatic).value_or(0) != 0;
    return view;
}

}  // namespace

std::optional<ViosoView> findViosoView(const FileBytes& ini, const std::string& warpFile, int index) {
    const auto sections = sectionsOf(ini.bytes);
    Section defaults;
    for (const auto& [name, section] : sections)
        if (lowerCase(name) == kDefault) defaults = section;
    for (const auto& [name, section] : sections) {
        if (lowerCase(name) == kDefault) continue;
        const Channel channel(ini, defaults, section);
        if (uses(channel, warpFile, index)) return viewOf(channel, name);
    }
    return std::nullopt;
}

}  // namespace curvewall
