#include <nlohmann/json.hpp>
#include <zlg/live/record_book.hpp>

#include "kept_records.hpp"
#include "test.hpp"

namespace zlg::live::record_book_test {

using nlohmann::json;

constexpr double tick_s = 0.005;

Record record(std::int64_t tick, std::uint32_t flags = 0) {
    return {.angle = {.tick = tick,
                      .dtheta_arcsec = static_cast<double>(tick) + 0.1,
                      .dtheta_final_arcsec = static_cast<double>(tick % 7),
                      .sigma_arcsec = tick == 0 ? std::numeric_limits<double>::infinity() : 0.25,
                      .mode = -1,
                      .flags = flags}};
}

void add(RecordBook& book, std::int64_t from, std::int64_t to) {
    for (std::int64_t tick = from; tick < to; ++tick) book.add(record(tick), tick_s);
}

struct Read {
    std::string name;
    json news;
};

Read read(const Event& event) {
    const std::string start = "event: ";
    const std::size_t data = event.text.find("\ndata: ");
    EXPECT_TRUE(event.text.starts_with(start));
    EXPECT_TRUE(event.text.ends_with("\n\n"));
    // An event is two lines and an empty one.
    EXPECT_EQ(std::ranges::count(event.text, '\n'), 3);
    return {event.text.substr(start.size(), data - start.size()), json::parse(event.text.substr(data + 7))};
}

TEST(RecordBooks, GiveANewPageASnapshotAndThenEveryRecord) {
    RecordBook book{"a line", false};
    add(book, 0, 10);
    const Event first = book.event({});
    const auto [name, snapshot] = read(first);
    EXPECT_EQ(name, "snapshot");
    EXPECT_EQ(snapshot["source"], "a line");
    EXPECT_EQ(snapshot["first"], 0);
    ASSERT_EQ(snapshot["rows"].size(), 10u);
    EXPECT_EQ(snapshot["rows"][3], json({3.1, 3.0, 0.25, -1, 0, 6.0, nullptr, nullptr, nullptr, 0}));
    EXPECT_EQ(snapshot["rows"][0][2], nullptr);  // JSON has no infinity
    EXPECT_EQ(first.after, book.position());
    add(book, 10, 12);
    const auto [rows_name, rows] = read(book.event(first.after));
    EXPECT_EQ(rows_name, "rows");
    EXPECT_EQ(rows["first"], 10);
    ASSERT_EQ(rows["rows"].size(), 2u);
    EXPECT_EQ(rows["rows"][1][0], 11.1);
    EXPECT_FALSE(rows.contains("history"));
}

TEST(RecordBooks, GiveAPageThatIsFarBehindASnapshotOfTheNewest) {
    RecordBook book{"", false};
    add(book, 0, 100);
    const Position page = book.event({}).after;
    add(book, 100, 100 + RecordBook::most_rows);
    EXPECT_EQ(read(book.event(page)).name, "rows");
    add(book, 100 + RecordBook::most_rows, 20'000);
    const auto [name, snapshot] = read(book.event(page));
    EXPECT_EQ(name, "snapshot");
    EXPECT_EQ(snapshot["first"], 20'000 - RecordBook::kept_rows);
    EXPECT_EQ(std::ssize(snapshot["rows"]), RecordBook::kept_rows);
    EXPECT_EQ(snapshot["rows"].back()[0], 19'999.1);
    // The whole angle, thinned: 0 + 1 + ... + 6 every seven ticks.
    const json& times = snapshot["history"][0];
    ASSERT_GT(times.size(), 500u);
    for (std::size_t k = 0; k < times.size(); ++k) {
        const auto ticks = std::llround(times[k].get<double>() / tick_s);
        const std::int64_t rest = ticks % 7;
        const auto angle = static_cast<double>(ticks / 7 * 21 + rest * (rest - 1) / 2);
        EXPECT_EQ(snapshot["history"][1][k], angle) << k;
    }
}

TEST(RecordBooks, SayOnceThatTheSourceHasEnded) {
    RecordBook book{"", false};
    add(book, 0, 5);
    const Position page = book.event({}).after;
    book.end();
    EXPECT_FALSE(page == book.position());
    const Event last = book.event(page);
    EXPECT_EQ(read(last).news["ended"], true);
    EXPECT_TRUE(last.after == book.position());
}

TEST(RecordBooks, AreReadBeforeTheFirstRecord) {
    const RecordBook book{"", true};
    const auto [name, snapshot] = read(book.event({}));
    EXPECT_EQ(name, "snapshot");
    EXPECT_EQ(snapshot["tick_s"], nullptr);
    EXPECT_EQ(snapshot["rows"].size(), 0u);
    EXPECT_EQ(snapshot["health_names"].size(), 32u);
}

TEST(RecordBooks, NameASourceOfAnyBytes) {
    for (const std::string source : {"a\nevent: x\ndata: y\n\n", "\"}", "\xff\xfe", "</script>", "\x01"}) {
        const RecordBook book{source, false};
        EXPECT_TRUE(read(book.event({})).news["source"].is_string());
    }
}

TEST(RecordBooks, TellWhatWasEverRaisedAndAPlaceNobodyCanHave) {
    RecordBook book{"", true};
    Record raised = record(0, core::flag_correction);
    raised.health = 1u << 31;
    book.add(raised, tick_s);
    add(book, 1, 4);
    const auto [name, news] = read(book.event({.next_row = 100}));
    EXPECT_EQ(name, "snapshot");
    EXPECT_EQ(news["since_start"], json({{"flags", core::flag_correction}, {"health", 1u << 31}}));
}

TEST(RecordBooks, GiveAGapOnceWhenWhatFollowsItIsKnown) {
    RecordBook book{"", false};
    add(book, 0, 100);
    for (std::int64_t tick = 100; tick < 103; ++tick) book.add(record(tick, core::flag_loop_unlocked), tick_s);
    add(book, 103, 110);
    const Position before = book.event({}).after;
    EXPECT_FALSE(read(book.event({})).news.contains("gap"));
    add(book, 110, 160);
    const Event event = book.event(before);
    const json gap = read(event).news["gap"];
    EXPECT_EQ(gap["first"], 100);
    EXPECT_EQ(gap["ticks"], 3);
    EXPECT_EQ(gap["shown"], 88);
    EXPECT_EQ(gap["dtheta"].size(), 12u + 3u + 40u);
    EXPECT_EQ(gap["dtheta"][0], 88.1);
    book.add(record(160), tick_s);
    EXPECT_FALSE(read(book.event(event.after)).news.contains("gap"));
}

TEST(Gaps, AtTheStartAndWithoutEndAreShownInBoundedMemory) {
    GapFinder gaps;
    for (std::int64_t row = 0; row < 100'000; ++row)
        gaps.take(row, {.tick = row, .flags = row < 20 ? 0u : static_cast<std::uint32_t>(core::flag_invalid)});
    EXPECT_FALSE(gaps.newest());
    for (std::int64_t row = 100'000; row < 100'041; ++row) gaps.take(row, {.tick = row});
    ASSERT_TRUE(gaps.newest());
    EXPECT_EQ(gaps.newest()->first_row, 20);
    EXPECT_EQ(gaps.newest()->n_ticks, 99'980);
    EXPECT_EQ(gaps.newest()->shown_row, 8);
    EXPECT_EQ(std::ssize(gaps.newest()->rows), GapFinder::most_rows);
    GapFinder first;
    for (std::int64_t row = 0; row < 60; ++row)
        first.take(row, {.tick = row, .flags = row < 2 ? static_cast<std::uint32_t>(core::flag_invalid) : 0u});
    ASSERT_TRUE(first.newest());
    EXPECT_EQ(first.newest()->shown_row, 0);
    EXPECT_EQ(first.newest()->n_ticks, 2);
    EXPECT_EQ(first.newest()->rows.size(), 42u);
}

// Gaps of three ticks, the next one before and after the picture of the last is whole.
TEST(Gaps, ThatFollowEachOtherAreEachSeen) {
    for (const std::int64_t every : {20, 42, 43, 44, 90}) {
        GapFinder gaps;
        std::int64_t seen = 0;
        for (std::int64_t row = 0; row < 20 * every + 5; ++row) {
            gaps.take(row,
                      {.tick = row, .flags = row % every < 3 ? static_cast<std::uint32_t>(core::flag_invalid) : 0u});
            if (!gaps.newest() || gaps.newest()->first_row < seen * every) continue;
            EXPECT_EQ(gaps.newest()->first_row, seen * every) << every;
            EXPECT_EQ(gaps.newest()->n_ticks, 3) << every;
            const std::int64_t before = std::min(seen * every, GapFinder::before_ticks);
            EXPECT_EQ(gaps.newest()->shown_row, seen * every - before) << every;
            for (std::size_t k = 0; k < gaps.newest()->rows.size(); ++k)
                ASSERT_EQ(gaps.newest()->rows[k].tick, gaps.newest()->shown_row + static_cast<std::int64_t>(k));
            ++seen;
        }
        EXPECT_EQ(seen, 20) << every;
    }
}

TEST(ThinnedRecords, KeepEveryStrideThOfAll) {
    Thinned<std::int64_t, 64> thinned;
    for (std::int64_t n = 0; n < 10'000; ++n) {
        thinned.add(n);
        ASSERT_LE(thinned.kept().size(), 64u);
        ASSERT_GE(std::ssize(thinned.kept()), std::min<std::int64_t>(n + 1, 32));
        for (std::size_t k = 0; k < thinned.kept().size(); ++k)
            ASSERT_EQ(thinned.kept()[k], static_cast<std::int64_t>(k) * thinned.stride());
    }
}

}  // namespace zlg::live::record_book_test
