#include "term_sets.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace zlg::noise {
namespace {

// Costs in -2 log likelihood. Of one coefficient that may not be negative: half of chi-square beyond 6.63 is 0.5 %.
constexpr double cost = 6.6;
// Of a Markov term, whose time is free too: of 654 records without one 10 showed one (zlg_trials noise,
// docs/noise.md).
constexpr double markov_cost = 12.0;
// Of one more averaging time left free for a filter that is found already: Akaike's.
constexpr double filter_cost = 2.0;
// Averaging times that are left when the shortest ones go: as many as there are smooth terms without a Markov time.
constexpr Eigen::Index min_points = 4;

constexpr unsigned quantised_bit = 1, white_bit = 2, basic_mask = 15, markov_bit = 16;

Eigen::VectorXd column(const HadamardPoints& points, std::size_t kind, double time_s) {
    std::array<double, n_smooth> squares{};
    squares[kind] = 1.0;
    const NoiseTerms unit = terms_of(squares, time_s);
    Eigen::VectorXd c(points.tau_s.size());
    for (Eigen::Index i = 0; i < c.size(); ++i) c[i] = hadamard_variance(unit, points.tau_s[i]);
    // Two angles at each of the gaps, gap_rate tau in each mean of a third difference, (1 + 4 + 1)/(6 tau^2).
    if (kind == quantised_index) c.array() += 2.0 * points.gap_rate_hz / points.tau_s.array();
    return c;
}

class Search {
public:
    Search(const HadamardPoints& points, const Eigen::MatrixXd& relative, std::size_t skipped)
        : points_(points), skipped_(skipped), n_(points.value.size() - static_cast<Eigen::Index>(skipped)) {
        variances_.value = points.value.tail(n_);
        set_scatter(relative.bottomRightCorner(n_, n_), variances_);
        for (std::size_t kind = 0; kind < markov_index; ++kind) basic_.emplace_back(column(points, kind, 1.0).tail(n_));
    }

    // An averaging time left free is met: what is left of its likelihood is the logarithm of its variance.
    [[nodiscard]] double objective_of_skipped() const { return log_sum(points_.value.head(points_.value.size() - n_)); }
    [[nodiscard]] double price_of_skipped() const { return cost * static_cast<double>(skipped_); }
    // Of no set is the price less.
    [[nodiscard]] double least_price() const { return log_sum(points_.value) + price_of_skipped() + cost; }

    // time_s  with which the search for that of the Markov term begins.
    [[nodiscard]] TermSet fit(unsigned mask, double time_s) const {
        TermSet c{.mask = mask, .skipped = skipped_};
        TimedColumn timed;
        if ((mask & markov_bit) != 0) {
            timed.at = [this](double log_time) { return markov(std::exp(log_time)); };
            timed.log_time = std::log(time_s);
            timed.low = std::log(points_.tau_0_s);
            timed.high = std::log(points_.tau_s[points_.tau_s.size() - 1]);
        }
        Eigen::MatrixXd columns(n_, std::popcount(mask & basic_mask));
        for (std::size_t kind = 0; kind < markov_index; ++kind)
            if (c.has(kind)) columns.col(c.place_of(kind)) = basic_[kind];
        c.fit = fit_terms(variances_, columns, timed);
        c.time_s = std::exp(c.fit.log_time);
        c.objective = c.fit.objective + objective_of_skipped();
        c.price = c.objective + price_of_skipped();
        for (std::size_t kind = 0; kind < n_smooth; ++kind) {
            if (!c.has(kind)) continue;
            c.price += kind == markov_index ? markov_cost : cost;
            c.square[kind] = c.fit.coefficient[c.place_of(kind)];
            c.variance[kind] = c.fit.covariance(c.place_of(kind), c.place_of(kind));
        }
        if (c.has(markov_index)) take_filter(c);
        return c;
    }

    void add_sets(bool with_markov, std::vector<TermSet>& all) const {
        const double time_s = with_markov ? likely_time() : 0.0;
        for (unsigned mask = 1; mask < 2 * markov_bit; ++mask)
            if (is_allowed(mask, with_markov)) all.push_back(fit(mask, time_s));
    }

private:
    static double log_sum(const Eigen::VectorXd& value) { return 2.0 / 3.0 * value.array().log().sum(); }
    [[nodiscard]] Eigen::VectorXd markov(double time_s) const { return column(points_, markov_index, time_s).tail(n_); }

    // Of sets that say nothing of the shortest times one coefficient is what is left of them: the time of a filter, as
    // which the Markov term of white noise stands, or the quantisation that rounding leaves.
    [[nodiscard]] bool is_allowed(unsigned mask, bool with_markov) const {
        const bool is_markov = (mask & markov_bit) != 0;
        if (is_markov && !with_markov) return false;
        if (skipped_ == 0) return true;
        const bool is_one = is_markov ? (mask & (white_bit | quantised_bit)) == 0 : (mask & quantised_bit) != 0;
        return is_one && std::popcount(mask) + (is_markov ? 1 : 0) < n_;
    }

