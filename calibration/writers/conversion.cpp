#include "calibration/writers/conversion.h"

#include "calibration/errors.h"
#include "calibration/readers/wall_reader.h"
#include "calibration/writers/bourke_writer.h"
#include "calibration/writers/map_conversion.h"
#include "calibration/writers/map_writer.h"
#include "calibration/writers/mpcdi_writer.h"
#include "calibration/writers/staged_files.h"
#include "calibration/writers/wall_writer.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

namespace curvewall {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string nameOf(const std::string& path) { return fs::path(path).filename().string(); }

// The entry of one display in the wall file, and the files that it names.
struct Written {
    Json entry;
    std::vector<std::string> files;
    glm::ivec2 nodes{0};
};

class Converter {
public:
    Converter(const Wall& wall, const ConversionRequest& request)
        : wall_(wall),
          request_(request),
          staged_(fs::path(request.paths.front()).parent_path()),
          wallName_(nameOf(request.wallPath)) {}

    std::vector<ConvertedDisplay> convert() {
        std::vector<ConvertedDisplay> converted;
        std::vector<std::string> files;
        std::vector<Json> entries;
        for (size_t i = 0; i < request_.displays.size(); ++i) {
            const Display& display = *request_.displays[i];
            const std::string& path = request_.paths.at(request_.kind == ConvertedKind::mpcdi ? 0 : i);
            converted.push_back({display.name, path, request_.grid.value_or(display.sizePx), {}});
            if (request_.kind == ConvertedKind::mpcdi) continue;
            Written written = write(display, nameOf(path));
            converted.back().nodes = written.nodes;
            files.insert(files.end(), written.files.begin(), written.files.end());
            entries.push_back(std::move(written.entry));
        }
        if (request_.kind == ConvertedKind::mpcdi) {
            files.push_back(nameOf(request_.paths.front()));
            writeMpcdi(staged_.path(files.back()), request_.displays, staged_.path("scratch.png"));
        } else {
            files.push_back(wallName_);
            writeBytes(staged_.path(wallName_), wallFile(wall_, entries));
        }
        requireNotInput(files);
        measure(staged_.path(files.back()), converted);
        staged_.publish(files);
        return converted;
    }

private:
    Written write(const Display& display, const std::string& file) const {
        if (request_.kind == ConvertedKind::bourke) return writeBourke(display, file);
        const RayGrid grid = rayGrid(display, request_.grid);
        Written written = request_.kind == ConvertedKind::cameraTexture
                              ? writeCameraTexture(display, grid, file)
                              : writePoints(display, grid, file);
        written.nodes = grid.nodes;
        addBlend(display, fs::path(file).stem().string(), written);
        return written;
    }

    Written writeCameraTexture(const Display& display, const RayGrid& grid, const std::string& file) const {
        const ViewCone cone = viewCone(grid);
        if (!fitsFrustum(cone))
            throw UsageError(
                fmt::format("display \"{}\" sees {:.0f} degrees, and a camera texture distorts a flat "
                            "picture, which holds "
                            "less than 170; surface-map holds every view",
                            display.name, 2 * glm::degrees(cone.halfAngleRad)));
        const Frustum frustum = frustumAround(grid, cone);
        writeExr(staged_.path(file), imageOffsets(grid, frustum, display.sizePx));
        return {cameraTextureEntry(display, file, grid.alignment, frustum), {file}};
    }

    Written writePoints(const Display& display, const RayGrid& grid, const std::string& file) const {
        const NumberMap points = surfacePoints(grid, wall_.eyeM, glm::dvec3(0));
        if (request_.kind == ConvertedKind::pfm)
            writeBytes(staged_.path(file), pfmBytes(points));
        else
            writeExr(staged_.path(file), points);
        return {surfaceMapEntry(display, file, grid.alignment), {file}};
    }

    Written writeBourkeGrid(const Display& display, const std::string& file, glm::ivec2 nodes) const {
        const RayGrid grid = rayGrid(display, nodes);
        const FisheyeSource source = fisheyeSource(grid, display.sizePx);
        const BourkeMesh mesh = bourkeMesh(display, grid, source);
        writeBytes(staged_.path(file), mesh.text);
        return {bourkeEntry(display, file, source, mesh.hasIntensity), {file}, nodes};
    }

    // Without a grid that was asked for, the coarsest of a few that is good enough.
    Written writeBourke(const Display& display, const std::string& file) const {
        if (request_.grid) return writeBourkeGrid(display, file, *request_.grid);
        constexpr int kFewest = 32, kMost = 512;
        constexpr double kGoodEnoughPx = 0.25, kFewLost = 0.005;
        const double aspect = static_cast<double>(display.sizePx.y) / display.sizePx.x;
        for (int columns = kFewest;; columns *= 2) {
            const int rows = std::clamp(static_cast<int>(std::lround(columns * aspect)), 2, 4 * kMost);
            Written written = writeBourkeGrid(display, file, {columns, rows});
            if (columns == kMost || columns >= display.sizePx.x) return written;
            writeBytes(staged_.path(wallName_), wallFile(wall_, {written.entry}));
            const Wall read = readWall(staged_.path(wallName_));
            const ConversionError error = conversionError(display, read.displays.front());
            const double pixels = static_cast<double>(display.sizePx.x) * display.sizePx.y;
            if (error.maxPx < kGoodEnoughPx && static_cast<double>(error.holesGained) < kFewLost * pixels)
                return written;
        }
    }

    // As floats, so that nothing is lost.
    void addBlend(const Display& display, const std::string& stem, Written& written) const {
        if (!display.blend) return;
        Json blend = Json::object();
        const auto add = [&](const char* key, const std::vector<glm::vec3>& light) {
            if (light.empty()) return;
            NumberMap map{display.sizePx, 3, false, {}};
            for (const glm::vec3 value : light)
                for (int c = 0; c < 3; ++c) map.values.push_back(std::clamp(value[c], 0.0F, 1.0F));
            const std::string file = stem + "-" + key + ".exr";
            writeExr(staged_.path(file), map);
            written.files.push_back(file);
            blend[key] = file;
        };
        add("alpha", display.blend->alpha);
        add("beta", display.blend->beta);
        if (!blend.empty()) written.entry["blend"] = std::move(blend);
    }

    void requireNotInput(const std::vector<std::string>& files) const {
        std::set<std::string> names;
        for (const std::string& file : files) {
            const std::string target = (fs::path(request_.paths.front()).parent_path() / file).string();
            if (!names.insert(file).second) throw UsageError(target + " would be written twice");
            // By what is on the disk: a file has many names, by links and by disks that ignore letter case.
            const bool isRead = std::ranges::any_of(wall_.files, [&](const std::string& read) {
                std::error_code missing;
                return fs::equivalent(target, read, missing);
            });
            if (isRead) throw UsageError(target + " is the input or a file that it uses: not overwritten");
        }
    }

    void measure(const std::string& path, std::vector<ConvertedDisplay>& converted) const {
        const Wall read = readWall(path);
        for (size_t i = 0; i < converted.size(); ++i)
            converted[i].error = conversionError(*request_.displays[i], read.displays.at(i));
    }

    const Wall& wall_;
    const ConversionRequest& request_;
    StagedFiles staged_;
    std::string wallName_;
};

}  // namespace

std::vector<ConvertedDisplay> convertWall(const Wall& wall, const ConversionRequest& request) {
    if (request.kind == ConvertedKind::mpcdi && request.grid)
        throw UsageError(
            "an MPCDI archive cannot say where the nodes of a coarser grid lie; leave out --grid");
    return Converter(wall, request).convert();
}

}  // namespace curvewall
