#pragma once
// The physics of the twin as pictures, and the numbers that are read off them.

#include <string>
#include <vector>

#include <zlg/report/figure.hpp>

namespace zlg::trials {

// One drawing: figures one below the other.
struct Picture {
    std::string name;  // of its file, without suffix
    std::vector<report::Figure> panels;
};

// A number that the pictures are made of, as it is to be quoted.
struct Reading {
    std::string quantity;
    std::string value;
    std::string unit;  // empty: none
};

struct PhysicsPictures {
    std::vector<Picture> pictures;
    std::vector<Reading> readings;
};

// Everything of the default gyro, or of one that differs from it as the caption says.
//
// cost  some ten seconds.
[[nodiscard]] PhysicsPictures physics_pictures();

// A complete SVG document on a white ground, which dark viewers leave alone.
[[nodiscard]] std::string svg_file(const Picture& picture);

// The readings as a table in Markdown.
[[nodiscard]] std::string markdown(const std::vector<Reading>& readings);

}  // namespace zlg::trials
