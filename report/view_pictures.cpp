#include "report/view_pictures.h"

#include "renderer/image_file.h"
#include "renderer/shown_error.h"
#include "report/pictures.h"

#include <filesystem>

namespace curvewall {
namespace {

constexpr int kCropPx = 64;
constexpr int kCropFactor = 4;
constexpr int kTruthWidthPx = 1024;  // in the page, where it says what one looks at

std::string written(const Frame& frame, const std::string& folder, const std::string& name) {
    std::string file = "pictures/" + name + ".png";
    std::filesystem::create_directories(folder + "/pictures");
    writeFrame(folder + "/" + file, frame);
    return file;
}

}  // namespace

void writePictures(SettingResult& result, const DrawnOutputs& drawn, const Display& display,
                   double tolerancePx, const std::string& folder, const std::string& stem) {
    result.picture = written(drawn.color, folder, stem);
    result.errorMap =
        written(errorMap(shownErrorsPx(drawn.position, display), drawn.position.sizePx, tolerancePx), folder,
                stem + "-error");
}

void cropPictures(ViewReport& view, const Truth& truth, const std::string& folder, const std::string& stem) {
    std::vector<double> difference;
    for (const SettingResult& result : view.settings)
        if (!result.picture.empty())
            addDifference(difference, readFrame(folder + "/" + result.picture), truth.color);
    if (difference.empty()) return;
    const Square worst = worstSquare(difference, view.sizePx, kCropPx);
    for (SettingResult& result : view.settings)
        if (!result.picture.empty()) {
            const std::string name = std::filesystem::path(result.picture).stem().string();
            result.crop = written(enlarged(readFrame(folder + "/" + result.picture), worst, kCropFactor),
                                  folder, name + "-crop");
        }
    view.truth.picture = written(reduced(truth.color, kTruthWidthPx), folder, stem + "-truth");
    view.truth.crop = written(enlarged(truth.color, worst, kCropFactor), folder, stem + "-truth-crop");
}

}  // namespace curvewall
