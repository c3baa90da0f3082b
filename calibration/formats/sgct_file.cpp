#include "calibration/formats/sgct_file.h"

#include "calibration/errors.h"
#include "calibration/formats/display_names.h"
#include "calibration/formats/mesh_file.h"
#include "calibration/formats/sgct_correction.h"
#include "calibration/formats/sgct_document.h"
#include "calibration/formats/sgct_projection.h"
#include "calibration/formats/texel_budget.h"
#include "calibration/readers/projection_fields.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <variant>

namespace curvewall {
namespace {

// A viewport, or a window that is described by a file of its own.
struct Part {
    const SgctWindow* window;
    const SgctViewport* viewport;  // null for a window with a file
    std::string name;

    const std::string& place() const { return viewport ? viewport->place : window->place; }
};

// What tells one of several apart: nothing where there is one, its name where no other has it, or its number.
template <class Item, class NameOf>
std::string labelOf(const std::vector<Item>& items, size_t index, const char* kind, const NameOf& nameOf) {
    if (items.size() < 2) return {};
    const std::string& name = nameOf(items[index]);
    const auto sameName = [&](const Item& item) { return nameOf(item) == name; };
    if (!name.empty() && std::ranges::count_if(items, sameName) == 1) return name;
    return kind + std::to_string(index + 1);
}

std::string joined(std::initializer_list<std::string> labels) {
    std::string text;
    for (const std::string& label : labels)
        if (!label.empty()) text += (text.empty() ? "" : "-") + label;
    return text;
}

bool showsSomething(const SgctWindow& window, Decisions& decisions) {
    if (window.copyOf || window.drawsScene) return true;
    decisions.warn(window.place + ".draw3d: the window does not show the scene and is left out");
    return false;
}

std::vector<Part> partsOf(const SgctDocument& document, const std::string& fileName, Decisions& decisions) {
    std::vector<Part> parts;
    const auto add = [&](const SgctWindow& window, const SgctViewport* viewport, const std::string& name) {
        parts.push_back({&window, viewport, safeDisplayName(name.empty() ? fileName : name)});
    };
    for (size_t n = 0; n < document.nodes.size(); ++n) {
        const SgctNode& node = document.nodes[n];
        const std::string ofNode = labelOf(
            document.nodes, n, "node", [](const SgctNode& i) -> auto& { return i.address; });
        for (size_t w = 0; w < node.windows.size(); ++w) {
            const SgctWindow& window = node.windows[w];
            if (!showsSomething(window, decisions)) continue;
            const std::string ofWindow = labelOf(
                node.windows, w, "window", [](const SgctWindow& i) -> auto& { return i.name; });
            if (!window.mpcdi.empty() || !window.scalableMesh.empty())
                add(window, nullptr, joined({ofNode, ofWindow}));
            for (size_t v = 0; v < window.viewports.size(); ++v) {
                if (!glm::all(glm::greaterThan(window.viewports[v].size, glm::dvec2(0)))) continue;
                const std::string ofViewport = labelOf(
                    window.viewports, v, "viewport", [](const SgctViewport& i) -> auto& { return i.name; });
                add(window, &window.viewports[v], joined({ofNode, ofWindow, ofViewport}));
            }
        }
    }
    return parts;
}

// Old XML names viewports "Channel 1"; where that tells all of them apart nothing else is needed.
void preferViewportNames(std::vector<Part>& parts) {
    std::set<std::string> names;
    for (const Part& part : parts)
        if (!part.viewport || part.viewport->name.empty() || !names.insert(part.viewport->name).second)
            return;
    for (Part& part : parts) part.name = safeDisplayName(part.viewport->name);
}

void makeNamesUnique(std::vector<Part>& parts) {
    std::set<std::string> taken;
    for (Part& part : parts) part.name = uniqueName(part.name, taken);
}

std::string nameOfUser(const Part& part) { return part.viewport ? part.viewport->user : std::string(); }

struct FoundUser {
    const SgctUser& user;
    bool isNamed = true;  // as it was asked for
};

FoundUser userOf(const SgctDocument& document, const Part& part) {
    static const SgctUser kNobody;
    const auto named = [&](const std::string& wanted) {
        return std::ranges::find(document.users, wanted, &SgctUser::name);
    };
    const std::string name = nameOfUser(part);
    if (const auto user = named(name); user != document.users.end()) return {*user};
    const bool isNamed = name.empty();
    if (const auto user = named(""); user != document.users.end()) return {*user, isNamed};
    return {document.users.empty() ? kNobody : document.users.front(), isNamed};
}

bool isStereo(const SgctWindow& window) {
    return window.stereo != "none" && window.stereo != "no_stereo" && window.stereo != "test" &&
           window.stereo != "dummy";
}

std::string textOf(glm::dvec3 v) { return fmt::format("({}, {}, {})", v.x, v.y, v.z); }

void warnOfOtherEye(const SgctUser& user, const CalibrationRequest& request, Decisions& decisions) {
    if (request.eyeM && *request.eyeM != user.positionM)
        decisions.warn(fmt::format("users: the eye {} was asked for; the user of the file is at {}",
                                   textOf(*request.eyeM), textOf(user.positionM)));
}

// The eye is the same for all displays of a wall.
SgctEye decideEye(const SgctUser& user, const std::vector<Part>& parts, const CalibrationRequest& request,
                  Decisions& decisions) {
    SgctEye eye{.userM = request.eyeM.value_or(user.positionM)};
    eye.eyeM = eye.userM;
    const bool anyStereo = std::ranges::any_of(parts, [](const Part& part) {
        return isStereo(*part.window) ||
               (part.viewport && (part.viewport->eye == "left" || part.viewport->eye == "right"));
    });
    if (!anyStereo) return eye;
    eye.eyeM.x += user.eyeSeparationM / 2 *
                  decisions.choose("stereo_eye", {{"none", 0}, {"left", -1}, {"right", 1}}, 0,
                                   "the file is for two eyes, a wall has one: the middle between them");
    return eye;
}

glm::dvec2 shareOfOneEye(const SgctWindow& window) {
    if (window.stereo.starts_with("side_by_side")) return {0.5, 1};
    if (window.stereo.starts_with("top_bottom")) return {1, 0.5};
    return glm::dvec2(1);
}

// Borders are rounded, not sizes, so that neighbours stay neighbours.
std::optional<glm::ivec2> sizeOf(const FileBytes& file, const Part& part) {
    if (!part.window->sizePx) return std::nullopt;
    const glm::dvec2 windowPx = glm::dvec2(*part.window->sizePx) * shareOfOneEye(*part.window);
    const glm::dvec2 sizePx = glm::round((part.viewport->position + part.viewport->size) * windowPx) -
                              glm::round(part.viewport->position * windowPx);
    // Larger ones are mistakes, and their masks would take gigabytes.
    constexpr double kMostPixels = 1 << 26;
    if (!glm::all(glm::greaterThanEqual(sizePx, glm::dvec2(1))) ||
        !glm::all(glm::lessThanEqual(sizePx, glm::dvec2(static_cast<double>(kMostPx)))) ||
        sizePx.x * sizePx.y > kMostPixels)
        throw InputError(file.path, part.place() + ".size",
                         fmt::format("a viewport of 1 to {} pixels in both directions and at most {} in all",
                                     kMostPx, kMostPixels),
                         fmt::format("{} x {}", sizePx.x, sizePx.y));
    return glm::ivec2(sizePx);
}

void warnOfUser(const SgctDocument& document, const Part& part, const SgctUser& ofWall,
                Decisions& decisions) {
    const FoundUser own = userOf(document, part);
    if (!own.isNamed)
        decisions.warn(fmt::format("{}.user: no user is named \"{}\"; the default one is taken", part.place(),
                                   nameOfUser(part)));
    if (own.user.positionM != ofWall.positionM)
        decisions.warn(fmt::format("{}.user: \"{}\" is elsewhere; the wall has one eye, that of \"{}\"",
                                   part.place(), own.user.name, ofWall.name));
}

void warnOfCopy(const Part& part, Decisions& decisions) {
    if (part.window->copyOf)
        decisions.warn(
            fmt::format("{}.blitwindowid: the window is a copy of window {}; it is read by its own "
                        "projection",
                        part.window->place, *part.window->copyOf));
}

void warnOfStereo(const Part& part, Decisions& decisions) {
    if (isStereo(*part.window))
        decisions.warn(fmt::format("{}.stereo: {} is for two eyes; the picture of one is taken",
                                   part.window->place, part.window->stereo));
    if (part.viewport->eye == "left" || part.viewport->eye == "right")
        decisions.warn(fmt::format("{}.eye: the picture is for the {} eye; a wall has one", part.place(),
                                   part.viewport->eye));
}

void warnOfShiftedCube(const Part& part, const SgctEye& eye, Decisions& decisions) {
    const bool isPlanar = std::holds_alternative<SgctPlanar>(part.viewport->projection) ||
                          std::holds_alternative<SgctPlane>(part.viewport->projection);
    if (!isPlanar && eye.userM != glm::dvec3(0))
        decisions.warn(part.place() +
                       ".projection: the user is not at the origin, where SGCT's own pictures of "
                       "this projection would no longer fit together; taken as seen from his place");
}

class SgctReader {
public:
    SgctReader(const FileBytes& file, const FindFile& find, const CalibrationRequest& request, bool isXml,
               SgctEye eye)
        : file_(file),
          find_(find),
          request_(request),
          isXml_(isXml),
          eye_(eye),
          budget_(file.path, file.bytes.size()) {}

