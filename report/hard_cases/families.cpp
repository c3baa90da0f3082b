#include "report/hard_cases/families.h"

#include <iterator>

namespace curvewall {

std::vector<HardCaseFamily> hardCaseFamilies() {
    std::vector<HardCaseFamily> all;
    for (const auto& bySubject :
         {hard_cases::directionFamilies, hard_cases::nearTheEyeFamilies, hard_cases::smallAndThinFamilies,
          hard_cases::scaleFamilies, hard_cases::fieldOfViewFamilies, hard_cases::displayFamilies}) {
        std::vector<HardCaseFamily> families = bySubject();
        all.insert(all.end(), std::make_move_iterator(families.begin()),
                   std::make_move_iterator(families.end()));
    }
    return all;
}

}  // namespace curvewall
