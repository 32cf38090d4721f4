"""Claims about tools/check_mirror."""


from trees import TreeTest

# The headers that the check excuses: without them it says so.
EXCUSED = ("core/records", "core/methods",
           "core/compensation/switch_window", "core/common/handover", "deviations/variance_law", "config/config", "logs/error", "logs/settings", "logs/raw_layout", "logs/angle_layout",
           "rig/processor", "firmware/port",
           "firmware/half_period", "twin/twin_half", "study/axis", "study/design_lines", "paper/paper_item")


class CheckMirror(TreeTest):
    def setUp(self):
        super().setUp()
        for name in (*EXCUSED, "core/angle"):
            folder = name.split("/")[0]
            self.write(f"{'' if folder == 'firmware' else 'src/'}{folder}/include/zlg/{name}.hpp", "#pragma once\n")
        self.write("tests/core/angle_test.cpp", "TEST(Angle, LosesNothing) {}\n")

    def test_a_test_for_every_header_is_good(self):
        self.assert_good(self.run_check("check_mirror"))

    def test_a_missing_test_is_named(self):
        self.write("src/twin/include/zlg/twin/motion.hpp", "#pragma once\n")
        self.assert_refused(self.run_check("check_mirror"), "motion_test.cpp is missing below tests/twin")

    def test_a_header_in_a_room_needs_one_too(self):
        self.write("src/twin/include/zlg/twin/laser/gas.hpp", "#pragma once\n")
        self.assert_refused(self.run_check("check_mirror"), "gas_test.cpp is missing below tests/twin")
        self.write("tests/twin/laser/gas_test.cpp", "TEST(Gas, IsThin) {}\n")
        self.assert_good(self.run_check("check_mirror"))

    def test_a_test_in_another_folder_does_not_count(self):
        self.write("src/twin/include/zlg/twin/angle.hpp", "#pragma once\n")
        self.assert_refused(self.run_check("check_mirror"), "angle_test.cpp is missing below tests/twin")

    def test_a_file_without_a_test_does_not_count(self):
        self.write("tests/core/angle_test.cpp", "// TEST(Angle, LosesNothing) {}\n")
        self.assert_refused(self.run_check("check_mirror"), "tests/core/angle_test.cpp: holds no test")

    def test_a_property_counts(self):
        self.write("tests/core/angle_test.cpp", "RC_GTEST_PROP(Angle, LosesNothing, ()) {}\n")
        self.assert_good(self.run_check("check_mirror"))

    def test_an_excuse_without_its_header_is_named(self):
        (self.root / "src/logs/include/zlg/logs/error.hpp").unlink()
        self.assert_refused(self.run_check("check_mirror"), "logs/error.hpp is excused but does not exist")
