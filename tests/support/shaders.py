#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compiles goffer's shader files for what engines use, and validates what comes out as SPIR-V.
   shaders.py packed INCLUDE_FOLDER         packed.glsl and packed.hlsl
   shaders.py deform INCLUDE_FOLDER PAGE    deform.glsl, deform.hlsl, and the shaders that the page shows
   shaders.py clip INCLUDE_FOLDER PAGE      vertex_texture.glsl and .hlsl, and the shaders that the page shows
Exits with 77 where no compiler is installed."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

PACKED = """
{uniforms}
layout(location = 0) in vec4 position;
layout(location = 1) in vec2 octant;
layout(location = 2) in uvec3 words;
{location} out vec3 normal;
#include <goffer/bend/packed.glsl>
void main() {{
    vec3 low = box_low, high = box_high;
    normal = goffer_normal(octant) + goffer_normal(words);
    gl_Position = vec4(goffer_position(position.xyz, low, high) + goffer_position(words, low, high), 1.0);
}}
"""
PACKED_HLSL = """
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
DEFORM = """
{uniforms}
layout(location = 0) in vec4 column;
layout(location = 1) in vec4 wrinkle;
layout(location = 2) in vec3 normal;
layout(location = 3) in vec4 shape;
layout(location = 4) in vec4 tangent;
layout(location = 5) in vec4 joint;
{location} out vec3 results;
#include <goffer/gpu/deform.glsl>
vec4 goffer_row(int row) {{ return rows[row]; }}
void main() {{
    GofferBent bent = goffer_deform(GofferVertex(column, wrinkle, normal, shape, tangent, joint), 0);
    results = bent.normal + bent.tangent.xyz;
    gl_Position = vec4(bent.position, bent.tangent.w);
}}
"""
DEFORM_HLSL = """
StructuredBuffer<float4> rows;
#include <goffer/gpu/deform.hlsl>
float4 goffer_row(int row) { return rows[row]; }
struct In {
    float4 column : COLUMN; float4 wrinkle : WRINKLE; float3 normal : NORMAL; float4 shape : SHAPE;
    float4 tangent : TANGENT; float4 joint : JOINT; uint instance : SV_InstanceID;
};
struct Out { float3 normal : NORMAL; float4 tangent : TANGENT; float4 position : SV_Position; };
Out main(In from) {
    GofferVertex vertex;
    vertex.column = from.column;
    vertex.wrinkle = from.wrinkle;
    vertex.normal = from.normal;
    vertex.shape = from.shape;
    vertex.tangent = from.tangent;
    vertex.joint = from.joint;
    GofferBent bent = goffer_deform(vertex, 17 * int(from.instance));
    Out result;
    result.normal = bent.normal;
    result.tangent = bent.tangent;
    result.position = float4(bent.position, 1.0);
    return result;
}
"""
CLIP = """
{uniforms}
{samplers}
{location} out vec3 normal;
#include <goffer/clip/vertex_texture.glsl>
void main() {{
    GofferClip clip = GofferClip(width, rows_per_frame, low, high, flipped_height);
    GofferFrames at = goffer_frames(frame, frames);
    if (frames > 9) at = goffer_frames_repeated(frame, frames);
    normal = goffer_normal(shares, {vertex}, at, clip) + goffer_normal(steps, {vertex}, at, clip);
    gl_Position = vec4(goffer_position(shares, {vertex}, at, clip) + goffer_position(steps, {vertex}, at, clip), 1.0);
}}
"""
CLIP_HLSL = """
Texture2D<float4> positions;
Texture2D<float4> normals;
#include <goffer/clip/vertex_texture.hlsl>
cbuffer Moment { GofferClip clip; int frames; float frame; };
struct Out { float3 normal : NORMAL; float4 position : SV_Position; };
Out main(uint id : SV_VertexID, float2 number : TEXCOORD1) {
    GofferFrames at = goffer_frames(frame, frames);
    if (frames > 9) at = goffer_frames_repeated(frame, frames);
    Out result;
    result.normal = goffer_normal(normals, int(id), at, clip);
    result.position = float4(goffer_position(positions, goffer_vertex(number.x), at, clip), 1.0);
    return result;
}
"""
VARIABLES = {"packed": "vec3 box_low; vec3 box_high;", "deform": "vec4 rows[34];",
             "clip": "int width; int rows_per_frame; vec3 low; vec3 high; float frame; int frames; int flipped_height;"}
SAMPLERS = ("highp sampler2D shares", "highp usampler2D steps")
MODULES = pathlib.Path(__file__).resolve().parents[2] / "modules"
TARGETS = {"GLSL 3.30": "#version 330 core", "GLSL 4.60": "#version 460 core", "GLSL ES 3.00": "#version 300 es",
           "GLSL ES 3.20": "#version 320 es", "Vulkan": "#version 450"}


def found(name, folder):
    """Where an included file lies: in the folder, or among the headers of the module that it names."""
    if (folder / name).exists():
        return folder / name
    return MODULES / name.split("/")[1] / "include" / name


def included(text, folder):
    """The text with files put in the place of #include lines: not every target knows them."""
    lines = []
    for line in text.splitlines():
        if line.startswith("#include"):
            path = found(line.split(None, 1)[1].strip('<>"'), folder)
            line = included(path.read_text(), path.parent)
        lines.append(line)
    return "\n".join(lines)


