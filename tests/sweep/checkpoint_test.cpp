// Claims about checkpoints: what was appended is there, a torn end is cut off, anything else that is wrong is said.

#include <zlg/logs/error.hpp>
#include <zlg/sweep/checkpoint.hpp>

#include "descriptions.hpp"
#include "temporary_folder.hpp"

namespace zlg::sweep::checkpoint_test {

const Row good{.gyro = 3, .fingerprint = "0123456789abcdef", .metrics = {0.1 + 0.2}};
const Row bad{.gyro = 0, .status = Status::refused, .reason = "no | gyro, \"really\"", .metrics = {std::nan("")}};

std::string description() { return to_toml(short_sweep()); }

void fill(const std::string& path) {
    Checkpoint checkpoint{path, description()};
    checkpoint.append(good);
    checkpoint.append(bad);
}

std::string complaint(const std::string& path, const std::string& text) {
    return test::refusal_by<std::runtime_error>([&] { const Checkpoint checkpoint{path, text}; });
}

TEST(Checkpoint, holds_every_row_bit_for_bit) {
    const test::TemporaryFolder folder;
    fill(folder.file("r.part"));
    const Checkpoint again{folder.file("r.part"), description()};
    ASSERT_EQ(again.rows().size(), 2u);
    EXPECT_TRUE(are_equal(again.rows().at(3), good));
    EXPECT_TRUE(are_equal(again.rows().at(0), bad));
    EXPECT_TRUE(is_checkpoint(folder.file("r.part")));
    EXPECT_EQ(read_checkpoint(folder.file("r.part")).description, description());
}

// A program may be killed between any two bytes.
TEST(Checkpoint, goes_on_after_any_torn_end) {
    const test::TemporaryFolder folder;
    fill(folder.file("r.part"));
    const std::string whole = test::content_of(folder.file("r.part"));
    for (std::size_t size = 0; size <= whole.size(); ++size) {
        folder.write("torn.part", whole.substr(0, size));
        {
            Checkpoint torn{folder.file("torn.part"), description()};
            for (const Row& row : {good, bad})
                if (!torn.rows().contains(row.gyro)) torn.append(row);
        }
        ASSERT_EQ(test::content_of(folder.file("torn.part")), whole) << size;
    }
}

TEST(Checkpoint, damage_within_is_named_by_its_line) {
    const test::TemporaryFolder folder;
    fill(folder.file("r.part"));
    std::string bytes = test::content_of(folder.file("r.part"));
    bytes[bytes.find("\n3\t") + 4] ^= 1;
    folder.write("r.part", bytes);
    EXPECT_NE(complaint(folder.file("r.part"), description()).find("is damaged"), std::string::npos);
    EXPECT_EQ(test::content_of(folder.file("r.part")), bytes) << "nothing is lost";
}

TEST(Checkpoint, of_another_sweep_is_left_alone) {
    const test::TemporaryFolder folder;
    fill(folder.file("r.part"));
    Description other = short_sweep();
    other.seed = 12;
    EXPECT_NE(complaint(folder.file("r.part"), to_toml(other))
                  .find("is of another sweep: it has `seed = 11`, this one `seed = 12`"),
              std::string::npos);
    folder.write("x.part", "something else\n");
    EXPECT_NE(complaint(folder.file("x.part"), description()).find("is no checkpoint"), std::string::npos);
    EXPECT_EQ(test::content_of(folder.file("x.part")), "something else\n");
}

TEST(Checkpoint, only_one_program_writes_it) {
    const test::TemporaryFolder folder;
    const Checkpoint first{folder.file("r.part"), description()};
    EXPECT_NE(complaint(folder.file("r.part"), description()).find("another program writes it"), std::string::npos);
}

TEST(Checkpoint, removed_is_gone) {
    const test::TemporaryFolder folder;
    Checkpoint checkpoint{folder.file("r.part"), description()};
    checkpoint.remove();
    EXPECT_FALSE(std::filesystem::exists(folder.file("r.part")));
}

}  // namespace zlg::sweep::checkpoint_test
