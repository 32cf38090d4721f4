#pragma once
// Why a processor began anew: a record that outlives the reset, and the words for it.
//
// Nothing here knows a board. The fault registers are those of ARMv7-M.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace zlg::firmware {

// By their numbers from 0 on, which go out in the status message and never change their meaning.
// clang-format off
#define ZLG_FAULT_KINDS(KIND)                                                                            \
    KIND(none) /* power */                                                                               \
    KIND(undefined_instruction) /* no such instruction, or none of this processor */                     \
    KIND(no_coprocessor) /* of a unit that is absent or switched off */                                  \
    KIND(unaligned) /* access that must be aligned and is not */                                         \
    KIND(divide_by_zero) /* of integers */                                                               \
    KIND(bad_branch) /* to what is no code, or a return to what was no exception */                      \
    KIND(bus_error) /* nobody answers at this address */                                                 \
    KIND(forbidden_address) /* outside of what the program may read, write or run */                     \
    KIND(stack_overflow)                                                                                 \
    KIND(hard_fault) /* none of those above */                                                           \
    KIND(unexpected_interrupt) /* detail: number of the exception */                                     \
    KIND(assertion) /* detail: that of the caller */                                                     \
    KIND(half_period_hung) /* the watchdog: no half-period has ended */                                  \
    KIND(background_hung) /* the watchdog: halves go on, the background does not */                      \
    KIND(reset) /* without a reason noted: from outside, or by the watchdog when nothing ran any more */

// clang-format on
#define ZLG_ENUMERATOR(name) name,
enum class FaultKind : std::uint32_t { ZLG_FAULT_KINDS(ZLG_ENUMERATOR) };
#undef ZLG_ENUMERATOR

struct FaultRecord {
    FaultKind kind = FaultKind::none;
    std::uint32_t pc = 0;  // instruction that was interrupted; 0: not known
    std::uint32_t lr = 0;  // where it would have returned to; 0: not known
    std::uint32_t sp = 0;
    std::uint32_t cfsr = 0;  // fault status registers
    std::uint32_t hfsr = 0;
    std::uint32_t address = 0;  // that was asked for; 0: not known
    std::uint32_t detail = 0;   // see the kind
    std::uint32_t halves = 0;   // half-periods done since the start, wraps
    std::uint32_t overruns = 0;
    std::uint32_t sum = 0;  // of all the others, made by `seal`

    friend bool operator==(const FaultRecord&, const FaultRecord&) = default;
};

// What the registers say; they alone do not distinguish `stack_overflow` from `forbidden_address`.
[[nodiscard]] FaultKind kind_of(std::uint32_t cfsr) noexcept;

// The address that was asked for, of the two registers for it; 0 where neither is valid.
[[nodiscard]] std::uint32_t address_of(std::uint32_t cfsr, std::uint32_t mmfar, std::uint32_t bfar) noexcept;

[[nodiscard]] FaultRecord seal(FaultRecord record) noexcept;

// False of memory that held no record, or lost a bit of it.
[[nodiscard]] bool is_sound(const FaultRecord& record) noexcept;

// As in the enumeration.
[[nodiscard]] std::string_view name_of(FaultKind kind) noexcept;

// One line for a reader, without its end: the name, then key=value.
struct FaultText {
    std::array<char, 192> characters{};
    std::size_t size = 0;

    [[nodiscard]] std::string_view view() const noexcept { return {characters.data(), size}; }
};

[[nodiscard]] FaultText text_of(const FaultRecord& record) noexcept;

}  // namespace zlg::firmware
