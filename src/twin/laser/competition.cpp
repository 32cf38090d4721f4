#include "competition.hpp"

#include <limits>

namespace zlg::twin {
namespace {

constexpr unsigned n_sets = 1U << n_waves;

// A pivot below this part of its diagonal is rounding.
constexpr double singular = 1e-12;

// Solve the rows and columns of `lit` by elimination without exchange: a positive definite matrix needs none.
bool solve(const Competition& c, unsigned lit, std::array<double, n_waves>& intensity) {
    std::array<unsigned, n_waves> wave{};
    unsigned n = 0;
    for (unsigned i = 0; i < n_waves; ++i) {
        if (lit >> i & 1U) wave[n++] = i;
    }
    double m[n_waves][n_waves + 1];
    for (unsigned r = 0; r < n; ++r) {
        for (unsigned k = 0; k < n; ++k) m[r][k] = c.saturation[wave[r]][wave[k]];
        m[r][n] = c.net_gain[wave[r]];
    }
    for (unsigned p = 0; p < n; ++p) {
        if (!(m[p][p] > singular * c.saturation[wave[p]][wave[p]])) return false;
        for (unsigned r = p + 1; r < n; ++r) {
            const double factor = m[r][p] / m[p][p];
            for (unsigned k = p + 1; k <= n; ++k) m[r][k] -= factor * m[p][k];
        }
    }
    for (unsigned r = n; r-- > 0;) {
        double rest = m[r][n];
        for (unsigned k = r + 1; k < n; ++k) rest -= m[r][k] * intensity[wave[k]];
        intensity[wave[r]] = rest / m[r][r];
    }
    return true;
}

}  // namespace

bool balance_of(const Competition& competition, unsigned lit, Balance& balance) {
    std::array<double, n_waves> intensity{};
    if (!solve(competition, lit, intensity)) return false;
    balance.lit = lit;
    for (unsigned i = 0; i < n_waves; ++i) {
        double spare = competition.net_gain[i];
        for (unsigned j = 0; j < n_waves; ++j) spare -= competition.saturation[i][j] * intensity[j];
        balance.value[i] = lit >> i & 1U ? intensity[i] : spare / competition.saturation[i][i];
    }
    return true;
}

Balance steady_state(const Competition& competition) {
    Balance best;
    double best_margin = -std::numeric_limits<double>::infinity();
    for (unsigned lit = 0; lit < n_sets; ++lit) {
        Balance candidate;
        if (!balance_of(competition, lit, candidate)) continue;
        const double candidate_margin = margin(lit, candidate.value.data());
        if (candidate_margin > best_margin) {
            best = candidate;
            best_margin = candidate_margin;
        }
        // At a zone's border two sets are steady with the same intensities: the smaller one is met first and does.
        if (candidate_margin >= 0.0) break;
    }
    return best;
}

}  // namespace zlg::twin
