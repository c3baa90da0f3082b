#include "report/truth.h"

#include "calibration/errors.h"
#include "renderer/blending.h"
#include "renderer/image_file.h"
#include "renderer/reference.h"
#include "report/kept_json.h"
#include "report/speed_report_json.h"

#include <fmt/core.h>

#include <cmath>
#include <filesystem>

namespace curvewall {
namespace {

// The mean of pictures, kept in double so that the order of many does not matter.
class MeanPicture {
public:
    void add(const Frame& frame) {
        sums_.resize(frame.texels.size());
        for (size_t i = 0; i < sums_.size(); ++i) sums_[i] += frame.texels[i];
        sizePx_ = frame.sizePx;
        ++count_;
    }
    void add(const MeanPicture& other) {
        sums_.resize(other.sums_.size());
        for (size_t i = 0; i < sums_.size(); ++i) sums_[i] += other.sums_[i];
        sizePx_ = other.sizePx_;
        count_ += other.count_;
    }
    Frame frame() const {
        Frame mean{sizePx_, channelsOf(OutputKind::color), {}};
        for (const double sum : sums_) mean.texels.push_back(static_cast<float>(sum / count_));
        return mean;
    }

private:
    std::vector<double> sums_;
    glm::ivec2 sizePx_{0};
    int count_ = 0;
};

class Tracer {
public:
    explicit Tracer(const RenderRequest& request)
        : request_(request), display_(findDisplay(*request.wall, request.display)), rays_(request.scene) {}

    Frame trace(OutputKind output, int samples = 1, uint64_t seed = 0) const {
        return rays_.render(*request_.wall, display_, request_.camera,
                            {request_.style, output, samples, 0, seed});
    }
    Frame blended(Frame color) const {
        if (display_.blend) blend(color, *display_.blend, mostLight(request_.linearOutput));
        return color;
    }

private:
    const RenderRequest& request_;
    const Display& display_;
    ReferenceRenderer rays_;
};

void supersample(const Tracer& tracer, const Supersampling& supersampling, KnownTruth& truth) {
    MeanPicture even, odd;
    uint64_t seed = 0;
    for (int pair = 1; pair <= supersampling.mostPairs; ++pair) {
        for (MeanPicture* half : {&even, &odd})
            half->add(tracer.trace(OutputKind::color, supersampling.raysAPass, ++seed));
        const double fourTimesInDb = 10 * std::log10(4.0);
        truth.facts.noiseDb = compareColor(even.frame(), odd.frame()).psnrDb + fourTimesInDb;
        truth.facts.supersamples = 2 * pair * supersampling.raysAPass;
        if (truth.facts.noiseDb >= supersampling.quietDb) break;
    }
    even.add(odd);
    truth.pictures.supersampled = tracer.blended(even.frame());
}

// A picture and the end of its file's name.
struct KeptPicture {
    Frame Truth::*picture;
    OutputKind output;
    const char* name;
};

constexpr KeptPicture kPictures[] = {{&Truth::color, OutputKind::color, "color"},
                                     {&Truth::position, OutputKind::position, "position"},
                                     {&Truth::coverage, OutputKind::coverage, "coverage"},
                                     {&Truth::supersampled, OutputKind::color, "supersampled"}};

// How the names of its files begin.
std::string truthStem(const std::string& viewKey, const Supersampling& supersampling,
                      const std::string& folder) {
    return fmt::format("{}/{}-{}x{}", folder, viewKey.substr(0, kShortKey), supersampling.raysAPass,
                       2 * supersampling.mostPairs);
}

std::string factsPath(const std::string& stem) { return stem + ".json"; }

}  // namespace

KnownTruth traceTruth(const RenderRequest& request, const Supersampling& supersampling) {
    const Tracer tracer(request);
    KnownTruth truth;
    truth.pictures.color = tracer.blended(tracer.trace(OutputKind::color));
    truth.pictures.position = tracer.trace(OutputKind::position);
    truth.pictures.coverage = tracer.trace(OutputKind::coverage);
    supersample(tracer, supersampling, truth);
    return truth;
}

bool isTruthKept(const std::string& viewKey, const Supersampling& supersampling, const std::string& folder) {
    return std::filesystem::exists(factsPath(truthStem(viewKey, supersampling, folder)));
}

KnownTruth keptTruth(const RenderRequest& request, const std::string& viewKey,
                     const Supersampling& supersampling, const std::string& folder) {
    const std::string stem = truthStem(viewKey, supersampling, folder);
    const auto pathOf = [&](const KeptPicture& kept) { return fmt::format("{}-{}.exr", stem, kept.name); };
    KnownTruth truth;
    if (const auto facts = keptValue<TruthFacts>(factsPath(stem))) {
        truth.facts = *facts;
        try {
            for (const KeptPicture& kept : kPictures) truth.pictures.*kept.picture = readFrame(pathOf(kept));
            return truth;
        } catch (const InputError&) {
            // A picture is lost or cut: traced again.
        }
    }
    truth = traceTruth(request, supersampling);
    std::filesystem::create_directories(folder);
    for (const KeptPicture& kept : kPictures)
        writeFrame(pathOf(kept), truth.pictures.*kept.picture, kept.output);
    // Last: where it is, the pictures are complete.
    keepJson(factsPath(stem), truth.facts);
    return truth;
}

}  // namespace curvewall
