#include <zlg/logs/error.hpp>
#include <zlg/noise/imu_yaml.hpp>

#include "test.hpp"

namespace zlg::noise::imu_yaml_test {

class ImuYaml : public ::testing::Test {
protected:
    void SetUp() override {
        path_ = ::testing::TempDir() + "zlg-imu-" + ::testing::UnitTest::GetInstance()->current_test_info()->name() +
                ".yaml";
    }
    void TearDown() override { std::filesystem::remove(path_); }
    const std::string& write(const std::string& text) {
        std::ofstream{path_} << text;
        return path_;
    }
    std::string complaint(const std::string& text) {
        return zlg::test::refusal_by<zlg::logs::FormatError>([&] { (void)read_imu_yaml(write(text)); });
    }

private:
    std::string path_;
};

TEST_F(ImuYaml, what_is_written_reads_back_to_the_bit) {
    const KalibrGyro gyro{
        .noise_density_rad_s_sqrt_hz = 5.8177e-7 / 3.0, .random_walk_rad_s2_sqrt_hz = 1.1e-9, .update_rate_hz = 200.0};
    const KalibrGyro back = read_imu_yaml(write(imu_yaml(gyro)));
    EXPECT_EQ(back.noise_density_rad_s_sqrt_hz, gyro.noise_density_rad_s_sqrt_hz);
    EXPECT_EQ(back.random_walk_rad_s2_sqrt_hz, gyro.random_walk_rad_s2_sqrt_hz);
    EXPECT_EQ(back.update_rate_hz, 200.0);
}

TEST_F(ImuYaml, a_limit_is_called_so) {
    KalibrGyro gyro{.noise_density_rad_s_sqrt_hz = 1e-6, .random_walk_rad_s2_sqrt_hz = 1e-9, .update_rate_hz = 200.0};
    EXPECT_EQ(imu_yaml(gyro).find("limit"), std::string::npos);
    gyro.random_walk_is_limit = true;
    zlg::test::expect_contains(imu_yaml(gyro), "upper limit, none was found");
    EXPECT_EQ(read_imu_yaml(write(imu_yaml(gyro))).random_walk_rad_s2_sqrt_hz, 1e-9);
}

TEST_F(ImuYaml, reads_what_kalibr_users_have) {
    const KalibrGyro flat =
        read_imu_yaml(write("#Accelerometers\naccelerometer_noise_density: 1.86e-03   #continuous\n"
                            "accelerometer_random_walk:   4.33e-04\n\ngyroscope_noise_density:     1.87e-04\n"
                            "gyroscope_random_walk:       2.66e-05\nrostopic:                    /imu0\n"
                            "update_rate:                 200.0\n"));
    EXPECT_EQ(flat.noise_density_rad_s_sqrt_hz, 1.87e-4);
    EXPECT_EQ(flat.random_walk_rad_s2_sqrt_hz, 2.66e-5);
    const KalibrGyro nested =
        read_imu_yaml(write("imu0:\n  T_i_b:\n  - [1.0, 0.0]\n  gyroscope_noise_density: 0.001\n"
                            "  gyroscope_random_walk: 0\n  update_rate: 100\n"));
    EXPECT_EQ(nested.noise_density_rad_s_sqrt_hz, 1e-3);
    EXPECT_EQ(nested.random_walk_rad_s2_sqrt_hz, 0.0);
    EXPECT_EQ(nested.update_rate_hz, 100.0);
}

TEST_F(ImuYaml, what_is_wrong_is_named) {
    zlg::test::expect_contains(complaint("a: 1\n"), "has no gyroscope_noise_density");
    zlg::test::expect_contains(complaint("gyroscope_noise_density: 1\nupdate_rate: 1\n"),
                               "has no gyroscope_random_walk");
    zlg::test::expect_contains(complaint("gyroscope_noise_density: -1\ngyroscope_random_walk: 1\nupdate_rate: 1\n"),
                               "= -1, allowed");
    zlg::test::expect_contains(complaint("gyroscope_noise_density: x\ngyroscope_random_walk: 1\nupdate_rate: 1\n"),
                               "= x, allowed");
    zlg::test::expect_contains(complaint("gyroscope_noise_density: .nan\ngyroscope_random_walk: 1\nupdate_rate: 1\n"),
                               "allowed");
    zlg::test::expect_contains(complaint("a: [1\n"), "is no YAML");
    zlg::test::expect_contains(complaint(""), "has no");
    EXPECT_THROW((void)read_imu_yaml("/no/such/file.yaml"), zlg::logs::IoError);
}

}  // namespace zlg::noise::imu_yaml_test
