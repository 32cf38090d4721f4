#include "bank_kernel.hpp"

namespace zlg::core {
namespace {

// Where a member walks in this window.
Walk walk_of(const BankMember& member, const SwitchWindow& window) noexcept {
    if (member.place == WalkPlace::everywhere) return {member.kind, 0, window.n_halves};
    const int behind = window.gap.last + member.halves;
    if (member.place == WalkPlace::after) return {member.kind, behind, window.n_halves};
    return {member.kind, window.gap.first - member.halves, behind};
}

// The largest variance of a half, or that of the middle of the window for a walk that goes both ways.
double unit_of(const BankMember& member, const Walk& walk, int n_halves) noexcept {
    const auto variance = [&](int half) { return walked(walk, {half, half + 1}).variance; };
    if (member.place != WalkPlace::everywhere) return variance(n_halves - 1);
    return 0.5 * (variance(n_halves / 2) + variance(n_halves - 1 - n_halves / 2));
}

}  // namespace

BankKernel::BankKernel(const BankMember& member, const SwitchWindow& window) noexcept {
    const bool both_ways = member.place == WalkPlace::everywhere;
    const Walk walk = walk_of(member, window);
    const double unit = unit_of(member, walk, window.n_halves);
    if (!(unit > 0.0)) return;
    const double part = (both_ways ? 0.5 : 1.0) / unit;
    const auto kind = static_cast<unsigned>(member.kind);
    n_terms_ = both_ways ? 2 * kind : kind;
    for (unsigned r = 0; r < static_cast<unsigned>(window.n_rows); ++r) {
        const Stretch& halves = window.row[r].halves;
        const WalkedStretch in_time = walked(walk, halves);
        variance_[r] = part * in_time.variance;
        for (unsigned t = 0; t < kind; ++t) {
            early_[t][r] = part * in_time.moment[t];
            late_[t][r] = in_time.coefficient[t];
        }
        if (!both_ways) continue;
        // Against time the later of two rows is the first.
        const WalkedStretch back = walked(walk, {window.n_halves - halves.last, window.n_halves - halves.first});
        variance_[r] += part * back.variance;
        for (unsigned t = 0; t < kind; ++t) {
            early_[kind + t][r] = back.coefficient[t];
            late_[kind + t][r] = part * back.moment[t];
        }
    }
}

double BankKernel::at(int r, int s) const noexcept {
    if (r == s) return variance_[static_cast<unsigned>(r)];
    const auto first = static_cast<unsigned>(r < s ? r : s), second = static_cast<unsigned>(r < s ? s : r);
    double sum = 0.0;
    for (unsigned t = 0; t < n_terms_; ++t) sum += early_[t][first] * late_[t][second];
    return sum;
}

template <unsigned n>
void BankKernel::add_terms(std::span<const int> rows, Triangle matrix, double size, Triangle into) const noexcept {
    for (std::size_t a = 0; a < rows.size(); ++a) {
        const auto late = static_cast<unsigned>(rows[a]);
        const double* const from = matrix.row(rows[a]);
        double* const to = into.row(static_cast<int>(a));
        double of_late[n];
        for (unsigned t = 0; t < n; ++t) of_late[t] = size * late_[t][late];
        for (std::size_t b = 0; b < a; ++b) {
            const auto early = static_cast<unsigned>(rows[b]);
            double sum = from[early];
            for (unsigned t = 0; t < n; ++t) sum += of_late[t] * early_[t][early];
            to[b] = sum;
        }
        to[a] = from[late] + size * variance_[late];
    }
}

void BankKernel::add(std::span<const int> rows, Triangle matrix, double size, Triangle into) const noexcept {
    // Terms beyond its own are 0.
    if (n_terms_ <= 2) return add_terms<2>(rows, matrix, size, into);
    return n_terms_ <= 4 ? add_terms<4>(rows, matrix, size, into) : add_terms<6>(rows, matrix, size, into);
}

}  // namespace zlg::core
