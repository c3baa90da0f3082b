#include "calibration/formats/camera_yaml.h"

#include "calibration/errors.h"
#include "calibration/files/map_file.h"
#include "calibration/files/number_text.h"
#include "calibration/files/yaml_values.h"
#include "calibration/formats/display_names.h"
#include "calibration/projections/camera_lens.h"
#include "calibration/projections/lens_projection.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace curvewall {
namespace {

constexpr double kMostNumber = 1e6;
constexpr double kMostTiltRad = 1.5;  // short of a sensor seen edge on

// --- Names ---

enum class Role { matrix, distortion, rotation, translation, projection, width, height, size };

struct Stem {
    std::string_view text;
    Role role;
};

// Without case and underscores. Longer names come first, so that none hides behind its own beginning.
constexpr Stem kStems[] = {
    {"distortioncoefficients", Role::distortion},
    {"distortioncoeffs", Role::distortion},
    {"distcoeffs", Role::distortion},
    {"distortion", Role::distortion},
    {"dist", Role::distortion},
    {"kc", Role::distortion},
    {"d", Role::distortion},
    {"cameramatrix", Role::matrix},
    {"intrinsicmatrix", Role::matrix},
    {"intrinsics", Role::matrix},
    {"matrix", Role::matrix},
    {"mtx", Role::matrix},
    {"k", Role::matrix},
    {"m", Role::matrix},
    {"rotationmatrix", Role::rotation},
    {"rotationvector", Role::rotation},
    {"rotation", Role::rotation},
    {"rvec", Role::rotation},
    {"r", Role::rotation},
    {"translationvector", Role::translation},
    {"translation", Role::translation},
    {"tvec", Role::translation},
    {"t", Role::translation},
    {"projectionmatrix", Role::projection},
    {"p", Role::projection},
    {"imagewidth", Role::width},
    {"width", Role::width},
    {"imageheight", Role::height},
    {"height", Role::height},
    {"imagesize", Role::size},
    {"resolution", Role::size},
    {"size", Role::size},
};

struct Meaning {
    Role role;
    std::string device;  // "" in a file of one, "proj", "left", "2"
};

bool isDeviceSuffix(std::string_view text) {
    return text.empty() || text == "left" || text == "right" ||
           (text.size() <= 2 && text.find_first_not_of("0123456789") == std::string_view::npos);
}

// What a name like "proj_K" or "cameraMatrix2" stands for.
std::optional<Meaning> meaningOf(const std::string& name) {
    std::string folded = lowerCase(name);
    std::erase(folded, '_');
    for (const std::string_view device : {"", "cam", "camera", "proj", "projector", "left", "right"}) {
        if (!folded.starts_with(device)) continue;
        const std::string_view rest = std::string_view(folded).substr(device.size());
        for (const Stem& stem : kStems)
            if (rest.starts_with(stem.text) && isDeviceSuffix(rest.substr(stem.text.size())))
                return Meaning{stem.role, std::string(device) + std::string(rest.substr(stem.text.size()))};
    }
    return std::nullopt;
}

// --- Numbers ---

struct Field {
    std::string path;
    std::string name;
    std::vector<std::string> texts;
};

InputError wrong(const Field& field, const std::string& expected, const std::string& found) {
    return {field.path, field.name, expected, found};
}

std::vector<double> numbersOf(const Field& field, std::initializer_list<size_t> counts,
                              const std::string& expected) {
    if (std::ranges::find(counts, field.texts.size()) == counts.end())
        throw wrong(field, expected, std::to_string(field.texts.size()) + " values");
    std::vector<double> numbers;
    for (const std::string& text : field.texts) {
        const auto number = finiteNumberFrom(text);
        if (!number || std::abs(*number) > kMostNumber)
            throw wrong(field, "numbers from -1e6 to 1e6", describe(nlohmann::json(text)));
        numbers.push_back(*number);
    }
    return numbers;
}

int pixelsOf(const Field& field, const std::string& text) {
    const auto number = finiteNumberFrom(text);
    if (!number || *number < 1 || *number > double{kMostPx} || *number != std::floor(*number))
        throw wrong(field, "a whole number of pixels from 1 to 16384", describe(nlohmann::json(text)));
    return static_cast<int>(*number);
}

// --- The file ---

// Everything that it says of one camera or projector.
using Fields = std::map<Role, Field>;

struct CameraFile {
    std::string path;
    YamlValues values;
    std::map<std::string, Fields> devices;  // those with a camera matrix
    Fields common;                          // what is said of no device

