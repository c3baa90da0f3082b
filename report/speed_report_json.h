#pragma once
// report.json (docs/report.md): nlohmann::json(report). What measurements keep in files of their own is read
// again with every digit. JSON has no infinity, which a PSNR may be: null stands for it.

#include "report/speed_report.h"

namespace curvewall {

void to_json(nlohmann::json& json, const Spread& spread);
void from_json(const nlohmann::json& json, Spread& spread);
void to_json(nlohmann::json& json, const SettingName& setting);
void from_json(const nlohmann::json& json, SettingName& setting);
void to_json(nlohmann::json& json, const MethodErrors& errors);
void from_json(const nlohmann::json& json, MethodErrors& errors);
void to_json(nlohmann::json& json, const SettingResult& result);
void from_json(const nlohmann::json& json, SettingResult& result);
void to_json(nlohmann::json& json, const TruthFacts& truth);
void from_json(const nlohmann::json& json, TruthFacts& truth);
void to_json(nlohmann::json& json, const SamplingFloor& floor);
void from_json(const nlohmann::json& json, SamplingFloor& floor);
void to_json(nlohmann::json& json, const ViewReport& view);
void to_json(nlohmann::json& json, const SpeedReport& report);

}  // namespace curvewall
