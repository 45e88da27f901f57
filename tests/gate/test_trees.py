# SPDX-License-Identifier: MIT
"""Trees: which commit the base is, and what is said of those that cannot be built."""

import subprocess
import unittest

import support
from gating.outcome import Broken, Unmeasured
from gating.trees import Repository

GOOD = """cmake_minimum_required(VERSION 3.25)
project(x LANGUAGES NONE)
add_custom_target(goffer_bench COMMAND ${CMAKE_COMMAND} -E touch ${CMAKE_BINARY_DIR}/bin-made)
"""


class Trees(support.Case):
    def setUp(self):
        super().setUp()
        self.repository = Repository(self.folder)
        self.git("init", "-q", "-b", "main")
        self.first = self.commit(GOOD)

    def git(self, *words):
        subprocess.run(["git", "-C", str(self.folder), "-c", "user.name=x", "-c", "user.email=x", *words], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def commit(self, text):
        (self.folder / ".gitignore").write_text("/build/\n")
        (self.folder / "CMakeLists.txt").write_text(text)
        self.git("add", "-A")
        self.git("commit", "-qm", "x")
        return self.repository.commit("HEAD")

    def test_default_base(self):
        with self.assertRaisesRegex(Unmeasured, "no commit HEAD~1"):
            self.repository.default_base()
        second = self.commit(GOOD + "# 2\n")
        self.assertEqual(self.repository.default_base(), self.first)
        (self.folder / "CMakeLists.txt").write_text(GOOD + "# at work\n")
        self.assertEqual(self.repository.default_base(), second)
        self.assertEqual(self.repository.label(), second[:12] + "+")
        self.git("checkout", "-qfb", "branch")
        self.commit(GOOD + "# 3\n")
        self.commit(GOOD + "# 4\n")
        self.assertEqual(self.repository.default_base(), second)

    def test_a_base_is_built_once(self):
        tree = self.repository.base(self.first, ["goffer_bench"])
        made = tree.build / "bin-made"
        self.assertTrue(made.exists())
        self.assertEqual(tree.label, self.first[:12])
        source = made.parents[2]
        time = source.joinpath("CMakeLists.txt").stat().st_mtime_ns
        self.repository.base(self.first, ["goffer_bench"])
        self.assertEqual(source.joinpath("CMakeLists.txt").stat().st_mtime_ns, time)

    def test_what_an_interrupted_run_left_is_no_part_of_a_base(self):
        left = self.repository.folder / "partial" / "left"
        left.mkdir(parents=True)
        tree = self.repository.base(self.first, ["goffer_bench"])
        self.assertEqual([path.name for path in tree.build.parents[1].glob("left")], [])
        self.assertFalse(left.exists())

    def test_the_head_is_the_files_as_they_are(self):
        (self.folder / "CMakeLists.txt").write_text(GOOD.replace("bin-made", "head-made"))
        tree = self.repository.head(["goffer_bench"])
        self.assertTrue((tree.build / "head-made").exists())

    def test_a_head_that_does_not_build(self):
        (self.folder / "CMakeLists.txt").write_text(GOOD + 'message(FATAL_ERROR "no such thing")\n')
        with self.assertRaisesRegex(Broken, "head does not build goffer_bench: CMake Error"):
            self.repository.head(["goffer_bench"])
        (self.folder / "CMakeLists.txt").write_text(GOOD.replace("-E touch", "-E false"))
        with self.assertRaisesRegex(Broken, "head does not build goffer_bench: FAILED"):
            self.repository.head(["goffer_bench"])

    def test_bases_that_cannot_be_built(self):
        with self.assertRaisesRegex(Unmeasured, "no commit nowhere here"):
            self.repository.base("nowhere", ["goffer_bench"])
        broken = self.commit(GOOD + 'message(FATAL_ERROR "no such thing")\n')
        with self.assertRaisesRegex(Unmeasured, f"base {broken[:12]} does not build goffer_bench: CMake Error"):
            self.repository.base(broken, ["goffer_bench"])
        without = self.commit(GOOD.replace("goffer_bench", "other"))
        with self.assertRaisesRegex(Unmeasured, "does not build goffer_bench: .*unknown target"):
            self.repository.base(without, ["goffer_bench"])


if __name__ == "__main__":
    unittest.main()
