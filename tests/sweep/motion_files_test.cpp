// Claims about the motion files of a sweep: those that its gyros may read are known by their bytes, and no others are
// looked at.

#include <fmt/format.h>
#include <zlg/logs/error.hpp>
#include <zlg/sweep/motion_files.hpp>

#include "descriptions.hpp"
#include "temporary_folder.hpp"

namespace zlg::sweep::motion_files_test {

class MotionFiles : public testing::Test {
protected:
    std::string written(const std::string& name, const std::string& bytes) { return folder_.write(name, bytes); }
    static Description moved_by(const std::string& kind, const std::string& path, const std::string& parameter = "") {
        return parse(fmt::format("[sweep]\ngyros = 4\n[base.motion]\nkind = \"{}\"\npath = \"{}\"\n{}{}", kind, path,
                                 parameter, testing_metric),
                     "s.toml");
    }

    test::TemporaryFolder folder_;
};

// The checksums are the published ones of XXH64 with seed 0.
TEST_F(MotionFiles, have_the_checksum_of_their_bytes) {
    const std::string none = written("none", ""), a = written("a", "a");
    EXPECT_EQ(with_motion_checksums(moved_by("file", none)).motion_checksums.at(none), "ef46db3751d8e999");
    EXPECT_EQ(with_motion_checksums(moved_by("file", a)).motion_checksums.at(a), "d24ec4f1a98c6e5b");
}

TEST_F(MotionFiles, longer_than_a_block_count_to_the_last_byte) {
    const std::string one = written("one", std::string(200'000, 'x') + "y");
    const std::string other = written("other", std::string(200'000, 'x') + "z");
    EXPECT_NE(with_motion_checksums(moved_by("file", one)).motion_checksums.at(one),
              with_motion_checksums(moved_by("file", other)).motion_checksums.at(other));
}

TEST_F(MotionFiles, are_all_that_a_parameter_may_name) {
    const std::string a = written("a", "a"), b = written("b", "b");
    const std::string paths =
        fmt::format("[[parameter]]\nkeys = [\"motion.path\"]\ndraw = \"list\"\nvalues = [\"{}\", \"{}\"]\n", a, b);
    EXPECT_EQ(with_motion_checksums(moved_by("file", a, paths)).motion_checksums.size(), 2u);
    const std::string kinds =
        "[[parameter]]\nkeys = [\"motion.kind\"]\ndraw = \"grid\"\nvalues = [\"rest\", \"file\"]\n";
    EXPECT_EQ(with_motion_checksums(moved_by("rest", b, kinds)).motion_checksums.size(), 1u);
}

TEST_F(MotionFiles, that_no_gyro_reads_are_not_looked_at) {
    EXPECT_TRUE(with_motion_checksums(moved_by("sine", "/nowhere")).motion_checksums.empty());
}

TEST_F(MotionFiles, that_have_changed_or_are_none_are_refused) {
    const Description before = with_motion_checksums(moved_by("file", written("a", "a")));
    EXPECT_EQ(with_motion_checksums(before), before);
    written("a", "b");
    EXPECT_THROW((void)with_motion_checksums(before), zlg::logs::IoError);
    EXPECT_THROW((void)with_motion_checksums(moved_by("file", folder_.file("nothing"))), zlg::logs::IoError);
    EXPECT_THROW((void)with_motion_checksums(moved_by("file", folder_.file(""))), zlg::logs::IoError);
}

TEST_F(MotionFiles, that_are_written_or_replaced_are_seen) {
    const std::string path = written("a", "a");
    const Description description = with_motion_checksums(moved_by("file", path));
    const MotionWatch watch{description};
    EXPECT_NO_THROW(watch.require_unchanged());
    std::ofstream{path, std::ios::app} << "b";
    EXPECT_THROW(watch.require_unchanged(), zlg::logs::IoError);
    const MotionWatch again{description};
    const std::string other = written("other", "ab");
    std::filesystem::rename(other, path);
    EXPECT_THROW(again.require_unchanged(), zlg::logs::IoError);
    const MotionWatch at_last{description};
    std::filesystem::remove(path);
    EXPECT_THROW(at_last.require_unchanged(), zlg::logs::IoError);
    const Description unmoved = moved_by("rest", path);
    EXPECT_NO_THROW(MotionWatch{unmoved}.require_unchanged());
}

}  // namespace zlg::sweep::motion_files_test
