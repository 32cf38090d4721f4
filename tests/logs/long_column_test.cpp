#include <zlg/logs/long_column.hpp>

#include <cstdlib>
#include <filesystem>

#include "temporary_folder.hpp"
#include "test.hpp"

namespace zlg::logs::long_column_test {

double number(std::size_t k) { return static_cast<double>(k * 2654435761u % 1000003u) - 0.5; }

// Several times as many as are kept in memory, and no whole number of blocks.
constexpr std::size_t many = 1'000'001;

LongColumn numbers(std::size_t n) {
    LongColumn column;
    for (std::size_t k = 0; k < n; ++k) column.push_back(number(k));
    return column;
}

void expect_numbers(const LongColumn& column) {
    ASSERT_EQ(column.size(), many);
    std::size_t k = 0, n_other = 0;
    for (const double value : column) n_other += value == number(k++) ? 0u : 1u;
    for (std::size_t i = 0, at = 0; i < 10'000; ++i, at = (at + 7'654'321) % many)
        n_other += column[at] == number(at) ? 0u : 1u;
    const std::vector<double> all = column.vector();
    for (k = 0; k < many; ++k) n_other += all[k] == number(k) ? 0u : 1u;
    EXPECT_EQ(n_other, 0u);
    EXPECT_EQ(column.back(), number(many - 1));
}

TEST(LongColumn, holds_as_many_numbers_as_there_are) {
    LongColumn column = numbers(many);
    expect_numbers(column);
    const LongColumn moved = std::move(column);
    expect_numbers(moved);
}

TEST(LongColumn, what_is_changed_is_changed_from_the_first_on) {
    LongColumn column = numbers(many);
    double sum = 0.0;
    column.change([&](double value) { return sum += value; });
    for (const std::size_t at : {std::size_t{0}, std::size_t{300'000}, many - 1}) {
        double expected = 0.0;
        for (std::size_t k = 0; k <= at; ++k) expected += number(k);
        EXPECT_EQ(column[at], expected);
    }
    EXPECT_EQ(column.size(), many);
}

TEST(LongColumn, of_few_numbers_is_as_a_vector) {
    const LongColumn column{1.0, 2.0, 3.0};
    EXPECT_EQ(column.vector(), (std::vector{1.0, 2.0, 3.0}));
    EXPECT_EQ(column.end() - column.begin(), 3);
    EXPECT_TRUE(LongColumn{}.empty());
}

// Sets TMPDIR for a test.
class TemporaryDirectory {
public:
    explicit TemporaryDirectory(const std::string& folder) { ::setenv("TMPDIR", folder.c_str(), 1); }
    ~TemporaryDirectory() {
        if (before_.empty())
            ::unsetenv("TMPDIR");
        else
            ::setenv("TMPDIR", before_.c_str(), 1);
    }

private:
    std::string before_ = std::getenv("TMPDIR") == nullptr ? "" : std::getenv("TMPDIR");
};

TEST(LongColumn, leaves_no_file_behind_and_stays_in_memory_where_none_can_be) {
    const test::TemporaryFolder folder;
    {
        const TemporaryDirectory here{folder.file("")};
        expect_numbers(numbers(many));
        EXPECT_TRUE(std::filesystem::is_empty(folder.file("")));
    }
    const TemporaryDirectory nowhere{folder.file("nowhere")};
    expect_numbers(numbers(many));
}

}  // namespace zlg::logs::long_column_test