    // Of those reached from every fourth octave beside all other terms, that of the best.
    [[nodiscard]] double likely_time() const {
        const unsigned others = skipped_ == 0 ? basic_mask : basic_mask & ~(white_bit | quantised_bit);
        TermSet best;
        for (double t = 2.0 * points_.tau_0_s; t <= points_.tau_s[points_.tau_s.size() - 1]; t *= 4.0) {
            TermSet c = fit(others | markov_bit, t);
            if (c.price < best.price) best = std::move(c);
        }
        return best.time_s;
    }

    // Whether a part is most of the noise at averaging times over two octaves.
    [[nodiscard]] bool is_followed(const TermSet& c, const Eigen::VectorXd& part, double from_s) const {
        const Eigen::ArrayXd share = part.array() / c.fit.expected.array();
        return ((points_.tau_s.tail(n_).array() >= from_s) && (share > 0.5)).count() > 2;
    }

    // A Markov term whose line s sqrt(2T/tau) is followed is white noise that a low pass of the time T cut off, unless
    // at shorter times the noise of single samples and angles, a white one of the rate among it, is followed too. From
    // 4 T on its Hadamard deviation is within a quarter of that line. A white noise that is followed nowhere beside a
    // Markov term is what that term of interval means misses of a filter of samples.
    void take_filter(TermSet& c) const {
        constexpr double line_from = 4.0;
        Eigen::VectorXd single = Eigen::VectorXd::Zero(n_);
        for (const std::size_t kind : {quantised_index, white_index}) single += c.square[kind] * basic_[kind];
        if (c.has(white_index) && is_followed(c, single, 0.0)) return;
        if (!is_followed(c, c.square[markov_index] * markov(c.time_s), line_from * c.time_s)) {
            c.square[white_index] = c.variance[white_index] = 0.0;
            return;
        }
        c.filtered = true;
        const double white = 2.0 * c.square[markov_index] * c.time_s;
        Eigen::VectorXd by = Eigen::VectorXd::Zero(c.fit.covariance.rows());
        if (c.has(white_index)) by[c.place_of(white_index)] = 1.0;
        by[c.place_of(markov_index)] = 2.0 * c.time_s;
        by[c.place_of(n_smooth)] = white;
        c.square[white_index] += white;
        c.variance[white_index] = by.dot(c.fit.covariance * by);
        c.square[markov_index] = c.variance[markov_index] = 0.0;
    }

    const HadamardPoints& points_;
    std::size_t skipped_;
    Eigen::Index n_;  // averaging times that are left
    MeasuredVariances variances_;
    std::vector<Eigen::VectorXd> basic_;
};

// A filter ends gradually: what is left of it where its memory begins to end is less than a term costs, and more than
// its standard error.
void leave_filter(std::vector<TermSet>& all) {
    const unsigned mask = all.front().mask;
    const double price = all.front().price;
    const auto first = std::ranges::min_element(all, {}, [mask](const TermSet& c) {
        return c.mask == mask && c.filtered ? c.objective + filter_cost * static_cast<double>(c.skipped)
                                            : std::numeric_limits<double>::infinity();
    });
    std::rotate(all.begin(), first, first + 1);
    all.front().price = price;
}

}  // namespace

Eigen::Index TermSet::place_of(std::size_t kind) const { return std::popcount(mask & ((1u << kind) - 1u)); }

double TermSet::log_time_variance() const { return fit.covariance(place_of(n_smooth), place_of(n_smooth)); }

NoiseTerms TermSet::seen_terms(const HadamardPoints& points) const {
    std::array<double, n_smooth> squares{};
    for (std::size_t kind = 0; kind < n_smooth; ++kind)
        if (has(kind)) squares[kind] = fit.coefficient[place_of(kind)];
    squares[white_index] += 2.0 * points.gap_rate_hz * squares[quantised_index];
    return terms_of(squares, time_s);
}

Eigen::VectorXd TermSet::expected(const HadamardPoints& points) const {
    const NoiseTerms all = seen_terms(points);
    Eigen::VectorXd e(points.tau_s.size());
    for (Eigen::Index i = 0; i < e.size(); ++i) e[i] = hadamard_variance(all, points.tau_s[i]);
    return e;
}

TermSet all_basic_terms(const HadamardPoints& points, const Eigen::MatrixXd& relative) {
    return Search(points, relative, 0).fit(basic_mask, 0.0);
}

std::vector<TermSet> all_sets(const HadamardPoints& points, const Eigen::MatrixXd& relative, bool with_markov) {
    std::vector<TermSet> all;
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index skipped = 0; skipped + min_points <= points.value.size(); ++skipped) {
        const Search search(points, relative, static_cast<std::size_t>(skipped));
        if (search.least_price() > least) break;
        search.add_sets(with_markov, all);
        least = std::ranges::min_element(all, {}, &TermSet::price)->price;
    }
    std::ranges::stable_sort(all, {}, &TermSet::price);
    if (all.front().filtered) leave_filter(all);
    return all;
}

}  // namespace zlg::noise
