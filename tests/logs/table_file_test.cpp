#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <zlg/logs/error.hpp>
#include <zlg/logs/table_file.hpp>

#include "temporary_folder.hpp"

using namespace zlg::logs;
using namespace zlg::test;
namespace fs = std::filesystem;

namespace {

// How a child ends whose files cannot grow beyond 64 KiB, as on a full disk.
enum Ending { no_error = 10, io_error_and_nothing_left, io_error_and_something_left };

Ending write_a_megabyte_to(const std::string& path) {
    try {
        TableFile file{path, false};
        for (int i = 0; i < 1024; ++i) file.append(std::string(1024, 'x'));
        file.append("\n");
        file.close();
    } catch (const IoError& error) {
        const bool named = std::string{error.what()}.find(path) != std::string::npos;
        return named && !fs::exists(path) && !fs::exists(path + ".part") ? io_error_and_nothing_left
                                                                         : io_error_and_something_left;
    }
    return no_error;
}

int ending_with_file_size_limit(rlim_t limit_bytes, const std::string& path) {
    const pid_t child = ::fork();
    if (child == 0) {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{limit_bytes, limit_bytes};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        ::_exit(write_a_megabyte_to(path));
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string refusal(const std::string& path, bool force) {
    return message_of<IoError>([&] { TableFile(path, force); });
}

}  // namespace

TEST(TableFile, appears_only_at_close_and_whole) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.csv");
    TableFile file{path, false};
    file.append("one,");
    file.append("two\n");
    EXPECT_FALSE(fs::exists(path));
    EXPECT_TRUE(fs::exists(path + ".part"));
    file.close();
    EXPECT_EQ(content_of(path), "one,two\n");
    EXPECT_FALSE(fs::exists(path + ".part"));
}

TEST(TableFile, keeps_every_byte_of_a_file_longer_than_its_buffer) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.csv");
    std::string expected;
    {
        TableFile file{path, false};
        for (int i = 0; i < 300000; ++i) {
            const std::string row = std::to_string(i) + ",x\n";
            expected += row;
            file.append(row);
        }
        file.close();
    }
    EXPECT_TRUE(content_of(path) == expected);
}

TEST(TableFile, destroyed_before_close_leaves_nothing) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.csv");
    { TableFile(path, false).append("half a row"); }
    EXPECT_FALSE(fs::exists(path));
    EXPECT_FALSE(fs::exists(path + ".part"));
}

TEST(TableFile, a_moved_file_is_written_once_by_its_new_owner) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.csv");
    TableFile first{path, false};
    first.append("a");
    TableFile second{std::move(first)};
    second.append("b");
    second.close();
    EXPECT_EQ(content_of(path), "ab");
}

TEST(TableFile, does_not_overwrite_without_force) {
    const TemporaryFolder folder;
    const std::string path = folder.write("a.csv", "precious");
    EXPECT_EQ(refusal(path, false), path + " exists; use --force to overwrite");
    EXPECT_EQ(content_of(path), "precious");
    EXPECT_FALSE(fs::exists(path + ".part"));
}

TEST(TableFile, with_force_the_old_file_stays_until_close) {
    const TemporaryFolder folder;
    const std::string path = folder.write("a.csv", "old");
    TableFile file{path, true};
    file.append("new");
    EXPECT_EQ(content_of(path), "old");
    file.close();
    EXPECT_EQ(content_of(path), "new");
}

TEST(TableFile, a_file_that_appears_meanwhile_survives_without_force) {
    const TemporaryFolder folder;
    TableFile file{folder.file("a.csv"), false};
    file.append("new");
    const std::string path = folder.write("a.csv", "precious");
    EXPECT_EQ(message_of<IoError>([&] { file.close(); }), path + " exists; use --force to overwrite");
    EXPECT_EQ(content_of(path), "precious");
    EXPECT_FALSE(fs::exists(path + ".part"));
}

