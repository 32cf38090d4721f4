#pragma once
// Numbers that pass between the half-period's interrupt and what it interrupts: written by one side and read by the
// other, with all that was written before.

namespace zlg::core {

template <class T> [[nodiscard]] T taken(const T& from) noexcept {
    T value;
    __atomic_load(&from, &value, __ATOMIC_ACQUIRE);
    return value;
}

template <class T> void hand_over(T& to, T value) noexcept { __atomic_store(&to, &value, __ATOMIC_RELEASE); }

// false: it was not `expected`, and is as it was.
template <class T> bool hand_over_if(T& to, T expected, T value) noexcept {
    return __atomic_compare_exchange(&to, &expected, &value, false, __ATOMIC_ACQ_REL, __ATOMIC_ACQUIRE);
}

}  // namespace zlg::core