    std::vector<Display> displaysOf(const Part& part, Decisions& decisions) {
        warnOfCopy(part, decisions);
        if (!part.viewport) return displaysOfWindowFile(part, decisions);
        warnOfStereo(part, decisions);
        warnOfShiftedCube(part, eye_, decisions);
        try {
            if (const auto* cube = std::get_if<SgctCube>(&part.viewport->projection))
                return displaysOfCube(part, *cube, decisions);
            return {displayOf(part, decisions)};
        } catch (const UsageError& error) {
            throw InputError(file_.path, part.place() + ".projection", "a screen that the eye can see",
                             error.what());
        }
    }

private:
    FileBytes named(const Part& part, const std::string& key, const std::string& name) const {
        auto found = find_(name);
        if (found) return std::move(*found);
        throw InputError(file_.path, part.place() + "." + key,
                         fmt::format("the file \"{}\" of display \"{}\"", name, part.name),
                         "none of that name beside the configuration");
    }

    Display displayOf(const Part& part, Decisions& decisions) {
        const SgctViewport& viewport = *part.viewport;
        requireKnown(viewport);
        Display display;
        display.name = part.name;
        display.sizePx = decideSize(request_, sizeOf(file_, part), std::nullopt, decisions);
        const glm::dvec2 size(display.sizePx);
        const SgctContext context{
            *part.window,
            viewport,
            display.sizePx,
            part.window->aspect ? *part.window->aspect * viewport.size.x / viewport.size.y : size.x / size.y,
            eye_,
            [&](const std::string& key, const std::string& name) { return named(part, key, name); },
            budget_};
        SgctShown shown = sgctShown(context, decisions);
        display.projection = std::move(shown.display.projection);
        display.projectionType = shown.type;
        BlendMaps blend = sgctBlend(context, isXml_, shown.display.intensity, decisions);
        if (!blend.empty()) display.blend = std::make_shared<const BlendMaps>(std::move(blend));
        if (!viewport.overlay.empty())
            decisions.warn(fmt::format("{}.overlay: {} is not drawn", viewport.place, viewport.overlay));
        listDecisions(decisions, display);
        return display;
    }

