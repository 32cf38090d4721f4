// The model as boxes: what is computed from what.

#include "parts.hpp"

namespace zlg::trials {

Picture chain_picture() {
    report::Diagram d{
        .id = "chain",
        .title = "The laser twin",
        .caption = "Solid: computed in every half-period. Dashed: what the processor commands. Shaded: the processor.",
        .height = 296,
        .boxes = {{.lines = {"Coil: field,", "linear edges"}, .left = 7, .top = 6, .width = 120, .height = 64},
                  {.lines = {"Table of the", "four waves"}, .left = 189, .top = 6, .width = 120, .height = 174},
                  {.lines = {"Phases of", "two beats"}, .left = 371, .top = 6, .width = 120, .height = 64},
                  {.lines = {"Comparators,", "counter"}, .left = 553, .top = 6, .width = 120, .height = 64},
                  {.lines = {"Perimeter:", "nearest mode"}, .left = 7, .top = 116, .width = 120, .height = 64},
                  {.lines = {"Photodiodes,", "loop"}, .left = 371, .top = 116, .width = 120, .height = 64},
                  {.lines = {"Processor"}, .left = 553, .top = 116, .width = 120, .height = 174, .shaded = true},
                  {.lines = {"Piezo, mirror,", "block"}, .left = 7, .top = 226, .width = 120, .height = 64},
                  {.lines = {"High-voltage", "stage"}, .left = 371, .top = 226, .width = 120, .height = 64}},
        .arrows = {{.from = {127, 38}, .to = {189, 38}, .label = "G"},
                   {.from = {309, 38}, .to = {371, 38}, .label = "bias"},
                   {.from = {491, 38}, .to = {553, 38}, .label = "phase"},
                   {.from = {127, 148}, .to = {189, 148}, .label = "length"},
                   {.from = {309, 148}, .to = {371, 148}, .label = "light"},
                   {.from = {431, 180}, .to = {431, 226}, .label = "command"},
                   {.from = {371, 258}, .to = {127, 258}, .label = "volts"},
                   {.from = {67, 226}, .to = {67, 180}},
                   {.from = {613, 70}, .to = {613, 116}, .label = "counts"},
                   {.from = {491, 148}, .to = {553, 148}, .label = "light"},
                   {.from = {553, 258}, .to = {491, 258}, .label = "DAC", .dashed = true}}};
    return {"chain", {std::move(d)}, {}};
}

}  // namespace zlg::trials
