"""Claims about tools/check_nocompile."""


from trees import TreeTest

REFUSED = "// expect: invalid conversion\nint* refused = 1;\n"
CONTROL = "// expect: success\nint good = 1;\n"


class CheckNocompile(TreeTest):
    def write_case(self, text):
        self.write("tests/nocompile/case.cpp", text)
        return self.run_check("check_nocompile")

    def test_the_expected_message_passes_and_so_does_the_control(self):
        self.write("tests/nocompile/control.cpp", CONTROL)
        answer = self.write_case(REFUSED)
        self.assert_good(answer)
        self.assertEqual(answer.stdout, "2 passed, 0 failed\n")

    def test_code_that_compiles_fails(self):
        self.assert_refused(self.write_case("// expect: invalid\nint x = 1;\n"), "compiles, and must not", "0 passed, 1 failed")

    def test_another_message_fails(self):
        self.assert_refused(self.write_case("// expect: invalid conversion\n#include <absent>\n"), "another message")

    def test_a_control_that_is_refused_fails(self):
        self.assert_refused(self.write_case(REFUSED.replace("invalid conversion", "success")), "must compile")

    def test_a_case_without_expectation_fails(self):
        self.assert_refused(self.write_case("int* refused = 1;\n"), "the first line is not")

    def test_an_empty_file_fails(self):
        self.assert_refused(self.write_case(""), "the first line is not")

    def test_no_cases_at_all_fail(self):
        self.assert_refused(self.run_check("check_nocompile"), "0 passed, 0 failed")