    void requireKnown(const SgctViewport& viewport) const {
        if (const auto* unknown = std::get_if<SgctUnknownProjection>(&viewport.projection))
            throw InputError(file_.path, viewport.place + ".projection.type", "a projection that SGCT has",
                             "\"" + unknown->type + "\"");
        const auto* planar = std::get_if<SgctPlanar>(&viewport.projection);
        if (planar && planar->isTextureMapped && viewport.mesh.empty())
            throw InputError(file_.path, viewport.place + ".mesh", "the map of a TextureMappedProjection",
                             "nothing");
    }

    // The pictures that SGCT sends to other programs.
    std::vector<Display> displaysOfCube(const Part& part, const SgctCube& cube, Decisions& decisions) const {
        if (cube.front != cube.back)
            decisions.warn(part.place() +
                           ".projection.channels: zleft is the face ahead and zright the one "
                           "behind, as SGCT draws them; its documentation has them exchanged");
        std::vector<Display> displays;
        for (SgctFace& face : sgctCubeFaces(cube, decisions)) {
            displays.push_back({.name = part.name + "-" + face.name,
                                .sizePx = glm::ivec2(cube.facePx),
                                .projectionType = "planar",
                                .projection = std::move(face.projection)});
            listDecisions(decisions, displays.back());
        }
        return displays;
    }

