#include "report/view_pictures.h"

#include "renderer/image_file.h"

#include <filesystem>
namespace curvewall {
void writePictures(SettingResult& result, const DrawnOutputs& drawn, const Display&,
                   const std::string& folder, const std::string& stem) {
    result.picture = "pictures/" + stem + ".png";
    std::filesystem::create_directories(folder + "/pictures");
    writeFrame(folder + "/" + result.picture, drawn.color);
}
void cropPictures(ViewReport&, const Truth&, const std::string&) {}
}  // namespace curvewall
