"""Claims about tools/mutate: which faults it makes of a text, and what it says of tests that notice them or do not."""

import shutil
import subprocess
import sys
import unittest
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader

from trees import TOOLS, TreeTest

sys.dont_write_bytecode = True
sys.path.insert(0, str(TOOLS))
from mutation_operators import mutants  # noqa: E402

ROOT = TOOLS.parent
loader = SourceFileLoader("mutate", str(TOOLS / "mutate"))
mutate = module_from_spec(spec_from_loader(loader.name, loader))
loader.exec_module(mutate)


def changes(text):
    return [(m.line, m.change) for m in mutants("f.cpp", text)]


def in_function(statement):
    return f"int f(int a, int b) {{\n    {statement}\n}}\n"


class Operators(unittest.TestCase):
    def assert_changes(self, statement, *expected):
        found = {change for line, change in changes(in_function(statement)) if line == statement}
        self.assertLessEqual(set(expected), found)

    def assert_untouched(self, text):
        self.assertEqual(changes(text), [])

    def test_relations_move_their_boundary_and_turn_round(self):
        self.assert_changes("if (a < b) return a;", "`<` -> `<=`", "`<` -> `>=`", "if (...) -> if (!(...))")
        self.assert_changes("if (a == b) return a;", "`==` -> `!=`")

    def test_arithmetic_logic_and_assignments_change(self):
        self.assert_changes("a += b * 2;", "`+=` -> `-=`", "`+=` -> `=`", "`*` -> `/`", "`2` -> `1`", "`2` -> `3`")
        self.assert_changes("if (a && !b) return 1;", "`&&` -> `||`", "`!` -> ``", "`1` -> `0`", "`1` -> `2`")
        self.assert_changes("a |= b & 4u;", "`|=` -> `=`", "`&` -> `|`", "`4u` -> `5u`")
        self.assert_changes("++a;", "`++` -> `--`", "the statement is left out")

    def test_numbers_of_every_kind_get_one_more_and_one_less(self):
        self.assert_changes("g(1.5, 0u, 1e3, 0x1p-3);", "`1.5` -> `2.5`", "`1.5` -> `(0.5)`", "`0u` -> `1u`", "`0u` -> `(0u - 1)`",
                            "`1e3` -> `1001.0`")

    def test_signs_are_lost(self):
        self.assert_changes("a = -b;", "`-` -> ``", "the statement is left out")
        self.assert_changes("return -a;", "`-` -> ``", "return ... -> return {}")

    def test_a_choice_is_made_for_good(self):
        self.assert_changes("return a > b ? a : b;", "`?` -> `&& false ?`", "`?` -> `|| true ?`")

    def test_early_returns_and_jumps_are_left_out(self):
        self.assert_changes("if (a) return b;", "the return is left out")
        self.assert_changes("for (;;) break;", "the statement is left out")

    def test_what_empty_braces_make_is_not_returned_twice(self):
        for value in ("{}", "false", "0", "0.0", "SwitchFault::none"):
            with self.subTest(value):
                self.assertNotIn("return ... -> return {}", [change for _, change in changes(in_function(f"return {value};"))])

    def test_declarations_stay(self):
        for statement in ("const int c = a;", "std::array<double, 4> x{};", "Row& row = rows[a];", "zlg::Sum sum;", "auto c = a;"):
            with self.subTest(statement):
                self.assertNotIn("the statement is left out", [change for _, change in changes(in_function(statement))])

    def test_what_is_no_code_is_untouched(self):
        self.assert_untouched("// a < b && 1\n/* a + 1\n   - 2 */\n")
        self.assert_untouched('#include <array>\n#define N 3 \\\n    + 4\n')
        self.assert_untouched('static_assert(sizeof(int) == 4 && 1 < 2);\n')
        self.assertEqual(changes('const char* s = "a < 1 && b";\n'), [])

    def test_brackets_of_templates_are_no_relations(self):
        self.assert_untouched("std::array<std::array<double, 3>, 4> x;\n")
        self.assertNotIn("`<` -> `<=`", [change for _, change in changes(in_function("a = static_cast<int>(b);"))])

    def test_a_mutant_is_the_text_with_one_place_changed(self):
        text = in_function("return a + b;")
        texts = {m.change: m.text for m in mutants("f.cpp", text)}
        self.assertEqual(texts["`+` -> `-`"], in_function("return a - b;"))
        self.assertEqual(texts["return ... -> return {}"], in_function("return {};"))
        text = in_function("if (a < 1) b = 2;")
        texts = {m.change: m.text for m in mutants("f.cpp", text)}
        self.assertEqual(texts["if (...) -> if (!(...))"], in_function("if (!(a < 1)) b = 2;"))

    def test_the_key_outlives_a_move_and_is_its_own(self):
        text = in_function("return a + b + b;")
        before = [m.key for m in mutants("f.cpp", text)]
        after = [m.key for m in mutants("f.cpp", "// A line more.\n\n" + text)]
        self.assertEqual(before, after)
        self.assertEqual(len(set(before)), len(before))
        self.assertIn(("f.cpp", "f", "return a + b + b;", "`+` -> `-`", 2), before)


    def test_the_key_names_the_function_or_the_struct(self):
        text = "struct Decay {\n    double q = 0.0;\n};\n\nint f(int a) noexcept { return a; }\nint B::g(int a,\n         int b) {\n    return a;\n}\n"
        self.assertEqual([m.function for m in mutants("f.cpp", text)], ["Decay", "Decay", "f", "g"])
        text = "bool operator==(const A& a, const A& b) noexcept {\n    return f(a, b) ||\n           g(a, b);\n}\n"
        self.assertEqual({m.function for m in mutants("f.cpp", text)}, {"operator=="})


