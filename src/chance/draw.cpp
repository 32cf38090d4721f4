// Laws of a Draw that need logarithms, and its store of normal deviates.
#include <zlg/chance/draw.hpp>

#include <zlg/core/common/maths.hpp>

namespace zlg::chance {

double Draw::within_log(double least, double most) noexcept {
    return least * core::maths::exp(core::maths::log(most / least) * uniform());
}

double Draw::normal() noexcept {
    const auto at = n_normals_taken_ % static_cast<std::uint32_t>(normals_.size());
    if (at == 0) normals(address_, normals_, n_normals_taken_);
    ++n_normals_taken_;
    return normals_[at];
}

double Draw::exponential() noexcept { return -core::maths::log(1.0 - uniform()); }

}  // namespace zlg::chance