    // What these files hold in memory is taken to be in proportion to their displays.
    std::vector<Display> displaysOfWindowFile(const Part& part, Decisions& decisions) {
        const bool isMesh = part.window->mpcdi.empty();
        const FileBytes file = isMesh ? named(part, "scalablemesh", part.window->scalableMesh)
                                      : named(part, "mpcdi", part.window->mpcdi);
        CalibrationRequest request = request_;
        request.display.clear();
        request.eyeM = eye_.eyeM;
        if (isMesh) {
            Display display = meshDisplay(readMesh(file, find_, decisions), file, request, decisions);
            display.name = part.name;
            if (display.blend) budget_.take(display.sizePx, part.place() + ".scalablemesh");
            return {std::move(display)};
        }
        if (isSgctFile(file)) throw InputError(file.path, "", "an MPCDI archive", "a configuration of SGCT");
        std::vector<Display> displays = readCalibration(file, find_, request, decisions).displays;
        const bool isOne = displays.size() == 1;
        for (Display& display : displays) {
            display.name = isOne ? part.name : part.name + "-" + display.name;
            budget_.take(display.sizePx, part.place() + ".mpcdi");
        }
        return displays;
    }

    const FileBytes& file_;
    const FindFile& find_;
    const CalibrationRequest& request_;
    bool isXml_;
    SgctEye eye_;
    TexelBudget budget_;  // of all displays
};

// Whether the part may have the display that was asked for; those of several displays add to its name.
bool isWanted(const Part& part, const std::string& display) {
    if (display.empty() || display == part.name) return true;
    const bool hasSeveral = !part.viewport || std::holds_alternative<SgctCube>(part.viewport->projection);
    return hasSeveral && display.starts_with(part.name + "-");
}

std::vector<Part> wantedParts(const FileBytes& file, std::vector<Part> parts, const std::string& display) {
    if (parts.empty()) throw InputError(file.path, "nodes", "a viewport that shows something", "none");
    std::string names;
    for (const Part& part : parts) names += (names.empty() ? "\"" : ", \"") + part.name + "\"";
    std::erase_if(parts, [&](const Part& part) { return !isWanted(part, display); });
    if (parts.empty())
        throw InputError(file.path, "", "a display of " + names, "\"" + display + "\" asked for");
    return parts;
}

double linearOf(double encoded) {  // IEC 61966-2-1
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

// What SGCT shows around a fisheye's circle.
glm::vec3 backgroundOf(const std::vector<Part>& parts) {
    for (const Part& part : parts)
        if (part.viewport)
            if (const auto* fisheye = std::get_if<SgctFisheye>(&part.viewport->projection);
                fisheye && fisheye->background)
                return {linearOf(fisheye->background->r), linearOf(fisheye->background->g),
                        linearOf(fisheye->background->b)};
    return glm::vec3(0);
}

}  // namespace

bool isSgctFile(const FileBytes& file) { return isSgctDocument(file); }

Wall readSgctFile(const FileBytes& file, const FindFile& find, const CalibrationRequest& request,
                  Decisions& decisions) {
    Decisions ofWall = decisions;  // with what is said of no display alone
    const SgctDocument document = readSgctDocument(file, ofWall);
    std::vector<Part> all = partsOf(document, file.stem(), ofWall);
    preferViewportNames(all);
    makeNamesUnique(all);
    const std::vector<Part> parts = wantedParts(file, std::move(all), request.display);
    const SgctUser& user = userOf(document, parts.front()).user;
    warnOfOtherEye(user, request, ofWall);
    const SgctEye eye = decideEye(user, parts, request, decisions);
    Wall wall{.name = file.stem(), .eyeM = eye.eyeM, .background = backgroundOf(parts)};
    SgctReader reader(file, find, request, document.isXml, eye);
    for (const Part& part : parts) {
        Decisions own = decisions;
        warnOfUser(document, part, user, own);
        for (Display& display : reader.displaysOf(part, own)) wall.displays.push_back(std::move(display));
    }
    if (!wall.displays.empty()) {
        std::vector<std::string>& first = wall.displays.front().warnings;
        first.insert(first.begin(), ofWall.warnings().begin(), ofWall.warnings().end());
    }
    return wall;
}

}  // namespace curvewall
