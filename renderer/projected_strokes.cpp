#include "renderer/projected_strokes.h"

#include "calibration/angles.h"
#include "calibration/parallel.h"
#include "renderer/strokes.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <mutex>
#include <utility>

namespace curvewall {
namespace {

constexpr int kTilePx = 8;
constexpr double kChordErrorPx = 0.005;  // at the middle; elsewhere it may be a little more
constexpr double kChordPx = 8;           // about the longest, so that no bend is missed between its ends
constexpr double kShortestShare = 1.0 / 4096;  // of that: there a curve has an end, or a map a tear

// Strokes that are farther outside leave no trace.
constexpr double kMarginPx = 0.5 * (kPointSizePx > kLineWidthPx ? kPointSizePx : kLineWidthPx);

double radiusPx(const Scene& scene, uint32_t stroke) {
    return 0.5 * (stroke < scene.points.size() ? kPointSizePx : kLineWidthPx);
}

// The share of the way from a to b that is nearest to p.
double nearestShare(glm::dvec2 a, glm::dvec2 b, glm::dvec2 p) {
    const glm::dvec2 way = b - a;
    const double squared = glm::dot(way, way);
    return squared > 0 ? std::clamp(glm::dot(p - a, way) / squared, 0.0, 1.0) : 0;
}

// Whether a curve that goes from a to b by way of `middle` may be taken for a straight line. One whose middle
// is near an end jumps.
bool isStraight(glm::dvec2 a, glm::dvec2 middle, glm::dvec2 b) {
    const double share = nearestShare(a, b, middle);
    const bool isEven = (share > 0.25 && share < 0.75) || glm::distance(a, b) <= kChordErrorPx;
    return isEven && glm::distance(middle, glm::mix(a, b, share)) <= kChordErrorPx;
}

// The angle that a chord may span: that of a few pixels in the middle of the display.
double longestChordRad(const Display& display) {
    const glm::dvec2 middle = glm::dvec2(display.sizePx) / 2.0;
    const auto ray = display.projection->unproject(middle),
               next = display.projection->unproject(middle + 1.0);
    if (!ray || !next) return 0.01;
    return std::clamp(kChordPx * angleBetween(*ray, *next), 1e-4, 0.03);
}

}  // namespace

glm::uvec2 verticesOf(const Scene& scene, uint32_t stroke) {
    if (stroke < scene.points.size()) return glm::uvec2(scene.points[stroke]);
    return scene.lines[stroke - scene.points.size()];
}

const Material& strokeMaterialOf(const Scene& scene, uint32_t stroke) {
    const bool isPoint = stroke < scene.points.size();
    const auto& ranges = isPoint ? scene.pointRanges : scene.lineRanges;
    const size_t index = isPoint ? stroke : stroke - scene.points.size();
    const auto next = std::ranges::upper_bound(ranges, index, {}, &StrokeRange::first);
    return scene.materials[std::prev(next)->material];
}

// Follows strokes over the display.
class ProjectedStrokes::Projector {
public:
    Projector(const Scene& scene, const Display& display, const glm::dmat3& sceneFromWall, glm::dvec3 eyeM)
        : scene_(scene),
          display_(display),
          wallFromScene_(glm::transpose(sceneFromWall)),
          eyeM_(eyeM),
          longestRad_(longestChordRad(display)),
          turnPx_(closesOnItself(display) ? display.sizePx.x : 0) {}

    void project(uint32_t stroke, std::vector<Chord>& chords) const {
        const glm::uvec2 vertices = verticesOf(scene_, stroke);
        const Node from = nodeAt(0, rayTo(vertices.x));
        if (stroke < scene_.points.size()) {
            for (const glm::dvec2 px : from.seenAtPx)
                add(chords, {stroke, px, px, 0, 0, from.distanceM(), 0});
            return;
        }
        followLine(stroke, from, nodeAt(1, rayTo(vertices.y)), chords);
    }

private:
    struct Node {
        double along;
        glm::dvec3 ray;  // wall axes, from the eye to the place
        std::vector<glm::dvec2> seenAtPx;

        double distanceM() const { return glm::length(ray); }
    };

    glm::dvec3 rayTo(uint32_t vertex) const {
        return wallFromScene_ * (glm::dvec3(scene_.positions[vertex]) - eyeM_);
    }

