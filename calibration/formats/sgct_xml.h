#pragma once
// The XML that SGCT read until 2024, as the JSON that it reads since.

#include "calibration/files/xml_document.h"

#include <nlohmann/json.hpp>

namespace curvewall {

// The root <Cluster> in the shape of a version 1 configuration: keys in lower case, every value a text.
nlohmann::json sgctJsonFromXml(const XmlElement& root);

}  // namespace curvewall
