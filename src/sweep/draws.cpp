#include <zlg/sweep/draws.hpp>

#include <algorithm>
#include <numeric>

#include <fmt/format.h>
#include <boost/random/sobol.hpp>

#include <zlg/chance/address.hpp>
#include <zlg/chance/draw.hpp>

namespace zlg::sweep {
namespace {

std::uint32_t thing_of(const Parameter& parameter) {
    return chance::thing_of(fmt::format("{}", fmt::join(parameter.keys, ",")));
}

double unit_interval(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

double at(const Parameter& p, double place) { return p.min + (p.max - p.min) * place; }

double truncated(const Parameter& p, chance::Draw& draw) {
    double value = 0.0;
    do value = p.mean + p.sd * draw.normal();
    while (!(value >= p.min && value <= p.max));
    return value;
}

// Fisher and Yates's shuffle.
std::vector<std::uint32_t> shuffled(std::int64_t n, chance::Draw draw) {
    std::vector<std::uint32_t> order(static_cast<std::size_t>(n));
    std::iota(order.begin(), order.end(), 0u);
    for (std::size_t k = order.size(); k > 1; --k) std::swap(order[k - 1], order[draw.below(k)]);
    return order;
}

}  // namespace

std::int64_t gyro_seed(const Description& description, std::int64_t gyro) {
    const chance::Address address{
        .seed = description.seed, .cause = chance::Cause::sweep_seed, .half = static_cast<std::uint64_t>(gyro)};
    return std::max<std::int64_t>(1, static_cast<std::int64_t>(chance::bits(address, 0) >> 1));
}

Draws::Draws(const Description& description)
    : description_{description}, order_(description.parameters.size()), shift_(description.parameters.size()) {
    for (std::size_t k = 0; k < order_.size(); ++k) {
        const Parameter& p = description.parameters[k];
        if (p.draw == DrawKind::latin)
            order_[k] = shuffled(description.n_gyros, {description.seed, chance::Cause::sweep_order, 0, thing_of(p)});
        if (p.draw != DrawKind::sobol) continue;
        ++n_sobol_;
        if (!description.sobol_shift) continue;
        chance::Draw draw{description.seed, chance::Cause::sweep_shift, 0, thing_of(p)};
        shift_[k] = draw.bits();
    }
}

double Draws::latin(std::size_t parameter, std::int64_t gyro) const {
    const Parameter& p = description_.parameters[parameter];
    const auto trial = static_cast<std::uint64_t>(gyro);
    const double within = chance::Draw{description_.seed, chance::Cause::sweep_parameter, trial, thing_of(p)}.uniform();
    const auto part = static_cast<double>(order_[parameter][trial]);
    return at(p, (part + within) / static_cast<double>(description_.n_gyros));
}

double Draws::number(std::size_t parameter, std::int64_t gyro) const {
    const Parameter& p = description_.parameters[parameter];
    chance::Draw draw{description_.seed, chance::Cause::sweep_parameter, static_cast<std::uint64_t>(gyro), thing_of(p)};
    switch (p.draw) {
        case DrawKind::log_uniform: return draw.within_log(p.min, p.max);
        case DrawKind::normal: return p.mean + p.sd * draw.normal();
        case DrawKind::truncated: return truncated(p, draw);
        case DrawKind::latin: return latin(parameter, gyro);
        default: return draw.within(p.min, p.max);
    }
}

// The engine of Boost leaves out the first point, the origin.
std::vector<std::uint64_t> Draws::sobol_point(std::int64_t index, std::size_t n_dimensions) {
    std::vector<std::uint64_t> bits(n_dimensions);
    if (index == 0 || n_dimensions == 0) return bits;
    boost::random::sobol engine{n_dimensions};
    engine.seed(static_cast<std::uint64_t>(index - 1));
    std::ranges::generate(bits, [&] { return engine(); });
    return bits;
}

std::vector<double> Draws::sobol_places(std::int64_t gyro) const {
    const std::vector<std::uint64_t> bits = sobol_point(gyro, n_sobol_);
    std::vector<double> places;
    for (std::size_t k = 0; k < description_.parameters.size(); ++k)
        if (description_.parameters[k].draw == DrawKind::sobol)
            places.push_back(unit_interval(bits[places.size()] ^ shift_[k]));
    return places;
}

std::vector<Value> Draws::values(std::int64_t gyro) const {
    const std::vector<double> sobol = sobol_places(gyro);
    std::size_t dimension = 0;
    std::vector<Value> values(description_.parameters.size());
    auto point = static_cast<std::size_t>(gyro);  // of the grid: mixed radix, the last parameter its lowest digit
    for (std::size_t k = values.size(); k-- > 0;) {
        const Parameter& p = description_.parameters[k];
        if (p.draw != DrawKind::grid) continue;
        values[k] = p.values[point % p.values.size()];
        point /= p.values.size();
    }
    for (std::size_t k = 0; k < values.size(); ++k) {
        const Parameter& p = description_.parameters[k];
        if (p.draw == DrawKind::list)
            values[k] = p.values[static_cast<std::size_t>(gyro) % p.values.size()];
        else if (p.draw == DrawKind::sobol)
            values[k] = at(p, sobol[dimension++]);
        else if (p.draw != DrawKind::grid)
            values[k] = number(k, gyro);
    }
    return values;
}

}  // namespace zlg::sweep
