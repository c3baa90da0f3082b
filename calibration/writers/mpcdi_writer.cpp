#include "calibration/writers/mpcdi_writer.h"

#include "calibration/errors.h"
#include "calibration/files/file_bytes.h"
#include "calibration/writers/map_conversion.h"
#include "calibration/writers/map_writer.h"
#include "calibration/writers/ray_grid.h"
#include "calibration/writers/zip_writer.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <chrono>
#include <pugixml.hpp>
#include <sstream>
#include <utility>

namespace curvewall {
namespace {

void addText(pugi::xml_node parent, const char* name, const std::string& text) {
    parent.append_child(name).text().set(text.c_str());
}

void addNumber(pugi::xml_node parent, const char* name, double number) {
    addText(parent, name, fmt::format("{}", number));
}

bool needsSurface(const Display& display) {
    return display.projection->dependsOnEye() || !fitsFrustum(viewCone(rayGrid(display, std::nullopt)));
}

// Regions beside each other, in as many rows as the widest buffer that readers take needs: the standard
// allows one buffer only where it allows frusta.
struct Layout {
    glm::ivec2 bufferPx{0};
    std::vector<glm::ivec2> topLeftPx;
};

Layout layoutOf(const std::vector<const Display*>& displays) {
    constexpr int kMostPx = 16384;
    Layout layout;
    glm::ivec2 next(0);
    for (const Display* display : displays) {
        if (next.x + display->sizePx.x > kMostPx) next = {0, layout.bufferPx.y};
        layout.topLeftPx.push_back(next);
        layout.bufferPx = glm::max(layout.bufferPx, next + display->sizePx);
        if (layout.bufferPx.y > kMostPx)
            throw UsageError(fmt::format(
                "display \"{}\" does not fit with the others into one archive, whose buffer has at "
                "most {} x {} pixels; --display converts one",
                display->name, kMostPx, kMostPx));
        next.x += display->sizePx.x;
    }
    return layout;
}

class Archive {
public:
    Archive(bool isSurface, const Layout& layout, std::string scratch)
        : isSurface_(isSurface), bufferPx_(layout.bufferPx), scratch_(std::move(scratch)) {
        pugi::xml_node declaration = xml_.append_child(pugi::node_declaration);
        declaration.append_attribute("version") = "1.0";
        declaration.append_attribute("encoding") = "utf-8";
        pugi::xml_node root = xml_.append_child("MPCDI");
        root.append_attribute("profile") = isSurface ? "a3d" : "3d";
        root.append_attribute("level") = "4";  // a node a pixel, alpha and beta
        root.append_attribute("version") = "1.0";
        const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
        root.append_attribute("date") = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now)).c_str();
        buffer_ = root.append_child("display").append_child("buffer");
        buffer_.append_attribute("id") = "buffer";
        buffer_.append_attribute("Xresolution") = bufferPx_.x;
        buffer_.append_attribute("Yresolution") = bufferPx_.y;
        files_ = root.append_child("files");
    }

    void add(const Display& display, glm::ivec2 topLeftPx) {
        pugi::xml_node region = addRegion(display, topLeftPx);
        pugi::xml_node fileset = files_.append_child("fileset");
        fileset.append_attribute("region") = display.name.c_str();
        const std::string name = fmt::format("region{}", ++regions_);
        const RayGrid grid = rayGrid(display, std::nullopt);
        pugi::xml_node warp = fileset.append_child("geometryWarpFile");
        addText(warp, "path", name + "-warp.pfm");
        addText(warp, "interpolation", "linear");
        if (isSurface_) {
            addText(warp, "geometricUnit", "m");
            addText(warp, "originOf3DData", "idealEyePoint");
            addWallAxes(region);
            members_.push_back(
                {name + "-warp.pfm", pfmBytes(surfacePoints(grid, glm::dvec3(0), glm::dvec3(0)))});
        } else {
            const Frustum frustum = frustumAround(grid, viewCone(grid));
            addFrustum(region, frustum);
            members_.push_back({name + "-warp.pfm", pfmBytes(imageFractions(grid, frustum))});
        }
        const BlendMaps none, &blend = display.blend ? *display.blend : none;
        addMap(fileset, "alphaMap", name + "-alpha.png", display.sizePx, blend.alpha, 1);
        addMap(fileset, "betaMap", name + "-beta.png", display.sizePx, blend.beta, 0);
    }

