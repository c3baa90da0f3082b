#include "bench/speed/csv.h"

#include <iostream>
#include <sstream>

namespace curvewall {

void printHeader() { std::cout << "part,case,quantity,value" << std::endl; }

void print(const Row& row, std::string_view quantity, std::string_view text) {
    std::cout << row.part << ",\"" << row.name << "\"," << quantity << ",\"" << text << '"' << std::endl;
}

void print(const Row& row, std::string_view quantity, double value) {
    std::ostringstream text;
    text.precision(10);
    text << value;
    std::cout << row.part << ",\"" << row.name << "\"," << quantity << ',' << text.str() << std::endl;
}

void print(const Row& row, const RenderStats& stats) {
    print(row, "engine", stats.engine);
    print(row, "frame_ms", stats.frameMsMedian);
    print(row, "frame_ms.min", stats.frameMsMin);
    print(row, "frame_ms.max", stats.frameMsMax);
    for (const auto& [stage, ms] : stats.stageMs) print(row, "stage_ms." + stage, ms);
    print(row, "pieces", stats.pieces);
    print(row, "max_error_px", stats.geometricError.maxPx);
    print(row, "triangles", static_cast<double>(stats.triangles));
    print(row, "pairs", static_cast<double>(stats.pairs));
    print(row, "meshlets", static_cast<double>(stats.meshlets));
    print(row, "meshlets_drawn", static_cast<double>(stats.meshletsDrawn));
    print(row, "gpu_memory_mib.scene", stats.gpuMemoryMib.scene);
    print(row, "gpu_memory_mib.pairs", stats.gpuMemoryMib.pairs);
    print(row, "peak_memory_mib", stats.peakMemoryMib);
}

}  // namespace curvewall
