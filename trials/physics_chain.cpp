// The model as boxes: what is computed from what.

#include "physics_parts.hpp"

namespace zlg::trials {

Picture chain_picture() {
    report::Diagram d{
        .id = "chain",
        .title = "The laser twin",
        .caption = "Solid: computed in every half-period. Dashed: what the processor commands. Shaded: the processor.",
        .boxes = {{.lines = {"Coil: field,", "linear edges"}, .column = 0, .row = 0},
                  {.lines = {"Table of the", "four waves"}, .column = 1, .row = 0, .rows = 2},
                  {.lines = {"Phases of", "two beats"}, .column = 2, .row = 0},
                  {.lines = {"Comparators,", "counter"}, .column = 3, .row = 0},
                  {.lines = {"Perimeter:", "nearest mode"}, .column = 0, .row = 1},
                  {.lines = {"Photodiodes,", "loop"}, .column = 2, .row = 1},
                  {.lines = {"Processor"}, .column = 3, .row = 1, .rows = 2, .shaded = true},
                  {.lines = {"Piezo, mirror,", "block"}, .column = 0, .row = 2},
                  {.lines = {"High-voltage", "stage"}, .column = 2, .row = 2}},
        .arrows = {{.from = 0, .to = 1, .label = "G"},
                   {.from = 1, .to = 2, .label = "bias"},
                   {.from = 2, .to = 3, .label = "phase"},
                   {.from = 4, .to = 1, .label = "length"},
                   {.from = 1, .to = 5, .label = "light"},
                   {.from = 5, .to = 8, .label = "command"},
                   {.from = 8, .to = 7, .label = "volts"},
                   {.from = 7, .to = 4},
                   {.from = 3, .to = 6, .label = "counts"},
                   {.from = 5, .to = 6, .label = "light"},
                   {.from = 6, .to = 8, .label = "DAC", .dashed = true}}};
    return {"chain", {std::move(d)}, {}};
}

}  // namespace zlg::trials