    Node nodeAt(double along, glm::dvec3 ray) const {
        Node node{along, ray, {}};
        if (!(glm::dot(ray, ray) > 0)) return node;
        node.seenAtPx = display_.projection->project(ray);
        std::erase_if(node.seenAtPx,
                      [](glm::dvec2 px) { return !std::isfinite(px.x) || !std::isfinite(px.y); });
        return node;
    }

    void followLine(uint32_t stroke, const Node& from, const Node& to, std::vector<Chord>& chords) const {
        const double angle = angleBetween(from.ray, to.ray);
        if (angle <= 4 * longestRad_ && isBeside(from, to)) return;
        // Where a line from the eye in half the angle meets the segment (Euclid, Elements, VI.3).
        const double share = from.distanceM() / (from.distanceM() + to.distanceM());
        const Node middle = nodeAt(glm::mix(from.along, to.along, share), glm::mix(from.ray, to.ray, share));
        if (angle <= longestRad_) {
            if (from.seenAtPx.empty() && middle.seenAtPx.empty() && to.seenAtPx.empty()) return;
            const bool isShortest = angle <= kShortestShare * longestRad_;
            if (addChords(stroke, from, middle, to, isShortest, chords) || isShortest) return;
        }
        followLine(stroke, from, middle, chords);
        followLine(stroke, middle, to, chords);
    }

    // Whether all that is seen of both lies on one side of the display.
    bool isBeside(const Node& a, const Node& b) const {
        if (a.seenAtPx.empty() || b.seenAtPx.empty()) return false;
        const auto allBeyond = [&](int axis, double sign, double limit) {
            const auto isBeyond = [&](glm::dvec2 px) { return sign * (px[axis] - limit) > kMarginPx; };
            return std::ranges::all_of(a.seenAtPx, isBeyond) && std::ranges::all_of(b.seenAtPx, isBeyond);
        };
        for (int axis = 0; axis < 2; ++axis)
            if (allBeyond(axis, -1, 0) || allBeyond(axis, 1, display_.sizePx[axis])) return true;
        return false;
    }

    // The position nearest to `px`; on a closed display it may lie beyond the border.
    glm::dvec2 nearestTo(glm::dvec2 px, const Node& node) const {
        glm::dvec2 best(std::numeric_limits<double>::infinity());
        for (glm::dvec2 candidate : node.seenAtPx) {
            if (turnPx_ > 0) candidate.x += turnPx_ * std::round((px.x - candidate.x) / turnPx_);
            if (!(glm::distance(px, candidate) >= glm::distance(px, best))) best = candidate;
        }
        return best;
    }

    // One chord for each time that the part is seen. False where a chord would not be the curve.
    bool addChords(uint32_t stroke, const Node& from, const Node& middle, const Node& to, bool isShortest,
                   std::vector<Chord>& chords) const {
        const size_t times = from.seenAtPx.size();
        if (!isShortest && (times != middle.seenAtPx.size() || times != to.seenAtPx.size())) return false;
        std::vector<Chord> found;
        for (const glm::dvec2 px : from.seenAtPx) {
            const glm::dvec2 toPx = nearestTo(px, to);
            if (isStraight(px, nearestTo(px, middle), toPx))
                found.push_back({stroke, px, toPx, from.along, to.along, from.distanceM(), to.distanceM()});
            else if (!isShortest)
                return false;
        }
        for (const Chord& chord : found) add(chords, chord);
        return true;
    }

    void add(std::vector<Chord>& chords, const Chord& chord) const {
        for (const double shiftPx : {-turnPx_, 0.0, turnPx_}) {
            Chord shown = chord;
            shown.fromPx.x += shiftPx;
            shown.toPx.x += shiftPx;
            const glm::dvec2 low = glm::min(shown.fromPx, shown.toPx),
                             high = glm::max(shown.fromPx, shown.toPx);
            if (glm::all(glm::greaterThanEqual(high, glm::dvec2(-kMarginPx))) &&
                glm::all(glm::lessThanEqual(low, glm::dvec2(display_.sizePx) + kMarginPx)))
                chords.push_back(shown);
            if (turnPx_ == 0) return;
        }
    }

