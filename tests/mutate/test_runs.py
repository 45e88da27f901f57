#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Which mutants are tried, and what is said of them."""

import argparse
import fnmatch
import json
import pathlib
import sys
import tempfile
import unittest
import unittest.mock

sys.dont_write_bytecode = True

from mutating import command, groups, report, survivors  # noqa: E402
from mutating.report import Result  # noqa: E402
from mutating.sites import Mutant, mutants  # noqa: E402
from mutating.trees import Outcome  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Picks(unittest.TestCase):
    def setUp(self):
        self.files = [str(path.relative_to(ROOT)) for folder in ("modules", "bench")
                      for path in (ROOT / folder).rglob("*.*")]

    def test_they_depend_on_the_seed_alone(self):
        first = groups.candidates(ROOT, self.files, "paper", 1)
        self.assertEqual(groups.candidates(ROOT, self.files[::-1], "paper", 1), first)
        self.assertNotEqual(groups.candidates(ROOT, self.files, "paper", 2), first)

    def test_every_group_has_enough_and_one_a_line(self):
        for name, count in groups.counts(200, list(groups.GROUPS)).items():
            with self.subTest(name):
                found = groups.candidates(ROOT, self.files, name, 1)
                self.assertGreater(len(found), 3 * count)
                self.assertEqual(len({(one.file, one.line) for one in found}), len(found))

    def test_every_pattern_names_files(self):
        for name, group in groups.GROUPS.items():
            for pattern in group.files:
                self.assertTrue(fnmatch.filter(self.files, pattern), f"{name}: {pattern}")

    def test_shares(self):
        for total in (1, 7, 200):
            self.assertEqual(sum(groups.counts(total, list(groups.GROUPS)).values()), total)
        self.assertEqual(groups.counts(30, ["fit"]), {"fit": 30})

    def test_no_group_is_kept_for_last(self):
        wanted = groups.counts(200, list(groups.GROUPS))
        order = command.spread(wanted)
        self.assertEqual({name: order.count(name) for name in wanted}, wanted)
        for name, count in wanted.items():
            self.assertAlmostEqual(order[:100].count(name), count / 2, delta=1)


class Survivors(unittest.TestCase):
    def read(self, text):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "survivors.md"
            path.write_text(text, encoding="utf-8")
            return survivors.read(path)

    def test_reasons(self):
        text = ("# Some\n\nWords.\n\n## `a.cpp`\n\n```diff\n- a < b\n+ a <= b\n```\n\nThey are\nnever equal.\n\n"
                "```diff\n- f();\n+ ;\n```\n\nOnly faster.\n\n## `b.cpp`\n\n```diff\n- a < b\n+ a > b\n```\n\nNo.\n")
        self.assertEqual(self.read(text), {("a.cpp", "a < b", "a <= b"): "They are never equal.",
                                           ("a.cpp", "f();", ";"): "Only faster.", ("b.cpp", "a < b", "a > b"): "No."})

    def test_all_are_still_there(self):
        for file, old, new in survivors.read(ROOT / "tests/mutate/survivors.md"):
            found = mutants(file, (ROOT / file).read_text(encoding="utf-8"))
            self.assertTrue(any(one.key == (file, old, new) for one in found), f"{file} has no such mutant: {old}")


class Again(unittest.TestCase):
    def test_lines_are_found_where_they_are_now(self):
        def survived(line, old):
            return Result("fit", Mutant("a.cpp", line, "return", old, "new"), Outcome("survived"))
        caught = Result("fit", Mutant("a.cpp", 9, "return", "third", "new"), Outcome("caught"))
        with tempfile.TemporaryDirectory() as folder, unittest.mock.patch.object(command, "ROOT", pathlib.Path(folder)), \
                unittest.mock.patch.object(command, "progress") as told:
            root = pathlib.Path(folder)
            (root / "a.cpp").write_text("a line more\nfirst\nfirst\n", encoding="utf-8")
            (root / "r.json").write_text(json.dumps(report.document(
                [survived(1, "first"), survived(2, "second"), caught], 1)), encoding="utf-8")
            kept, wanted = command.again(argparse.Namespace(json=root / "r.json"))
        self.assertEqual(kept, [caught])
        mutants_there, count = wanted["fit"]
        self.assertEqual([(one.line, one.old) for one in mutants_there], [(2, "first")])
        self.assertEqual(count, 1)
        self.assertIn("no line 'second' any more", told.call_args[0][0])


class Reports(unittest.TestCase):
    def test_tally(self):
        def result(group, verdict, reason=""):
            return Result(group, Mutant("a.cpp", 1, "return", "  old", "  new"), Outcome(verdict), reason)
        results = [result("fit", "caught"), result("fit", "survived"), result("fit", "same"), result("gate", "unbuildable"),
                   result("gate", "survived", "it does no harm")]
        self.assertEqual(report.tally(results), {"fit": [2, 1, 0, 1], "gate": [1, 0, 1, 0], "all": [3, 1, 1, 1]})
        self.assertEqual(report.from_document(report.document(results, 1)), results)
        text = report.markdown(results)
        self.assertIn("| all | 3 | 1 | 33 % | 1 | 1 |", text)
        self.assertLess(text.index("- old\n+ new"), text.index("it does no harm"))


if __name__ == "__main__":
    unittest.main()
