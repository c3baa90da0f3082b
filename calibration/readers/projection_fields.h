#pragma once
// Fields that several types of projection have.

#include "calibration/files/json_fields.h"
#include "calibration/files/map_file.h"
#include "calibration/projections/frustum.h"
#include "calibration/projections/pose.h"
#include "calibration/readers/projection_reader.h"
#include "calibration/readers/wall_folder.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>

namespace curvewall {

inline constexpr double kMostM = 1e7;  // no wall is larger than the earth
inline constexpr Range kAnywhereM{-kMostM, kMostM};
inline constexpr Range kLengthM{0, kMostM, true};
inline constexpr Range kTurnsDeg{0, 1440, true};  // a panorama may go around more than once

std::optional<glm::dvec3> vector3(JsonFields& fields, const char* key, Range range);

// A number that must be there.
double requiredNumber(JsonFields& fields, const char* key, Range range);

// center, yaw_deg, pitch_deg and roll_deg, all optional.
Pose readPose(JsonFields& fields);

// The same for what is infinitely far and so takes no center.
Orientation readOrientationAtInfinity(JsonFields& fields);

// left_deg, right_deg, down_deg and up_deg, all needed.
Frustum readFrustumAngles(JsonFields& fields);

// One of a few words; the first is the default where the key may be absent.
std::string readChoice(JsonFields& fields, const char* key, std::initializer_list<const char*> choices);

// The same where the key must be there.
std::string requiredChoice(JsonFields& fields, const char* key, std::initializer_list<const char*> choices);

// A file that an object names, relative to the wall file's folder. It must be there, and is
// among the folder's files then.
std::optional<std::string> readPath(JsonFields& fields, const char* key, const WallFolder& folder);
std::string requiredPath(JsonFields& fields, const char* key, const WallFolder& folder);

// As messages quote it.
std::string describe(glm::dvec3 vector);

}  // namespace curvewall
