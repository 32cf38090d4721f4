"""Claims about tools/check_budget: a room that grows beyond its lines is named, and what is no code does not count."""

from trees import TOOLS, TreeTest


class CheckBudget(TreeTest):
    def test_a_room_over_its_budget_is_named_and_one_at_it_is_not(self):
        self.write("src/text/a.cpp", "int a;\n" * 100)
        self.assert_good(self.run_check("check_budget"))
        self.write("src/text/b.cpp", "int b;\n" * 100_000)
        answer = self.run_check("check_budget")
        self.assert_refused(answer, "src/text: 100100 lines of code, allowed are ")
        self.assertEqual(answer.stdout.count("\n"), 1)

    def test_a_room_without_a_budget_has_none(self):
        self.write("src/other/a.py", "a = 1\n")
        self.assert_refused(self.run_check("check_budget"), "src/other: 1 lines of code, allowed are 0")

    def test_blanks_and_comments_and_what_is_no_code_do_not_count(self):
        for name, text in (("a.cpp", "// a\n\n/* b\n c */\n  // d\n"), ("b.py", "\n# a\n"), ("c.md", "words\n"),
                           ("build/d.cpp", "int d;\n")):
            self.write(f"src/other/{name}", text)
        self.assert_good(self.run_check("check_budget"))

    def test_the_project_is_within_its_own(self):
        self.assert_good(self.run_check("check_budget", TOOLS.parent))
