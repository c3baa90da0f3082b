#include "calibration/formats/mesh_file.h"

#include "calibration/errors.h"
#include "calibration/formats/bourke_file.h"
#include "calibration/formats/domeprojection_file.h"
#include "calibration/formats/frustum_file.h"
#include "calibration/formats/obj_mesh_file.h"
#include "calibration/formats/openmesh_file.h"
#include "calibration/formats/sgc_file.h"
#include "calibration/formats/simcad_file.h"
#include "calibration/formats/skyskan_file.h"

#include <algorithm>
#include <initializer_list>

namespace curvewall {
namespace {

struct MeshFormat {
    bool (*isOne)(const FileBytes& file);
    MeshCalibration (*read)(const FileBytes& file, Decisions& decisions);
    bool frustumLiesBeside;
};

// Those with a signature come first.
constexpr std::initializer_list<MeshFormat> kMeshFormats{
    {isSgcFile, readSgcFile, false},
    {isSimcadFile, readSimcadFile, true},
    {isDomeprojectionFile, readDomeprojectionFile, true},
    {isOpenmeshFile, readOpenmeshFile, false},
    {isSkyskanFile, readSkyskanFile, false},
    {isObjMeshFile, readObjMeshFile, false},
    {isBourkeFile, readBourkeFile, false},
};

const MeshFormat* meshFormatOf(const FileBytes& file) {
    const auto found = std::ranges::find_if(kMeshFormats, [&](const MeshFormat& f) { return f.isOne(file); });
    return found == kMeshFormats.end() ? nullptr : found;
}

}  // namespace

bool isMeshFile(const FileBytes& file) { return meshFormatOf(file) != nullptr; }

MeshCalibration readMesh(const FileBytes& file, const FindFile& find, Decisions& decisions) {
    const MeshFormat* format = meshFormatOf(file);
    if (format == nullptr) throw InputError(file.path, "", "a warp mesh", "a file that begins like none");
    MeshCalibration mesh = format->read(file, decisions);
    if (format->frustumLiesBeside && find) mesh.frustum = frustumBeside(file, find, decisions);
    return mesh;
}

}  // namespace curvewall