    void write(const std::string& path) {
        std::ostringstream manifest;
        xml_.save(manifest, "  ");
        members_.insert(members_.begin(), {"mpcdi.xml", manifest.str()});
        writeZip(path, members_);
    }

private:
    pugi::xml_node addRegion(const Display& display, glm::ivec2 topLeftPx) {
        pugi::xml_node region = buffer_.append_child("region");
        region.append_attribute("id") = display.name.c_str();
        const auto add = [&](const char* name, int px, int ofPx) {
            region.append_attribute(name) = fmt::format("{}", static_cast<double>(px) / ofPx).c_str();
        };
        add("x", topLeftPx.x, bufferPx_.x);
        add("y", topLeftPx.y, bufferPx_.y);
        add("xsize", display.sizePx.x, bufferPx_.x);
        add("ysize", display.sizePx.y, bufferPx_.y);
        region.append_attribute("Xresolution") = display.sizePx.x;
        region.append_attribute("Yresolution") = display.sizePx.y;
        return region;
    }

    static void addFrustum(pugi::xml_node region, const Frustum& frustum) {
        pugi::xml_node node = region.append_child("frustum");
        addNumber(node, "yaw", glm::degrees(frustum.orientation.yawRad));
        addNumber(node, "pitch", glm::degrees(frustum.orientation.pitchRad));
        addNumber(node, "roll", glm::degrees(frustum.orientation.rollRad));
        addNumber(node, "rightAngle", glm::degrees(frustum.rightRad));
        addNumber(node, "leftAngle", glm::degrees(frustum.leftRad));
        addNumber(node, "upAngle", glm::degrees(frustum.upRad));
        addNumber(node, "downAngle", glm::degrees(frustum.downRad));
    }

    // The tips of an aircraft's axes: pitch points right, roll ahead and yaw down.
    static void addWallAxes(pugi::xml_node region) {
        pugi::xml_node frame = region.append_child("coordinateFrame");
        for (const auto& [name, axis] :
             {std::pair{"pos", glm::ivec3(0)}, std::pair{"yaw", glm::ivec3(0, -1, 0)},
              std::pair{"pitch", glm::ivec3(1, 0, 0)}, std::pair{"roll", glm::ivec3(0, 0, -1)}})
            for (int i = 0; i < 3; ++i)
                addText(frame, (std::string(name) + "xyz"[i]).c_str(), std::to_string(axis[i]));
    }

    void addMap(pugi::xml_node fileset, const char* element, const std::string& file, glm::ivec2 sizePx,
                const std::vector<glm::vec3>& light, float otherwise) {
        const bool isGrey = std::ranges::all_of(light, [](glm::vec3 v) { return v.r == v.g && v.g == v.b; });
        NumberMap map{sizePx, isGrey ? 1 : 3, true, {}};
        const size_t pixels = static_cast<size_t>(sizePx.x) * static_cast<size_t>(sizePx.y);
        map.values.reserve(pixels * static_cast<size_t>(map.channels));
        for (size_t i = 0; i < pixels; ++i) {
            const glm::vec3 value = glm::clamp(light.empty() ? glm::vec3(otherwise) : light[i], 0.0F, 1.0F);
            for (int c = 0; c < map.channels; ++c) map.values.push_back(value[c]);
        }
        writePng16(scratch_, map);
        members_.push_back({file, readFile(scratch_, "a picture").bytes});
        pugi::xml_node node = fileset.append_child(element);
        addText(node, "path", file);
        addText(node, "componentDepth", std::to_string(map.channels));
        addText(node, "bitDepth", "16");
        addText(node, "gammaEmbedded", "1.0");
    }

    bool isSurface_;
    glm::ivec2 bufferPx_;
    std::string scratch_;
    pugi::xml_document xml_;
    pugi::xml_node buffer_, files_;
    int regions_ = 0;
    std::vector<ZipMember> members_;
};

}  // namespace

void writeMpcdi(const std::string& path, const std::vector<const Display*>& displays,
                const std::string& scratch) {
    const Layout layout = layoutOf(displays);
    const bool isSurface =
        std::ranges::any_of(displays, [](const Display* display) { return needsSurface(*display); });
    Archive archive(isSurface, layout, scratch);
    for (size_t i = 0; i < displays.size(); ++i) archive.add(*displays[i], layout.topLeftPx[i]);
    archive.write(path);
}

}  // namespace curvewall
