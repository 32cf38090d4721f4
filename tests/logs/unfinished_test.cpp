#include <sys/wait.h>
#include <unistd.h>

#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/table_file.hpp>
#include <zlg/logs/unfinished.hpp>

#include "temporary_folder.hpp"

namespace zlg::logs::unfinished_test {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

// In a process of its own, which `work` ends by `_exit`, as `abandon_outputs` is meant for: its exit code.
int in_a_process(const std::function<void()>& work) {
    const pid_t child = fork();
    if (child == 0) {
        work();
        _exit(99);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// Those of a folder: the process has what other tests have completed in the one that it was forked from.
Names in_folder(const test::TemporaryFolder& folder, Names names) {
    std::erase_if(names, [&](const std::string& name) { return !name.starts_with(folder.file("")); });
    return names;
}

TEST(Unfinished, WhatIsNotCompleteGoesAndWhatHoldsRowsStays) {
    const test::TemporaryFolder folder;
    const auto path = [&](const char* name) { return folder.file(name); };
    const int code = in_a_process([&] {
        fs::create_directory(path("new"));
        fs::create_directory(path("full"));
        const NewFolder made{path("new")};
        const NewFolder full{path("full")};
        TableFile page{path("new/page.html"), false};
        page.append("half a page");
        page.flush();
        TableFile whole{path("full/whole.csv"), false};
        whole.close();
        AngleWriter grows{path("grows.h5"), 0.005, {}, false, {.keep_part = true}};
        grows.write({.tick = 0});
        grows.flush();
        AngleWriter empty{path("empty.h5"), 0.005, {}, false, {.keep_part = true}};
        AngleWriter other{path("other.h5"), 0.005, {}, false, {}};
        other.write({.tick = 0});
        other.flush();
        const auto remains = abandon_outputs();
        const Names parts{path("grows.h5.part")};
        const Names complete{path("full/whole.csv")};
        _exit(remains && remains->parts == parts && in_folder(folder, remains->complete) == complete ? 0 : 1);
    });
    EXPECT_EQ(code, 0);
    EXPECT_FALSE(fs::exists(path("new")));
    EXPECT_TRUE(fs::exists(path("full/whole.csv")));
    EXPECT_TRUE(fs::exists(path("grows.h5.part")));
    EXPECT_FALSE(fs::exists(path("empty.h5.part")));
    EXPECT_FALSE(fs::exists(path("other.h5.part")));
    // It can be read as a killed writer's.
    AngleReader reader{path("grows.h5.part")};
    TimedAngle angle;
    EXPECT_TRUE(reader.next(angle));
    EXPECT_FALSE(reader.header().complete);
}

TEST(Unfinished, ACsvLogThatCannotBeHadAgainStaysWithTheRowsFlushedSoFar) {
    const test::TemporaryFolder folder;
    const auto path = [&](const char* name) { return folder.file(name); };
    const int code = in_a_process([&] {
        AngleWriter grows{path("grows.csv"), 0.005, {}, false, {.keep_csv_part = true}};
        grows.write({.tick = 0});
        grows.write({.tick = 1});
        grows.flush();
        grows.write({.tick = 2});
        AngleWriter empty{path("empty.csv"), 0.005, {}, false, {.keep_csv_part = true}};
        empty.flush();
        const auto remains = abandon_outputs();
        _exit(remains && remains->parts == Names{path("grows.csv.part")} ? 0 : 1);
    });
    EXPECT_EQ(code, 0);
    EXPECT_FALSE(fs::exists(path("empty.csv.part")));
    AngleReader reader{path("grows.csv.part")};
    TimedAngle angle;
    EXPECT_TRUE(reader.next(angle));
    EXPECT_TRUE(reader.next(angle));
    EXPECT_FALSE(reader.next(angle));
}

TEST(Unfinished, WhatAnotherProgramHasPutUnderTheNameStays) {
    const test::TemporaryFolder folder;
    const std::string path = folder.file("a.csv");
    const int code = in_a_process([&] {
        TableFile loser{path, true};
        loser.append("mine");
        loser.flush();
        fs::remove(path + ".part");
        std::ofstream{path + ".part"} << "of another";
        const auto remains = abandon_outputs();
        _exit(remains && remains->parts.empty() && in_folder(folder, remains->complete).empty() ? 0 : 1);
    });
    EXPECT_EQ(code, 0);
    EXPECT_EQ(fs::file_size(path + ".part"), 10u);
}

TEST(Unfinished, FilesThatAppearTogetherAreNotAbandonedHalfway) {
    const test::TemporaryFolder folder;
    const auto path = [&](const char* name) { return folder.file(name); };
    const int code = in_a_process([&] {
        TableFile first{path("first.csv"), false};
        TableFile second{path("second.csv"), false};
        int tried = 0;
        {
            const Together both;
            first.close();
            std::thread{[&tried] { tried = abandon_outputs() ? 1 : 2; }}.join();
            second.close();
        }
        std::thread{[&tried] { tried += abandon_outputs() ? 10 : 20; }}.join();
        _exit(tried);
    });
    EXPECT_EQ(code, 12);
    EXPECT_TRUE(fs::exists(path("first.csv")));
    EXPECT_TRUE(fs::exists(path("second.csv")));
}

TEST(Unfinished, WhatWasCompletedOrGivenUpIsNoPartAnyMore) {
    const test::TemporaryFolder folder;
    const auto path = [&](const char* name) { return folder.file(name); };
    const int code = in_a_process([&] {
        { const TableFile given_up{path("a.csv"), false}; }
        TableFile completed{path("b.csv"), false};
        completed.close();
        // Of somebody else, under the same names.
        TableFile{path("c.csv"), false}.close();
        fs::copy_file(path("c.csv"), path("a.csv.part"));
        fs::copy_file(path("c.csv"), path("b.csv.part"));
        const auto remains = abandon_outputs();
        const Names complete{path("b.csv"), path("c.csv")};
        _exit(remains && remains->parts.empty() && in_folder(folder, remains->complete) == complete ? 0 : 1);
    });
    EXPECT_EQ(code, 0);
    EXPECT_TRUE(fs::exists(path("a.csv.part")));
    EXPECT_TRUE(fs::exists(path("b.csv.part")));
    EXPECT_TRUE(fs::exists(path("b.csv")));
}

}  // namespace zlg::logs::unfinished_test
