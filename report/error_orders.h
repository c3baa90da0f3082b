#pragma once
// How fast errors fall as a knob is turned.

#include "report/speed_report.h"

#include <vector>

namespace curvewall {

// Of every curve whose knob is known to make it exact: the tolerance of pieces (order 1), the size of faces
// (-1) and the length of edges (2), for the largest geometric error, that of 99 pixels in 100, and the share
// of wrong edges, of which what the floor of sampling has is taken off. Only points clearly above the floor
// count; curves with fewer than two of them are left out.
std::vector<ErrorOrder> errorOrders(const ViewReport& view);

}  // namespace curvewall