TEST(TableFile, an_unfinished_part_is_not_replaced_without_force) {
    const TemporaryFolder folder;
    const std::string part = folder.write("a.csv.part", "of another run");
    expect_contains(refusal(folder.file("a.csv"), false), part + " exists");
    EXPECT_EQ(content_of(part), "of another run");
    TableFile file{folder.file("a.csv"), true};
    file.append("new");
    file.close();
    EXPECT_EQ(content_of(folder.file("a.csv")), "new");
}

TEST(TableFile, of_two_writers_to_one_name_the_second_is_refused) {
    const TemporaryFolder folder;
    TableFile first{folder.file("a.csv"), false};
    first.append("first");
    expect_contains(refusal(folder.file("a.csv"), false), "a.csv.part exists");
    first.close();
    EXPECT_EQ(content_of(folder.file("a.csv")), "first");
}

TEST(TableFile, a_writer_whose_part_was_taken_by_force_touches_nothing_of_the_other) {
    const TemporaryFolder folder;
    TableFile first{folder.file("a.csv"), true};
    TableFile second{folder.file("a.csv"), true};
    second.append("second");
    expect_contains(message_of<IoError>([&] { first.close(); }), "another program");
    second.close();
    EXPECT_EQ(content_of(folder.file("a.csv")), "second");
}

TEST(TableFile, refuses_what_is_no_place_for_a_file) {
    const TemporaryFolder folder;
    expect_contains(refusal(folder.file("missing/a.csv"), true), "there is no folder");
    expect_contains(refusal(folder.file(""), true), "is a folder");
    expect_contains(refusal(folder.write("plain", "") + "/a.csv", true), "there is no folder");
    expect_contains(refusal("/proc/a.csv", true), "cannot create /proc/a.csv.part: ");
    expect_contains(refusal("", true), "needs a name");
}

TEST(TableFile, never_replaces_a_device_even_with_force) {
    expect_contains(refusal("/dev/null", true), "no regular file");
    struct stat status {};
    ASSERT_EQ(::stat("/dev/null", &status), 0);
    EXPECT_TRUE(S_ISCHR(status.st_mode));
}

TEST(TableFile, a_full_disk_is_an_error_and_leaves_nothing) {
    const TemporaryFolder folder;
    EXPECT_EQ(ending_with_file_size_limit(64 << 10, folder.file("a.csv")), io_error_and_nothing_left);
    EXPECT_EQ(ending_with_file_size_limit(2 << 20, folder.file("b.csv")), no_error);
    EXPECT_EQ(fs::file_size(folder.file("b.csv")), (1u << 20) + 1u);
}

TEST(TableFile, nothing_can_be_written_after_close) {
    const TemporaryFolder folder;
    TableFile file{folder.file("a.csv"), false};
    file.close();
    EXPECT_THROW(file.append("late"), IoError);
    EXPECT_THROW(file.close(), IoError);
}

TEST(TableFile, flush_hands_over_what_was_buffered) {
    const TemporaryFolder folder;
    TableFile file{folder.file("a.csv"), false};
    EXPECT_EQ(file.part_path(), folder.file("a.csv.part"));
    file.append("one\n");
    file.flush();
    EXPECT_EQ(content_of(file.part_path()), "one\n");
    file.append("two\n");
    file.close();
    EXPECT_EQ(content_of(folder.file("a.csv")), "one\ntwo\n");
    EXPECT_THROW(file.flush(), IoError);
}

TEST(TableFile, bytes_can_be_put_over_those_before_and_the_rest_goes_on) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.csv");
    TableFile file{path, false};
    file.append("name = ....\n");
    file.overwrite(7, "left");  // still in the buffer
    file.append(std::string(3 << 20, 'x') + "\n");
    file.overwrite(7, "riGh");  // long in the file
    file.append("end\n");
    file.close();
    EXPECT_EQ(content_of(path), "name = riGh\n" + std::string(3 << 20, 'x') + "\nend\n");
    EXPECT_THROW(file.overwrite(0, "n"), IoError);
}
