#pragma once
// YAML as calibration programs write it, flat: every value by the names that lead to it.

#include "calibration/files/file_bytes.h"

#include <map>
#include <string>
#include <vector>

namespace curvewall {

// "camera_matrix.data" has all numbers of the list `data` of the map `camera_matrix`, lists in lists one
// after another. What lies deeper than two names is left out. Texts are as in the file.
using YamlValues = std::map<std::string, std::vector<std::string>>;

// The first document of the file. Throws InputError for what is no YAML or no map of names.
YamlValues readYamlValues(const FileBytes& file);

}  // namespace curvewall
