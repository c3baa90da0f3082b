#pragma once
// What a report says, apart from how it is written down: a browser gets it as one HTML file, docs/ as
// Markdown beside pictures.

#include "report/plot.h"

#include <string>
#include <variant>
#include <vector>

namespace curvewall {

// In all texts `code` is set as code; nothing else is markup.
struct Heading {
    int level = 2;  // 2 to 4; the title is 1
    std::string text;
};

struct Paragraph {
    std::string text;
};

struct List {
    std::vector<std::string> items;
};

struct Table {
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;  // cells as many as columns
    std::vector<size_t> emphasized{};            // rows that matter most
};

// A PNG file, its path relative to the report's folder.
struct Picture {
    std::string file;
    std::string caption;  // also what is read where pictures are not seen
};

// Side by side as far as there is room.
struct PictureRow {
    std::vector<Picture> pictures;
};

// Drawn as a vector picture into HTML, and as a PNG file beside Markdown.
struct PlotFigure {
    Plot plot;
    Picture picture;
};

using Block = std::variant<Heading, Paragraph, List, Table, PictureRow, PlotFigure>;

struct Document {
    std::string title;
    std::vector<Block> blocks;
};

// Draws the plots of the document into `folder`. Throws std::runtime_error where a file cannot be written or
// gnuplot is not there.
void writePlots(const Document& document, const std::string& folder);

// One file that needs no other and no network: pictures are read from `folder` and built in.
std::string htmlOf(const Document& document, const std::string& folder);

// Refers to the pictures by their paths relative to the folder.
std::string markdownOf(const Document& document);

}  // namespace curvewall
