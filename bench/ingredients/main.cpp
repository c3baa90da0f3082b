// How many pieces each ingredient of the method saves: for every wall and tolerance the fewest pieces with
// which each set of ingredients keeps every pixel within the tolerance, as CSV. Arguments name the walls to
// look at; none means all. See docs/ingredients.md.

#include "bench/ingredients/measured_wall.h"
#include "bench/ingredients/uniform_grid.h"
#include "calibration/parallel.h"
#include "calibration/pieces/cell_fit.h"
#include "calibration/pieces/lower_bound.h"
#include "calibration/pieces/piece_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace curvewall {
namespace {

constexpr std::array<double, 8> kTolerancesPx{2, 1, 0.5, 0.25, 0.1, 0.05, 0.025, 0.01};

// Fits above this take minutes.
constexpr size_t kMostBalanced = 20'000, kMostAdaptive = 20'000;

struct Row {
    glm::ivec2 cells{0};  // none where the mesh is not a grid
    Measured measured;
};

using MakeGrid = std::function<PieceMesh(glm::ivec2 cells, double tolerancePx)>;
using Rows = std::array<std::optional<Row>, kTolerancesPx.size()>;

// Grids of one shape, from coarse to fine.
class GridSearch {
public:
    GridSearch(const MeasuredWall& wall, double rowsPerColumn, const MakeGrid& make)
        : wall_(wall), rowsPerColumn_(rowsPerColumn), make_(make) {}

    // The first grid that meets the tolerance and has `mostPieces` at most. Leaps are shorter than an error
    // that falls with the square of the number of columns allows, so the last steps are one or two in a
    // hundred columns.
    std::optional<Row> first(double tolerancePx, size_t mostPieces) {
        for (;;) {
            const glm::ivec2 cells(columns_, std::max(1.0, std::round(columns_ * rowsPerColumn_)));
            constexpr double kLeastPerCell = 1.5;  // the other quarter lies in holes at most
            if (kLeastPerCell * cells.x * cells.y > static_cast<double>(mostPieces)) return std::nullopt;
            const Row row{cells, measure(*wall_.projection, make_(cells, tolerancePx), tolerancePx)};
            if (row.measured.pieces > mostPieces) return std::nullopt;
            if (row.measured.maxPx <= tolerancePx) return row;
            constexpr double kShorter = 0.9, kLongestLeap = 2;
            const double leap =
                std::min(kShorter * std::sqrt(row.measured.maxPx / tolerancePx), kLongestLeap);
            const int step = std::max(1, columns_ / 50);
            const int next = std::max(columns_ + step, static_cast<int>(leap * columns_));
            columns_ = std::min(next, nextOnMap());
        }
    }

private:
    int nextOnMap() const {
        if (wall_.mapColumns == 0) return std::numeric_limits<int>::max();
        return (columns_ / wall_.mapColumns + 1) * wall_.mapColumns;
    }