def sources(subject, include, page):
    """For each target: a shader's text, its stage, and options of the compiler."""
    text, hlsl = {"packed": (PACKED, PACKED_HLSL), "deform": (DEFORM, DEFORM_HLSL), "clip": (CLIP, CLIP_HLSL)}[subject]
    for name, version in TARGETS.items():
        uniforms = f"layout(set = 0, binding = 0) uniform Block {{ {VARIABLES[subject]} }};"
        if name != "Vulkan":
            uniforms = re.sub(r"(\S+ [^;]+;)", r"uniform \1", VARIABLES[subject])
        where = "layout(location = 0)" if name == "Vulkan" else ""
        bindings = [f"layout(set = 0, binding = {i}) " if name == "Vulkan" else "" for i in (1, 2)]
        samplers = "\n".join(f"{binding}uniform {sampler};" for binding, sampler in zip(bindings, SAMPLERS))
        vertex = "gl_VertexIndex" if name == "Vulkan" else "gl_VertexID"
        filled = version + "\n" + text.format(uniforms=uniforms, samplers=samplers, location=where, vertex=vertex)
        yield name, included(filled, include), "vert", ["-V"] if name == "Vulkan" else []
    if hlsl:
        yield "HLSL", included(hlsl, include), "vert", ["-D", "-V", "-e", "main"]
    shown = re.findall(r"^```(glsl|hlsl)\n(.*?)^```", page.read_text(), re.M | re.S) if page else []
    for number, (language, example) in enumerate(shown):
        stage = "comp" if "local_size_x" in example else "vert"
        options = ["-D", "-V", "-e", "main"] if language == "hlsl" else []
        yield f"{page.name}, {number + 1}", included(example, include), stage, options
    if page and not shown:
        sys.exit(f"{page}: there is no shader in it")


def fails(command, text=None):
    """Whether a command fails, and what it says then."""
    ran = subprocess.run(command, input=text, capture_output=True, text=True, check=False)
    if ran.returncode != 0:
        print(" ".join(command), ran.stdout, ran.stderr, sep="\n")
    return ran.returncode != 0


def main():
    subject, include = sys.argv[1], pathlib.Path(sys.argv[2])
    page = pathlib.Path(sys.argv[3]) if len(sys.argv) > 3 else None
    compiler, validator = shutil.which("glslangValidator"), shutil.which("spirv-val")
    if not compiler or not validator:
        print("skipped: glslangValidator or spirv-val is not here: bash .ci/setup test installs them")
        return 77
    failed = []
    with tempfile.TemporaryDirectory() as folder:
        for name, text, stage, options in sources(subject, include, page):
            module = f"{folder}/module.spv"
            output = ["-o", module] if "-V" in options else []
            bad = fails([compiler, "--stdin", "-S", stage, *options, *output], text)
            if not bad and output:
                bad = fails([validator, module])
            print(name, "fails" if bad else "compiles")
            if bad:
                failed.append(name)
    return 1 if failed else 0


sys.exit(main())
