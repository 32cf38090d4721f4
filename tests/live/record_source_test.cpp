#include <zlg/config/schema.hpp>
#include <zlg/live/record_source.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/rig/asked_compensation.hpp>
#include <zlg/rig/replay.hpp>

#include "../logs/line_gyro.hpp"
#include "temporary_folder.hpp"
#include "test.hpp"

namespace zlg::live::record_source_test {

using Next = RecordSource::Next;

class Sources : public testing::Test {
protected:
    // Up to the end, or until nothing more is there.
    static std::vector<Record> records_of(RecordSource& source) {
        std::vector<Record> records;
        Record record;
        while (source.next(record) == Next::record) records.push_back(record);
        return records;
    }

    static core::AngleRow row(std::int64_t tick) {
        return {.tick = tick, .dtheta_arcsec = 1.0, .dtheta_final_arcsec = 1.5, .sigma_arcsec = 0.5};
    }

    static core::HalfRecord half(std::int64_t k) {
        return {.half = k,
                .counts = 40 + (k % 2 == 0 ? 10 : -10),
                .detuning_lambda = 1e-3 * static_cast<double>(k),
                .piezo_v = static_cast<double>(k),
                .temperature_c = 20.0 + static_cast<double>(k),
                .bias_sign = static_cast<std::int8_t>(k % 2 == 0 ? 1 : -1)};
    }

    test::TemporaryFolder folder_;
};

TEST_F(Sources, OfALineAreItsRows) {
    logs::Gyro gyro;
    std::string bytes;
    const auto send = [&bytes](const logs::Bytes& sent) { bytes.append(sent.begin(), sent.end()); };
    for (int k = 0; k < 500; ++k) send(gyro.tick());
    send(gyro.drain());
    const auto source = line_source(folder_.write("line.bin", bytes), 921600);
    EXPECT_FALSE(source->tick_s());
    std::vector<core::AngleRow> rows;
    Record record;
    for (Next next = source->next(record); next != Next::end; next = source->next(record))
        if (next == Next::record) rows.push_back(record.angle);
    EXPECT_EQ(rows, gyro.rows);
    EXPECT_TRUE(source->tick_s());
    EXPECT_TRUE(source->tells_health());
    EXPECT_THROW((void)line_source(folder_.file("nothing"), 921600), logs::IoError);
}

TEST_F(Sources, OfAnAngleLogGrowWithItUntilItIsClosed) {
    logs::AngleWriter writer{folder_.file("a.h5"), 0.004, {}, false};
    for (std::int64_t tick = 0; tick < 10; ++tick) writer.write(row(tick));
    writer.flush();
    const auto source = log_source(logs::AngleReader{writer.part_path()});
    EXPECT_EQ(records_of(*source).size(), 10u);
    EXPECT_EQ(source->tick_s(), 0.004);
    Record record;
    EXPECT_EQ(source->next(record), Next::nothing);
    for (std::int64_t tick = 10; tick < 15; ++tick) writer.write(row(tick));
    writer.close();
    const std::vector<Record> rest = records_of(*source);
    ASSERT_EQ(rest.size(), 5u);
    EXPECT_EQ(rest.back().angle.tick, 14);
    EXPECT_TRUE(std::isnan(rest.back().piezo_v));
    EXPECT_EQ(source->next(record), Next::end);
}

TEST_F(Sources, OfARawLogAreItsRowsAndTheSignalsOfTheirTicks) {
    const core::GyroCompensationConfig compensation = rig::asked_compensation(config::Config{});
    logs::RawWriter writer{folder_.file("raw.h5"), {}, false};
    rig::Replay replay{compensation};
    std::vector<core::AngleRow> expected;
    const auto keep = [&expected](const core::AngleRow& settled) { expected.push_back(settled); };
    for (std::int64_t k = 0; k < 100; ++k) {
        writer.write(half(k));
        replay.take(half(k), {}, keep);
    }
    replay.end(keep);
    writer.flush();
    const auto source = log_source(logs::RawReader{writer.part_path()}, "raw.h5", compensation, 0.005, {});
    std::vector<Record> records = records_of(*source);
    EXPECT_LE(records.size(), 50u);
    writer.close();
    for (const Record& record : records_of(*source)) records.push_back(record);
    ASSERT_EQ(records.size(), 50u);
    for (std::size_t tick = 0; tick < records.size(); ++tick) {
        const auto second = static_cast<double>(2 * tick + 1);
        EXPECT_EQ(records[tick].angle, expected[tick]);
        EXPECT_NEAR(records[tick].detuning_lambda, 1e-3 * (second - 0.5), 1e-12);
        EXPECT_EQ(records[tick].piezo_v, second);
        EXPECT_EQ(records[tick].temperature_c, 20.0 + second);
    }
}

TEST_F(Sources, ThatAreStoppedReadNoMore) {
    logs::AngleWriter writer{folder_.file("a.h5"), 0.004, {}, false};
    for (std::int64_t tick = 0; tick < 10; ++tick) writer.write(row(tick));
    writer.flush();
    const auto source = log_source(logs::AngleReader{writer.part_path()});
    Record record;
    EXPECT_EQ(source->next(record), Next::record);
    source->stop();
    EXPECT_EQ(source->next(record), Next::end);
}

}  // namespace zlg::live::record_source_test
