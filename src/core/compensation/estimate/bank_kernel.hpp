#pragma once
// Covariance of the rows of a window by a member of the bank.

#include <array>
#include <span>

#include <zlg/core/common/triangle.hpp>
#include <zlg/core/compensation/switch_window.hpp>

namespace zlg::core {

// K, as large as its unit: the walk of walk_kernel.hpp, of one both ways half of each. For r before s it is a sum of
// few products,
//
//   K_rs = sum over t of early_t(r) late_t(s)
class BankKernel {
public:
    BankKernel(const BankMember& member, const SwitchWindow& window) noexcept;

    // False: it does not walk in this window.
    [[nodiscard]] bool is_there() const noexcept { return n_terms_ > 0; }

    // Of two rows of the window.
    [[nodiscard]] double at(int r, int s) const noexcept;

    // A matrix of all rows, with so many times the kernel: of these of them, which are in order of time. It may take
    // the place of the matrix.
    void add(std::span<const int> rows, Triangle matrix, double size, Triangle into) const noexcept;

private:
    using Terms = std::array<std::array<double, most_window_rows>, 2 * most_walk_terms>;

    template <unsigned n>
    void add_terms(std::span<const int> rows, Triangle matrix, double size, Triangle into) const noexcept;

    unsigned n_terms_ = 0;
    std::array<double, most_window_rows> variance_{};
    Terms early_{}, late_{};
};

}  // namespace zlg::core
