#include "calibration/formats/mpcdi_file.h"

#include "calibration/errors.h"
#include "calibration/files/pfm_file.h"
#include "calibration/files/xml_document.h"
#include "calibration/files/zip_archive.h"
#include "calibration/formats/blend_files.h"
#include "calibration/formats/display_names.h"
#include "calibration/formats/map_decisions.h"
#include "calibration/formats/mpcdi_document.h"
#include "calibration/formats/mpcdi_frustum.h"
#include "calibration/formats/texel_budget.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <map>
#include <memory>
#include <set>
#include <utility>

namespace curvewall {
namespace {

// A region with everything that its display is made of.
struct RegionContext {
    const MpcdiDocument& document;
    const MpcdiBuffer& buffer;
    const MpcdiRegion& region;
    const FindFile& find;
    const CalibrationRequest& request;
    TexelBudget& budget;

    InputError error(const std::string& field, const std::string& expected, const std::string& found) const {
        return {document.path, region.place + field, expected, found};
    }
};

FileBytes named(const RegionContext& c, const char* element, const std::string& path) {
    if (auto file = c.find(path)) return std::move(*file);
    throw c.error(std::string("/") + element + "/path", "a file that is there", "\"" + path + "\"");
}

struct RegionMap {
    FileBytes file;  // its bytes are gone
    NumberMap numbers;
    bool isPfm = true;

