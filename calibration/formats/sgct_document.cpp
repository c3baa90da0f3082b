#include "calibration/formats/sgct_document.h"

#include "calibration/errors.h"
#include "calibration/files/json_fields.h"
#include "calibration/files/xml_document.h"
#include "calibration/formats/sgct_xml.h"
#include "calibration/projections/pose.h"
#include "calibration/readers/projection_fields.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <map>
#include <string_view>
#include <utility>

namespace curvewall {
namespace {

using nlohmann::json;

constexpr Range kAnyNumber{-1e9, 1e9};
constexpr Range kAngleDeg{-3600, 3600};
constexpr Range kFraction{0, 1};
constexpr size_t kMostParts = 256;  // nodes, windows, viewports or users of a configuration

// What the fields of one configuration find together.
struct SgctFindings {
    std::vector<std::string> unknownKeys{};
    std::map<std::string, size_t> parts{};  // by the key of their lists
};

// One JSON object, read leniently: numbers and truth values may be texts, as XML has them, and keys that
// nobody asks for are collected.
class SgctFields {
public:
    SgctFields(const json& object, std::string place, SgctFindings& findings)
        : object_(object), place_(std::move(place)), findings_(findings) {
        if (!object.is_object())
            throw FieldError(FieldError::Kind::shape, place_, "an object", describe(object));
    }

    const std::string& place() const { return place_; }
    std::string placeOf(const std::string& key) const { return place_.empty() ? key : place_ + "." + key; }

    std::optional<double> number(const char* key, Range range) {
        const json* value = find(key);
        if (!value) return std::nullopt;
        if (!value->is_string()) return *JsonFields(object_, place_).number(key, range);
        const auto number = finiteNumberFrom(value->get_ref<const std::string&>());
        if (!number) throw FieldError(FieldError::Kind::shape, placeOf(key), "a number", describe(*value));
        const json numbers{{key, *number}};
        return *JsonFields(numbers, place_).number(key, range);
    }

    double number(const char* key, Range range, double byDefault) {
        return number(key, range).value_or(byDefault);
    }

    double requiredNumber(const char* key, Range range) {
        const auto value = number(key, range);
        if (!value) throw FieldError(FieldError::Kind::shape, placeOf(key), "a number", "nothing");
        return *value;
    }

    bool truth(const char* key, bool byDefault) {
        const json* value = find(key);
        if (!value) return byDefault;
        if (value->is_boolean()) return value->get<bool>();
        const std::string word = value->is_string() ? lowerCase(value->get<std::string>()) : "";
        if (word != "true" && word != "false" && word != "1" && word != "0")
            throw FieldError(FieldError::Kind::shape, placeOf(key), "true or false", describe(*value));
        return word == "true" || word == "1";
    }

    std::string text(const char* key) {
        const json* value = find(key);
        if (!value || value->is_null()) return {};
        if (value->is_string()) return value->get<std::string>();
        if (value->is_number()) return value->dump();
        throw FieldError(FieldError::Kind::shape, placeOf(key), "a text", describe(*value));
    }

    std::optional<SgctFields> object(const char* key) {
        const json* value = find(key);
        if (!value || value->is_null()) return std::nullopt;
        return SgctFields(*value, placeOf(key), findings_);
    }

    SgctFields requiredObject(const char* key) {
        const auto fields = object(key);
        if (!fields) throw FieldError(FieldError::Kind::shape, placeOf(key), "an object", "nothing");
        return *fields;
    }

    std::vector<SgctFields> objects(const char* key) {
        const json* value = find(key);
        std::vector<SgctFields> list;
        if (!value) return list;
        if (!value->is_array())
            throw FieldError(FieldError::Kind::shape, placeOf(key), "a list of objects", describe(*value));
        if (const size_t count = findings_.parts[key] += value->size(); count > kMostParts)
            throw FieldError(FieldError::Kind::shape, placeOf(key),
                             fmt::format("at most {} {} in a configuration", kMostParts, key),
                             std::to_string(count));
        for (size_t i = 0; i < value->size(); ++i)
            list.emplace_back((*value)[i], fmt::format("{}[{}]", placeOf(key), i), findings_);
        return list;
    }

    bool has(const char* key) const { return object_.contains(key); }

    // Keys that say nothing of what is seen where.
    void ignore(std::initializer_list<const char*> keys) {
        known_.insert(known_.end(), keys.begin(), keys.end());
    }

