"""The count of the image's costs complains when it should."""

import importlib.machinery
import importlib.util
import sys
import unittest
from pathlib import Path

BENCH = Path(__file__).resolve().parents[2] / "bench"


def load(name):
    sys.path.insert(0, str(BENCH))
    try:
        loader = importlib.machinery.SourceFileLoader(name, str(BENCH / name))
        spec = importlib.util.spec_from_loader(name, loader)
        module = importlib.util.module_from_spec(spec)
        loader.exec_module(module)
        return module
    finally:
        sys.path.pop(0)


count_image = load("count_image")


def table(worst=29999, typical=3199, background=7999999, flash=212991, memory=122879, stack_used=16383):
    return {"worst_half": {"instructions": worst}, "background": {"most": background}, "lives": {"life, defaults": {"mean": typical}}, "flash": {"bytes": flash},
            "memory": {"bytes": memory, "stack": 16384, "stack_used": stack_used}}


class Limits(unittest.TestCase):
    def test_each_limit_is_held(self):
        self.assertEqual(count_image.missed_limits(table()), [])
        for key, name in (("worst", "worst half-period"), ("typical", "typical half-period"),
                          ("background", "estimate in the background"), ("flash", "flash"),
                          ("memory", "memory"), ("stack_used", "stack used")):
            with self.subTest(key):
                found = count_image.missed_limits(table(**{key: {"worst": 30000, "typical": 3200, "background": 8000000, "flash": 212992,
                                                                 "memory": 122880, "stack_used": 16384}[key]}))
                self.assertEqual([line.partition(":")[0] for line in found], [name])

    def test_symbols_of_a_heap(self):
        for name in ("malloc", "_malloc_r", "free", "_sbrk", "_sbrk_r", "_Znwj", "_Znaj", "_ZdlPv", "_ZdlPvj", "realloc"):
            self.assertTrue(count_image.HEAP.search(name), name)
        for name in ("memcpy", "_ZN3zlg8firmware4port4sendE", "free_timer", "_ZNK3zlg4core5Angle4freeEv", "half_period"):
            self.assertFalse(count_image.HEAP.search(name), name)


class Differences(unittest.TestCase):
    def test_more_than_five_percent_counts_either_way(self):
        for new, is_wrong in ((104, False), (106, True), (96, False), (94, True)):
            found = count_image.differences({"a": new * 10}, {"a": 1000}, same_compiler=True)
            self.assertEqual(bool(found), is_wrong, new)

    def test_a_figure_that_comes_or_goes_counts(self):
        self.assertTrue(count_image.differences({"a": 1, "b": 1}, {"a": 1}, same_compiler=True))
        self.assertTrue(count_image.differences({}, {"a": 1}, same_compiler=True))

    def test_another_compiler_may_take_half_as_much_again(self):
        self.assertFalse(count_image.differences({"a": 1490}, {"a": 1000}, same_compiler=False))
        self.assertTrue(count_image.differences({"a": 1600}, {"a": 1000}, same_compiler=False))


class Page(unittest.TestCase):
    def test_tables_stand_between_the_marks(self):
        begin, end = count_image.MARKS
        page = f"before\n{begin}old\n{end}after\n"
        self.assertEqual(count_image.text_with(page, "new\n"), f"before\n{begin}new\n{end}after\n")

    def test_a_page_without_marks_is_refused(self):
        with self.assertRaises(SystemExit):
            count_image.text_with("nothing\n", "new\n")


class Modules(unittest.TestCase):
    def test_every_source_of_the_core_belongs_to_a_module(self):
        core = BENCH.parent / "src" / "core"
        lost = [path.name for path in sorted(core.rglob("*.cpp")) if count_image.Image.module(str(path)) is None]
        self.assertEqual(lost, [])