    MapFile described(glm::ivec2 sizePx) const {
        return {numbers, surveyMap(numbers, isPfm), isPfm, sizePx, file.name()};
    }
};

RegionMap readMap(const RegionContext& c, const char* element, const MpcdiWarp& warp, int channels,
                  Decisions& decisions) {
    RegionMap map{named(c, element, warp.path), {}, true};
    map.isPfm = isPfm(map.file.bytes);
    map.numbers = readNumberMap(map.file, [&](glm::ivec2 sizePx) { c.budget.take(sizePx, c.region.place); });
    map.file.bytes = {};
    decideScale(map.numbers, decisions);
    if (map.numbers.channels < channels)
        throw InputError(map.file.path, "", fmt::format("a map of {} channels", channels),
                         std::to_string(map.numbers.channels));
    if (!surveyMap(map.numbers, map.isPfm).hasNodes)
        throw InputError(map.file.path, "", "a map", "no valid sample anywhere");
    return map;
}

// Profiles 2d and 3d: positions in a picture, or offsets as Evans & Sutherland wrote them in 2017.
ProjectionPtr warped(const RegionContext& c, const RegionMap& map, const MpcdiWarp& warp, Display& display,
                     const PictureRect& rect, const SourcePicture& source, Decisions& decisions) {
    const MapFile described = map.described(display.sizePx);
    const MapSurvey& s = described.survey;
    const bool isOffset = decisions.choose<bool>(
        "map_values", {{"absolute", false}, {"offset", true}}, looksLikeOffsets(s),
        fmt::format("the numbers are {:.3f} to {:.3f} and {:.3f} to {:.3f}, on the average {:.3f} and {:.3f}",
                    s.low.x, s.high.x, s.low.y, s.high.y, s.mean.x, s.mean.y));
    MapDirection direction = MapDirection::inverse;
    if (isOffset)
        direction = decisions.choose<MapDirection>(
            "map_direction", {{"forward", MapDirection::forward}, {"inverse", MapDirection::inverse}},
            MapDirection::forward, "offsets move the vertices of a mesh in the files of Evans & Sutherland");
    if (warp.interpolation == "keystone" || warp.interpolation == "smooth")
        decisions.warn(fmt::format("{}/geometryWarpFile: interpolation {} is read as linear", c.region.place,
                                   warp.interpolation));
    MapMeaning meaning = decideMeaning(described, direction, isOffset, decisions);
    meaning.sourceRect = rect;
    display.projectionType = meaning.cells.empty() ? "camera_texture" : "warp_mesh";
    return projectionOfMap(map.numbers, meaning, display.sizePx, source, map.file.path);
}

ProjectionPtr readFlat(const RegionContext& c, Display& display, Decisions& decisions) {
    const MpcdiRegion& region = c.region;
    if (!glm::all(glm::greaterThan(region.size, glm::dvec2(0))))
        throw c.error("/@xsize", "a region that covers an area of its buffer",
                      fmt::format("{} x {}", region.size.x, region.size.y));
    const glm::ivec2 bufferPx = c.buffer.sizePx.value_or(
        glm::clamp(glm::round(glm::dvec2(display.sizePx) / region.size), 1.0, double{kMostPx}));
    const SourcePicture source =
        c.request.source
            ? *c.request.source
            : decideSource(false, "profile 2d does not say what its media show", bufferPx, decisions);
    const PictureRect rect{region.origin, region.size};
    display.projectionType = "camera_texture";
    if (region.warp)
        return warped(c, readMap(c, "geometryWarpFile", *region.warp, 2, decisions), *region.warp, display,
                      rect, source, decisions);
    // Without a map the region shows its part of the buffer as it is.
    const NumberMap corners{{2, 2}, 2, false, {0, 0, 1, 0, 0, 1, 1, 1}};
    return projectionOfMap(corners, {.alignment = Alignment::corners, .sourceRect = rect}, display.sizePx,
                           source, c.document.path);
}

ProjectionPtr readView(const RegionContext& c, Display& display, const MpcdiWarp* warp, const char* element,
                       Decisions& decisions) {
    const SourcePicture picture{display.sizePx,
                                pictureOfRegion(c.region, display.sizePx, c.document.path, decisions)};
    display.projectionType = c.region.fisheye ? "radial" : "planar";
    if (!warp) return picture.projection;
    return warped(c, readMap(c, element, *warp, 2, decisions), *warp, display, {}, picture, decisions);
}

ProjectionPtr readSurface(const RegionContext& c, Display& display, glm::dvec3 eyeM, Decisions& decisions) {
    const MpcdiWarp& warp = *c.region.warp;
    const RegionMap map = readMap(c, "geometryWarpFile", warp, 3, decisions);
    const MapFile described = map.described(display.sizePx);
    static const std::map<std::string, double> kUnits{{"mm", 0.001},  {"cm", 0.01},   {"dm", 0.1},   {"m", 1},
                                                      {"in", 0.0254}, {"ft", 0.3048}, {"yd", 0.9144}};
    KnownFrame known;
    if (const auto unit = kUnits.find(warp.unit); unit != kUnits.end()) known.unitM = unit->second;
    if (c.region.frame) known.wallFromFile = wallFromFrame(*c.region.frame);
    const PointFrame frame = decideFrame(known, described.survey, decisions);
    if (!c.request.eyeM && warp.origin != "idealeyepoint")
        decisions.warn(
            fmt::format("{}/geometryWarpFile: originOf3DData is {}, and no eye is given: it is "
                        "taken at that origin",
                        c.region.place, warp.origin.empty() ? "missing" : warp.origin));
    const bool bottomRowFirst = decideBottomRowFirst(described, decisions);
    display.projectionType = "surface_map";
    return projectionOfSurface(map.numbers, frame, bottomRowFirst, decideAlignment(described, decisions),
                               display.sizePx, eyeM, map.file.path);
}

// What the frustum shows as if the eye were in the projector's place.
ProjectionPtr readProjector(const RegionContext& c, Display& display, Decisions& decisions) {
    if (c.region.frame) {
        const glm::dvec3 atM = wallFromFrame(*c.region.frame) * c.region.frame->position;
        decisions.warn(
            fmt::format("{}/coordinateFrame: its position ({:g}, {:g}, {:g}) is left out: a wall has "
                        "one eye, and without points of the surface nothing tells what it sees of "
                        "this projector's light",
                        c.region.place, atM.x, atM.y, atM.z));
    }
    const MpcdiWarp* distortion = c.region.distortion ? &*c.region.distortion : nullptr;
    return readView(c, display, distortion, "distortionMap", decisions);
}

ProjectionPtr readProjection(const RegionContext& c, Display& display, glm::dvec3 eyeM,
                             Decisions& decisions) {
    const std::string& profile = c.document.profile;
    const MpcdiRegion& region = c.region;
    if (profile == "2d") return readFlat(c, display, decisions);
    if (profile == "3d") {
        if (region.warp || !region.frame)
            return readView(c, display, region.warp ? &*region.warp : nullptr, "geometryWarpFile", decisions);
        return readProjector(c, display, decisions);
    }
    if (profile == "sl" && !region.warp) return readProjector(c, display, decisions);
    if (profile != "a3d" && profile != "sl")
        throw InputError(c.document.path, "MPCDI/@profile", "2d, 3d, a3d or sl", "\"" + profile + "\"");
    if (!region.warp) throw c.error("", "a geometryWarpFile with the points of profile a3d", "none");
    if (region.distortion)
        decisions.warn(region.place +
                       "/distortionMap: not used, since the points tell what every pixel lights");
    return readSurface(c, display, eyeM, decisions);
}

BlendMapsPtr readBlend(const RegionContext& c, glm::ivec2 sizePx, Decisions& decisions) {
    constexpr Range kGamma{0.1, 10};
    constexpr double kUsualGamma = 2.2;
    BlendMaps blend;
    double alphaGamma = kUsualGamma;
    if (const auto& alpha = c.region.alpha) {
        alphaGamma = alpha->gamma ? *alpha->gamma
                                  : decisions.number("alpha_gamma", kGamma, kUsualGamma,
                                                     "alphaMap has no gammaEmbedded; 2.2 is usual");
        blend.alpha = readBlendPicture(named(c, "alphaMap", alpha->path), sizePx, alphaGamma,
                                       c.region.place + "/alphaMap", decisions, &c.budget);
    }
    if (const auto& beta = c.region.beta) {
        const double gamma = beta->gamma
                                 ? *beta->gamma
                                 : decisions.number("beta_gamma", kGamma, alphaGamma,
                                                    "betaMap has no gammaEmbedded; that of the alphaMap, "
                                                    "or else 2.2, is usual");
        blend.beta = readBlendPicture(named(c, "betaMap", beta->path), sizePx, gamma,
                                      c.region.place + "/betaMap", decisions, &c.budget);
    }
    if (blend.empty()) return nullptr;
    return std::make_shared<const BlendMaps>(std::move(blend));
}

// Of a display that has a name and a size.
void readRegion(const RegionContext& c, Display& display, glm::dvec3 eyeM, Decisions& decisions) {
    display.projection = readProjection(c, display, eyeM, decisions);
    display.blend = readBlend(c, display.sizePx, decisions);
    for (const std::string& unread : c.region.unread)
        decisions.warn(c.region.place + ": " + unread + " is not used");
    listDecisions(decisions, display);
}

std::vector<std::string> displayNames(const MpcdiDocument& document) {
    std::map<std::string, int> uses;
    for (const MpcdiBuffer& buffer : document.buffers)
        for (const MpcdiRegion& region : buffer.regions) ++uses[region.id];
    std::vector<std::string> names;
    std::set<std::string> taken;
    for (const MpcdiBuffer& buffer : document.buffers)
        for (const MpcdiRegion& region : buffer.regions) {
            std::string name = uses[region.id] > 1 ? buffer.id + "-" + region.id : region.id;
            if (name.empty()) name = "region";
            names.push_back(uniqueName(safeDisplayName(name), taken));
        }
    return names;
}

Wall readDocument(const MpcdiDocument& document, const FindFile& find, const CalibrationRequest& request,
                  const std::string& name, uint64_t archiveBytes, Decisions& decisions) {
    Wall wall{.name = name, .eyeM = request.eyeM.value_or(glm::dvec3(0))};
    for (const std::string& broken : brokenRules(document)) decisions.warn(broken);
    const std::vector<std::string> names = displayNames(document);
    struct Wanted {
        const MpcdiBuffer& buffer;
        const MpcdiRegion& region;
        Display display;
        Decisions decisions;
    };
    std::vector<Wanted> wanted;
    TexelBudget budget(document.path, archiveBytes);
    size_t place = 0;
    for (const MpcdiBuffer& buffer : document.buffers)
        for (const MpcdiRegion& region : buffer.regions) {
            const std::string& displayName = names[place++];
            if (!request.display.empty() && displayName != request.display) continue;
            Wanted w{buffer, region, {}, decisions};
            w.display.name = displayName;
            for (const std::string& broken : brokenRules(document, region))
                w.decisions.warn(region.place + ": " + broken);
            w.display.sizePx =
                decideSize(request, region.sizePx ? region.sizePx : buffer.sizePx, std::nullopt, w.decisions);
            for (const bool isThere : {region.alpha.has_value(), region.beta.has_value()})
                if (isThere) budget.take(w.display.sizePx, region.place);
            wanted.push_back(std::move(w));
        }
    for (Wanted& w : wanted) {
        readRegion({document, w.buffer, w.region, find, request, budget}, w.display, wall.eyeM, w.decisions);
        wall.displays.push_back(std::move(w.display));
    }
    return wall;
}

FileBytes manifestOf(const ZipArchive& archive, const FindFile& find, const std::string& path) {
    // mpacs.xml is what some writers call it.
    for (const char* usual : {"mpcdi.xml", "mpacs.xml"})
        for (const std::string& name : archive.names())
            if (lowerCase(name) == usual) return *find(name);
    std::vector<std::string> found;
    for (const std::string& name : archive.names())
        if (lowerCase(name).ends_with(".xml")) found.push_back(name);
    if (found.size() != 1)
        throw InputError(path, "", "an MPCDI archive with mpcdi.xml, or else one file *.xml",
                         std::to_string(found.size()) + " of them");
    return *find(found.front());
}

}  // namespace

bool isMpcdi(const FileBytes& file) {
    return isZip(file.bytes) || lowerCase(xmlRootName(file.bytes)) == "mpcdi";
}

Wall readMpcdi(const FileBytes& file, const FindFile& find, const CalibrationRequest& request,
               Decisions& decisions) {
    if (!isZip(file.bytes)) return readDocument(parseMpcdi(file), find, request, file.stem(), 0, decisions);
    const ZipArchive archive(file);
    const FindFile members = archive.files();
    return readDocument(parseMpcdi(manifestOf(archive, members, file.path)), members, request, file.stem(),
                        file.bytes.size(), decisions);
}

}  // namespace curvewall
