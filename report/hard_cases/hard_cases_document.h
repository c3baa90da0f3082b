#pragma once
// The suite's results, told.

#include "report/document.h"
#include "report/hard_cases/results.h"

#include <vector>

namespace curvewall {

// Of families among hardCaseFamilies(); its pictures lie where the suite's folder is.
Document hardCasesDocument(const std::vector<FamilyResult>& results);

}  // namespace curvewall