SOURCE = """#include "relock.hpp"
int larger(int a, int b) noexcept {
    return a > b ? a : b;
}
"""
TEST = """#include <gtest/gtest.h>
#include "control/relock.hpp"
TEST(Larger, IsTheFirstWhereItIsLarger) { EXPECT_EQ(larger(2, 1), 2); }
"""
SECOND_TEST = "TEST(Larger, IsTheSecondWhereThatIsLarger) { EXPECT_EQ(larger(1, 2), 2); }\n"
EQUIVALENT = """[[equivalent]]
file = "src/core/control/perimeter_loop.cpp"
function = "larger"
line = "return a > b ? a : b;"
change = "`>` -> `>=`"
why = "of two equal numbers either is the larger"
"""


SURVIVOR = "src/core/control/perimeter_loop.cpp\tlarger\t1\t`>` -> `>=`\treturn a > b ? a : b;\n"


class Mutate(TreeTest):
    def setUp(self):
        super().setUp()
        (self.root / "tools").mkdir()
        for name in ("mutate", "mutation_operators.py", "mutation_programs.py"):
            shutil.copy(TOOLS / name, self.root / "tools" / name)
        (self.root / "src" / "core" / "include").mkdir(parents=True)
        self.write("src/core/control/relock.hpp", "int larger(int a, int b) noexcept;\n")
        self.write("src/core/control/perimeter_loop.cpp", SOURCE)
        self.write("tests/core/perimeter_loop_test.cpp", TEST + SECOND_TEST)
        self.write("tests/test.hpp", "#include <gtest/gtest.h>\n")

    def mutate(self, *arguments):
        command = [sys.executable, self.root / "tools" / "mutate", *arguments]
        return subprocess.run(command, capture_output=True, text=True, check=False)

    def survivors(self):
        return (self.root / "tests" / "mutants" / "survivors.txt").read_text(encoding="utf-8")

    def test_a_mutant_that_no_test_notices_is_named_unless_it_is_proved_equivalent(self):
        answer = self.mutate("perimeter_loop")
        self.assert_refused(answer, "survived: src/core/control/perimeter_loop.cpp:3: `>` -> `>=`   in larger")
        self.assertEqual(answer.stdout.count("survived: "), 1, answer.stdout)
        self.write("tests/mutants/equivalent.toml", EQUIVALENT)
        self.assert_good(self.mutate("perimeter_loop"))

    def test_a_weak_test_lets_more_survive(self):
        self.write("tests/core/perimeter_loop_test.cpp", TEST)
        self.assert_refused(self.mutate("perimeter_loop"), "`?` -> `|| true ?`")

    def test_a_known_survivor_is_none_that_is_new(self):
        self.write("tests/mutants/survivors.txt", SURVIVOR)
        for arguments in (["perimeter_loop"], ["--sample", "40"]):
            self.assert_good(self.mutate(*arguments))
            self.assertEqual(self.survivors(), SURVIVOR)

    def test_a_survivor_that_is_killed_or_gone_is_taken_out_of_the_list(self):
        killed = SURVIVOR.replace("`>` -> `>=`", "`>` -> `<=`")
        gone = SURVIVOR.replace("return a", "return  a")
        for arguments in (["perimeter_loop"], ["--sample", "40"]):
            self.write("tests/mutants/survivors.txt", SURVIVOR + killed + gone)
            answer = self.mutate(*arguments)
            self.assert_good(answer)
            self.assertEqual(answer.stdout.count("taken out of tests/mutants/survivors.txt"), 2, answer.stdout)
            self.assertEqual(self.survivors(), SURVIVOR)

    def test_what_survives_in_a_new_module_is_added_where_it_is_asked(self):
        (self.root / "tests" / "mutants").mkdir()
        self.assert_good(self.mutate("perimeter_loop", "--add"))
        self.assertEqual(self.survivors(), SURVIVOR)

    def test_the_day_is_the_seed_and_is_printed(self):
        self.write("tests/mutants/survivors.txt", SURVIVOR)
        self.assertRegex(self.mutate("--sample", "1").stdout, r"drawn with --sample 1 --seed 20\d{6}\n")

    def test_a_list_that_is_wrong_is_refused(self):
        self.write("tests/mutants/equivalent.toml", EQUIVALENT + EQUIVALENT.replace("`>` -> `>=`", "`>` -> `<=`"))
        self.assert_refused(self.mutate("perimeter_loop"), "listed as equivalent, but killed")
        self.write("tests/mutants/equivalent.toml", EQUIVALENT + EQUIVALENT.replace("a > b", "a >> b"))
        self.assert_refused(self.mutate(), "listed as equivalent, but no mutant")

    def test_tests_that_fail_without_a_mutant_prove_nothing(self):
        self.write("tests/core/perimeter_loop_test.cpp", TEST.replace("larger(2, 1), 2", "larger(2, 1), 1"))
        answer = self.mutate("perimeter_loop")
        self.assertEqual(answer.returncode, 1)
        self.assertIn("fail on the core as it is", answer.stderr)

    def test_a_sample_is_the_same_for_the_same_seed(self):
        first, second = (self.mutate("--list", "--sample", "3", "--seed", "5").stdout for _ in range(2))
        self.assertEqual((first, first.count("\n")), (second, 3))


class Lists(unittest.TestCase):
    """Of the project itself."""

    def test_what_is_left_out_exists(self):
        stems = {path.stem for path in (ROOT / "src" / "core").rglob("*.?pp")}
        self.assertEqual(mutate.LEFT_OUT - stems, set(), "take them out of LEFT_OUT in tools/mutate")

    # A survivor more is a test less: raise this number for a module that is new to the mutants, and for nothing else.
    def test_the_list_of_survivors_only_shrinks(self):
        self.assertLessEqual(len(mutate.known_survivors()), 36)

    def test_every_survivor_and_every_equivalent_is_a_mutant_and_stands_once(self):
        every = {mutant.key for path in (ROOT / "src" / "core").rglob("*.?pp")
                 for mutant in mutants(str(path.relative_to(ROOT)), path.read_text(encoding="utf-8"))}
        self.assertEqual((mutate.known_survivors() | set(mutate.listed())) - every, set())
        lines = mutate.SURVIVORS.read_text(encoding="utf-8").splitlines()
        self.assertEqual(lines, sorted(set(lines)))
