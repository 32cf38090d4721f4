#include "pieces.hpp"

namespace zlg::calibration {
namespace {

struct Merging {
    std::vector<Piece> pieces;
    double min_s;
    std::int64_t chain = -1;
    std::int64_t segment = -1;

    void take(const LabLog& log, std::size_t index, const Block& block) {
        if (block.segment != segment) {
            segment = block.segment;
            ++chain;
            begin(log, index, block);
        } else if (pieces.back().length_s >= min_s) {
            begin(log, index, block);
        }
        Piece& piece = pieces.back();
        const double length_s = static_cast<double>(block.n_ticks) * log.tick_s;
        const double temperature_c = block.temperature_sum_c / static_cast<double>(2 * block.n_ticks);
        piece.length_s += length_s;
        piece.counts += static_cast<double>(block.counts);
        piece.difference += static_cast<double>(block.difference);
        piece.signed_rise_c += block.first_sign * (block.last_temperature_c - block.first_temperature_c);
        piece.temperature_c += (temperature_c - piece.temperature_c) * length_s / piece.length_s;
    }

    void begin(const LabLog& log, std::size_t index, const Block& block) {
        pieces.push_back({.chain = chain,
                          .log = index,
                          .mode = block.mode,
                          .start_s = static_cast<double>(block.first_tick) * log.tick_s});
    }
};

}  // namespace

double settled_s(std::span<const LabLog> logs) {
    double sum_s = 0.0;
    for (const LabLog& log : logs)
        for (const Block& block : log.blocks) sum_s += static_cast<double>(block.n_ticks) * log.tick_s;
    return sum_s;
}

std::vector<Piece> pieces_of(std::span<const LabLog> logs, double min_s) {
    Merging merging{.pieces = {}, .min_s = min_s};
    for (std::size_t index = 0; index < logs.size(); ++index) {
        merging.segment = -1;
        for (const Block& block : logs[index].blocks) merging.take(logs[index], index, block);
    }
    return std::move(merging.pieces);
}

}  // namespace zlg::calibration
