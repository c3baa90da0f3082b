#include "calibration/pieces/piece_drawing.h"

#include <nlohmann/json.hpp>

#include <sstream>

namespace curvewall {

using nlohmann::json;

json piecesAsJson(const PieceMesh& mesh) {
    json vertices = json::array();
    for (const PieceVertex& vertex : mesh.vertices)
        vertices.push_back({{"m", {vertex.m.x, vertex.m.y, vertex.m.z}}, {"s", {vertex.s.x, vertex.s.y}}});
    json pieces = json::array();
    for (const Piece& piece : mesh.pieces) {
        json corners = json::array();
        for (uint32_t i = 0; i < piece.vertexCount; ++i) corners.push_back(piece.vertices[i]);
        pieces.push_back(std::move(corners));
    }
    return {{"size", {mesh.sizePx.x, mesh.sizePx.y}},
            {"vertices", std::move(vertices)},
            {"pieces", std::move(pieces)}};
}

std::string piecesAsSvg(const PieceMesh& mesh) {
    std::ostringstream svg;
    svg.precision(9);
    svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << mesh.sizePx.x << "\" height=\""
        << mesh.sizePx.y << "\" viewBox=\"0 0 " << mesh.sizePx.x << " " << mesh.sizePx.y << "\">\n"
        << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
        << "<g fill=\"none\" stroke=\"black\" stroke-width=\"1\" stroke-linejoin=\"round\">\n";
    for (const Piece& piece : mesh.pieces) {
        svg << "<polygon points=\"";
        for (uint32_t i = 0; i < piece.vertexCount; ++i) {
            const glm::dvec2 s = mesh.vertices[piece.vertices[i]].s;
            svg << (i == 0 ? "" : " ") << s.x << "," << s.y;
        }
        svg << "\"/>\n";
    }
    svg << "</g>\n</svg>";
    return svg.str();
}

}  // namespace curvewall