    const MeasuredWall& wall_;
    double rowsPerColumn_;
    const MakeGrid& make_;
    int columns_ = 1;
};

// The best shape at each tolerance.
Rows fewestOfGrids(const MeasuredWall& wall, const MakeGrid& make, size_t mostPieces) {
    Rows rows;
    std::vector<GridSearch> shapes;
    for (double shape : wall.rowsPerColumn) shapes.emplace_back(wall, shape, make);
    for (size_t i = 0; i < rows.size(); ++i) {
        for (GridSearch& shape : shapes) {
            const size_t most = rows[i] ? rows[i]->measured.pieces - 1 : mostPieces;
            if (const auto row = shape.first(kTolerancesPx[i], most)) rows[i] = row;
        }
    }
    return rows;
}

size_t triangleCount(const PieceMesh& mesh) {
    size_t count = 0;
    for (const Piece& piece : mesh.pieces) count += piece.vertexCount - 2;
    return count;
}

// Stops before a fit that would have more pieces than are worth the time, if pieces grow at least with the
// root of the tolerance.
Rows fewestOfFits(const std::function<Measured(double tolerancePx)>& fit) {
    Rows rows;
    for (size_t i = 0; i < rows.size(); ++i) {
        if (i > 0) {
            if (!rows[i - 1]) break;
            const double growth = std::sqrt(kTolerancesPx[i - 1] / kTolerancesPx[i]);
            if (static_cast<double>(rows[i - 1]->measured.pieces) * growth > kMostAdaptive) break;
        }
        rows[i] = Row{{}, fit(kTolerancesPx[i])};
    }
    return rows;
}

Rows adaptiveTriangles(const MeasuredWall& wall) {
    return fewestOfFits([&](double tolerancePx) {
        const PieceMesh mesh = fitCells(*wall.projection, wall.sizePx, tolerancePx).pieces.mesh;
        return Measured{measure(*wall.projection, mesh, tolerancePx).maxPx, triangleCount(mesh)};
    });
}

Rows fittedPieces(const MeasuredWall& wall) {
    return fewestOfFits([&](double tolerancePx) {
        const FittedPieces fitted = fitPieces(*wall.projection, wall.sizePx, tolerancePx);
        return Measured{fitted.certificate.maxPx, fitted.mesh.pieces.size()};
    });
}

std::string asCsv(const MeasuredWall& wall, const char* ingredients, const Rows& rows) {
    std::ostringstream csv;
    for (size_t i = 0; i < rows.size(); ++i) {
        csv << wall.name << ',' << ingredients << ',' << kTolerancesPx[i] << ',';
        if (!rows[i]) {
            csv << "-,-,-,-\n";
            continue;
        }
        if (const glm::ivec2 cells = rows[i]->cells; cells.x > 0)
            csv << cells.x << ',' << cells.y << ',';
        else
            csv << "-,-,";
        csv << rows[i]->measured.pieces << ',' << rows[i]->measured.maxPx << '\n';
    }
    return csv.str();
}

std::string boundAsCsv(const MeasuredWall& wall) {
    std::ostringstream csv;
    for (double tolerancePx : kTolerancesPx)
        csv << wall.name << ",bound," << tolerancePx << ",-,-,"
            << lowerBoundOfPieces(*wall.projection, wall.sizePx, tolerancePx) << ",-\n";
    return csv.str();
}

std::string comparisonOn(const MeasuredWall& wall) {
    constexpr double kMargin = 0.98;  // for the pixels between the samples of the fit
    const MakeGrid paper = [&](glm::ivec2 cells, double) { return paperGrid(wall, cells); };
    const MakeGrid onSurface = [&](glm::ivec2 cells, double) { return gridOnSurface(wall, cells); };
    const MakeGrid balanced = [&](glm::ivec2 cells, double tolerancePx) {
        return balancedGrid(wall, cells, kMargin * tolerancePx);
    };
    return asCsv(wall, "grid", fewestOfGrids(wall, paper, kMostPieces)) +
           asCsv(wall, "surface", fewestOfGrids(wall, onSurface, kMostPieces)) +
           asCsv(wall, "balanced", fewestOfGrids(wall, balanced, kMostBalanced)) +
           asCsv(wall, "adaptive", adaptiveTriangles(wall)) + asCsv(wall, "merged", fittedPieces(wall)) +
           boundAsCsv(wall);
}

// Most of the time goes to solvers, which have one thread each.
std::vector<std::string> comparisons(const std::vector<MeasuredWall>& walls) {
    std::vector<std::string> csv(walls.size());
    parallelRanges(static_cast<int>(walls.size()), [&](int begin, int end) {
        for (auto i = static_cast<size_t>(begin); i < static_cast<size_t>(end); ++i)
            csv[i] = comparisonOn(walls[i]);
    });
    return csv;
}

}  // namespace
}  // namespace curvewall

int main(int argc, char** argv) {
    std::vector<curvewall::MeasuredWall> walls = curvewall::measuredWalls();
    const std::vector<std::string> wanted(argv + 1, argv + argc);
    std::erase_if(walls, [&](const curvewall::MeasuredWall& wall) {
        return !wanted.empty() && std::ranges::find(wanted, wall.name) == wanted.end();
    });
    std::cout << "wall,ingredients,tolerance_px,columns,rows,pieces,max_error_px\n";
    for (const std::string& csv : curvewall::comparisons(walls)) std::cout << csv;
}