    std::optional<std::string> text(const char* name) const {
        const auto found = values.find(name);
        if (found == values.end() || found->second.size() != 1) return std::nullopt;
        return found->second.front();
    }
    const Field* find(const std::string& device, Role role) const {
        for (const Fields* fields : {&devices.at(device), &common})
            if (const auto found = fields->find(role); found != fields->end()) return &found->second;
        return nullptr;
    }
};

bool isScalar(Role role) { return role == Role::width || role == Role::height; }

CameraFile cameraFile(const FileBytes& file) {
    CameraFile cameras{file.path, readYamlValues(file), {}, {}};
    for (const auto& [path, texts] : cameras.values) {
        const std::string name = path.ends_with(".data") ? path.substr(0, path.size() - 5) : path;
        const auto meaning = meaningOf(name);
        // "k1: 0.2" is no matrix.
        if (!meaning || isScalar(meaning->role) != (texts.size() == 1)) continue;
        cameras.devices[meaning->device].insert({meaning->role, {file.path, name, texts}});
    }
    if (const auto found = cameras.devices.find("");
        found != cameras.devices.end() && !found->second.contains(Role::matrix))
        cameras.common = found->second;
    std::erase_if(cameras.devices, [](const auto& device) { return !device.second.contains(Role::matrix); });
    if (cameras.devices.empty())
        throw InputError(file.path, "", "a camera matrix (camera_matrix, cameraMatrix, M1, cam_K, K ...)",
                         "none");
    return cameras;
}

// --- One camera ---

CameraIntrinsics readIntrinsics(const CameraFile& file, const std::string& device, Decisions& decisions) {
    const Field& field = *file.find(device, Role::matrix);
    const std::vector<double> k = numbersOf(field, {9}, "a camera matrix of 3 x 3 numbers");
    if (!(k[0] > 0 && k[4] > 0 && k[3] == 0 && k[6] == 0 && k[7] == 0 && k[8] == 1))
        throw wrong(field, "a camera matrix [fx, 0, cx, 0, fy, cy, 0, 0, 1] with focal lengths above 0",
                    fmt::format("[{}]", fmt::join(k, ", ")));
    if (k[1] != 0)
        decisions.warn(
            fmt::format("{}: its skew of {} is left out, as OpenCV leaves it out", field.name, k[1]));
    return {{k[0], k[4]}, {k[2], k[5]}, {}};
}

std::vector<double> readDistortion(const CameraFile& file, const std::string& device) {
    const Field* field = file.find(device, Role::distortion);
    if (!field) return {};
    std::vector<double> distortion =
        numbersOf(*field, {0, 4, 5, 8, 12, 14}, "0, 4, 5, 8, 12 or 14 distortion coefficients");
    for (size_t i = 12; i < distortion.size(); ++i)
        if (std::abs(distortion[i]) > kMostTiltRad)
            throw wrong(*field, "a tilt from -1.5 to 1.5 radians", std::to_string(distortion[i]));
    return distortion;
}

enum class LensModel { pinhole, fisheye };

// What the file says. Nothing where it does not.
std::optional<LensModel> namedModel(const CameraFile& file) {
    if (const auto isFisheye = file.text("fisheye_model"))
        return *isFisheye == "1" || *isFisheye == "true" ? LensModel::fisheye : LensModel::pinhole;
    for (const char* name : {"distortion_model", "camera_model", "model"}) {
        const auto model = file.text(name);
        if (!model) continue;
        const std::string word = lowerCase(*model);
        for (const char* pinhole : {"plumb_bob", "rational_polynomial", "pinhole", "thin_prism"})
            if (word == pinhole) return LensModel::pinhole;
        for (const char* fisheye : {"equidistant", "fisheye"})
            if (word == fisheye) return LensModel::fisheye;
        throw InputError(file.path, name, "plumb_bob, rational_polynomial, equidistant, pinhole or fisheye",
                         describe(nlohmann::json(*model)));
    }
    return std::nullopt;
}

LensPtr lensOf(LensModel model, const CameraIntrinsics& intrinsics) {
    if (model == LensModel::fisheye) return fisheyeCameraLens(intrinsics);
    return std::make_shared<PinholeLens>(intrinsics);
}

struct Unseen {
    int pixels = 0;
    int sampled = 0;
    glm::dvec2 first{0};
};

// Pixels that no ray reaches: the distortion turns back before it gets there.
Unseen unseenOf(const Lens& lens, glm::ivec2 sizePx) {
    constexpr int kSteps = 32;
    Unseen unseen;
    for (int y = 0; y <= kSteps; ++y)
        for (int x = 0; x <= kSteps; ++x) {
            const glm::dvec2 px = 0.5 + glm::dvec2(sizePx - 1) * glm::dvec2(x, y) / double{kSteps};
            ++unseen.sampled;
            if (lens.direction(px)) continue;
            if (unseen.pixels++ == 0) unseen.first = px;
        }
    return unseen;
}

LensModel decideModel(const CameraFile& file, const CameraIntrinsics& intrinsics, glm::ivec2 sizePx,
                      Decisions& decisions) {
    const auto named = namedModel(file);
    if (named) return *named;
    if (intrinsics.distortion.size() != 4) return LensModel::pinhole;  // a fisheye has four
    const bool folds = unseenOf(PinholeLens(intrinsics), sizePx).pixels > 0 &&
                       unseenOf(*fisheyeCameraLens(intrinsics), sizePx).pixels == 0;
    return decisions.choose(
        "lens_model", {{"pinhole", LensModel::pinhole}, {"fisheye", LensModel::fisheye}},
        folds ? LensModel::fisheye : LensModel::pinhole,
        folds ? "of four coefficients k1 k2 p1 p2 the distortion would fold back inside the picture, of "
                "k1 k2 k3 k4 of a fisheye it does not"
              : "both models have four coefficients and the file names none; this is OpenCV's usual one");
}

std::optional<glm::ivec2> fileSize(const CameraFile& file, const std::string& device) {
    if (const Field* size = file.find(device, Role::size)) {
        if (size->texts.size() != 2)
            throw wrong(*size, "width and height", std::to_string(size->texts.size()) + " values");
        return glm::ivec2(pixelsOf(*size, size->texts[0]), pixelsOf(*size, size->texts[1]));
    }
    const Field *width = file.find(device, Role::width), *height = file.find(device, Role::height);
    if (!width || !height) return std::nullopt;
    return glm::ivec2(pixelsOf(*width, width->texts[0]), pixelsOf(*height, height->texts[0]));
}

glm::ivec2 decideCameraSize(const CalibrationRequest& request, std::optional<glm::ivec2> inFile,
                            const CameraIntrinsics& intrinsics, Decisions& decisions) {
    if (request.sizePx || inFile) return decideSize(request, inFile, std::nullopt, decisions);
    const auto side = [&](const char* key, double principalPx) {
        const double guess = std::clamp(std::round(2 * (principalPx + 0.5)), 1.0, double{kMostPx});
        return static_cast<int>(decisions.number(
            key, {1, double{kMostPx}}, guess,
            fmt::format("the file names no size; the principal point, {}, would be its middle",
                        principalPx)));
    };
    const int width = side("width_px", intrinsics.principalPx.x);
    return {width, side("height_px", intrinsics.principalPx.y)};
}

// Intrinsics are in pixels of the picture that was calibrated; another size shows the same, resampled.
void scaleTo(glm::ivec2 sizePx, std::optional<glm::ivec2> inFile, CameraIntrinsics& intrinsics) {
    if (!inFile || *inFile == sizePx) return;
    const glm::dvec2 scale = glm::dvec2(sizePx) / glm::dvec2(*inFile);
    intrinsics.focalPx *= scale;
    intrinsics.principalPx = (intrinsics.principalPx + 0.5) * scale - 0.5;
}

void checkPlausible(const Field& matrix, const CameraIntrinsics& intrinsics, const Lens& lens,
                    glm::ivec2 sizePx, Decisions& decisions) {
    const glm::dvec2 c = intrinsics.principalPx + 0.5;
    if (!(c.x >= 0 && c.y >= 0 && c.x <= sizePx.x && c.y <= sizePx.y))
        decisions.warn(fmt::format("{}: the principal point ({}, {}) lies outside of the picture of {} x {}",
                                   matrix.name, c.x - 0.5, c.y - 0.5, sizePx.x, sizePx.y));
    const Unseen unseen = unseenOf(lens, sizePx);
    if (unseen.pixels == unseen.sampled)
        throw wrong(matrix, "a lens that shows something in the picture",
                    "a distortion that turns back before it reaches any pixel");
    if (unseen.pixels > 0)
        decisions.warn(
            fmt::format("the distortion turns back inside the picture: {:.1f} % of the pixels, "
                        "that at ({:.1f}, {:.1f}) for example, show nothing",
                        100.0 * unseen.pixels / unseen.sampled, unseen.first.x, unseen.first.y));
}

// --- Where it looks ---

glm::dmat3 rotationOf(const Field& field) {
    const std::vector<double> r =
        numbersOf(field, {3, 9}, "a rotation of 3 x 3 numbers or a vector of 3 (Rodrigues)");
    if (r.size() == 3) {
        const glm::dvec3 axis(r[0], r[1], r[2]);
        const double angleRad = glm::length(axis);
        return angleRad > 0 ? glm::mat3_cast(glm::angleAxis(angleRad, axis / angleRad)) : glm::dmat3(1);
    }
    const glm::dmat3 rows(r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8]);
    const glm::dmat3 rotation = glm::transpose(rows), product = rows * rotation;
    double off = 0;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            off = std::max(off, std::abs(product[column][row] - (column == row ? 1 : 0)));
    if (!(off < 1e-3 && glm::determinant(rotation) > 0))
        throw wrong(field, "a rotation", "a matrix that also stretches or mirrors");
    return rotation;
}

