// Claims about whole sweeps: the file is the same whatever way led to it, and no gyro is run twice.

#include <zlg/logs/error.hpp>
#include <zlg/sweep/sweep.hpp>

#include "descriptions.hpp"
#include "temporary_folder.hpp"

namespace zlg::sweep::sweep_test {

Task task_of(const std::string& out, const Description& description = short_sweep()) {
    return {.description = description, .out = out, .threads = 1};
}

std::string whole_bytes() {
    static const std::string bytes = [] {
        const test::TemporaryFolder folder;
        (void)run(task_of(folder.file("r.h5")));
        return test::content_of(folder.file("r.h5"));
    }();
    return bytes;
}

TEST(Sweep, threads_do_not_change_a_byte) {
    for (const int threads : {2, 4}) {
        const test::TemporaryFolder folder;
        Task task = task_of(folder.file("r.h5"));
        task.threads = threads;
        EXPECT_EQ(run(task).n_run, 6);
        EXPECT_EQ(test::content_of(folder.file("r.h5")), whole_bytes());
        EXPECT_FALSE(std::filesystem::exists(folder.file("r.h5.part")));
    }
}

TEST(Sweep, parts_in_any_order_make_the_same_bytes) {
    const test::TemporaryFolder folder;
    std::vector<std::string> parts;
    for (const std::int64_t k : {4, 1, 3, 2}) {
        parts.push_back(folder.file(std::to_string(k) + ".h5"));
        Task task = task_of(parts.back());
        task.part = {k, 4};
        (void)run(task);
    }
    (void)merge({parts[2], parts[0]}, folder.file("some.h5"), false);
    (void)merge({parts[1], folder.file("some.h5"), parts[3]}, folder.file("all.h5"), false);
    EXPECT_EQ(test::content_of(folder.file("all.h5")), whole_bytes());
    // What is missing in a merger of some is run as ever.
    EXPECT_EQ(run(task_of(folder.file("some.h5"))).n_run, 4) << "only gyros 2 and 3 are there";
}

TEST(Sweep, stopped_at_any_gyro_it_goes_on) {
    const test::TemporaryFolder folder;
    std::int64_t calls = 0;
    std::int64_t ran = 0;
    for (bool is_stopped = true; is_stopped; ++calls) {
        Task task = task_of(folder.file("r.h5"));
        bool enough = false;
        task.on_progress = [&](std::int64_t, std::int64_t) { enough = true; };
        task.is_stopped = [&] { return enough; };
        const Outcome outcome = run(task);
        is_stopped = outcome.is_stopped;
        ran += outcome.n_run;
    }
    EXPECT_EQ(calls, 6);
    EXPECT_EQ(ran, 6) << "none twice";
    EXPECT_EQ(test::content_of(folder.file("r.h5")), whole_bytes());
}

// From the last to the first, and half of them in each call.
TEST(Sweep, another_crew_in_another_order_gives_the_same_bytes) {
    const test::TemporaryFolder folder;
    Task task = task_of(folder.file("r.h5"));
    task.crew = [](const Gyros& gyros, const std::vector<std::int64_t>& asked, const std::function<void(Row)>& take) {
        const std::size_t n = asked.size() > 3 ? 3 : asked.size();
        for (std::size_t k = 0; k < n; ++k) take(gyros.run(asked[asked.size() - 1 - k]));
        return n == asked.size();
    };
    const Outcome first = run(task);
    EXPECT_TRUE(first.is_stopped);
    EXPECT_EQ(first.rows.begin()->first, 3) << "gyros 3, 4 and 5 were run";
    EXPECT_FALSE(std::filesystem::exists(folder.file("r.h5")));
    EXPECT_EQ(run(task).n_run, 3);
    EXPECT_EQ(test::content_of(folder.file("r.h5")), whole_bytes());
}

TEST(Sweep, finished_it_does_nothing) {
    const test::TemporaryFolder folder;
    (void)run(task_of(folder.file("r.h5")));
    const auto written = std::filesystem::last_write_time(folder.file("r.h5"));
    const Outcome again = run(task_of(folder.file("r.h5")));
    EXPECT_EQ(again.n_run, 0);
    EXPECT_EQ(again.rows.size(), 6u);
    EXPECT_EQ(std::filesystem::last_write_time(folder.file("r.h5")), written);
}

TEST(Sweep, more_gyros_are_added_and_fewer_are_refused) {
    const test::TemporaryFolder folder;
    (void)run(task_of(folder.file("r.h5"), short_sweep(4)));
    EXPECT_EQ(run(task_of(folder.file("r.h5"))).n_run, 2);
    EXPECT_EQ(test::content_of(folder.file("r.h5")), whole_bytes());
    EXPECT_THROW((void)run(task_of(folder.file("r.h5"), short_sweep(5))), config::ConfigError);
}

TEST(Sweep, new_limits_run_nothing_and_are_written) {
    const test::TemporaryFolder folder;
    (void)run(task_of(folder.file("r.h5")));
    Description limited = short_sweep();
    limited.metrics[0].max = 2.0;
    EXPECT_EQ(run(task_of(folder.file("r.h5"), limited)).n_run, 0);
    EXPECT_EQ(read_results(folder.file("r.h5")).description, to_toml(limited));
}

TEST(Sweep, another_sweeps_results_are_left_alone_without_force) {
    const test::TemporaryFolder folder;
    Description other = short_sweep();
    other.seed = 1;
    (void)run(task_of(folder.file("r.h5"), other));
    const std::string before = test::content_of(folder.file("r.h5"));
    EXPECT_THROW((void)run(task_of(folder.file("r.h5"))), logs::IoError);
    EXPECT_EQ(test::content_of(folder.file("r.h5")), before);
    Task task = task_of(folder.file("r.h5"));
    task.force = true;
    EXPECT_EQ(run(task).n_run, 6);
    EXPECT_EQ(test::content_of(folder.file("r.h5")), whole_bytes());
}

TEST(Sweep, parts_of_different_sweeps_do_not_merge) {
    const test::TemporaryFolder folder;
    Description other = short_sweep();
    other.seed = 1;
    (void)run(task_of(folder.file("a.h5")));
    (void)run(task_of(folder.file("b.h5"), other));
    EXPECT_THROW((void)merge({folder.file("a.h5"), folder.file("b.h5")}, folder.file("m.h5"), false), logs::IoError);
    EXPECT_FALSE(std::filesystem::exists(folder.file("m.h5")));
    EXPECT_THROW((void)merge({folder.file("a.h5")}, folder.file("b.h5"), false), logs::IoError) << "it exists";
}

}  // namespace zlg::sweep::sweep_test
