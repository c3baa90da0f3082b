#include "calibration/formats/mpcdi_document.h"

#include "calibration/errors.h"
#include "calibration/files/map_file.h"
#include "calibration/files/xml_document.h"

#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace curvewall {
namespace {

constexpr size_t kMostRegions = 1024;

std::string attributeText(const XmlElement& element, std::string_view name) {
    return element.attribute(name).value_or("");
}

std::string childText(const XmlElement& element, std::string_view name) {
    const auto child = element.child(name);
    return child ? child->text() : "";
}

std::optional<glm::ivec2> resolutionOf(const XmlElement& element) {
    const auto side = [&](std::string_view name) {
        const auto number = element.attributeNumber(name);
        if (number && !(*number >= 1 && *number <= double{kMostPx} && *number == std::floor(*number)))
            throw InputError(element.path(), element.place() + "/@" + std::string(name),
                             "a whole number from 1 to 16384", attributeText(element, name));
        return number;
    };
    const auto x = side("xResolution"), y = side("yResolution");
    if (!x || !y) return std::nullopt;
    return glm::ivec2(*x, *y);
}

double requiredChild(const XmlElement& element, std::string_view name) {
    const auto number = element.childNumber(name);
    if (!number) throw element.error(std::string(name), "none");
    return *number;
}

MpcdiFrustum frustumOf(const XmlElement& element) {
    const auto angle = [&](std::string_view name) { return element.childNumber(name).value_or(0); };
    return {.yawDeg = angle("yaw"),
            .pitchDeg = angle("pitch"),
            .rollDeg = angle("roll"),
            .rightDeg = requiredChild(element, "rightAngle"),
            .leftDeg = requiredChild(element, "leftAngle"),
            .upDeg = requiredChild(element, "upAngle"),
            .downDeg = requiredChild(element, "downAngle")};
}

glm::dvec3 vectorOf(const XmlElement& element, const std::string& name) {
    return {requiredChild(element, name + "x"), requiredChild(element, name + "y"),
            requiredChild(element, name + "z")};
}

MpcdiFrame frameOf(const XmlElement& element) {
    MpcdiFrame frame{vectorOf(element, "pos"), vectorOf(element, "yaw"), vectorOf(element, "pitch"),
                     vectorOf(element, "roll")};
    constexpr double kUnit = 1e-3;
    const auto dot = [](glm::dvec3 a, glm::dvec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
    for (const glm::dvec3 axis : {frame.yaw, frame.pitch, frame.roll})
        if (!(std::abs(dot(axis, axis) - 1) < kUnit))
            throw element.error("axes of length one", std::to_string(std::sqrt(dot(axis, axis))));
    if (!(std::abs(dot(frame.yaw, frame.pitch)) < kUnit && std::abs(dot(frame.yaw, frame.roll)) < kUnit &&
          std::abs(dot(frame.pitch, frame.roll)) < kUnit))
        throw element.error("axes at right angles", "others");
    return frame;
}

// Every region of an id gets a copy of both.
constexpr size_t kMostWord = 64, kMostPath = 4096;

std::string pathOf(const XmlElement& element) {
    std::string path = childText(element, "path");
    if (path.size() > kMostPath) throw element.error("a path of at most 4096 bytes", "a longer one");
    return path;
}

std::optional<MpcdiWarp> warpOf(const std::optional<XmlElement>& element) {
    if (!element || childText(*element, "path").empty()) return std::nullopt;
    const auto word = [&](const char* name) {
        return lowerCase(childText(*element, name)).substr(0, kMostWord);
    };
    return MpcdiWarp{pathOf(*element), word("interpolation"), word("geometricUnit"), word("originOf3DData")};
}

std::optional<MpcdiPicture> pictureOf(const std::optional<XmlElement>& element) {
    if (!element || childText(*element, "path").empty()) return std::nullopt;
    const auto gamma = element->childNumber("gammaEmbedded");
    if (gamma && !(*gamma >= 0.1 && *gamma <= 10))
        throw element->error("a gammaEmbedded from 0.1 to 10", std::to_string(*gamma));
    return MpcdiPicture{pathOf(*element), gamma};
}

MpcdiFisheye fisheyeOf(const XmlElement& fisheye, const std::optional<XmlElement>& anamorphic) {
    MpcdiFisheye lens;
    const auto number = [&](const std::string& name) {
        constexpr double kMost = 1e6;
        const double value = fisheye.childNumber(name).value_or(0);
        if (std::abs(value) > kMost) throw fisheye.error(name + " within a million", std::to_string(value));
        return value;
    };
    lens.offset = {number("horizontalOffset"), number("verticalOffset")};
    for (size_t i = 0; i < lens.coefficients.size(); ++i)
        lens.coefficients[i] = number("f" + std::to_string(i + 1));
    if (anamorphic) {
        const auto ratio = anamorphic->childNumber("ratio");
        lens.anamorphicRatio =
            ratio ? *ratio : anamorphic->childNumber("aspect").value_or(1);  // the older spelling
        if (!(lens.anamorphicRatio >= 0.01 && lens.anamorphicRatio <= 100))
            throw anamorphic->error("a ratio from 0.01 to 100", std::to_string(lens.anamorphicRatio));
        lens.anamorphicDeg = anamorphic->childNumber("angle").value_or(0);
    }
    return lens;
}

MpcdiFiles filesOf(const XmlElement& element) {
    MpcdiFiles files{warpOf(element.child("geometryWarpFile")),
                     warpOf(element.child("distortionMap")),
                     pictureOf(element.child("alphaMap")),
                     pictureOf(element.child("betaMap")),
                     {}};
    for (const char* name : {"decodeLUT", "correctLUT", "encodeLUT"})
        if (const auto table = element.child(name); table && !childText(*table, "path").empty())
            files.unread.insert(name);
    return files;
}

// What is named twice is what came first.
void addFiles(MpcdiFiles& files, const MpcdiFiles& more) {
    const auto add = [](auto& place, const auto& value) {
        if (!place) place = value;
    };
    add(files.warp, more.warp);
    add(files.distortion, more.distortion);
    add(files.alpha, more.alpha);
    add(files.beta, more.beta);
    files.unread.insert(more.unread.begin(), more.unread.end());
}

MpcdiRegion regionOf(const XmlElement& element, const std::string& place) {
    MpcdiRegion region;
    region.id = attributeText(element, "id");
    region.place = place;
    const auto fraction = [&](std::string_view name, double otherwise) {
        return element.attributeNumber(name).value_or(otherwise);
    };
    region.origin = {fraction("x", 0), fraction("y", 0)};
    region.size = {fraction("xsize", 1), fraction("ysize", 1)};
    region.sizePx = resolutionOf(element);
    if (const auto frustum = element.child("frustum"); frustum && !frustum->children().empty())
        region.frustum = frustumOf(*frustum);
    if (const auto frame = element.child("coordinateFrame"); frame && !frame->children().empty())
        region.frame = frameOf(*frame);
    addFiles(region, filesOf(element));
    return region;
}

// Those of one id. They are read when a region asks for them, and once for all regions of that id.
struct FileSets {
    std::vector<XmlElement> unread;
    MpcdiFiles files;

    const MpcdiFiles& read() {
        for (const XmlElement& set : unread) addFiles(files, filesOf(set));
        unread.clear();
        return files;
    }
};

// What the file says of regions elsewhere, by their id.
struct Elsewhere {
    std::map<std::string, FileSets> fileSets;
    std::map<std::pair<std::string, std::string>, XmlElement> extended;  // by the buffer's id first
};

Elsewhere readElsewhere(const XmlElement& root) {
    Elsewhere elsewhere;
    for (const XmlElement& set : root.descendants("fileset"))
        elsewhere.fileSets[attributeText(set, "region")].unread.push_back(set);
    for (const XmlElement& extension : root.descendants("extension"))
        for (const XmlElement& buffer : extension.children("buffer"))
            for (const XmlElement& region : buffer.children("region"))
                if (region.child("fisheye"))
                    elsewhere.extended.try_emplace({attributeText(buffer, "id"), attributeText(region, "id")},
                                                   region);
    return elsewhere;
}

bool hasPose(const MpcdiDocument& document) { return document.profile == "3d" || document.profile == "sl"; }

// What XmlElement::place is, without counting all siblings again for each element.
std::string placeOf(const std::string& parent, const std::vector<XmlElement>& elements, size_t index) {
    return parent + "/" + elements[index].name() +
           (elements.size() > 1 ? "[" + std::to_string(index) + "]" : "");
}

}  // namespace

MpcdiDocument parseMpcdi(const FileBytes& manifest) {
    const XmlElement root = parseXml(manifest);
    if (lowerCase(root.name()) != "mpcdi")
        throw InputError(manifest.path, "", "an MPCDI manifest", "the element \"" + root.name() + "\"");
    MpcdiDocument document{
        manifest.path, lowerCase(attributeText(root, "profile")), attributeText(root, "version"), {}};
    const auto display = root.child("display");
    if (!display) throw root.error("a display", "none");
    Elsewhere elsewhere = readElsewhere(root);
    size_t count = 0;
    const std::vector<XmlElement> buffers = display->children("buffer");
    const std::string displayPlace = display->place();
    for (size_t b = 0; b < buffers.size(); ++b) {
        const XmlElement& buffer = buffers[b];
        const std::vector<XmlElement> regions = buffer.children("region");
        const std::string bufferPlace = placeOf(displayPlace, buffers, b);
        document.buffers.push_back({attributeText(buffer, "id"), resolutionOf(buffer), {}});
        for (size_t r = 0; r < regions.size(); ++r) {
            if (++count > kMostRegions) throw display->error("at most 1024 regions", "more");
            MpcdiRegion region = regionOf(regions[r], placeOf(bufferPlace, regions, r));
            if (const auto sets = elsewhere.fileSets.find(region.id); sets != elsewhere.fileSets.end())
                addFiles(region, sets->second.read());
            if (const auto extended = elsewhere.extended.find({document.buffers.back().id, region.id});
                extended != elsewhere.extended.end())
                region.fisheye =
                    fisheyeOf(*extended->second.child("fisheye"), extended->second.child("anamorphic"));
            document.buffers.back().regions.push_back(std::move(region));
        }
    }
    if (count == 0) throw display->error("a buffer with a region", "none");
    return document;
}

std::vector<std::string> brokenRules(const MpcdiDocument& document) {
    std::vector<std::string> broken;
    if (hasPose(document) && document.buffers.size() != 1)
        broken.push_back("display: profile " + document.profile + " has one buffer, and there are " +
                         std::to_string(document.buffers.size()));
    std::set<std::string> origins;
    for (const MpcdiBuffer& buffer : document.buffers)
        for (const MpcdiRegion& region : buffer.regions)
            if (region.warp && !region.warp->origin.empty()) origins.insert(region.warp->origin);
    if (origins.size() > 1) broken.emplace_back("files: regions with different values of originOf3DData");
    return broken;
}

std::vector<std::string> brokenRules(const MpcdiDocument& document, const MpcdiRegion& region) {
    std::vector<std::string> broken;
    const glm::dvec2 end = region.origin + region.size;
    constexpr double kRounding = 1e-6;
    if (!glm::all(glm::greaterThanEqual(region.origin, glm::dvec2(-kRounding))) ||
        !glm::all(glm::lessThanEqual(end, glm::dvec2(1 + kRounding))) ||
        !glm::all(glm::greaterThan(region.size, glm::dvec2(0))))
        broken.emplace_back("lies outside of its buffer");
    if (!region.sizePx) broken.emplace_back("no resolution");
    if (hasPose(document) && !region.frustum)
        broken.push_back("profile " + document.profile + " needs a frustum");
    if (document.profile == "sl" && !region.frame) broken.emplace_back("profile sl needs a coordinateFrame");
    if (document.version.starts_with("1") && !region.alpha)
        broken.emplace_back("MPCDI 1.0 needs an alphaMap");
    return broken;
}

}  // namespace curvewall
