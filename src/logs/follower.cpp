#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include <zlg/logs/follower.hpp>

namespace zlg::logs {
namespace {

constexpr int patience_ms = 50;
constexpr std::size_t buffer_bytes = 65536;
constexpr double max_duration_s = 1e9;

constexpr std::array<std::pair<const char*, WireFlag>, 4> line_flags{
    {{"lost", flag_lost}, {"final_lost", flag_final_lost}, {"restarted", flag_restarted}, {"outage", flag_outage}}};

}  // namespace

Follower::Follower(const std::string& source, int baud, std::optional<double> duration_s)
    : source_{source, baud}, duration_s_{duration_s}, buffer_(buffer_bytes) {
    if (duration_s && !(*duration_s > 0.0 && *duration_s <= max_duration_s))
        throw SourceError{fmt::format("duration {} s: allowed is up to 1e9 s", *duration_s)};
}

Follower::Next Follower::next(core::AngleRow& row) {
    if (is_full()) return Next::end;
    if (!rows_.next(row)) {
        if (is_stopped_) return Next::end;
        take_bytes();
        if (!rows_.next(row)) return Next::nothing;
    }
    ++n_rows_;
    angle_arcsec_ += row.dtheta_arcsec;
    return Next::row;
}

void Follower::stop() {
    if (std::exchange(is_stopped_, true)) return;
    left_ = {};
    rows_.end();
}

bool Follower::is_full() const {
    return duration_s_ && rows_.tick_s() &&
           static_cast<double>(n_rows_) * *rows_.tick_s() >= *duration_s_ * (1.0 - 1e-12);
}

// In pieces of a few messages, for what waits in `rows_` has no other limit.
void Follower::take_bytes() {
    if (left_.empty()) {
        std::size_t n = 0;
        const ByteSource::Read read = source_.read(buffer_, n, patience_ms);
        if (read == ByteSource::Read::end) return stop();
        left_ = std::span{buffer_}.first(n);
    }
    const std::size_t piece = std::min<std::size_t>(left_.size(), wire::max_frame_bytes);
    rows_.take(left_.first(piece));
    left_ = left_.subspan(piece);
}

Settings line_settings() {
    std::string legend;
    for (std::size_t bit = 0; bit < core::angle_flag_names.size(); ++bit)
        legend += fmt::format("{}:{} ", core::angle_flag_names[bit], 1u << bit);
    for (const auto& [name, bit] : line_flags) legend += fmt::format("{}:{} ", name, static_cast<unsigned>(bit));
    legend.pop_back();
    return {{"flags", legend}};
}

}  // namespace zlg::logs
