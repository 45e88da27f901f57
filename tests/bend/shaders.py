#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compiles packed.glsl and packed.hlsl for what engines use, and validates what comes out as SPIR-V.
   shaders.py INCLUDE_FOLDER
Exits with 77 where no compiler is installed."""
import pathlib
import shutil
import subprocess
import sys
import tempfile

GLSL = """
{bounds}
{inputs}
{outputs}
#include <goffer/bend/packed.glsl>
void main() {{
    vec3 low = box_low, high = box_high;
    normal = goffer_normal(octant) + goffer_normal(words);
    gl_Position = vec4(goffer_position(position.xyz, low, high) + goffer_position(words, low, high), 1.0);
}}
"""
UNIFORMS = "uniform vec3 box_low, box_high;"
BLOCK = "layout(set = 0, binding = 0) uniform Box { vec3 box_low; vec3 box_high; };"
INPUTS = """layout(location = 0) in vec4 position;
layout(location = 1) in vec2 octant;
layout(location = 2) in uvec3 words;"""
HLSL = """
cbuffer Box { float3 box_low; float3 box_high; };
#include <goffer/bend/packed.hlsl>
struct Out { float3 normal : NORMAL; float4 position : SV_Position; };
Out main(float4 position : POSITION, float2 octant : NORMAL, uint3 words : WORDS) {
    Out result;
    result.normal = goffer_normal(octant) + goffer_normal(words);
    result.position = float4(goffer_position(position.xyz, box_low, box_high) +
                             goffer_position(words, box_low, box_high), 1.0);
    return result;
}
"""
# name: what comes first, bounds, outputs, options
TARGETS = {
    "GLSL 3.30": ("#version 330 core\n", UNIFORMS, "out vec3 normal;", []),
    "GLSL 4.60": ("#version 460 core\n", UNIFORMS, "out vec3 normal;", []),
    "GLSL ES 3.00": ("#version 300 es\n", UNIFORMS, "out vec3 normal;", []),
    "GLSL ES 3.20": ("#version 320 es\n", UNIFORMS, "out vec3 normal;", []),
    "Vulkan": ("#version 450\n", BLOCK, "layout(location = 0) out vec3 normal;", ["-V"]),
}


def included(text, folder):
    """The text with files put in the place of #include lines: not every target knows them."""
    lines = []
    for line in text.splitlines():
        if line.startswith("#include"):
            path = folder / line.split(None, 1)[1].strip('<>"')
            line = included(path.read_text(), path.parent)
        lines.append(line)
    return "\n".join(lines)


def fails(command, text=None):
    """Whether a command fails, and what it says then."""
    ran = subprocess.run(command, input=text, capture_output=True, text=True, check=False)
    if ran.returncode != 0:
        print(" ".join(command), ran.stdout, ran.stderr, sep="\n")
    return ran.returncode != 0


def main():
    include = pathlib.Path(sys.argv[1])
    compiler, validator = shutil.which("glslangValidator"), shutil.which("spirv-val")
    if not compiler or not validator:
        print("glslangValidator or spirv-val is not here: bash .ci/setup test installs them")
        return 77
    sources = {name: (version + included(GLSL.format(bounds=bounds, inputs=INPUTS, outputs=outputs), include), options)
               for name, (version, bounds, outputs, options) in TARGETS.items()}
    sources["HLSL"] = (included(HLSL, include), ["-D", "-V", "-e", "main"])
    failed = []
    with tempfile.TemporaryDirectory() as folder:
        for name, (text, options) in sources.items():
            module = f"{folder}/module.spv"
            output = ["-o", module] if "-V" in options else []
            bad = fails([compiler, "--stdin", "-S", "vert", *options, *output], text)
            if not bad and output:
                bad = fails([validator, module])
            print(name, "fails" if bad else "compiles")
            if bad:
                failed.append(name)
    return 1 if failed else 0


sys.exit(main())