    const Scene& scene_;
    const Display& display_;
    glm::dmat3 wallFromScene_;
    glm::dvec3 eyeM_;
    double longestRad_;
    double turnPx_;  // 0: the display does not close on itself
};

ProjectedStrokes::ProjectedStrokes(const Scene& scene, const Display& display,
                                   const glm::dmat3& sceneFromWall, glm::dvec3 eyeM, int threads)
    : scene_(scene), eyeM_(eyeM), sizePx_(display.sizePx), tiles_((sizePx_ + kTilePx - 1) / kTilePx) {
    const Projector projector(scene, display, sceneFromWall, eyeM);
    std::map<int, std::vector<Chord>> byRange;
    std::mutex mutex;  // guards byRange
    parallelRanges(
        static_cast<int>(scene.points.size() + scene.lines.size()),
        [&](int begin, int end) {
            std::vector<Chord> chords;
            for (int stroke = begin; stroke < end; ++stroke)
                projector.project(static_cast<uint32_t>(stroke), chords);
            const std::scoped_lock lock(mutex);
            byRange[begin] = std::move(chords);
        },
        threads);
    std::vector<Chord> all;
    for (const auto& [begin, chords] : byRange) all.insert(all.end(), chords.begin(), chords.end());
    fillTiles(all);
}

void ProjectedStrokes::fillTiles(const std::vector<Chord>& chords) {
    const auto forEachTile = [&](const Chord& chord, const auto& visit) {
        const glm::dvec2 reach(radiusPx(scene_, chord.stroke));
        const auto tileAt = [&](glm::dvec2 px) {
            return glm::ivec2(glm::clamp(px, glm::dvec2(0), glm::dvec2(sizePx_ - 1))) / kTilePx;
        };
        const glm::ivec2 first = tileAt(glm::min(chord.fromPx, chord.toPx) - reach),
                         last = tileAt(glm::max(chord.fromPx, chord.toPx) + reach);
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; ++x) visit(tileOf({x, y}));
    };
    firstInTile_.assign(static_cast<size_t>(tiles_.x) * static_cast<size_t>(tiles_.y) + 1, 0);
    for (const Chord& chord : chords) forEachTile(chord, [&](size_t tile) { ++firstInTile_[tile + 1]; });
    for (size_t tile = 1; tile < firstInTile_.size(); ++tile) firstInTile_[tile] += firstInTile_[tile - 1];
    inTiles_.resize(firstInTile_.back());
    std::vector<size_t> next(firstInTile_.begin(), firstInTile_.end() - 1);
    for (const Chord& chord : chords)
        forEachTile(chord, [&](size_t tile) { inTiles_[next[tile]++] = chord; });
}

std::vector<StrokePlace> ProjectedStrokes::at(glm::dvec2 px) const {
    const glm::ivec2 tilePx = glm::clamp(glm::ivec2(px), glm::ivec2(0), sizePx_ - 1);
    const size_t tile = tileOf(tilePx / kTilePx);
    std::vector<StrokePlace> places;
    double nearestPx = 0;  // of the last of the places
    for (size_t i = firstInTile_[tile]; i < firstInTile_[tile + 1]; ++i) {
        const Chord& chord = inTiles_[i];
        const double share = nearestShare(chord.fromPx, chord.toPx, px);
        const double distancePx = glm::distance(px, glm::mix(chord.fromPx, chord.toPx, share));
        if (distancePx > radiusPx(scene_, chord.stroke)) continue;
        const bool isKnown = !places.empty() && places.back().stroke == chord.stroke;
        if (isKnown && nearestPx <= distancePx) continue;
        if (!isKnown) places.emplace_back();
        nearestPx = distancePx;
        StrokePlace& place = places.back();
        place = {chord.stroke, chord.fromAlong, glm::dvec2(0), glm::dvec3(0)};
        const double lengthPx = glm::distance(chord.fromPx, chord.toPx);
        if (lengthPx > 0) {
            // Equal steps on the display are steps in proportion to the distance in space.
            const double weight =
                share * chord.fromDistanceM / glm::mix(chord.toDistanceM, chord.fromDistanceM, share);
            place.along = glm::mix(chord.fromAlong, chord.toAlong, weight);
            place.alongPerPx =
                (chord.toAlong - chord.fromAlong) * (chord.toPx - chord.fromPx) / (lengthPx * lengthPx);
        }
        const glm::uvec2 ends = verticesOf(scene_, chord.stroke);
        place.fromEyeM = glm::mix(glm::dvec3(scene_.positions[ends.x]), glm::dvec3(scene_.positions[ends.y]),
                                  place.along) -
                         eyeM_;
    }
    return places;
}

}  // namespace curvewall
