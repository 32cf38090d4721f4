#include <zlg/logs/error.hpp>
#include <zlg/logs/follower.hpp>

#include "line_gyro.hpp"
#include "temporary_folder.hpp"

namespace zlg::logs::follower_test {

class Followed : public testing::Test {
protected:
    // A line of so many ticks.
    std::string line(int ticks) {
        const std::string path = folder_.file("line.bin");
        std::ofstream file{path, std::ios::binary};
        const auto send = [&file](const Bytes& bytes) {
            for (const std::uint8_t byte : bytes) file.put(static_cast<char>(byte));
        };
        for (int k = 0; k < ticks; ++k) send(gyro_.tick());
        send(gyro_.drain());
        return path;
    }

    static std::vector<core::AngleRow> rows_of(Follower& follower) {
        std::vector<core::AngleRow> rows;
        core::AngleRow row;
        for (auto next = follower.next(row); next != Follower::Next::end; next = follower.next(row))
            if (next == Follower::Next::row) rows.push_back(row);
        return rows;
    }

    test::TemporaryFolder folder_;
    Gyro gyro_;
};

TEST_F(Followed, AreTheRowsOfTheGyroUntilTheFileEnds) {
    Follower follower{line(3000), default_baud, std::nullopt};
    EXPECT_EQ(rows_of(follower), gyro_.rows);
    EXPECT_EQ(follower.n_rows(), 3000);
    EXPECT_NEAR(follower.angle_arcsec(), sum(gyro_.rows, &core::AngleRow::dtheta_arcsec), 1e-9);
    core::AngleRow row;
    EXPECT_EQ(follower.next(row), Follower::Next::end);
}

TEST_F(Followed, EndWhenTheyAreAsLongAsWasAskedFor) {
    Follower follower{line(3000), default_baud, 2.5};
    EXPECT_EQ(rows_of(follower).size(), 500u);
}

TEST_F(Followed, EndWithWhatHasArrivedWhereItIsStopped) {
    Follower follower{line(3000), default_baud, std::nullopt};
    core::AngleRow row;
    std::vector<core::AngleRow> rows;
    while (rows.size() < 100)
        if (follower.next(row) == Follower::Next::row) rows.push_back(row);
    follower.stop();
    follower.stop();
    const std::vector<core::AngleRow> rest = rows_of(follower);
    ASSERT_FALSE(rest.empty());
    EXPECT_LT(rest.size(), 200u);
    rows.insert(rows.end(), rest.begin(), rest.end());
    for (std::size_t k = 0; k < rows.size(); ++k) EXPECT_EQ(rows[k].dtheta_arcsec, gyro_.rows[k].dtheta_arcsec);
    EXPECT_NE(rows.back().flags & flag_final_lost, 0u);
}

TEST_F(Followed, RefuseADurationThatIsNone) {
    const std::string path = line(1);
    for (const double duration_s : {0.0, -1.0, 1.1e9, inf, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THROW((Follower{path, default_baud, duration_s}), SourceError);
}

TEST(LineSettings, NameEveryFlag) {
    const Settings settings = line_settings();
    ASSERT_EQ(settings.size(), 1u);
    EXPECT_EQ(settings[0].first, "flags");
    for (const char* each : {"lost:65536", "final_lost:131072", "restarted:262144", "outage:524288"})
        EXPECT_NE(settings[0].second.find(each), std::string::npos) << each;
}

}  // namespace zlg::logs::follower_test