// Axes of another program in those of a wall.
const glm::dmat3 kDownAhead(1, 0, 0, 0, -1, 0, 0, 0, -1);  // y down, z ahead
const glm::dmat3 kAheadAbove(1, 0, 0, 0, 0, -1, 0, 1, 0);  // y ahead, z up

// The rotation of a stereo pair leads from the first device to the second.
bool isOfPair(const CameraFile& file, const Field& rotation) {
    const auto common = file.common.find(Role::rotation);
    return file.devices.size() > 1 && common != file.common.end() && common->second.name == rotation.name;
}

Orientation decideOrientation(const CameraFile& file, const std::string& device, Decisions& decisions) {
    const Field* field = file.find(device, Role::rotation);
    // Beside a projection matrix, R turns a picture until it is rectified.
    if (!field || file.find(device, Role::projection)) return {};
    const bool ofPair = isOfPair(file, *field);
    if (ofPair && device == file.devices.begin()->first) return {};
    enum class Meant { worldToCamera, cameraToWorld, nothing };
    const Meant meant = decisions.choose(
        "rotation",
        {{"world_to_camera", Meant::worldToCamera},
         {"camera_to_world", Meant::cameraToWorld},
         {"ignored", Meant::nothing}},
        Meant::worldToCamera,
        ofPair ? fmt::format("{} of a pair leads from the first device to the second, as cv::stereoCalibrate "
                             "has it; the first one's axes are the wall's",
                             field->name)
               : fmt::format("{} as cv::calibrateCamera and cv::solvePnP have it", field->name));
    if (meant == Meant::nothing) return {};
    glm::dmat3 wallFromWorld = kDownAhead;
    if (!ofPair)
        wallFromWorld = decisions.choose(
            "world_axes",
            {{"y_down_z_ahead", kDownAhead}, {"y_up_z_back", glm::dmat3(1)}, {"y_ahead_z_up", kAheadAbove}},
            kDownAhead, "those of OpenCV's cameras; nothing in the file tells");
    const glm::dmat3 rotation = rotationOf(*field);
    const glm::dmat3 worldFromCamera = meant == Meant::worldToCamera ? glm::transpose(rotation) : rotation;
    return orientationFromRotation(wallFromWorld * worldFromCamera * kDownAhead);
}

