#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compiles the C++ that pages and comments show: tests/samples/snippets.py pages|headers FOLDER COMPILER OPTION..

A snippet is a fenced block of C++ in a page, or an indented block in a public header's /// comments. It is written into
FOLDER and compiled, not run: one that includes something as a program of its own, any other as the body of a function in
the header's namespace, where it may use what ASSUMED declares for its file. Exit code 0: all compile; 1: the compiler
says what does not.
"""

import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = ("*.md", ".github/**/*.md", "bench/**/*.md", "modules/**/*.md", "samples/**/*.md")
HEADERS = ("engine/include/**/*.hpp", "modules/*/include/**/*.hpp")

# What the snippets of a file take for granted.
ASSUMED = {
    "README.md": """
        #include <goffer/bend/body_file.hpp>
        #include <goffer/bend/crowd.hpp>
        #include <glm/mat4x4.hpp>
        #include <vector>
        struct Vertex { glm::vec3 position; };
        extern std::vector<Vertex> vertices;
        extern const bend::Body body;
        extern const std::span<const std::byte> bytes;
        void complain(const char*);
    """,
    "engine/include/goffer/engine/strided_view.hpp": """
        #include <vector>
        struct Pose {};
        struct Worm { Pose pose; };
        struct Pool { Worm** raw(); };
        extern std::vector<Pose> poses;
        extern std::vector<Worm> worms;
        extern Pool pool;
        extern const std::size_t page_size, n;
    """,
    "modules/bend/include/goffer/bend/body_file.hpp": """
        extern const std::span<const std::byte> bytes;
        extern DeformJob job;
        void report(const char*);
    """,
    "modules/bend/include/goffer/bend/body_table.hpp": """
        #include <goffer/bend/body_file.hpp>
        #include <goffer/bend/crowd.hpp>
        extern std::optional<BodyFile> file, reloaded;
        extern BodyTable bodies;
        extern Batch batch;
    """,
    "modules/bend/include/goffer/bend/crowd.hpp": """
        #include <glm/mat4x4.hpp>
        #include <vector>
        struct Vertex { float x, y, z; };
        extern std::vector<Vertex> vertices;
        extern const Body body;
    """,
    "modules/bend/include/goffer/bend/job.hpp": """
        #include <cstdio>
        #include <vector>
        struct Vertex { float x, y, z; };
        extern std::vector<Vertex> vertices;
        extern const Body body;
    """,
    "modules/paper/include/goffer/paper/grid.hpp": """
        extern const Parameters body;
        extern const std::uint32_t columns, rows;
        extern const Cylindrical vertex;
        extern const Pose pose;
    """,
}

# Headers whose indented blocks are formulas.
FORMULAS = {
    "modules/bend/include/goffer/bend/table.hpp",
    "modules/paper/include/goffer/paper/wrinkle.hpp",
}


def blocks_of(name, text):
    """Each snippet of a file: its line and its text."""
    if name.endswith(".md"):
        for block in re.finditer(r"^```cpp\n(.*?)^```", text, re.M | re.S):
            yield text.count("\n", 0, block.start(1)) + 1, block[1]
    elif name not in FORMULAS:
        line = r"[ \t]*///     .*\n"
        for block in re.finditer(rf"(?:^{line}(?:[ \t]*///\n(?={line}))?)+", text, re.M):
            yield text.count("\n", 0, block.start()) + 1, re.sub(r"^[ \t]*///(?:     )?", "", block[0], flags=re.M)


def unit_of(name, line, snippet):
    """The snippet as a file that can be compiled."""
    if "#include" in snippet:
        return f'#line {line} "{name}"\n{snippet}'
    assumed = ASSUMED.get(name, "").splitlines()
    includes = [text for text in assumed if text.lstrip().startswith("#")]
    namespace = "goffer"
    if header := re.search(r"include/(goffer/(\w+)/.*)", name):
        includes.insert(0, f"#include <{header[1]}>")
        namespace += "" if header[2] == "engine" else f"::{header[2]}"
    declarations = [text for text in assumed if text not in includes]
    return "\n".join([*includes, f"namespace {namespace} {{", *declarations, "void snippet() {",
                      f'#line {line} "{name}"', snippet + "}", "}", ""])


def compiles(file, compiler):
    return subprocess.run([*compiler, "-fsyntax-only", str(file)], cwd=ROOT, check=False).returncode == 0


def main():
    patterns = {"pages": PAGES, "headers": HEADERS}[sys.argv[1]]
    folder, compiler = pathlib.Path(sys.argv[2]), sys.argv[3:]
    folder.mkdir(parents=True, exist_ok=True)
    count, failed = 0, 0
    for path in sorted(path for pattern in patterns for path in ROOT.glob(pattern)):
        name = path.relative_to(ROOT).as_posix()
        for number, (line, snippet) in enumerate(blocks_of(name, path.read_text(encoding="utf-8")), 1):
            file = folder / f"{name.replace('/', '_')}_{number}.cpp"
            file.write_text(unit_of(name, line, snippet), encoding="utf-8")
            count += 1
            failed += not compiles(file, compiler)
    print(f"{count} snippets, {failed} of which do not compile")
    return 1 if failed or not count else 0


sys.exit(main())