    void collectUnknownKeys() const {
        for (const auto& [key, value] : object_.items())
            if (std::ranges::find(known_, key) == known_.end()) findings_.unknownKeys.push_back(placeOf(key));
    }

private:
    const json* find(const char* key) {
        known_.emplace_back(key);
        const auto found = object_.find(key);
        return found == object_.end() ? nullptr : &*found;
    }

    const json& object_;
    std::string place_;
    std::vector<std::string_view> known_;
    SgctFindings& findings_;
};

std::optional<glm::dvec2> readVector2(SgctFields& parent, const char* key, Range range) {
    auto fields = parent.object(key);
    if (!fields) return std::nullopt;
    return glm::dvec2(fields->requiredNumber("x", range), fields->requiredNumber("y", range));
}

glm::dvec3 readVector3(SgctFields fields) {
    return {fields.requiredNumber("x", kAnywhereM), fields.requiredNumber("y", kAnywhereM),
            fields.requiredNumber("z", kAnywhereM)};
}

glm::dvec3 readVector3(SgctFields& parent, const char* key) {
    const auto fields = parent.object(key);
    return fields ? readVector3(*fields) : glm::dvec3(0);
}

glm::dmat3 rotationAbout(glm::dvec3 axis, double angleDeg) {
    return glm::dmat3(glm::mat3_cast(glm::angleAxis(glm::radians(angleDeg), axis)));
}

glm::dmat3 readQuaternion(SgctFields& fields) {
    const glm::dquat q(fields.requiredNumber("w", kAnyNumber), fields.requiredNumber("x", kAnyNumber),
                       fields.requiredNumber("y", kAnyNumber), fields.requiredNumber("z", kAnyNumber));
    if (!(glm::length(q) > 1e-6))
        throw FieldError(FieldError::Kind::value, fields.place(), "a quaternion of length one", "zero");
    return glm::mat3_cast(glm::normalize(q));
}

// x, y and z without w are the angles about these axes, one after another; only XML has them.
glm::dmat3 readRotation(SgctFields& parent) {
    auto fields = parent.object("orientation");
    if (!fields) return glm::dmat3(1);
    if (fields->has("w")) return readQuaternion(*fields);
    if (fields->has("x") || fields->has("y") || fields->has("z"))
        return rotationAbout({1, 0, 0}, fields->number("x", kAngleDeg, 0)) *
               rotationAbout({0, 1, 0}, fields->number("y", kAngleDeg, 0)) *
               rotationAbout({0, 0, 1}, fields->number("z", kAngleDeg, 0));
    return rotationFromOrientation({glm::radians(fields->number("yaw", kAngleDeg, 0)),
                                    glm::radians(fields->number("pitch", kAngleDeg, 0)),
                                    glm::radians(fields->number("roll", kAngleDeg, 0))});
}

// The angle of one side: its own key, or half of the whole.
double sideDeg(SgctFields& fov, const char* side, const char* whole) {
    constexpr Range kSideDeg{-90, 90, true, true}, kWholeDeg{-180, 180, true, true};
    const auto both = fov.number(whole, kWholeDeg);
    if (const auto own = fov.number(side, kSideDeg)) return *own;
    if (both) return *both / 2;
    throw FieldError(FieldError::Kind::shape, fov.placeOf(side), std::string("a number, or ") + whole,
                     "nothing");
}

SgctPlanar readPlanar(SgctFields& fields, bool isTextureMapped) {
    constexpr Range kDistanceM{1e-6, kMostM};
    SgctPlanar planar{.isTextureMapped = isTextureMapped};
    SgctFields fov = fields.requiredObject("fov");
    planar.leftDeg = -sideDeg(fov, "left", "hfov");
    planar.rightDeg = sideDeg(fov, "right", "hfov");
    planar.downDeg = -sideDeg(fov, "down", "vfov");
    planar.upDeg = sideDeg(fov, "up", "vfov");
    planar.distanceM = fields.number("distance", kDistanceM);
    if (const auto ofFov = fov.number("distance", kDistanceM); ofFov && !planar.distanceM)
        planar.distanceM = ofFov;
    fov.collectUnknownKeys();
    planar.rotation = readRotation(fields);
    planar.offsetM = readVector3(fields, "offset");
    return planar;
}

SgctPlane readPlane(SgctFields& fields) {
    return {readVector3(fields.requiredObject("lowerleft")), readVector3(fields.requiredObject("upperleft")),
            readVector3(fields.requiredObject("upperright"))};
}

std::optional<glm::dvec3> readBackground(SgctFields& parent) {
    auto fields = parent.object("background");
    if (!fields) return std::nullopt;
    return glm::dvec3(fields->requiredNumber("r", kFraction), fields->requiredNumber("g", kFraction),
                      fields->requiredNumber("b", kFraction));
}

SgctFisheye readFisheye(SgctFields& fields) {
    SgctFisheye fisheye;
    fisheye.fovDeg = fields.number("fov", {1e-3, 360}, fisheye.fovDeg);
    fisheye.tiltDeg = fields.number("tilt", kAngleDeg, fisheye.tiltDeg);
    fisheye.diameterM = fields.number("diameter", {1e-6, kMostM}, fisheye.diameterM);
    if (auto crop = fields.object("crop")) {
        fisheye.cropLeft = crop->number("left", kFraction, 0);
        fisheye.cropRight = crop->number("right", kFraction, 0);
        fisheye.cropBottom = crop->number("bottom", kFraction, 0);
        fisheye.cropTop = crop->number("top", kFraction, 0);
        crop->collectUnknownKeys();
        if (!(fisheye.cropLeft + fisheye.cropRight < 1) || !(fisheye.cropBottom + fisheye.cropTop < 1))
            throw FieldError(FieldError::Kind::value, crop->place(), "something of the picture to be left",
                             "nothing");
    }
    fisheye.offsetRadii = readVector3(fields, "offset");
    fisheye.keepsAspect = fields.truth("keepaspectratio", true);
    fisheye.background = readBackground(fields);
    fields.ignore({"quality", "interpolation", "method"});
    return fisheye;
}

SgctCylinder readCylinder(SgctFields& fields) {
    SgctCylinder cylinder;
    cylinder.rotation = fields.number("rotation", kAngleDeg, 0);
    cylinder.heightOffset = fields.number("heightoffset", {-1e6, 1e6}, 0);
    cylinder.radiusM = fields.number("radius", {1e-6, kMostM}, cylinder.radiusM);
    fields.ignore({"quality"});
    return cylinder;
}

SgctMirror readMirror(SgctFields& fields) {
    SgctMirror mirror{.tiltDeg = fields.number("tilt", kAngleDeg, 0)};
    SgctFields meshes = fields.requiredObject("geometry");
    for (const auto& [key, mesh] : {std::pair{"bottom", &mirror.bottomMesh},
                                    {"left", &mirror.leftMesh},
                                    {"right", &mirror.rightMesh},
                                    {"top", &mirror.topMesh}}) {
        *mesh = meshes.text(key);
        if (mesh->empty())
            throw FieldError(FieldError::Kind::shape, meshes.placeOf(key), "a mesh file", "nothing");
    }
    meshes.collectUnknownKeys();
    fields.ignore({"quality", "background"});
    return mirror;
}

int readQuality(SgctFields& fields) {
    constexpr auto kWords = std::to_array<std::pair<std::string_view, int>>({{"", 512},
                                                                             {"low", 256},
                                                                             {"medium", 512},
                                                                             {"high", 1024},
                                                                             {"1k", 1024},
                                                                             {"1.5k", 1536},
                                                                             {"2k", 2048},
                                                                             {"4k", 4096},
                                                                             {"8k", 8192},
                                                                             {"16k", 16384}});
    const std::string quality = lowerCase(fields.text("quality"));
    for (const auto& [word, px] : kWords)
        if (quality == word) return px;
    return static_cast<int>(fields.number("quality", {1, kMostPx}, 512));
}

SgctCube readCube(SgctFields& fields) {
    SgctCube cube{.facePx = readQuality(fields)};
    if (auto channels = fields.object("channels")) {
        cube.right = channels->truth("right", true);
        cube.left = channels->truth("left", true);
        cube.bottom = channels->truth("bottom", true);
        cube.top = channels->truth("top", true);
        cube.front = channels->truth("zleft", true);
        cube.back = channels->truth("zright", true);
        channels->collectUnknownKeys();
    }
    if (auto orientation = fields.object("orientation")) {
        if (orientation->has("w"))
            throw FieldError(FieldError::Kind::value, orientation->place(), "yaw, pitch and roll",
                             "a quaternion");
        cube.yawDeg = orientation->number("yaw", kAngleDeg, 0);
        cube.pitchDeg = orientation->number("pitch", kAngleDeg, 0);
        cube.rollDeg = orientation->number("roll", kAngleDeg, 0);
        orientation->collectUnknownKeys();
    }
    fields.ignore({"spout", "spoutname", "ndi", "mapping", "mappingspoutname", "drawmain", "background"});
    return cube;
}

SgctProjection projectionOfType(SgctFields& fields, const std::string& type) {
    if (type == "PlanarProjection") return readPlanar(fields, false);
    if (type == "TextureMappedProjection") return readPlanar(fields, true);
    if (type == "ProjectionPlane") return readPlane(fields);
    if (type == "FisheyeProjection") return readFisheye(fields);
    if (type == "CylindricalProjection") return readCylinder(fields);
    if (type == "SphericalMirrorProjection") return readMirror(fields);
    if (type == "CubemapProjection" || type == "SpoutOutputProjection") return readCube(fields);
    if (type == "EquirectangularProjection") {
        fields.ignore({"quality"});
        return SgctEquirectangular{};
    }
    if (type == "SpoutFlatProjection") {
        fields.ignore({"width", "height", "background", "mappingspoutname", "drawmain"});
        SgctFields planar = fields.requiredObject("planarprojection");
        return readPlanar(planar, false);
    }
    return SgctUnknownProjection{type};
}

void readProjection(SgctFields& parent, SgctViewport& viewport) {
    auto fields = parent.object("projection");
    if (!fields) return;
    const std::string type = fields->text("type");
    viewport.projection = projectionOfType(*fields, type);
    viewport.hasProjection = true;
    if (!std::holds_alternative<SgctUnknownProjection>(viewport.projection)) fields->collectUnknownKeys();
}

SgctViewport readViewport(SgctFields& fields) {
    SgctViewport viewport{.place = fields.place(), .name = fields.text("name")};
    viewport.position = readVector2(fields, "pos", {-16, 16}).value_or(glm::dvec2(0));
    viewport.size = readVector2(fields, "size", {0, 16}).value_or(glm::dvec2(1));
    readProjection(fields, viewport);
    viewport.mesh = fields.text("mesh");
    viewport.blendMask = fields.text("blendmask");
    viewport.blackLevelMask = fields.text("blacklevelmask");
    viewport.overlay = fields.text("overlay");
    viewport.user = fields.text("user");
    viewport.eye = lowerCase(fields.text("eye"));
    if (!viewport.eye.empty() && viewport.eye != "center" && viewport.eye != "left" &&
        viewport.eye != "right")
        throw FieldError(FieldError::Kind::value, fields.placeOf("eye"), "center, left or right",
                         "\"" + viewport.eye + "\"");
    fields.ignore({"tracked"});
    fields.collectUnknownKeys();
    return viewport;
}

SgctWindow readWindow(SgctFields& fields) {
    constexpr Range kSidePx{1, 1 << 16};
    SgctWindow window{.place = fields.place(), .name = fields.text("name")};
    const auto size = readVector2(fields, "size", kSidePx);
    const auto resolution = readVector2(fields, "res", kSidePx);
    if (resolution)
        window.sizePx = glm::ivec2(*resolution);
    else if (size)
        window.sizePx = glm::ivec2(*size);
    if (const std::string stereo = lowerCase(fields.text("stereo")); !stereo.empty()) window.stereo = stereo;
    window.isMirroredX = fields.truth("mirrorx", false) || fields.truth("mirror", false);
    window.isMirroredY = fields.truth("mirrory", false);
    window.drawsScene = fields.truth("draw3d", true);
    if (const auto number = fields.number("blitwindowid", {-1, 1 << 16}); number && *number >= 0)
        window.copyOf = static_cast<int>(*number);
    window.mpcdi = fields.text("mpcdi");
    window.scalableMesh = fields.text("scalablemesh");
    for (SgctFields& viewport : fields.objects("viewports"))
        window.viewports.push_back(readViewport(viewport));
    fields.ignore({"id",
                   "pos",
                   "tags",
                   "fullscreen",
                   "floating",
                   "msaa",
                   "numberofsamples",
                   "fxaa",
                   "border",
                   "decorated",
                   "resizable",
                   "hidden",
                   "alwaysrender",
                   "autoiconify",
                   "hidemousecursor",
                   "takescreenshot",
                   "alpha",
                   "draw2d",
                   "noerror",
                   "monitor",
                   "spout",
                   "spoutname",
                   "ndi",
                   "bufferbitdepth",
                   "dbuffered"});
    fields.collectUnknownKeys();
    return window;
}

SgctNode readNode(SgctFields& fields) {
    SgctNode node{.address = fields.text("address")};
    for (SgctFields& window : fields.objects("windows")) node.windows.push_back(readWindow(window));
    fields.ignore({"name", "port", "syncport", "datatransferport", "swaplock"});
    fields.collectUnknownKeys();
    return node;
}

SgctUser readUser(SgctFields& fields, Decisions& decisions) {
    SgctUser user{.name = fields.text("name")};
    user.positionM = readVector3(fields, "pos");
    user.eyeSeparationM = fields.number("eyeseparation", {0, 10}, user.eyeSeparationM);
    for (const char* key : {"matrix", "orientation", "tracking"})
        if (fields.has(key)) decisions.warn(fields.placeOf(key) + ": not used; the eye is at the user's pos");
    fields.ignore({"matrix", "orientation", "tracking"});
    fields.collectUnknownKeys();
    return user;
}

// The scene's pose is a matter of the camera, not of the wall.
void warnOfScene(SgctFields& root, Decisions& decisions) {
    auto scene = root.object("scene");
    if (!scene) return;
    const bool isMoved =
        readVector3(*scene, "offset") != glm::dvec3(0) || readRotation(*scene) != glm::dmat3(1);
    if (isMoved || scene->number("scale", kAnyNumber, 1) != 1)
        decisions.warn(
            "scene: its offset, orientation and scale move the scene, not the wall; give the camera "
            "that pose");
}

SgctDocument readCluster(const json& root, Decisions& decisions) {
    SgctFindings findings;
    SgctFields fields(root, "", findings);
    SgctDocument document;
    for (SgctFields& node : fields.objects("nodes")) document.nodes.push_back(readNode(node));
    for (SgctFields& user : fields.objects("users")) document.users.push_back(readUser(user, decisions));
    warnOfScene(fields, decisions);
    if (const std::vector<std::string>& unknown = findings.unknownKeys; !unknown.empty()) {
        constexpr size_t kMostNamed = 8;
        std::string names;
        for (size_t i = 0; i < std::min(unknown.size(), kMostNamed); ++i)
            names += (i == 0 ? "" : ", ") + unknown[i];
        if (unknown.size() > kMostNamed) names += fmt::format(" and {} more", unknown.size() - kMostNamed);
        decisions.warn("not known and passed over: " + names);
    }
    return document;
}

}  // namespace

bool isSgctDocument(const FileBytes& file) {
    const std::string_view bytes = file.bytes;
    if (looksLikeXml(bytes)) {
        constexpr std::string_view kRoot = "<cluster";
        const auto same = [](char c, char root) {
            return c == root || (c >= 'A' && c <= 'Z' && c - 'A' + 'a' == root);
        };
        return std::search(bytes.begin(), bytes.end(), kRoot.begin(), kRoot.end(), same) != bytes.end();
    }
    const size_t first = bytes.find_first_not_of("\xEF\xBB\xBF \t\r\n");
    return first != std::string_view::npos && bytes[first] == '{' &&
           bytes.find("\"nodes\"") != std::string_view::npos;
}

SgctDocument readSgctDocument(const FileBytes& file, Decisions& decisions) {
    const bool isXml = looksLikeXml(file.bytes);
    try {
        json root;
        if (isXml) {
            const XmlElement cluster = parseXml(file);
            if (lowerCase(cluster.name()) != "cluster")
                throw cluster.error("a root element Cluster", cluster.name());
            root = sgctJsonFromXml(cluster);
        } else {
            root = parseJson(file.bytes);
        }
        SgctDocument document = readCluster(root, decisions);
        document.isXml = isXml;
        return document;
    } catch (const JsonSyntaxError& error) {
        throw InputError(file.path, "", "JSON", error.what());
    } catch (const FieldError& error) {
        throw InputError(file.path, error.field, error.expected, error.found);
    }
}

}  // namespace curvewall
