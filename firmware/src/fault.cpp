#include <zlg/firmware/fault.hpp>

#include <algorithm>
#include <charconv>
#include <cstddef>

#include <zlg/wire/crc.hpp>

namespace zlg::firmware {
namespace {

// Bits of the configurable fault status register.
constexpr std::uint32_t instruction_violation = 1u << 0;
constexpr std::uint32_t data_violation = 1u << 1;
constexpr std::uint32_t memory_any = 0x3b;
constexpr std::uint32_t mmfar_valid = 1u << 7;
constexpr std::uint32_t bus_any = 0x3f00;
constexpr std::uint32_t bfar_valid = 1u << 15;
constexpr std::uint32_t undefined = 1u << 16;
constexpr std::uint32_t bad_state = 3u << 17;
constexpr std::uint32_t no_unit = 1u << 19;
constexpr std::uint32_t unaligned_access = 1u << 24;
constexpr std::uint32_t zero_divisor = 1u << 25;

struct Meaning {
    std::uint32_t bits;
    FaultKind kind;
};

// The first that fits: what a failed entry into the handler adds comes after what led there.
constexpr std::array meanings{Meaning{undefined, FaultKind::undefined_instruction},
                              Meaning{no_unit, FaultKind::no_coprocessor},
                              Meaning{unaligned_access, FaultKind::unaligned},
                              Meaning{zero_divisor, FaultKind::divide_by_zero},
                              Meaning{bad_state, FaultKind::bad_branch},
                              Meaning{bus_any, FaultKind::bus_error},
                              Meaning{data_violation, FaultKind::forbidden_address},
                              Meaning{instruction_violation, FaultKind::bad_branch},
                              Meaning{memory_any, FaultKind::forbidden_address}};

#define ZLG_NAME(name) #name,
constexpr std::string_view names[]{ZLG_FAULT_KINDS(ZLG_NAME)};
#undef ZLG_NAME

// Not 0 of a record of zeros, so that cleared memory is no record.
std::uint32_t sum_of(const FaultRecord& r) noexcept {
    return wire::crc32c({reinterpret_cast<const std::uint8_t*>(&r), offsetof(FaultRecord, sum)});
}

void append(FaultText& text, std::string_view word) noexcept {
    const std::size_t n = std::min(word.size(), text.characters.size() - text.size);
    std::copy_n(word.begin(), n, text.characters.begin() + static_cast<std::ptrdiff_t>(text.size));
    text.size += n;
}

void append(FaultText& text, std::string_view key, std::uint32_t number, int base) noexcept {
    std::array<char, 10> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number, base).ptr;
    append(text, key);
    append(text, {digits.data(), static_cast<std::size_t>(end - digits.data())});
}

}  // namespace

FaultKind kind_of(std::uint32_t cfsr) noexcept {
    const auto* const hit =
        std::find_if(meanings.begin(), meanings.end(), [cfsr](const Meaning& m) { return (cfsr & m.bits) != 0; });
    return hit == meanings.end() ? FaultKind::hard_fault : hit->kind;
}

std::uint32_t address_of(std::uint32_t cfsr, std::uint32_t mmfar, std::uint32_t bfar) noexcept {
    if ((cfsr & mmfar_valid) != 0) return mmfar;
    return (cfsr & bfar_valid) != 0 ? bfar : 0;
}

FaultRecord seal(FaultRecord record) noexcept {
    record.sum = sum_of(record);
    return record;
}

bool is_sound(const FaultRecord& record) noexcept {
    return static_cast<std::size_t>(record.kind) < std::size(names) && record.sum == sum_of(record);
}

std::string_view name_of(FaultKind kind) noexcept {
    const auto number = static_cast<std::size_t>(kind);
    return number < std::size(names) ? names[number] : "unknown";
}

FaultText text_of(const FaultRecord& record) noexcept {
    FaultText text;
    append(text, name_of(record.kind));
    if (record.kind == FaultKind::none) return text;
    append(text, " pc=0x", record.pc, 16);
    append(text, " lr=0x", record.lr, 16);
    append(text, " sp=0x", record.sp, 16);
    append(text, " cfsr=0x", record.cfsr, 16);
    append(text, " hfsr=0x", record.hfsr, 16);
    append(text, " address=0x", record.address, 16);
    append(text, " detail=", record.detail, 10);
    append(text, " halves=", record.halves, 10);
    append(text, " overruns=", record.overruns, 10);
    return text;
}

}  // namespace zlg::firmware
