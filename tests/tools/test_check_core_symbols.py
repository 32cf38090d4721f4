"""Claims about tools/check_core_symbols, on archives compiled for the machine that runs the tests."""

import subprocess

from trees import TreeTest

FORBIDDEN = {
    "the heap": ("int* f() { return new int{1}; }", "_Znwm"),
    "malloc": ("#include <cstdlib>\nvoid* f(int n) { return malloc(n); }", "malloc"),
    "exceptions": ("void f() { throw 1; }", "__cxa_throw"),
    "libm": ("#include <cmath>\ndouble f(double x) { return std::exp(x); }", "exp"),
    "output": ('#include <cstdio>\nvoid f() { std::printf("%d", 1); }', "printf"),
}

# Of the twin and what it stands on: functions that compile to another result on another machine.
DIFFERENT = {
    "a sine": ("#include <cmath>\ndouble f(double x) { return std::sin(x); }", "sin"),
    "a size": ("#include <complex>\ndouble f(std::complex<double> x) { return std::abs(x); }", "cabs"),
    "a quotient": ("#include <complex>\nstd::complex<double> f(std::complex<double> x) { return 1.0 / x; }", "__divdc3"),
    "a float": ("#include <cmath>\nfloat f(float x) { return std::exp(x); }", "expf"),
}


class CheckCoreSymbols(TreeTest):
    def archive(self, *texts):
        objects = []
        for index, text in enumerate(texts):
            source = self.write(f"f{index}.cpp", text)
            objects.append(source.with_suffix(".o"))
            subprocess.run(["g++", "-std=c++20", "-O2", "-c", source, "-o", objects[-1]], check=True)
        archive = self.root / "libzlg_core.a"
        subprocess.run(["ar", "rcs", archive, *objects], check=True)
        return archive

    def test_arithmetic_and_copies_are_good(self):
        text = "struct Block { double x[99]; }; void f(Block& a, const Block& b) { a = b; }"
        self.assert_good(self.run_check("check_core_symbols", self.archive(text)))

    def test_what_another_file_of_the_archive_defines_is_good(self):
        archive = self.archive("double g(double); double f(double x) { return g(x); }", "double g(double x) { return x; }")
        self.assert_good(self.run_check("check_core_symbols", archive))

    def test_what_the_core_must_not_need_is_named(self):
        for claim, (text, symbol) in FORBIDDEN.items():
            with self.subTest(claim):
                self.assert_refused(self.run_check("check_core_symbols", self.archive(text)), f"needs {symbol}, ")

    def test_one_bad_archive_among_good_ones_is_refused(self):
        good = self.archive("int f() { return 1; }").rename(self.root / "good.a")
        bad = self.archive(FORBIDDEN["malloc"][0])
        self.assert_refused(self.run_check("check_core_symbols", bad, good), "needs malloc")

    def test_with_bits_what_differs_between_machines_is_named(self):
        for claim, (text, symbol) in DIFFERENT.items():
            with self.subTest(claim):
                self.assert_refused(self.run_check("check_core_symbols", "--bits", self.archive(text)), f"needs {symbol}, ")

    def test_with_bits_heap_and_rounding_are_good(self):
        text = "#include <cmath>\ndouble* f(double x) { return new double{std::round(x) + std::sqrt(x) + std::fmod(x, 3.0)}; }"
        self.assert_good(self.run_check("check_core_symbols", "--bits", self.archive(text)))

    def test_a_file_that_is_no_archive_is_refused(self):
        self.assert_refused(self.run_check("check_core_symbols", self.write("x.a", "text")), "no symbols")

    def test_an_absent_archive_is_refused(self):
        self.assert_refused(self.run_check("check_core_symbols", self.root / "absent.a"), "no symbols")
