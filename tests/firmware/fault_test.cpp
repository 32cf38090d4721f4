#include <zlg/firmware/fault.hpp>

#include "test.hpp"

namespace zlg::firmware::fault_test {

// Bits as ARMv7-M's manual gives them, section B3.2.15.
TEST(Fault, the_registers_tell_what_it_was) {
    EXPECT_EQ(kind_of(1u << 16), FaultKind::undefined_instruction);
    EXPECT_EQ(kind_of(1u << 17), FaultKind::bad_branch);  // the Thumb bit is clear
    EXPECT_EQ(kind_of(1u << 18), FaultKind::bad_branch);  // a bad return from an exception
    EXPECT_EQ(kind_of(1u << 19), FaultKind::no_coprocessor);
    EXPECT_EQ(kind_of(1u << 24), FaultKind::unaligned);
    EXPECT_EQ(kind_of(1u << 25), FaultKind::divide_by_zero);
    EXPECT_EQ(kind_of(1u << 9 | 1u << 15), FaultKind::bus_error);
    EXPECT_EQ(kind_of(1u << 10), FaultKind::bus_error);
    EXPECT_EQ(kind_of(1u << 0), FaultKind::bad_branch);
    EXPECT_EQ(kind_of(1u << 1 | 1u << 7), FaultKind::forbidden_address);
    EXPECT_EQ(kind_of(1u << 4), FaultKind::forbidden_address);
    EXPECT_EQ(kind_of(0), FaultKind::hard_fault);
}

TEST(Fault, a_failed_entry_into_the_handler_does_not_hide_the_cause) {
    EXPECT_EQ(kind_of(1u << 25 | 1u << 4), FaultKind::divide_by_zero);
    EXPECT_EQ(kind_of(1u << 16 | 1u << 12), FaultKind::undefined_instruction);
}

TEST(Fault, the_address_is_that_of_the_valid_register) {
    EXPECT_EQ(address_of(1u << 7, 11, 22), 11u);
    EXPECT_EQ(address_of(1u << 15, 11, 22), 22u);
    EXPECT_EQ(address_of(1u << 16, 11, 22), 0u);
}

TEST(Fault, every_flipped_bit_of_a_record_is_seen) {
    const FaultRecord record = seal({.kind = FaultKind::bus_error, .pc = 0x1234, .address = 0x50000000, .halves = 77});
    ASSERT_TRUE(is_sound(record));
    for (std::size_t bit = 0; bit < 8 * sizeof record; ++bit) {
        FaultRecord spoilt = record;
        unsigned char bytes[sizeof spoilt];
        std::memcpy(bytes, &spoilt, sizeof spoilt);
        bytes[bit / 8] = static_cast<unsigned char>(bytes[bit / 8] ^ (1u << (bit % 8)));
        std::memcpy(&spoilt, bytes, sizeof spoilt);
        EXPECT_FALSE(is_sound(spoilt)) << "bit " << bit;
    }
}

TEST(Fault, cleared_memory_and_paint_are_no_record) {
    EXPECT_FALSE(is_sound(FaultRecord{}));
    FaultRecord ones;
    std::memset(static_cast<void*>(&ones), 0xff, sizeof ones);
    EXPECT_FALSE(is_sound(ones));
}

TEST(Fault, a_kind_that_does_not_exist_is_no_record) {
    EXPECT_FALSE(is_sound(seal({.kind = static_cast<FaultKind>(15)})));
    EXPECT_TRUE(is_sound(seal({.kind = FaultKind::reset})));
    EXPECT_EQ(name_of(static_cast<FaultKind>(15)), "unknown");
}

TEST(Fault, the_numbers_of_the_kinds_stay) {
    EXPECT_EQ(static_cast<int>(FaultKind::undefined_instruction), 1);
    EXPECT_EQ(static_cast<int>(FaultKind::stack_overflow), 8);
    EXPECT_EQ(static_cast<int>(FaultKind::reset), 14);
    EXPECT_EQ(name_of(FaultKind::stack_overflow), "stack_overflow");
    EXPECT_EQ(name_of(FaultKind::background_hung), "background_hung");
    EXPECT_EQ(name_of(FaultKind::reset), "reset");
}

TEST(Fault, the_line_names_every_number) {
    const FaultRecord record{.kind = FaultKind::bus_error,
                             .pc = 0x1a2b,
                             .lr = 0xfffffff9,
                             .sp = 0x20003000,
                             .cfsr = 0x8200,
                             .hfsr = 0x40000000,
                             .address = 0x50000000,
                             .detail = 3,
                             .halves = 4000000000,
                             .overruns = 5};
    EXPECT_EQ(text_of(record).view(),
              "bus_error pc=0x1a2b lr=0xfffffff9 sp=0x20003000 cfsr=0x8200 hfsr=0x40000000 address=0x50000000 detail=3 "
              "halves=4000000000 overruns=5");
    EXPECT_EQ(text_of({}).view(), "none");
}

TEST(Fault, the_longest_line_fits) {
    const std::uint32_t most = 0xffffffff;
    const FaultText text =
        text_of({FaultKind::undefined_instruction, most, most, most, most, most, most, most, most, most});
    EXPECT_TRUE(text.view().ends_with("overruns=4294967295")) << text.view();
}

}  // namespace zlg::firmware::fault_test
