#pragma once
// report.json, as docs/report.md describes it. What is written and read again is the same to the last digit.

#include "calibration/files/json_fields.h"
#include "report/speed_report.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace curvewall {

nlohmann::json toJson(const MethodErrors& errors);
nlohmann::json toJson(const Spread& spread);
nlohmann::json toJson(const TruthFacts& truth);
nlohmann::json toJson(const SamplingFloor& floor);
nlohmann::json toJson(const SettingResult& result);
nlohmann::json toJson(const ViewReport& view);
nlohmann::json toJson(const SpeedReport& report);

// Throw FieldError.
MethodErrors methodErrorsFrom(JsonFields fields);
TruthFacts truthFactsFrom(JsonFields fields);
SamplingFloor samplingFloorFrom(JsonFields fields);
SettingResult settingResultFrom(JsonFields fields);
ViewReport viewReportFrom(JsonFields fields);
SpeedReport speedReportFrom(JsonFields fields);

// Throws InputError.
SpeedReport readSpeedReport(const std::string& path);

// Throws std::runtime_error where the file cannot be written.
void writeSpeedReport(const SpeedReport& report, const std::string& path);

}  // namespace curvewall
