# SPDX-License-Identifier: MIT
"""The command, with programs that pretend to be goffer_bench: verdicts, exit codes and reports."""

import contextlib
import io
import json
import os
import subprocess
import tempfile
import unittest
import unittest.mock

import support
from support import CASES
from gating import command, programs
from gating.outcome import Unmeasured


ONE = {"setup/instance": 60.0}


class Gate(support.Case):
    def gate(self, base, head, *words):
        """The exit code; what it said is kept."""
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            try:
                code = command.main(["--programs", base, head, "--pairs", "15", "--json", str(self.folder / "r.json"),
                                     "--markdown", str(self.folder / "r.md"), *words])
            except SystemExit as end:
                code = end.code
        self.out, self.err = out.getvalue(), err.getvalue()
        return code

    def report(self):
        document = json.loads((self.folder / "r.json").read_text())
        return document, {row["name"]: row for row in document["parts"][0]["rows"]}

    def test_no_change_passes(self):
        self.assertEqual(self.gate(self.fake("base"), self.fake("head")), 0)
        document, rows = self.report()
        self.assertEqual(document["exit_code"], 0)
        self.assertEqual(set(rows), set(CASES))
        self.assertTrue(all(row["verdict"] == "pass" and row["pairs"] >= 15 for row in rows.values()))
        self.assertIn("# Benchmark gate: pass", (self.folder / "r.md").read_text())
        self.assertEqual(self.err, "")

    def test_a_slowdown_fails(self):
        self.assertEqual(self.gate(self.fake("base"), self.fake("head", CASES | {"setup/instance": 69.0})), 1)
        document, rows = self.report()
        self.assertEqual(document["exit_code"], 1)
        self.assertEqual(rows["setup/instance"]["verdict"], "regression")
        self.assertEqual(rows["setup/instance"]["pairs"], 30)  # a second set
        self.assertAlmostEqual(rows["setup/instance"]["change"], 0.15, delta=0.02)
        self.assertGreater(rows["setup/instance"]["low"], 0.1)
        self.assertEqual(rows["deform/positions/cache/avx2/1"]["verdict"], "pass")
        self.assertIn("**REGRESSION**: seen in two sets", (self.folder / "r.md").read_text())
        self.assertIn("setup/instance", self.out)

    def test_below_the_threshold_passes(self):
        self.assertEqual(self.gate(self.fake("base"), self.fake("head", ONE, factor=1.03)), 0)
        row = self.report()[1]["setup/instance"]
        self.assertEqual((row["pairs"], row["remark"]), (15, "slower, by less than the threshold"))
        self.assertEqual(self.gate(self.fake("base"), self.fake("head", ONE, factor=1.03), "--threshold", "1"), 1)

    def test_a_gain_is_said(self):
        self.assertEqual(self.gate(self.fake("base"), self.fake("head", ONE, factor=0.85)), 0)
        self.assertTrue(all(row["verdict"] == "gain" for row in self.report()[1].values()))

    def test_a_spell_is_not_confirmed(self):
        # Slow for a first run and fifteen pairs, and a little faster than the base after that: noise alone would now and
        # then confirm a program that is as fast.
        head = self.fake("head", ONE, factor=1.2, change_after=(16, 1 / 1.25))
        self.assertEqual(self.gate(self.fake("base"), head), 0)
        self.assertTrue(all("not confirmed" in row["remark"] for row in self.report()[1].values()))

    def test_too_noisy(self):
        self.assertEqual(self.gate(self.fake("base"), self.fake("head", ONE, swing=1)), 2)
        self.assertRegex(self.err, r"^bench/gate: pairs: too noisy: setup/instance\n$")
        self.assertEqual(self.report()[1]["setup/instance"]["pairs"], 60)

    def test_cases_that_only_one_has(self):
        head = self.fake("head", CASES | {"setup/bounds": 300.0})
        base = self.fake("base", CASES | {"deform/packed/cache/avx2/1": 4.0})
        self.assertEqual(self.gate(base, head), 0)
        document, rows = self.report()
        self.assertEqual(set(rows), set(CASES))
        remarks = document["parts"][0]["remarks"]
        self.assertIn("`setup/bounds` is not in the base: not compared", remarks)
        self.assertIn("`deform/packed/cache/avx2/1` is in the base alone: not compared", remarks)

    def test_nothing_in_common(self):
        code = self.gate(self.fake("base", {"a": 1.0}), self.fake("head"))
        self.assertEqual(code, 2)
        self.assertIn("no case in common", self.err)

    def test_only_some_cases(self):
        self.assertEqual(self.gate(self.fake("base"), self.fake("head"), "--cases", "^setup"), 0)
        self.assertEqual(list(self.report()[1]), ["setup/instance"])

    def test_programs_that_fail(self):
        for fault, said in (("exit", "it went wrong"), ("error", "no such body"), ("empty", "no readable result")):
            with self.subTest(fault):
                self.assertEqual(self.gate(self.fake("base"), self.fake("head", fault=fault)), 2)
                self.assertEqual(len(self.err.splitlines()), 1)
                self.assertIn(said, self.err)
                self.assertEqual(self.report()[0]["exit_code"], 2)
        self.assertEqual(self.gate(self.fake("base"), "/nowhere/goffer_bench"), 2)

    def test_the_same_program(self):
        base = self.fake("base", fault="exit")  # it would fail if it ran
        head = self.folder / "head"
        head.write_bytes((self.folder / "base").read_bytes())
        head.chmod(0o755)
        self.assertEqual(self.gate(base, str(head), "--skip-same"), 0)
        self.assertIn("same program", (self.folder / "r.md").read_text())

    def test_a_run_leaves_nothing_behind(self):
        program = self.fake("head", ONE)
        with unittest.mock.patch.dict(os.environ, {"TMPDIR": str(self.folder)}), \
                unittest.mock.patch.object(tempfile, "tempdir", None):
            opened = os.listdir("/proc/self/fd")
            self.assertIn("setup/instance", programs.Run(program, list(ONE), 0.01).counters())
            programs.Run(self.fake("other", ONE), list(ONE), 0.01).stop()
            with self.assertRaises(Unmeasured):
                programs.Run("/nowhere/goffer_bench", list(ONE), 0.01)
            self.assertEqual(os.listdir("/proc/self/fd"), opened)
        self.assertEqual([path.name for path in self.folder.glob("*.json")], [])

    def test_another_program_is_measured(self):
        self.assertEqual(self.gate(self.fake("base", ONE), self.fake("head", ONE, spread=0.011), "--skip-same"), 0)
        self.assertEqual(list(self.report()[1]), list(ONE))
        self.assertNotIn("same program", (self.folder / "r.md").read_text())

    def test_wrong_usage(self):
        self.assertEqual(self.gate("a", "b", "--pairs", "3"), 2)
        for words in (["--only", "paris"], ["--only", ""], ["--cases", "("]):
            self.assertEqual(self.gate("a", "b", *words), 2)
            self.assertIn("usage: bench/gate", self.err)

    def test_a_head_that_does_not_build_fails(self):
        (self.folder / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.25)\nproject(x LANGUAGES NONE)\n")
        for words in (["init", "-q"], ["add", "-A"], ["commit", "-qm", "x"]):
            subprocess.run(["git", "-C", self.folder, "-c", "user.name=x", "-c", "user.email=x", *words], check=True)
        report = [f"--{kind}={self.folder / 'build/gate/report'}.{kind}" for kind in ("json", "markdown")]
        for parts in ("counts", "ratios", "pairs", "counts,ratios,pairs"):
            with self.subTest(parts), unittest.mock.patch.object(command, "ROOT", self.folder), \
                    contextlib.redirect_stderr(io.StringIO()) as err:
                self.assertEqual(command.main(["--only", parts, "--base", "HEAD", *report]), 1)
                self.assertRegex(err.getvalue(), "^bench/gate: head does not build goffer_bench and goffer_count: .+\n$")
            self.assertEqual(json.loads((self.folder / "build/gate/report.json").read_text())["exit_code"], 1)
            self.assertIn("head does not build", (self.folder / "build/gate/report.markdown").read_text())

    def test_counts_and_ratios_are_judged_by_the_baseline(self):
        for naive, code in ((100.0, 0), (5.0, 1)):  # the bound is ten times as fast
            times = {"naive/positions": naive, "deform/positions/cache/avx2/1": 1.0}
            head = unittest.mock.Mock(label="head", **{"compiler.return_value": "GNU",
                                                       "program.return_value": self.fake("head", times)})
            document = {"compiler": "GNU", "counts": {"allocations/run": 0.0},
                        "ratios": {"over_naive": {"deform/positions/cache/avx2/1": 10.0}}}
            (self.folder / "baseline.json").write_text(json.dumps(document))
            with self.subTest(naive), unittest.mock.patch.object(command.Gate, "head", return_value=head), \
                    unittest.mock.patch.object(command.counts, "count", return_value={"allocations/run": 0.0}), \
                    contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
                self.assertEqual(command.main(["--only", "counts,ratios", "--baseline", str(self.folder / "baseline.json"),
                                               "--json", str(self.folder / "r.json"),
                                               "--markdown", str(self.folder / "r.md")]), code)
            parts = {part["name"]: part for part in json.loads((self.folder / "r.json").read_text())["parts"]}
            self.assertEqual(set(parts), {"counts", "ratios"})
            self.assertEqual(len(parts["ratios"]["rows"]), 1)

    def test_pairs_are_built_where_no_programs_are_given(self):
        def tree(label, program):
            return unittest.mock.Mock(label=label, **{"compiler.return_value": "GNU", "program.return_value": program})

        repository = unittest.mock.Mock(**{"default_base.return_value": "abc", "base.return_value": tree("abc", self.fake("base")),
                                           "head.return_value": tree("head", self.fake("head"))})
        with unittest.mock.patch.object(command, "Repository", return_value=repository), \
                contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            self.assertEqual(command.main(["--only", "pairs", "--json", str(self.folder / "r.json"),
                                           "--markdown", str(self.folder / "r.md")]), 0)
        repository.base.assert_called_once_with("abc", ["goffer_bench"])
        document = json.loads((self.folder / "r.json").read_text())
        self.assertEqual((document["base"], document["head"]), ("abc", "head"))
        self.assertEqual(len(document["parts"][0]["rows"]), 2)

    def test_update_writes_the_counts(self):
        file = self.folder / "baseline.json"
        head = unittest.mock.Mock(**{"compiler.return_value": "GNU 12.2.0"})
        with unittest.mock.patch.object(command.Gate, "head", return_value=head), \
                unittest.mock.patch.object(command.counts, "count", return_value={"allocations/run": 0.0}), \
                contextlib.redirect_stdout(io.StringIO()) as out:
            self.assertEqual(command.main(["--only", "counts", "--update", "--baseline", str(file)]), 0)
        self.assertEqual(json.loads(file.read_text()), {"compiler": "GNU 12.2.0", "counts": {"allocations/run": 0.0}})
        self.assertIn("1 counts of GNU 12.2.0", out.getvalue())

    def test_a_report_that_cannot_be_written(self):
        (self.folder / "file").write_text("")
        code = self.gate(self.fake("base", ONE), self.fake("head", ONE), "--json", str(self.folder / "file" / "r.json"))
        self.assertEqual(code, 2)
        self.assertEqual(len(self.err.splitlines()), 1)

    def test_record(self):
        history = self.folder / "h.csv"
        for _ in range(2):
            self.gate(self.fake("base"), self.fake("head", ONE), "--record", str(history))
        lines = history.read_text().splitlines()
        self.assertEqual(len(lines), 1 + 2)
        self.assertEqual(lines[0], "commit,date,compiler,cpu,case,value")
        self.assertRegex(lines[1], r"^unknown,20.*,unknown,.*,pairs/setup/instance,[0-9.]+$")


if __name__ == "__main__":
    unittest.main()
