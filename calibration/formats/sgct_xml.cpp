#include "calibration/formats/sgct_xml.h"

#include "calibration/files/file_bytes.h"

#include <array>
#include <string>
#include <utility>

namespace curvewall {
namespace {

using nlohmann::json;

// Older names of the same things.
constexpr std::array<std::pair<const char*, const char*>, 7> kRenamed{{{"ip", "address"},
                                                                       {"mask", "blendmask"},
                                                                       {"heading", "yaw"},
                                                                       {"azimuth", "yaw"},
                                                                       {"elevation", "pitch"},
                                                                       {"bank", "roll"},
                                                                       {"rigorientation", "orientation"}}};

constexpr std::array<std::pair<const char*, const char*>, 11> kProjections{
    {{"planarprojection", "PlanarProjection"},
     {"texturemappedprojection", "TextureMappedProjection"},
     {"fisheyeprojection", "FisheyeProjection"},
     {"sphericalmirrorprojection", "SphericalMirrorProjection"},
     {"spoutoutputprojection", "CubemapProjection"},
     {"cubemapprojection", "CubemapProjection"},
     {"spoutflatprojection", "SpoutFlatProjection"},
     {"cylindricalprojection", "CylindricalProjection"},
     {"equirectangularprojection", "EquirectangularProjection"},
     {"viewplane", "ProjectionPlane"},
     {"projectionplane", "ProjectionPlane"}}};

std::string keyOf(const std::string& name) {
    std::string key = lowerCase(name);
    for (const auto& [old, current] : kRenamed)
        if (key == old) return current;
    return key;
}

json attributesOf(const XmlElement& element) {
    json object = json::object();
    for (const auto& [name, value] : element.attributes()) object[keyOf(name)] = value;
    return object;
}

// An element whose children have nothing but attributes.
json flatObject(const XmlElement& element) {
    json object = attributesOf(element);
    for (const XmlElement& child : element.children()) object[keyOf(child.name())] = attributesOf(child);
    return object;
}

json planeObject(const XmlElement& element) {
    const auto corners = element.children();
    if (corners.size() != 3)
        throw element.error("three corners: lower left, upper left, upper right",
                            std::to_string(corners.size()));
    return {{"lowerleft", attributesOf(corners[0])},
            {"upperleft", attributesOf(corners[1])},
            {"upperright", attributesOf(corners[2])}};
}

json projectionObject(const XmlElement& element, const std::string& type) {
    json object = type == "ProjectionPlane" ? planeObject(element) : flatObject(element);
    object["type"] = type;
    if (type != "SpoutFlatProjection") return object;
    if (const auto planar = element.child("PlanarProjection"))
        object["planarprojection"] = flatObject(*planar);
    return object;
}

json viewportObject(const XmlElement& element) {
    json object = attributesOf(element);
    for (const XmlElement& child : element.children()) {
        const std::string key = keyOf(child.name());
        const char* type = nullptr;
        for (const auto& [name, ofJson] : kProjections)
            if (key == name) type = ofJson;
        if (type)
            object["projection"] = projectionObject(child, type);
        else
            object[key] = attributesOf(child);
    }
    return object;
}

// The list of what `name` elements say, in the object that stands for their parent.
template <class ObjectOf>
json listOf(const XmlElement& parent, const char* name, const ObjectOf& objectOf) {
    json list = json::array();
    for (const XmlElement& element : parent.children(name)) list.push_back(objectOf(element));
    return list;
}

json windowObject(const XmlElement& element) {
    json object = flatObject(element);
    object.erase("viewport");
    object["viewports"] = listOf(element, "Viewport", viewportObject);
    if (const auto stereo = element.child("Stereo"))
        object["stereo"] = stereo->attribute("type").value_or("none");
    return object;
}

json nodeObject(const XmlElement& element) {
    json object = attributesOf(element);
    object["windows"] = listOf(element, "Window", windowObject);
    return object;
}

}  // namespace

json sgctJsonFromXml(const XmlElement& root) {
    json cluster = attributesOf(root);
    if (const auto scene = root.child("Scene")) {
        cluster["scene"] = flatObject(*scene);
        if (const auto scale = scene->child("Scale"))
            cluster["scene"]["scale"] = scale->attribute("value").value_or("1");
    }
    cluster["nodes"] = listOf(root, "Node", nodeObject);
    cluster["users"] = listOf(root, "User", flatObject);
    return cluster;
}

}  // namespace curvewall
