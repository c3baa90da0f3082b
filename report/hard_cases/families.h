#pragma once
// The families by subject.

#include "report/hard_cases/family.h"

#include <vector>

namespace curvewall::hard_cases {

std::vector<HardCaseFamily> directionFamilies();     // axis, poles, seam, behind and around the eye
std::vector<HardCaseFamily> nearTheEyeFamilies();    // what touches the eye, or nearly
std::vector<HardCaseFamily> smallAndThinFamilies();  // slivers, dust, fans, surfaces in one plane
std::vector<HardCaseFamily> scaleFamilies();         // far away, huge and tiny
std::vector<HardCaseFamily> fieldOfViewFamilies();   // lenses around half and whole turns
std::vector<HardCaseFamily> displayFamilies();       // screens at the eye, measured maps, sizes

}  // namespace curvewall::hard_cases
