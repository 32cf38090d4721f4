// Claims about an HDF5 log while it grows: it can be followed, its writer can be killed, the disk can be full.
#include <sys/mman.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/log_kind.hpp>
#include <zlg/logs/raw_log.hpp>

#include "raw_rows.hpp"
#include "temporary_folder.hpp"

using namespace zlg::logs;
using namespace zlg::test;
using namespace std::chrono_literals;
using zlg::core::HalfRecord;
namespace fs = std::filesystem;

namespace {

constexpr RawWriterOptions keep{.light_samples = 4, .keep_part = true};

std::array<float, 4> light_of(std::int64_t half) {
    const auto x = static_cast<float>(half % 1000);
    return {x, x + 0.25f, x + 0.5f, x + 0.75f};
}

void write_row(RawWriter& writer, std::int64_t half) { writer.write(row_of(half), {light_of(half)}); }

// How many rows there are; a failure when one of them is not the one that was written.
std::int64_t good_rows(RawReader& reader, std::int64_t expected = 0) {
    HalfRecord row;
    while (reader.next(row)) {
        const bool same_light = std::ranges::equal(reader.light().a, light_of(expected));
        if (!(row == row_of(expected) && same_light)) {
            ADD_FAILURE() << "row " << expected << " is another";
            return expected;
        }
        ++expected;
    }
    return expected;
}

// A number that a child process and its parent both see.
class SharedCount {
public:
    SharedCount()
        : count_{static_cast<std::atomic<std::int64_t>*>(::mmap(
              nullptr, sizeof(std::atomic<std::int64_t>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0))} {
        new (count_) std::atomic<std::int64_t>{0};
    }
    ~SharedCount() { ::munmap(count_, sizeof *count_); }
    SharedCount(const SharedCount&) = delete;
    void set(std::int64_t value) { count_->store(value); }
    [[nodiscard]] std::int64_t get() const { return count_->load(); }

private:
    std::atomic<std::int64_t>* count_;
};

// The exit status of a child; empty when it has not ended in time, and then it is killed.
std::optional<int> status_of(pid_t child, std::chrono::milliseconds limit = 60s) {
    int status = 0;
    for (auto waited = 0ms; waited < limit; waited += 2ms) {
        if (::waitpid(child, &status, WNOHANG) == child) return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        std::this_thread::sleep_for(2ms);
    }
    ::kill(child, SIGKILL);
    ::waitpid(child, &status, 0);
    return std::nullopt;
}

bool begins_as_hdf5(const std::string& path) { return content_of(path).starts_with("\x89HDF"); }

// Writes rows until a limit stops it, and ends as a program does, with all that libraries do then.
//
// exit status  0: the failure was named, 1: with other words, 2: there was none.
[[noreturn]] void write_until_it_fails(const std::string& path, const std::string& reason, bool keep_part,
                                       SharedCount& flushed) {
    int status = 2;
    try {
        RawWriter writer{
            path, {{"run.seed", "1"}}, false, all_raw_columns, {.light_samples = 4, .keep_part = keep_part}};
        for (std::int64_t half = 0; half < 400'000; ++half) {
            write_row(writer, half);
            if (half % 5000 != 4999) continue;
            writer.flush();
            flushed.set(half + 1);
        }
        writer.close();
    } catch (const IoError& error) {
        const std::string expected = "cannot write " + path + ".part: " + reason;
        status = error.what() == expected ? 0 : 1;
        if (status == 1) std::fprintf(stderr, "%s\n", error.what());
    }
    std::exit(status);
}

struct Failed {
    std::optional<int> status;
    std::int64_t flushed = 0;
    std::string printed;  // on standard error
};

// `prepare` sets the limit in the child.
template <class Prepare>
Failed write_in_a_child(const std::string& path, const std::string& reason, bool keep_part,
                        const std::string& printed_to, Prepare prepare) {
    SharedCount flushed;
    const pid_t child = ::fork();
    if (child == 0) {
        if (std::freopen(printed_to.c_str(), "w", stderr) == nullptr) ::_exit(3);
        prepare();
        write_until_it_fails(path, reason, keep_part, flushed);
    }
    const auto status = status_of(child);
    return {status, flushed.get(), content_of(printed_to)};
}

Failed write_with_file_limit(const TemporaryFolder& folder, const std::string& path, rlim_t bytes, bool keep_part) {
    return write_in_a_child(path, "File too large", keep_part, folder.file("printed"), [bytes] {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{bytes, bytes};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    });
}

class TinyDisk {
public:
    explicit TinyDisk(const std::string& path, const char* options) : path_{path} {
        fs::create_directory(path);
        is_mounted_ = ::mount("none", path.c_str(), "tmpfs", 0, options) == 0;
    }
    ~TinyDisk() {
        if (is_mounted_) ::umount2(path_.c_str(), MNT_DETACH);
    }
    TinyDisk(const TinyDisk&) = delete;
    [[nodiscard]] bool is_mounted() const { return is_mounted_; }

private:
    std::string path_;
    bool is_mounted_ = false;
};

}  // namespace

TEST(GrowingLog, a_follower_in_the_same_process_sees_what_is_flushed) {
    const TemporaryFolder folder;
    AngleWriter writer{folder.file("a.h5"), 0.005, {}, false};
    AngleReader reader{writer.part_path()};
    TimedAngle angle;
    EXPECT_FALSE(reader.next(angle));
    EXPECT_FALSE(reader.refresh());
    writer.write({.tick = 0, .dtheta_arcsec = 7.0});
    EXPECT_FALSE(reader.refresh()) << "not flushed";
    writer.flush();
    EXPECT_TRUE(reader.refresh());
    ASSERT_TRUE(reader.next(angle));
    EXPECT_EQ(angle.row.dtheta_arcsec, 7.0);
    EXPECT_FALSE(reader.next(angle));
    writer.write({.tick = 1});
    writer.close();
    EXPECT_TRUE(reader.refresh());
    EXPECT_TRUE(reader.header().complete);
    ASSERT_TRUE(reader.next(angle));
    EXPECT_EQ(angle.row.tick, 1);
}

TEST(GrowingLog, destroyed_before_close_leaves_nothing_or_all_rows) {
    const TemporaryFolder folder;
    {
        RawWriter removed{folder.file("removed.h5"), {}, false};
        for (int half = 0; half < 20'000; ++half) removed.write(row_of(half));
        EXPECT_TRUE(fs::exists(removed.part_path()));
    }
    EXPECT_FALSE(fs::exists(folder.file("removed.h5.part")));
    {
        RawWriter kept{folder.file("kept.h5"), {}, false, all_raw_columns, keep};
        for (int half = 0; half < 20'000; ++half) write_row(kept, half);
    }
    EXPECT_FALSE(fs::exists(folder.file("kept.h5")));
    RawReader reader{folder.file("kept.h5.part")};
    EXPECT_FALSE(reader.header().complete) << "nobody has closed it";
    EXPECT_EQ(good_rows(reader), 20'000);
    RawWriter csv{folder.file("a.csv"), {}, false, all_raw_columns, {.keep_part = true}};
    EXPECT_EQ(csv.part_path(), folder.file("a.csv.part"));
}

TEST(GrowingLog, a_log_that_could_not_begin_leaves_nothing) {
    const TemporaryFolder folder;
    EXPECT_THROW(RawWriter(folder.file("raw.h5"), {{"a.b", "1\n2"}}, false, all_raw_columns, keep), FormatError);
    EXPECT_THROW(AngleWriter(folder.file("a.h5"), 1.0, {{"a.b", "\xFF"}}, false, {.keep_part = true}), FormatError);
    EXPECT_TRUE(fs::is_empty(folder.file("")));
}

// The library's own way to read a piece again and again, 1 ns, 2 ns, 4 ns ... later, would not end.
TEST(GrowingLog, a_damaged_part_is_an_error_and_not_a_wait_for_ever) {
    const TemporaryFolder folder;
    RawWriter writer{folder.file("raw.h5"), {}, false};
    for (int half = 0; half < 10; ++half) writer.write(row_of(half));
    writer.flush();
    const std::string bytes = content_of(writer.part_path());
    int headers = 0;
    for (auto at = bytes.find("OHDR"); at != std::string::npos; at = bytes.find("OHDR", at + 1)) {
        std::string damaged = bytes;
        damaged[at + 20] = static_cast<char>(~damaged[at + 20]);
        const std::string path = folder.write("damaged.h5.part", damaged);
        const pid_t child = ::fork();
        if (child == 0) {
            try {
                RawReader reader{path};
                for (HalfRecord row; reader.next(row);) continue;
            } catch (const FormatError&) {
                ::_exit(0);
            }
            ::_exit(1);
        }
        const auto status = status_of(child, 20s);
        ASSERT_TRUE(status.has_value()) << "header " << headers << ": no answer";
        ++headers;
    }
    EXPECT_GE(headers, 12) << "root, group and ten columns";
}

TEST(GrowingLog, does_not_overwrite_without_force) {
    const TemporaryFolder folder;
    const std::string path = folder.write("raw.h5", "precious");
    const auto refusal = [&] { return message_of<IoError>([&] { RawWriter(path, {}, false); }); };
    EXPECT_EQ(refusal(), path + " exists; use --force to overwrite");
    fs::remove(path);
    const std::string part = folder.write("raw.h5.part", "of another run");
    expect_contains(refusal(), part + " exists");
    EXPECT_EQ(content_of(part), "of another run");
    RawWriter writer{path, {}, true};
    writer.write(row_of(0));
    static_cast<void>(folder.write("raw.h5", "old"));
    writer.close();
    EXPECT_TRUE(begins_as_hdf5(path));
}

TEST(GrowingLog, a_file_that_appears_meanwhile_survives_without_force) {
    const TemporaryFolder folder;
    const std::string path = folder.file("raw.h5");
    RawWriter writer{path, {}, false, all_raw_columns, {.keep_part = true}};
    writer.write(row_of(0));
    static_cast<void>(folder.write("raw.h5", "precious"));
    const std::string message = message_of<IoError>([&] { writer.close(); });
    EXPECT_EQ(message, path + " exists; use --force to overwrite; the log stays in " + path + ".part");
    EXPECT_EQ(content_of(path), "precious");
    HalfRecord row;
    EXPECT_TRUE(RawReader{writer.part_path()}.next(row));
}

TEST(GrowingLog, nothing_can_be_written_after_close) {
    const TemporaryFolder folder;
    RawWriter writer{folder.file("raw.h5"), {}, false};
    writer.write(row_of(0));
    writer.close();
    EXPECT_THROW(writer.write(row_of(1)), IoError);
    EXPECT_THROW(writer.flush(), IoError);
    EXPECT_THROW(writer.close(), IoError);
}

// From a limit that stops the first bytes to one that stops the last.
TEST(GrowingLog, a_file_that_may_not_grow_is_an_error_and_keeps_what_was_flushed) {
    const TemporaryFolder folder;
    int with_rows = 0;
    int k = 0;
    for (const rlim_t limit : {rlim_t{0}, rlim_t{40}, rlim_t{1000}, rlim_t{4096}, rlim_t{7000}, rlim_t{9000},
                               rlim_t{100'000}, rlim_t{1'000'000}, rlim_t{2'345'678}, rlim_t{5'000'001},
                               rlim_t{9'999'999}, rlim_t{20'000'000}, rlim_t{27'000'000}}) {
        const std::string path = folder.file(std::to_string(k++) + ".h5");
        const Failed failed = write_with_file_limit(folder, path, limit, true);
        EXPECT_EQ(failed.status, 0) << "limit " << limit << ": " << failed.printed;
        EXPECT_EQ(failed.printed, "") << "limit " << limit;
        EXPECT_FALSE(fs::exists(path));
        if (failed.flushed == 0) continue;
        RawReader reader{path + ".part"};
        EXPECT_GE(good_rows(reader), failed.flushed) << "limit " << limit;
        EXPECT_FALSE(reader.header().complete);
        ++with_rows;
    }
    EXPECT_GE(with_rows, 5);
}

TEST(GrowingLog, a_failed_log_is_removed_where_it_is_not_to_be_kept) {
    const TemporaryFolder folder;
    const Failed failed = write_with_file_limit(folder, folder.file("raw.h5"), 3'000'000, false);
    EXPECT_EQ(failed.status, 0) << failed.printed;
    EXPECT_EQ(failed.printed, "");
    EXPECT_FALSE(fs::exists(folder.file("raw.h5.part")));
}

TEST(GrowingLog, a_full_disk_is_an_error_and_keeps_what_was_flushed) {
    const TemporaryFolder folder;
    const TinyDisk disk{folder.file("disk"), "size=4m"};
    if (!disk.is_mounted()) GTEST_SKIP() << "needs the right to mount";
    const std::string path = folder.file("disk/raw.h5");
    const Failed failed = write_in_a_child(path, "No space left on device", true, folder.file("printed"), [] {});
    EXPECT_EQ(failed.status, 0) << failed.printed;
    EXPECT_EQ(failed.printed, "");
    EXPECT_GT(failed.flushed, 0);
    RawReader reader{path + ".part"};
    EXPECT_GE(good_rows(reader), failed.flushed);
}