void warnOfDistance(const CameraFile& file, Decisions& decisions) {
    const auto found = file.common.find(Role::translation);
    if (file.devices.size() < 2 || found == file.common.end()) return;
    const std::vector<double> t = numbersOf(found->second, {3}, "a translation of 3 numbers");
    if (const double length = glm::length(glm::dvec3(t[0], t[1], t[2])); length > 0)
        decisions.warn(
            fmt::format("{}: the devices stand {} apart, in the file's unit; each display is what "
                        "its own lens sees",
                        found->second.name, length));
}

std::string displayName(const CameraFile& file, const std::string& device, const std::string& stem) {
    if (!device.empty()) return (device.find_first_of("0123456789") == 0 ? "camera" : "") + device;
    const std::string name = file.text("camera_name").value_or("");
    return name.empty() ? stem : name;
}

Display readDisplay(const CameraFile& file, const std::string& device, const CalibrationRequest& request,
                    Decisions decisions) {
    CameraIntrinsics intrinsics = readIntrinsics(file, device, decisions);
    intrinsics.distortion = readDistortion(file, device);
    const auto inFile = fileSize(file, device);
    Display display;
    display.projectionType = "camera";
    display.sizePx = decideCameraSize(request, inFile, intrinsics, decisions);
    scaleTo(display.sizePx, inFile, intrinsics);
    const LensModel model = decideModel(file, intrinsics, display.sizePx, decisions);
    if (model == LensModel::fisheye && intrinsics.distortion.size() > 4)
        throw wrong(*file.find(device, Role::distortion), "4 distortion coefficients of a fisheye",
                    std::to_string(intrinsics.distortion.size()));
    const LensPtr lens = lensOf(model, intrinsics);
    checkPlausible(*file.find(device, Role::matrix), intrinsics, *lens, display.sizePx, decisions);
    display.projection = std::make_shared<LensProjection>(lens, decideOrientation(file, device, decisions));
    listDecisions(decisions, display);
    return display;
}

}  // namespace

bool isCameraYaml(const FileBytes& file) {
    return file.bytes.starts_with("%YAML") || file.extension() == ".yml" || file.extension() == ".yaml";
}

Wall readCameraYaml(const FileBytes& file, const FindFile& /*find*/, const CalibrationRequest& request,
                    Decisions& decisions) {
    const CameraFile cameras = cameraFile(file);
    warnOfDistance(cameras, decisions);
    Wall wall{.name = file.stem(), .eyeM = request.eyeM.value_or(glm::dvec3(0))};
    std::set<std::string> taken;
    for (const auto& [device, fields] : cameras.devices) {
        wall.displays.push_back(readDisplay(cameras, device, request, decisions));
        wall.displays.back().name =
            uniqueName(safeDisplayName(displayName(cameras, device, file.stem())), taken);
    }
    return wall;
}

}  // namespace curvewall
