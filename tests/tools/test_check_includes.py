"""Claims about tools/check_includes: each rule is obeyed by a good tree, and breaking it is found, with its place."""


from trees import TreeTest

GOOD = {
    "src/core/include/zlg/core/compensation/angle.hpp": "#include <array>\n#include <zlg/core/units.hpp>\n",
    "src/core/angle.cpp": '#include <zlg/core/compensation/angle.hpp>\n#include "remainder.hpp"\n',
    "src/core/remainder.hpp": "#pragma once\n",
    "src/core/common/pair.hpp": "#pragma once\n",
    "src/core/include/zlg/core/gyro_compensation.hpp": "#include <zlg/core/compensation/gap_bridge.hpp>\n",
    "src/core/control/mode_switch.cpp": '#include <zlg/core/records.hpp>\n#include "common/pair.hpp"\n',
    "src/twin/twin.cpp": "#include <zlg/core/records.hpp>\n#include <zlg/core/common/maths.hpp>\n#include <cmath>\n#include <boost/random.hpp>\n",
    "src/logs/raw_log.cpp": "#include <zlg/core/units.hpp>\n#include <fmt/format.h>\n",
    "src/config/schema.cpp": "#include <zlg/core/methods.hpp>\n",
    "src/rig/rig.cpp": "#include <zlg/twin/twin.hpp>\n#include <zlg/config/config.hpp>\n",
    "src/recorded/motion.cpp": "#include <zlg/rig/wiring.hpp>\n#include <zlg/logs/raw_log.hpp>\n",
    "src/report/page.cpp": "#include <zlg/report/page.hpp>\n",
    "src/study/run.cpp": "#include <zlg/rig/rig.hpp>\n#include <zlg/core/compensation/angle.hpp>\n",
    "cli/main.cpp": "#include <iostream>\n#include <zlg/report/page.hpp>\n#include <zlg/study/run.hpp>\n",
    "firmware/main.cpp": "#include <zlg/core/compensation/angle.hpp>\n",
    "tests/twin/twin_test.cpp": '#include <zlg/core/compensation/angle.hpp>\n#include <zlg/rig/rig.hpp>\n#include "../x.hpp"\n',
    "build/release/generated.cpp": "#include <zlg/cli/verbs.hpp>\n",
}

# What is written into which file of the good tree, and what the check must say of it.
BROKEN = {
    "core sees nobody": ("src/core/angle.cpp", "#include <zlg/logs/raw_log.hpp>", "core may not include logs"),
    "core without exceptions": ("src/core/angle.cpp", "#include <stdexcept>", "core may not include <stdexcept>"),
    "core without libm": ("src/core/angle.cpp", "#include <cmath>", "core may not include <cmath>"),
    "core without libraries": ("src/core/angle.cpp", "#include <fmt/format.h>", "core may not include <fmt/format.h>"),
    "twin sees records only": ("src/twin/twin.cpp", "#include <zlg/core/compensation/angle.hpp>", "twin sees of core only"),
    "twin sees no controller": ("src/twin/twin.cpp", "#include <zlg/rig/rig.hpp>", "twin may not include rig"),
    "rig reads no logs": ("src/rig/rig.cpp", "#include <zlg/logs/raw_log.hpp>", "rig may not include logs"),
    "logs see records only": ("src/logs/raw_log.cpp", "#include <zlg/core/methods.hpp>", "logs sees of core only"),
    "config sees core only": ("src/config/schema.cpp", "#include <zlg/twin/twin.hpp>", "config sees of twin only"),
    "rig below study": ("src/rig/rig.cpp", "#include <zlg/study/run.hpp>", "rig may not include study"),
    "report sees tables only": ("src/report/page.cpp", "#include <zlg/core/records.hpp>", "report may not include core"),
    "rig without report": ("src/rig/rig.cpp", "#include <zlg/report/page.hpp>", "rig may not include report"),
    "study below cli": ("src/study/run.cpp", "#include <zlg/cli/verbs.hpp>", "study may not include cli"),
    "firmware sees core only": ("firmware/main.cpp", "#include <zlg/twin/twin.hpp>", "firmware may not include twin"),
    "bench beside cli": ("bench/cost.cpp", "#include <zlg/cli/verbs.hpp>", "bench may not include cli"),
    "no unknown folder": ("cli/main.cpp", "#include <zlg/utils/x.hpp>", "there is no folder utils"),
    "no source without rules": ("utils/x.cpp", "#include <array>", "without a line in the table"),
    "no clock below the border": ("src/rig/rig.cpp", "#include <chrono>", "reads a clock"),
    "no printing below the border": ("src/study/run.cpp", "#include <iostream>", "prints"),
    "no arguments below the border": ("src/config/schema.cpp", "#include <CLI/CLI.hpp>", "parses arguments"),
    "no path upwards": ("cli/main.cpp", '#include "../src/core/remainder.hpp"', "no path may lead up"),
    "no path upwards in brackets": ("cli/main.cpp", "#include <zlg/core/../x.hpp>", "no path may lead up"),
    "private headers stay": ("src/rig/rig.cpp", '#include "remainder.hpp"', "beside the file that includes them"),
    "public in brackets": ("cli/main.cpp", '#include "zlg/rig/rig.hpp"', "with angle brackets"),
    "public without private": (
        "src/core/include/zlg/core/compensation/angle.hpp", '#include "remainder.hpp"', "public header includes"),
    "spaces do not hide": ("src/core/angle.cpp", "  #  include   <vector>", "core may not include <vector>"),
    "control knows no compensation": (
        "src/core/control/mode_switch.cpp", "#include <zlg/core/compensation/gap_bridge.hpp>", "may not include compensation"),
    "nor its private headers": (
        "src/core/control/mode_switch.cpp", '#include "compensation/gap_points.hpp"', "may not include compensation"),
    "nor its door": ("src/core/control/mode_switch.cpp", "#include <zlg/core/gyro_compensation.hpp>", "may not include compensation"),
    "compensation knows no control": (
        "src/core/include/zlg/core/gyro_compensation.hpp", "#include <zlg/core/control/half_wave.hpp>", "may not include control"),
    "macros do not hide": ("src/core/angle.cpp", "#include HEADER", "the name must stand in the line"),
}


class CheckIncludes(TreeTest):
    def setUp(self):
        super().setUp()
        for path, text in GOOD.items():
            self.write(path, text)

    def test_a_tree_that_obeys_passes_in_silence(self):
        answer = self.run_check("check_includes")
        self.assert_good(answer)
        self.assertEqual(answer.stdout, "")

    def test_every_broken_rule_is_found_and_placed(self):
        for claim, (path, line, rule) in BROKEN.items():
            with self.subTest(claim):
                self.write(path, f"// first line\n{line}\n")
                answer = self.run_check("check_includes")
                self.assert_refused(answer, f"{path}:2: ", rule)
                self.assertEqual(answer.stdout.count("\n"), 1, answer.stdout)
                self.write(path, GOOD.get(path, ""))
                if path not in GOOD:
                    (self.root / path).unlink()

    def test_an_include_in_a_comment_is_none(self):
        self.write("src/core/angle.cpp", "// #include <vector>\n")
        self.assert_good(self.run_check("check_includes"))

    def test_a_tree_without_sources_is_refused(self):
        self.assertEqual(self.run_check("check_includes", self.root / "tests").returncode, 1)
