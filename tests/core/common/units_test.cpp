#include <zlg/core/units.hpp>

#include <concepts>

#include "support.hpp"

namespace zlg::core::units_test {

template <class A, class B>
concept Addable = requires(A a, B b) {
    a + b;
};
template <class A, class B>
concept Subtractable = requires(A a, B b) {
    a - b;
};
template <class A, class B>
concept Multipliable = requires(A a, B b) {
    a* b;
};
template <class A, class B>
concept Comparable = requires(A a, B b) {
    a < b;
};

// A quantity is as cheap as the number it holds, and is a value of a type of its own.
static_assert(sizeof(Volts) == sizeof(double));
static_assert(std::is_trivially_copyable_v<Arcsec>);
static_assert(!std::same_as<Seconds, Hertz>);
static_assert(!std::same_as<Arcsec, ArcsecPerRootSecond>);

// The only way in is explicit, the only way out has a name.
static_assert(std::constructible_from<Volts, double>);
static_assert(!std::convertible_to<double, Volts>);
static_assert(!std::convertible_to<Volts, double>);
static_assert(!std::constructible_from<Volts, Hertz>);
static_assert(!std::assignable_from<Volts&, Hertz>);
static_assert(!std::assignable_from<Volts&, double>);

// Units do not mix, and a product of two is physics that has to be written out.
static_assert(Addable<Volts, Volts> && Subtractable<Volts, Volts> && Comparable<Volts, Volts>);
static_assert(!Addable<Volts, Seconds> && !Subtractable<Volts, Seconds> && !Comparable<Volts, Hertz>);
static_assert(!Addable<Volts, double> && !Addable<double, Volts> && !Comparable<Volts, double>);
static_assert(Multipliable<double, Volts>);
static_assert(!Multipliable<Volts, Volts> && !Multipliable<Seconds, Hertz>);

TEST(Units, AQuantityStartsAtZeroAndCountsAsItsNumberDoes) {
    static_assert(Seconds{}.value() == 0.0);
    static_assert((Volts{3.5} + Volts{1.25}).value() == 4.75 && (Volts{3.5} - Volts{1.25}).value() == 2.25);
    static_assert((-2.0 * Volts{3.5}).value() == -7.0);
    EXPECT_LT(Hertz{1.0}, Hertz{2.0});
    EXPECT_NE(Wavelengths{0.1}, Wavelengths{0.2});
}

TEST(Units, NothingIsOrderedWithNotANumber) {
    const Volts nan{__builtin_nan("")};
    EXPECT_FALSE(nan == nan);
    EXPECT_FALSE(nan < Volts{0.0});
    EXPECT_FALSE(nan >= Volts{0.0});
}

}  // namespace zlg::core::units_test
