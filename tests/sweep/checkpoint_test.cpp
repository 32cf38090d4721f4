// Claims about checkpoints: what was appended is there, a torn end is cut off, anything else that is wrong is said.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include <zlg/logs/error.hpp>
#include <zlg/sweep/checkpoint.hpp>

#include "descriptions.hpp"
#include "folder.hpp"

namespace {

using namespace zlg;
using namespace zlg::sweep;

const Row good{.gyro = 3, .fingerprint = "0123456789abcdef", .metrics = {0.1 + 0.2}};
const Row bad{.gyro = 0, .status = Status::refused, .reason = "no | gyro, \"really\"", .metrics = {std::nan("")}};

std::string description() { return to_toml(short_sweep()); }

void fill(const std::string& path) {
    Checkpoint checkpoint{path, description()};
    checkpoint.append(good);
    checkpoint.append(bad);
}

std::string complaint(const std::string& path, const std::string& text) {
    try {
        const Checkpoint checkpoint{path, text};
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

TEST(Checkpoint, holds_every_row_bit_for_bit) {
    const Folder folder;
    fill(folder / "r.part");
    const Checkpoint again{folder / "r.part", description()};
    ASSERT_EQ(again.rows().size(), 2u);
    EXPECT_TRUE(are_equal(again.rows().at(3), good));
    EXPECT_TRUE(are_equal(again.rows().at(0), bad));
    EXPECT_TRUE(is_checkpoint(folder / "r.part"));
    EXPECT_EQ(read_checkpoint(folder / "r.part").description, description());
}

// A program may be killed between any two bytes.
TEST(Checkpoint, goes_on_after_any_torn_end) {
    const Folder folder;
    fill(folder / "r.part");
    const std::string whole = bytes_of(folder / "r.part");
    for (std::size_t size = 0; size <= whole.size(); ++size) {
        write_bytes(folder / "torn.part", whole.substr(0, size));
        {
            Checkpoint torn{folder / "torn.part", description()};
            for (const Row& row : {good, bad})
                if (!torn.rows().contains(row.gyro)) torn.append(row);
        }
        ASSERT_EQ(bytes_of(folder / "torn.part"), whole) << size;
    }
}

TEST(Checkpoint, damage_within_is_named_by_its_line) {
    const Folder folder;
    fill(folder / "r.part");
    std::string bytes = bytes_of(folder / "r.part");
    bytes[bytes.find("\n3\t") + 4] ^= 1;
    write_bytes(folder / "r.part", bytes);
    EXPECT_NE(complaint(folder / "r.part", description()).find("is damaged"), std::string::npos);
    EXPECT_EQ(bytes_of(folder / "r.part"), bytes) << "nothing is lost";
}

TEST(Checkpoint, of_another_sweep_is_left_alone) {
    const Folder folder;
    fill(folder / "r.part");
    Description other = short_sweep();
    other.seed = 12;
    EXPECT_NE(complaint(folder / "r.part", to_toml(other))
                  .find("is of another sweep: it has `seed = 11`, this one `seed = 12`"),
              std::string::npos);
    write_bytes(folder / "x.part", "something else\n");
    EXPECT_NE(complaint(folder / "x.part", description()).find("is no checkpoint"), std::string::npos);
    EXPECT_EQ(bytes_of(folder / "x.part"), "something else\n");
}

TEST(Checkpoint, only_one_program_writes_it) {
    const Folder folder;
    const Checkpoint first{folder / "r.part", description()};
    EXPECT_NE(complaint(folder / "r.part", description()).find("another program writes it"), std::string::npos);
}

TEST(Checkpoint, removed_is_gone) {
    const Folder folder;
    Checkpoint checkpoint{folder / "r.part", description()};
    checkpoint.remove();
    EXPECT_FALSE(std::filesystem::exists(folder / "r.part"));
}

}  // namespace
